/* The threads of a run: every piece of work is done once, results are taken in order, and a
 * failure or a canceled job stops all of them, with any number of threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "convert/finish/crew.h"

#define PIECES 100

/* What the pieces of work see. */
typedef struct pieces {
    atomic_int done[PIECES];
    int taken, missing; /* taken so far; of these NULL */
    int fails_at;       /* -1: none */
    wf_crew crew;
} pieces;

static void begin(pieces *p, weft_job *job, int threads, int fails_at) {
    memset(p, 0, sizeof *p);
    p->fails_at = fails_at;
    assert_int_equal(wf_crew_new(job, threads, &p->crew, NULL), WEFT_OK);
    assert_int_equal(p->crew.threads, threads);
}

static void work(void *user, wf_worker *worker, int n) {
    pieces *p = user;
    p->done[n]++;
    worker->source_s += 1;
    if (n == p->fails_at)
        wf_crew_fail(&p->crew, worker, wf_fail(&worker->error, WEFT_FAILED, "piece %d", n));
}

static void *make(void *user, wf_worker *worker, int n) {
    pieces *p = user;
    work(user, worker, n);
    return &p->done[n];
}

static void take(void *user, wf_worker *worker, int n, void *made) {
    pieces *p = user;
    (void)worker;
    assert_int_equal(n, p->taken++);
    if (!made) p->missing++;
}

static const int threads[] = {1, 2, 3, 8};
enum { TRIES = sizeof threads / sizeof *threads };

static void all_once(void **state) {
    weft_job *job = *state;
    for (int t = 0; t < TRIES; t++) {
        pieces p;
        begin(&p, job, threads[t], -1);
        wf_crew_each(&p.crew, PIECES, 4, work, &p);
        wf_crew_in_order(&p.crew, PIECES, make, take, &p);
        for (int n = 0; n < PIECES; n++) assert_int_equal(p.done[n], 2);
        assert_int_equal(p.taken, PIECES);
        assert_int_equal(p.missing, 0);
        assert_int_equal(wf_crew_status(&p.crew, NULL), WEFT_OK);
        assert_true(wf_crew_times(&p.crew).source_s == 2 * PIECES);
        wf_crew_free(&p.crew);
    }
}

/* Whatever is not made is still taken, so that its order does not break. */
static void failures(void **state) {
    weft_job *job = *state;
    for (int t = 0; t < TRIES; t++) {
        pieces p;
        weft_error err;
        begin(&p, job, threads[t], 5);
        wf_crew_in_order(&p.crew, PIECES, make, take, &p);
        assert_int_equal(p.taken, PIECES);
        assert_true(p.missing > 0);
        assert_true(wf_crew_stopped(&p.crew));
        assert_int_equal(wf_crew_status(&p.crew, &err), WEFT_FAILED);
        assert_string_equal(err.text, "piece 5");
        int before = p.done[PIECES - 1];
        wf_crew_each(&p.crew, PIECES, 1, work, &p);
        assert_int_equal(p.done[PIECES - 1], before);
        wf_crew_free(&p.crew);
    }
}

static void canceling(void **state) {
    weft_job *job = *state;
    pieces p;
    begin(&p, job, 2, -1);
    weft_job_cancel(job);
    wf_crew_each(&p.crew, PIECES, 1, work, &p);
    for (int n = 0; n < PIECES; n++) assert_int_equal(p.done[n], 0);
    assert_int_equal(wf_crew_status(&p.crew, NULL), WEFT_INTERRUPTED);
    wf_crew_free(&p.crew);
}

/* What is beside the work has its own failures, and may be ended however often. */
static weft_status count_to(void *user, weft_error *err) {
    int *n = user;
    ++*n;
    return *n < 3 ? WEFT_OK : wf_fail(err, WEFT_FAILED, "number %d", *n);
}

static void asides(void **state) {
    (void)state;
    wf_aside aside = {0};
    weft_error err;
    int n = 0;
    assert_int_equal(wf_aside_end(&aside, &err), WEFT_OK);
    for (int i = 1; i < 3; i++) {
        wf_aside_begin(&aside, count_to, &n);
        assert_int_equal(wf_aside_end(&aside, &err), WEFT_OK);
        assert_int_equal(n, i);
    }
    wf_aside_begin(&aside, count_to, &n);
    assert_int_equal(wf_aside_end(&aside, &err), WEFT_FAILED);
    assert_string_equal(err.text, "number 3");
    assert_int_equal(wf_aside_end(&aside, &err), WEFT_OK);
}

static void count_steps(const weft_progress *progress, void *user) {
    int64_t *seen = user;
    assert_int_equal(progress->frames_done, ++*seen);
    assert_int_equal(progress->frames_total, 3);
    assert_string_equal(progress->stage, "convert");
}

static void progress(void **state) {
    weft_job *job = *state;
    int64_t seen = 0;
    pieces p;
    begin(&p, job, 1, -1);
    weft_job_on_progress(job, count_steps, &seen);
    p.crew.total = 3;
    for (int n = 0; n < 3; n++) wf_crew_step(&p.crew);
    assert_int_equal(seen, 3);
    wf_crew_free(&p.crew);
}

static int new_job(void **state) {
    *state = weft_job_new();
    return *state ? 0 : -1;
}

static int free_job(void **state) {
    weft_job_free(*state);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(all_once, new_job, free_job),
        cmocka_unit_test_setup_teardown(failures, new_job, free_job),
        cmocka_unit_test(asides),
        cmocka_unit_test_setup_teardown(canceling, new_job, free_job),
        cmocka_unit_test_setup_teardown(progress, new_job, free_job),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
