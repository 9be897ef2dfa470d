#ifndef WF_CONVERT_READ_NAN_FIX_H
#define WF_CONVERT_READ_NAN_FIX_H

#include "convert/read/source.h"

/* Rows with NaN and Inf in them. `rows` are those to be fixed; `above` and `below` are the rows
 * beyond them, with y0 == y1 where the picture ends. All have the same columns and channels. */
typedef struct wf_nan_fixer {
    wf_rows rows, above, below;
    wf_nan_fix how; /* WF_NAN_BOX3 or WF_NAN_BLACK */
} wf_nan_fixer;

/* Writes the rows as floats [channels][lines][width] with every sample that is not finite
 * replaced: by the mean of the finite ones among its 3x3 neighbors of the same channel, or 0.
 * Returns how many pixels had any, and in how many of them WF_NAN_BOX3 found no such neighbor
 * and took 0. */
wf_nan_counts wf_nan_fix_rows(const wf_nan_fixer *fixer, float *out);

/* The first pixel that is not finite, in reading order. False if there is none. */
bool wf_find_not_finite(const wf_rows *rows, int *x, int *y);

/* Converts count halves, which need not be aligned. */
void wf_floats_of_halves(float *out, const void *halves, size_t count);

#endif
