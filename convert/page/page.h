/* One self-contained page that shows the fields of video, with what is measured of it. */
#ifndef WF_CONVERT_PAGE_PAGE_H
#define WF_CONVERT_PAGE_PAGE_H

#include <signal.h>

#include "color/codes/display.h"
#include "convert/weft.h"
#include "filters/raster/raster.h"

#define WF_PAGE_MOST_CLIPS 16
#define WF_PAGE_MOST_BYTES 100000000 /* unless more is allowed */

/* A clip to show: finished interlaced or segmented video of any kind that convert/read/video.h
 * opens, but for standard input, as it is read twice. */
typedef struct wf_page_clip {
    const char *path;  /* NULL where make_clip says it */
    const char *label; /* for people; NULL: the file's name */
} wf_page_clip;

/* How far a clip is that is made for the page: a part from 0 to 1, and its frames. */
typedef void wf_page_step_fn(double part, int64_t frames, void *user);

/* Makes clip `number` when its turn has come, and says where it is until the next is made.
 * People know it by its label, which errors call it. */
typedef weft_status wf_page_make_fn(void *user, size_t number, wf_page_step_fn *step,
                                    void *step_user, const char **path, weft_error *err);

typedef struct wf_page_request {
    const wf_page_clip *clip;
    size_t clips;                /* 1 to WF_PAGE_MOST_CLIPS; all of one size and rate */
    const char *title;           /* NULL: made of the labels */
    const wf_raster *raster;     /* what they are; NULL: as they say */
    const wf_transfer *transfer; /* of the display they are made for; NULL: as they say */
    int64_t first, count;        /* frames to show and to measure; count 0: all from first on */
    size_t max_bytes;            /* of the page */
    size_t max_memory_bytes;     /* of a picture in hand */
    bool overwrite;              /* a page that is there */
    wf_page_make_fn *make_clip;  /* NULL: clips are there, and all are looked at first */
    void *make_user;
    const volatile sig_atomic_t *canceled; /* not 0: to stop soon; NULL: never */
    weft_progress_fn *progress; /* called after every frame that is measured or packed; NULL */
    void *progress_user;
    weft_warning_fn *warning; /* what is guessed or left out; NULL */
    void *warning_user;
} wf_page_request;

/* Writes the page to a file, which is whole or absent. WEFT_USAGE where clips cannot be
 * compared or are not interlaced, WEFT_FAILED where one cannot be read or the page would be
 * larger than max_bytes. */
weft_status wf_page_make(const wf_page_request *request, const char *path, weft_error *err);

/* Whether the page's name is one that would be written: it ends in .html, and nothing is there
 * unless it may be replaced. Asked before long work. */
weft_status wf_page_check_name(const char *path, bool overwrite, weft_error *err);

#endif
