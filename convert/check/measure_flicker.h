#ifndef WF_CONVERT_CHECK_MEASURE_FLICKER_H
#define WF_CONVERT_CHECK_MEASURE_FLICKER_H

#include "convert/check/figures.h"
#include "convert/check/screen.h"

/* Interline flicker, what is seen of it, and crawl, of fields as a screen shows them. They are
 * of what is shown, frames of which may come later than signals, and so are no rows of the
 * measurements. NULL: no memory. */

typedef struct wf_flicker wf_flicker;
wf_flicker *wf_flicker_new(const wf_video_info *info, const wf_measure_options *options);
void wf_flicker_free(wf_flicker *flicker); /* NULL is fine */

/* A frame and how it is shown; `other` is the one after it, or the one before where it is the
 * last, or NULL where there is no other. */
void wf_flicker_add(wf_flicker *flicker, const wf_signal *frame, const wf_signal *other,
                    const wf_shown *shown);
void wf_flicker_finish(wf_flicker *flicker, wf_figures *figures);

typedef struct wf_crawl wf_crawl;
wf_crawl *wf_crawl_new(const wf_video_info *info, const wf_measure_options *options);
void wf_crawl_free(wf_crawl *crawl); /* NULL is fine */
void wf_crawl_add(wf_crawl *crawl, const wf_signal *frame, const wf_shown *shown);
void wf_crawl_finish(wf_crawl *crawl, wf_figures *figures);

#endif
