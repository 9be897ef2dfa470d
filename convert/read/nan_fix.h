#ifndef WF_CONVERT_READ_NAN_FIX_H
#define WF_CONVERT_READ_NAN_FIX_H

#include "convert/read/source.h"

/* Rows with NaN and Inf in them. `rows` are those to be mended; `above` and `below` are the
 * rows beyond them, with y0 == y1 where the picture ends. All have the same columns and
 * channels. */
typedef struct wf_mend {
    wf_rows rows, above, below;
    wf_nan_fix how; /* box3 or black */
} wf_mend;

/* Writes the rows as floats [channels][lines][width] with every sample that is not finite
 * replaced: by the mean of the finite ones among its 3x3 neighbours of the same channel, or 0.
 * Returns how many pixels had any. */
int64_t wf_mend_rows(const wf_mend *mend, float *out);

/* The first pixel that is not finite, in reading order. False if there is none. */
bool wf_find_odd(const wf_rows *rows, int *x, int *y);

/* Converts count halves, which need not be aligned. */
void wf_floats_of_halves(float *out, const void *halves, size_t count);

#endif
