#ifndef WF_CONVERT_FINISH_NEAREST_H
#define WF_CONVERT_FINISH_NEAREST_H

#include "color/codes/displayed.h"
#include "convert/finish/crew.h"
#include "convert/job/report.h"
#include "filters/least/least.h"
#include "filters/seen/seen.h"

/* Fields whose flicker is weighed or bounded: lines of all the frame at a field's instant come
 * in, the nearest picture is found (filters/least), and the field's own lines of it go out. */

/* How a job holds flicker. Zeroed: it does not. */
typedef struct wf_nearest_desc {
    bool held;
    double weight, limit; /* filters/least/least.h */
    bool limit_is_seen;   /* limit is in just noticeable differences, for: */
    wf_viewing viewing;
    bool channels; /* R, G, B and alpha alike, as linear light; else luminance as shown */
    wf_displayed shown;
    const wf_raster *raster; /* which lines are a field's own */
    int fields;              /* that are in hand at once */
} wf_nearest_desc;

typedef struct wf_nearest wf_nearest;

/* The crew must outlive it. */
weft_status wf_nearest_new(wf_crew *crew, const wf_nearest_desc *desc, wf_nearest **out,
                           weft_error *err);
void wf_nearest_free(wf_nearest *nearest); /* NULL is fine */
size_t wf_nearest_bytes(const wf_nearest_desc *desc, int threads);

/* Takes frame line `line` of a field: R'G'B' as it would be written, or, of channels, light;
 * and alpha. rgb is spoiled. Any worker, any line, once each. */
void wf_nearest_put(wf_nearest *nearest, const wf_worker *worker, int64_t field, int line,
                    float *const rgb[3], const float *alpha);

/* Finds the field's nearest picture, when all its lines are there. A column that is not proved
 * to be it is an error. By the one thread that owns the crew. */
weft_status wf_nearest_solve(wf_nearest *nearest, int64_t field, weft_error *err);

/* Frame line `line` of it, one of the field's own, as it was put in. Any worker; after
 * wf_nearest_solve, until the field after the next `fields` is put in. */
void wf_nearest_take(const wf_nearest *nearest, const wf_worker *worker, int64_t field,
                     int line, float *const rgb[3], float *alpha);

/* Adds what was done to the report. */
void wf_nearest_tell(const wf_nearest *nearest, wf_report *report);

#endif
