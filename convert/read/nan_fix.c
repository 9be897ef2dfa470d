#include "convert/read/nan_fix.h"

#include <math.h>

#include "filters/base/half.h"

static float sample_at(const wf_rows *rows, int channel, int x, int y) {
    size_t at = (size_t)(y - rows->y0) * rows->line_stride + (size_t)(x - rows->x0);
    if (rows->type == WF_HALF)
        return wf_half_value(((const uint16_t *)rows->plane[channel])[at]);
    return ((const float *)rows->plane[channel])[at];
}

static const wf_rows *rows_with(const wf_mend *m, int y) {
    if (y < m->rows.y0) return y >= m->above.y0 && y < m->above.y1 ? &m->above : NULL;
    if (y >= m->rows.y1) return y >= m->below.y0 && y < m->below.y1 ? &m->below : NULL;
    return &m->rows;
}

/* Mean of the finite neighbours, as they were before any was mended. */
static float box3(const wf_mend *m, int channel, int x, int y) {
    double sum = 0;
    int count = 0;
    for (int j = y - 1; j <= y + 1; j++) {
        const wf_rows *rows = rows_with(m, j);
        for (int i = x - 1; rows && i <= x + 1; i++) {
            if (i < rows->x0 || i >= rows->x1) continue;
            float value = sample_at(rows, channel, i, j);
            if (isfinite(value)) sum += (double)value, count++;
        }
    }
    return count ? (float)(sum / count) : 0;
}

static bool mend_pixel(const wf_mend *m, int x, int y, float *const plane[4], size_t at) {
    bool mended = false;
    for (int c = 0; c < m->rows.channels; c++) {
        float value = sample_at(&m->rows, c, x, y);
        bool fine = isfinite(value);
        plane[c][at] = fine ? value : m->how == WF_NAN_BOX3 ? box3(m, c, x, y) : 0;
        mended |= !fine;
    }
    return mended;
}

int64_t wf_mend_rows(const wf_mend *m, float *out) {
    const wf_rows *r = &m->rows;
    size_t width = (size_t)(r->x1 - r->x0), plane_samples = width * (size_t)(r->y1 - r->y0);
    float *const plane[4] = {out, out + plane_samples, out + 2 * plane_samples,
                             out + 3 * plane_samples};
    int64_t mended = 0;
    for (int y = r->y0; y < r->y1; y++)
        for (int x = r->x0; x < r->x1; x++)
            mended +=
                mend_pixel(m, x, y, plane, (size_t)(y - r->y0) * width + (size_t)(x - r->x0));
    return mended;
}

void wf_floats_of_halves(float *out, const void *halves, size_t count) {
    const unsigned char *byte = halves;
    for (size_t i = 0; i < count; i++) {
        uint16_t half;
        memcpy(&half, byte + 2 * i, sizeof half);
        out[i] = wf_half_value(half);
    }
}

bool wf_find_odd(const wf_rows *r, int *x, int *y) {
    for (*y = r->y0; *y < r->y1; ++*y)
        for (*x = r->x0; *x < r->x1; ++*x)
            for (int c = 0; c < r->channels; c++)
                if (!isfinite(sample_at(r, c, *x, *y))) return true;
    return false;
}
