#ifndef WF_CONVERT_FINISH_CREW_H
#define WF_CONVERT_FINISH_CREW_H

#include <pthread.h>
#include <stdatomic.h>

#include "convert/job/job.h"

/* The threads of a run: how work is shared out among them, and how they all learn that one of
 * them has failed or that the job was canceled. Whoever shares work out cuts it into pieces
 * that do not depend on the number of threads, so that the bits of the result do not either. */

/* One thread, as its pieces of work see it. */
typedef struct wf_worker {
    int number;         /* 0 <= number < threads: which of its owner's buffers are its own */
    weft_status status; /* of its first failure */
    weft_error error;
    double source_s, resample_s, color_s; /* seconds that it has spent in each */
} wf_worker;

typedef struct wf_crew {
    weft_job *job; /* whose canceling is heeded, and who is told of progress */
    wf_worker *workers;
    int threads;
    atomic_bool stop;       /* a worker has failed */
    int64_t done, total;    /* frames (or subframes) written, and to be written */
    double began_s, told_s; /* when the run began, and progress was last told of */
    /* After how many frames, of those in hand, the work that is next begins, how many it is,
     * and its pieces. */
    double part, part_share;
    double told_part; /* of the frames in hand, as it was last told */
    int piece_count;
    atomic_int pieces_done;
    struct wf_pool *pool; /* of threads, once there was work for them */
} wf_crew;

/* threads: 0 for what the job asks for. The job must outlive the crew. Whatever the status,
 * wf_crew_free releases it. */
weft_status wf_crew_new(weft_job *job, int threads, wf_crew *crew, weft_error *err);
void wf_crew_free(wf_crew *crew);

/* Calls work(user, worker, n) for 0 <= n < count, in any order, by all workers; `together` of
 * them in a row are handed out at once. What is left is skipped when wf_crew_stopped. */
typedef void wf_crew_work(void *user, wf_worker *worker, int n);
void wf_crew_each(wf_crew *crew, int count, int together, wf_crew_work *work, void *user);

/* The same, one at a time, of which progress is told as wf_crew_part has said. */
void wf_crew_within(wf_crew *crew, int count, wf_crew_work *work, void *user);

/* Calls make(user, worker, n) in any order, by all workers, and take(user, worker, n, made)
 * with what it returned in the order of n, one at a time. What is not made, since the crew has
 * stopped, is taken as NULL. */
typedef void *wf_crew_make(void *user, wf_worker *worker, int n);
typedef void wf_crew_take(void *user, wf_worker *worker, int n, void *made);
void wf_crew_in_order(wf_crew *crew, int count, wf_crew_make *make, wf_crew_take *take,
                      void *user);

/* One thing that is done on a thread of its own beside the workers' work, such as reading ahead
 * or writing, which mostly waits. At rest it is all zeros. */
typedef weft_status wf_aside_work(void *user, weft_error *err);
typedef struct wf_aside {
    wf_aside_work *work;
    void *user;
    pthread_t thread;
    bool begun, apart; /* not ended yet; there was a thread for it */
    weft_status status;
    weft_error error;
} wf_aside;

/* Begins work(user, err), which is not to be looked at until wf_aside_end has waited for it and
 * told how it went. Where no thread can be had it is done at once. Ending what was not begun,
 * or has ended, is fine. One thread begins and ends. */
void wf_aside_begin(wf_aside *aside, wf_aside_work *work, void *user);
weft_status wf_aside_end(wf_aside *aside, weft_error *err);

/* The worker has failed, with the reason in its error; its first failure is kept, and all
 * others stop at their next piece. */
void wf_crew_fail(wf_crew *crew, wf_worker *worker, weft_status status);

/* Whether nothing more should be begun. */
bool wf_crew_stopped(const wf_crew *crew);

/* WEFT_INTERRUPTED, or a worker's failure, or WEFT_OK. Between pieces of work only. */
weft_status wf_crew_status(const wf_crew *crew, weft_error *err);

/* Work on frames begins, or one frame more is done: tells the job's progress function. */
void wf_crew_begin(wf_crew *crew);
void wf_crew_step(wf_crew *crew);

/* What wf_crew_in_order or wf_crew_within is given next begins after `part` frames of those
 * that are being made, and is `share` of one or more: progress is told of within it. */
void wf_crew_part(wf_crew *crew, double part, double share);

/* Tells of progress within a frame, if the last time was long ago; any worker, at any time.
 * within: how much of its piece it has done, 0 to 1. */
void wf_crew_tick(wf_crew *crew, const wf_worker *worker, double within);

/* The seconds of all workers together. */
wf_worker wf_crew_times(const wf_crew *crew);

#endif
