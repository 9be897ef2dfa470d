/* Lines of gathered samples, and what fills the pixels that no sample reached. */
#include "convert/run/sum/gathered_line.h"

#include <inttypes.h>

static weft_status fill(const wf_gathered_line *l, int first, float *const rgb[3],
                        int64_t *filled, weft_error *err) {
    for (int i = first; i < l->job->raster.width_px; i++) {
        float nearest[4];
        if (wf_gather_reached(l->gather, l->line, i)) continue;
        if (!wf_gather_nearest(l->gather, l->line, i, nearest))
            return wf_fail(err, WEFT_FAILED, "field %" PRId64 ": no sample reached it",
                           l->field);
        for (int c = 0; c < 3; c++) rgb[c][i] = nearest[c];
        if (l->alpha) l->alpha[i] = nearest[3];
        ++*filled;
    }
    return WEFT_OK;
}

weft_status wf_gathered_finish(const wf_gathered_line *l, float *const rgb[3], int64_t *filled,
                               weft_error *err) {
    int first = wf_gather_line(l->gather, l->line, rgb);
    if (l->alpha) wf_gather_alpha(l->gather, l->line, l->alpha);
    if (first < 0) return WEFT_OK;
    if (l->job->on_empty == WF_EMPTY_NEAREST) return fill(l, first, rgb, filled, err);
    return wf_fail(err, WEFT_FAILED,
                   "field %" PRId64 ", line %d, pixel %d: no sample reached it; give more "
                   "samples, or %s%s",
                   l->field, l->called, first, l->remedy,
                   l->job->raster.all_lines
                       ? " (flicker is held on all lines of a frame at a field's instant, so "
                         "each of them needs samples)"
                       : "");
}
