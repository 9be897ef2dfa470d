#ifndef WF_CONVERT_CHECK_MEASURE_FLICKER_H
#define WF_CONVERT_CHECK_MEASURE_FLICKER_H

#include "convert/check/figures.h"
#include "convert/check/screen.h"
#include "filters/seen/seen.h"

/* Interline flicker, what is seen of it, and crawl, of fields as a screen shows them. They are
 * of what is shown, frames of which may come later than signals, and so are no rows of the
 * measurements. NULL: no memory. */

typedef struct wf_flicker wf_flicker;
wf_flicker *wf_flicker_new(const wf_video_info *info, const wf_measure_options *options,
                           int threads);
void wf_flicker_free(wf_flicker *flicker); /* NULL is fine */

/* Looks for what comes and goes in a frame as it is shown; `other` is the one after it, or the
 * one before where it is the last, or NULL where there is no other. What has begun, NULL for
 * nothing, has to be done with (seen.h), by as many threads, before it is counted. */
void wf_flicker_find(wf_flicker *flicker, const wf_signal *frame, const wf_signal *other,
                     const wf_shown *shown);
wf_seen *wf_flicker_begun(const wf_flicker *flicker);
void wf_flicker_count(wf_flicker *flicker);
void wf_flicker_finish(wf_flicker *flicker, wf_figures *figures);

typedef struct wf_crawl wf_crawl;
wf_crawl *wf_crawl_new(const wf_video_info *info, const wf_measure_options *options,
                       int threads);
void wf_crawl_free(wf_crawl *crawl); /* NULL is fine */
void wf_crawl_find(wf_crawl *crawl, const wf_signal *frame, const wf_shown *shown);
wf_seen *wf_crawl_begun(const wf_crawl *crawl);
void wf_crawl_count(wf_crawl *crawl);
void wf_crawl_finish(wf_crawl *crawl, wf_figures *figures);

#endif
