#ifndef WF_CONVERT_PLAN_PLAN_H
#define WF_CONVERT_PLAN_PLAN_H

#include "convert/job/job.h"
#include "convert/media/image.h"
#include "filters/resample/resampler.h"

/* What a renderer has to make for the frames of a job, before any of it is there. */

/* A plan holds at most this many subframes. */
#define WF_PLAN_MOST 1000000

typedef struct wf_plan_subframe {
    int64_t number; /* k: it is of the time k / rate */
    wf_box region;  /* of its pixels that are wanted, half-open */
} wf_plan_subframe;

/* What all subframes have in common, and which of them some window meets. */
typedef struct wf_plan {
    const weft_job *asked; /* the caller's, which may be canceled */
    weft_job job;     /* as it was asked, with its cadence settled; borrows what the job owns */
    wf_rational rate; /* subframes a second of the scene's time */
    wf_rational shown_rate; /* and of the video's: film runs .1 % slower or faster */
    int width_px, lines;    /* of a subframe */
    wf_rational pixel_aspect;
    int64_t first_field, end_field;
    wf_box reach;    /* pixels of a subframe that some aperture meets; may lie outside it */
    int64_t samples; /* a pixel, of a subframe; 0: not asked for */
    wf_resampler *resampler;
    wf_plan_subframe *subframe; /* ascending */
    size_t count;
} wf_plan;

/* Makes the plan of a job's options raster, frames, subframe-rate, aperture and so on.
 * WEFT_USAGE where they make no sense. Warns by the job. wf_plan_free releases it whatever the
 * status. */
weft_status wf_plan_make(const weft_job *job, wf_plan *plan, weft_error *err);
void wf_plan_free(wf_plan *plan);

/* The time of a subframe, in seconds of the scene. */
wf_rational wf_plan_time(const wf_plan *plan, int64_t number);

/* Whether the job's plan can be told in a format: one of WF_PLAN_FORMATS, and none that renders
 * where rectangles are wanted. WEFT_USAGE for others. */
#define WF_PLAN_FORMATS "text|json|csv|blender|povray|houdini"
weft_status wf_plan_check_format(const weft_job *job, const char *format, weft_error *err);

/* A plan as text of such a format; the caller's, free(). */
weft_status wf_plan_tell(const wf_plan *plan, const char *format, char **text, weft_error *err);

#endif
