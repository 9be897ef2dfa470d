/* The threads of a run: the only file that starts any, and the one place where failures,
 * cancelling and progress meet. */
#include "convert/finish/crew.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>

#include "convert/base/clock.h"

weft_status wf_crew_new(weft_job *job, int threads, wf_crew *crew, weft_error *err) {
    int asked = threads > 0 ? threads : job->threads;
    *crew = (wf_crew){.job = job, .began_s = wf_now_s()};
    crew->told_s = crew->began_s;
    crew->threads = asked > 0 ? asked : omp_get_num_procs();
    crew->workers = calloc((size_t)crew->threads, sizeof *crew->workers);
    if (!crew->workers)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for %d threads", crew->threads);
    for (int t = 0; t < crew->threads; t++) crew->workers[t].number = t;
    return WEFT_OK;
}

void wf_crew_free(wf_crew *crew) {
    free(crew->workers);
    *crew = (wf_crew){0};
}

/* ---- Work ---- */

void wf_crew_each(wf_crew *crew, int count, int together, wf_crew_work *work, void *user) {
#pragma omp parallel for num_threads(crew->threads) schedule(dynamic, together)
    for (int n = 0; n < count; n++)
        if (!wf_crew_stopped(crew)) work(user, &crew->workers[omp_get_thread_num()], n);
}

void wf_crew_in_order(wf_crew *crew, int count, wf_crew_make *make, wf_crew_take *take,
                      void *user) {
    crew->piece_count = count;
    atomic_store(&crew->pieces_done, 0);
#pragma omp parallel for num_threads(crew->threads) schedule(dynamic, 1) ordered
    for (int n = 0; n < count; n++) {
        wf_worker *worker = &crew->workers[omp_get_thread_num()];
        void *made = wf_crew_stopped(crew) ? NULL : make(user, worker, n);
#pragma omp ordered
        take(user, worker, n, made);
        atomic_fetch_add(&crew->pieces_done, 1);
        wf_crew_tick(crew, worker);
    }
}

/* ---- How it stands ---- */

void wf_crew_fail(wf_crew *crew, wf_worker *worker, weft_status status) {
    if (!worker->status) worker->status = status;
    atomic_store(&crew->stop, true);
}

bool wf_crew_stopped(const wf_crew *crew) {
    return atomic_load(&crew->stop) || crew->job->cancelled;
}

weft_status wf_crew_status(const wf_crew *crew, weft_error *err) {
    if (crew->job->cancelled) return wf_fail(err, WEFT_INTERRUPTED, "interrupted");
    for (int t = 0; t < crew->threads; t++)
        if (crew->workers[t].status)
            return wf_fail(err, crew->workers[t].status, "%s", crew->workers[t].error.text);
    return WEFT_OK;
}

static void tell(wf_crew *crew, double part) {
    if (!crew->job->progress) return;
    crew->told_s = wf_now_s();
    const weft_progress progress = {crew->done, crew->total, crew->told_s - crew->began_s,
                                    wf_command_name(crew->job->command), part};
    crew->job->progress(&progress, crew->job->progress_user);
}

void wf_crew_step(wf_crew *crew) {
    crew->done++;
    crew->part = crew->part_share = 0;
    tell(crew, 0);
}

void wf_crew_part(wf_crew *crew, double part, double share) {
    crew->part = part;
    crew->part_share = share;
}

/* Seconds between two times that progress within a frame is told of. */
#define TICK_S 0.25

/* The first worker is the thread that called. */
void wf_crew_tick(wf_crew *crew, const wf_worker *worker) {
    if (worker->number || !(crew->part_share > 0) || wf_now_s() - crew->told_s < TICK_S) return;
    double done = (double)atomic_load(&crew->pieces_done) / fmax(crew->piece_count, 1);
    tell(crew, fmin(crew->part + crew->part_share * done, 1));
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
