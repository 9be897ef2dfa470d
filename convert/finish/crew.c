/* The threads of a run: the only file that starts any, and the one place where failures,
 * canceling and progress meet. */
#include "convert/finish/crew.h"

#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdlib.h>

#include "convert/base/clock.h"

/* Threads wait for work without spinning: whoever reads video has threads of its own, which
 * would have to wait for those that spin. */
struct wf_pool {
    pthread_mutex_t lock;
    pthread_cond_t begun, done, taken; /* of in_order, `taken` */
    pthread_t *thread;
    struct helper *helper;
    int helpers, busy;
    int64_t round; /* of work: each helper takes part in each once */
    bool ends;
    void (*run)(void *what, wf_worker *worker);
    void *what;
};

typedef struct helper {
    struct wf_pool *pool;
    wf_worker *worker;
} helper;

static int processors(void) {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set)) return 1;
    return CPU_COUNT(&set);
}

weft_status wf_crew_new(weft_job *job, int threads, wf_crew *crew, weft_error *err) {
    int asked = threads > 0 ? threads : job->threads;
    *crew = (wf_crew){.job = job, .began_s = wf_now_s()};
    crew->told_s = crew->began_s;
    crew->threads = asked > 0 ? asked : processors();
    crew->workers = calloc((size_t)crew->threads, sizeof *crew->workers);
    if (!crew->workers)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for %d threads", crew->threads);
    for (int t = 0; t < crew->threads; t++) crew->workers[t].number = t;
    return WEFT_OK;
}

/* ---- The threads ---- */

