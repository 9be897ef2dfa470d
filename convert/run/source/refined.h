#ifndef WF_CONVERT_RUN_SOURCE_REFINED_H
#define WF_CONVERT_RUN_SOURCE_REFINED_H

#include "convert/job/job.h"
#include "convert/read/rate.h"
#include "convert/read/source.h"

/* Sequences of which some subframes exist in a rectangle alone (weft:region). At a pixel only
 * those count that exist there: the cell of one ends where the next of these begins (or, of
 * centered time, halfway to it). So time is cut wherever such a cell ends at any pixel, and in
 * each of these spans every pixel shows one file: a composed picture. */

/* A file of the sequence. */
typedef struct wf_refined_file {
    wf_subframe_ref ref;
    wf_rational time_s;
    wf_box region; /* of the display window */
    bool whole;    /* it has no region, and exists everywhere */
} wf_refined_file;

typedef struct wf_refined {
    wf_refined_file *file; /* ascending in time */
    size_t files;
    bool center;
    /* Spans of time, the units of the source: from edge_s[u] to edge_s[u + 1], with the last
     * file that has begun by the middle of each. */
    wf_rational *edge_s;
    size_t *latest;
    size_t units;
    wf_rational begin_s,
        end_s; /* when the sequence is shown: fields count from its beginning */
} wf_refined;

void wf_refined_free(wf_refined *refined);

/* Looks for regions in the files of a sequence. Where one has any, the sequence becomes that of
 * the spans, each with the file that was latest; absent numbers are not missing, and *shown has
 * the edges. Times are the files' weft:time where all have one, else numbers over the rate that
 * the job or the first file gives, counted from the first number that is selected (with
 * output-frames that do not begin with 0, from 0). refined->units is 0 where no file has a
 * region. WEFT_FAILED if the first subframe is not whole. */
weft_status wf_refine_sequence(const weft_job *job, const wf_image_info *first,
                               wf_sequence *sequence, wf_shown *shown, wf_refined *refined,
                               weft_error *err);

/* Which files a span shows, bottom first: each exists over those before it. At most `most`;
 * more are WEFT_FAILED. */
enum { WF_REFINED_LAYERS = 256 };
weft_status wf_refined_stack(const wf_refined *refined, size_t unit,
                             const wf_refined_file *stack[WF_REFINED_LAYERS], int *count,
                             weft_error *err);

#endif
