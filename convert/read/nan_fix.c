/* Replaces samples that are not finite, so that one bad pixel of a renderer does not spread
 * over every pixel whose aperture reaches it. */
#include "convert/read/nan_fix.h"

#include <math.h>

#include "filters/base/half.h"

static float sample_at(const wf_rows *rows, int channel, int x, int y) {
    size_t at = (size_t)(y - rows->y0) * rows->line_stride + (size_t)(x - rows->x0);
    if (rows->type == WF_HALF)
        return wf_half_value(((const uint16_t *)rows->plane[channel])[at]);
    return ((const float *)rows->plane[channel])[at];
}

static const wf_rows *rows_with(const wf_nan_fixer *f, int y) {
    if (y < f->rows.y0) return y >= f->above.y0 && y < f->above.y1 ? &f->above : NULL;
    if (y >= f->rows.y1) return y >= f->below.y0 && y < f->below.y1 ? &f->below : NULL;
    return &f->rows;
}

/* Mean of the finite neighbors, as they were before any was replaced. */
static float box3(const wf_nan_fixer *f, int channel, int x, int y, bool *alone) {
    double sum = 0;
    int count = 0;
    for (int j = y - 1; j <= y + 1; j++) {
        const wf_rows *rows = rows_with(f, j);
        for (int i = x - 1; rows && i <= x + 1; i++) {
            if (i < rows->x0 || i >= rows->x1) continue;
            float value = sample_at(rows, channel, i, j);
            if (isfinite(value)) sum += (double)value, count++;
        }
    }
    *alone |= !count;
    return count ? (float)(sum / count) : 0;
}

static void fix_pixel(const wf_nan_fixer *f, int x, int y, float *const plane[4], size_t at,
                      wf_nan_counts *counts) {
    bool fixed = false, alone = false;
    for (int c = 0; c < f->rows.channels; c++) {
        float value = sample_at(&f->rows, c, x, y);
        bool fine = isfinite(value);
        plane[c][at] = fine ? value : f->how == WF_NAN_BOX3 ? box3(f, c, x, y, &alone) : 0;
        fixed |= !fine;
    }
    counts->fixed += fixed;
    counts->alone += alone;
}

wf_nan_counts wf_nan_fix_rows(const wf_nan_fixer *f, float *out) {
    const wf_rows *r = &f->rows;
    size_t width = (size_t)(r->x1 - r->x0), plane_samples = width * (size_t)(r->y1 - r->y0);
    float *const plane[4] = {out, out + plane_samples, out + 2 * plane_samples,
                             out + 3 * plane_samples};
    wf_nan_counts counts = {0, 0};
    for (int y = r->y0; y < r->y1; y++)
        for (int x = r->x0; x < r->x1; x++)
            fix_pixel(f, x, y, plane, (size_t)(y - r->y0) * width + (size_t)(x - r->x0),
                      &counts);
    return counts;
}

void wf_floats_of_halves(float *out, const void *halves, size_t count) {
    const unsigned char *byte = halves;
    for (size_t i = 0; i < count; i++) {
        uint16_t half;
        memcpy(&half, byte + 2 * i, sizeof half);
        out[i] = wf_half_value(half);
    }
}

bool wf_find_not_finite(const wf_rows *r, int *x, int *y) {
    for (*y = r->y0; *y < r->y1; ++*y)
        for (*x = r->x0; *x < r->x1; ++*x)
            for (int c = 0; c < r->channels; c++)
                if (!isfinite(sample_at(r, c, *x, *y))) return true;
    return false;
}