static void *help(void *user) {
    const helper *h = user;
    struct wf_pool *p = h->pool;
    pthread_mutex_lock(&p->lock);
    for (int64_t seen = 0;;) {
        while (!p->ends && p->round == seen) pthread_cond_wait(&p->begun, &p->lock);
        if (p->ends) break;
        seen = p->round;
        pthread_mutex_unlock(&p->lock);
        p->run(p->what, h->worker);
        pthread_mutex_lock(&p->lock);
        if (!--p->busy) pthread_cond_signal(&p->done);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

static void free_pool(struct wf_pool *p) {
    if (!p) return;
    pthread_mutex_lock(&p->lock);
    p->ends = true;
    pthread_cond_broadcast(&p->begun);
    pthread_mutex_unlock(&p->lock);
    for (int t = 0; t < p->helpers; t++) pthread_join(p->thread[t], NULL);
    pthread_cond_destroy(&p->taken);
    pthread_cond_destroy(&p->done);
    pthread_cond_destroy(&p->begun);
    pthread_mutex_destroy(&p->lock);
    free(p->thread);
    free(p->helper);
    free(p);
}

/* As many helpers as can be had: with none the caller does all the work. */
static struct wf_pool *pool_of(wf_crew *crew) {
    struct wf_pool *p = crew->pool;
    if (p) return p;
    p = crew->pool = calloc(1, sizeof *p);
    if (!p) return NULL;
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->begun, NULL);
    pthread_cond_init(&p->done, NULL);
    pthread_cond_init(&p->taken, NULL);
    p->thread = calloc((size_t)crew->threads, sizeof *p->thread);
    p->helper = calloc((size_t)crew->threads, sizeof *p->helper);
    for (int t = 1; p->thread && p->helper && t < crew->threads; t++) {
        helper *h = &p->helper[p->helpers];
        *h = (helper){p, &crew->workers[t]};
        if (pthread_create(&p->thread[p->helpers], NULL, help, h)) break;
        p->helpers++;
    }
    return p;
}

void wf_crew_free(wf_crew *crew) {
    free_pool(crew->pool);
    free(crew->workers);
    *crew = (wf_crew){0};
}

/* Has all workers run, and waits for them. */
static void all_run(wf_crew *crew, void (*run)(void *what, wf_worker *worker), void *what) {
    struct wf_pool *p = crew->threads > 1 ? pool_of(crew) : NULL;
    if (p) {
        pthread_mutex_lock(&p->lock);
        p->run = run;
        p->what = what;
        p->busy = p->helpers;
        p->round++;
        pthread_cond_broadcast(&p->begun);
        pthread_mutex_unlock(&p->lock);
    }
    run(what, &crew->workers[0]);
    if (!p) return;
    pthread_mutex_lock(&p->lock);
    while (p->busy) pthread_cond_wait(&p->done, &p->lock);
    pthread_mutex_unlock(&p->lock);
}

/* ---- Work ---- */

typedef struct pieces {
    wf_crew *crew;
    atomic_int next;
    int count, together;
    wf_crew_work *work;
    wf_crew_make *make;
    wf_crew_take *take;
    int taken; /* under the pool's lock */
    void *user;
} pieces;

static void run_pieces(void *what, wf_worker *worker) {
    pieces *p = what;
    for (int first; (first = atomic_fetch_add(&p->next, p->together)) < p->count;)
        for (int n = first; n < p->count && n < first + p->together; n++)
            if (!wf_crew_stopped(p->crew)) p->work(p->user, worker, n);
}

/* One piece more of work of which progress is told is done. */
static void tell_piece(wf_crew *crew, const wf_worker *worker) {
    atomic_fetch_add(&crew->pieces_done, 1);
    wf_crew_tick(crew, worker, 0);
}

static void all_run_told(wf_crew *crew, void (*run)(void *what, wf_worker *worker), pieces *p) {
    crew->piece_count = p->count;
    atomic_store(&crew->pieces_done, 0);
    all_run(crew, run, p);
}

static void run_told(void *what, wf_worker *worker) {
    pieces *p = what;
    for (int n; (n = atomic_fetch_add(&p->next, 1)) < p->count;) {
        if (!wf_crew_stopped(p->crew)) p->work(p->user, worker, n);
        tell_piece(p->crew, worker);
    }
}

void wf_crew_each(wf_crew *crew, int count, int together, wf_crew_work *work, void *user) {
    pieces p = {.crew = crew, .count = count, .together = together, .work = work, .user = user};
    if (count > together)
        all_run(crew, run_pieces, &p);
    else
        run_pieces(&p, &crew->workers[0]);
}

void wf_crew_within(wf_crew *crew, int count, wf_crew_work *work, void *user) {
    pieces p = {.crew = crew, .count = count, .work = work, .user = user};
    all_run_told(crew, run_told, &p);
}

static void take_in_turn(pieces *p, wf_worker *worker, int n, void *made) {
    struct wf_pool *pool = p->crew->pool;
    if (pool) {
        pthread_mutex_lock(&pool->lock);
        while (p->taken < n) pthread_cond_wait(&pool->taken, &pool->lock);
        pthread_mutex_unlock(&pool->lock);
    }
    p->take(p->user, worker, n, made);
    if (!pool) return;
    pthread_mutex_lock(&pool->lock);
    p->taken++;
    pthread_cond_broadcast(&pool->taken);
    pthread_mutex_unlock(&pool->lock);
}

static void run_in_order(void *what, wf_worker *worker) {
    pieces *p = what;
    for (int n; (n = atomic_fetch_add(&p->next, 1)) < p->count;) {
        void *made = wf_crew_stopped(p->crew) ? NULL : p->make(p->user, worker, n);
        take_in_turn(p, worker, n, made);
        tell_piece(p->crew, worker);
    }
}

void wf_crew_in_order(wf_crew *crew, int count, wf_crew_make *make, wf_crew_take *take,
                      void *user) {
    pieces p = {.crew = crew, .count = count, .make = make, .take = take, .user = user};
    all_run_told(crew, run_in_order, &p);
}

/* ---- Beside the work ---- */

static void *do_aside(void *user) {
    wf_aside *a = user;
    a->status = a->work(a->user, &a->error);
    return NULL;
}

void wf_aside_begin(wf_aside *a, wf_aside_work *work, void *user) {
    a->work = work;
    a->user = user;
    a->status = WEFT_OK;
    a->begun = true;
    a->apart = !pthread_create(&a->thread, NULL, do_aside, a);
    if (!a->apart) do_aside(a);
}

weft_status wf_aside_end(wf_aside *a, weft_error *err) {
    if (!a->begun) return WEFT_OK;
    if (a->apart) pthread_join(a->thread, NULL);
    a->begun = a->apart = false;
    return a->status ? wf_fail(err, a->status, "%s", a->error.text) : WEFT_OK;
}

/* ---- How it stands ---- */

void wf_crew_fail(wf_crew *crew, wf_worker *worker, weft_status status) {
    if (!worker->status) worker->status = status;
    atomic_store(&crew->stop, true);
}

bool wf_crew_stopped(const wf_crew *crew) {
    return atomic_load(&crew->stop) || crew->job->canceled;
}

weft_status wf_crew_status(const wf_crew *crew, weft_error *err) {
    if (crew->job->canceled) return wf_fail(err, WEFT_INTERRUPTED, "interrupted");
    for (int t = 0; t < crew->threads; t++)
        if (crew->workers[t].status)
            return wf_fail(err, crew->workers[t].status, "%s", crew->workers[t].error.text);
    return WEFT_OK;
}

static void tell(wf_crew *crew) {
    if (!crew->job->progress) return;
    crew->told_s = wf_now_s();
    const weft_progress progress = {.frames_done = crew->done,
                                    .frames_total = crew->total,
                                    .seconds = crew->told_s - crew->began_s,
                                    .stage = wf_command_name(crew->job->command),
                                    .frame_part = fmin(crew->told_part, 1),
                                    .frames_made = (double)crew->done + crew->told_part};
    crew->job->progress(&progress, crew->job->progress_user);
}

void wf_crew_begin(wf_crew *crew) {
    tell(crew);
}

/* Frames that are made together are done one after the other. */
void wf_crew_step(wf_crew *crew) {
    crew->done++;
    crew->part = crew->part_share = 0;
    crew->told_part = fmax(crew->told_part - 1, 0);
    tell(crew);
}

void wf_crew_part(wf_crew *crew, double part, double share) {
    crew->part = part;
    crew->part_share = share;
}

/* Seconds between two times that progress within a frame is told of. */
#define TICK_S 0.25

/* The first worker is the thread that called. The others are as far with their pieces as it is,
 * about; what has been told once is not taken back. */
void wf_crew_tick(wf_crew *crew, const wf_worker *worker, double within) {
    if (worker->number || !(crew->part_share > 0) || wf_now_s() - crew->told_s < TICK_S) return;
    double done = atomic_load(&crew->pieces_done) + within * crew->threads;
    double share = fmin(done / fmax(crew->piece_count, 1), 1);
    crew->told_part = fmax(crew->told_part, crew->part + crew->part_share * share);
    tell(crew);
}

wf_worker wf_crew_times(const wf_crew *crew) {
    wf_worker sum = {0};
    for (int t = 0; t < crew->threads; t++) {
        sum.source_s += crew->workers[t].source_s;
        sum.resample_s += crew->workers[t].resample_s;
        sum.color_s += crew->workers[t].color_s;
    }
    return sum;
}
