/* Differences from a reference: plane by plane, whole frames and each field by itself. */
#include "convert/check/measure_difference.h"

#include <math.h>
#include <stdlib.h>

#include "color/codes/levels.h"

/* Structural similarity (Wang, Bovik, Sheikh and Simoncelli, 2004, equation 13) over square
 * windows that overlap by half; samples reach from 0 to 1. */
#define WINDOW 8
#define STEP   4
#define C1     (0.01 * 0.01)
#define C2     (0.03 * 0.03)

typedef enum lines_of { FRAME, TOP, BOTTOM } lines_of;

typedef struct sums {
    double squares, samples;
    double similarity, windows;
} sums;

struct wf_difference {
    wf_layout layout;
    int planes;
    double scale[3], offset[3]; /* signal * scale + offset is a share of the largest code */
    sums sum[3][3];             /* [plane][lines_of] */
};

wf_difference *wf_difference_new(const wf_video_info *info) {
    wf_difference *d = calloc(1, sizeof *d);
    if (!d) return NULL;
    const wf_encoding e = {
        .ycbcr = info->layout == WF_YCBCR, .full_range = info->full_range, .bits = info->bits};
    d->layout = info->layout;
    d->planes = info->planes;
    for (int p = 0; p < 3; p++) {
        double zero = 0, unit = 1, most = 1;
        if (info->layout == WF_YCBCR) {
            wf_code_scale(&e, p, &zero, &unit);
            most = (double)((1 << info->bits) - 1);
        }
        d->scale[p] = unit / most;
        d->offset[p] = zero / most;
    }
    return d;
}

void wf_difference_free(wf_difference *difference) {
    free(difference);
}

/* The same lines of a plane of both videos. */
typedef struct planes {
    const float *a, *b;
    size_t line_stride;
    int width, lines;
    double scale, offset;
} planes;

static planes planes_of(const wf_difference *d, const wf_video_frame *a,
                        const wf_video_frame *b, int p, lines_of which) {
    size_t width = (size_t)a->width_px[p], skip = which == BOTTOM ? width : 0;
    planes out = {a->plane[p] + skip, b->plane[p] + skip, width,       a->width_px[p],
                  a->lines[p],        d->scale[p],        d->offset[p]};
    if (which == FRAME) return out;
    out.line_stride = 2 * width;
    out.lines = (a->lines[p] + (which == TOP)) / 2;
    return out;
}

static void add_squares(const planes *p, sums *s) {
    for (int y = 0; y < p->lines; y++)
        for (int x = 0; x < p->width; x++) {
            size_t at = (size_t)y * p->line_stride + (size_t)x;
            double difference = p->scale * ((double)p->a[at] - (double)p->b[at]);
            s->squares += difference * difference;
        }
    s->samples += (double)p->lines * p->width;
}

static double similarity(const planes *p, int x0, int y0) {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    const double n = WINDOW * WINDOW;
    for (int y = y0; y < y0 + WINDOW; y++)
        for (int x = x0; x < x0 + WINDOW; x++) {
            size_t at = (size_t)y * p->line_stride + (size_t)x;
            double u = p->scale * (double)p->a[at] + p->offset;
            double v = p->scale * (double)p->b[at] + p->offset;
            a += u, b += v, aa += u * u, bb += v * v, ab += u * v;
        }
    a /= n, b /= n;
    double var_a = (aa - n * a * a) / (n - 1), var_b = (bb - n * b * b) / (n - 1);
    double covariance = (ab - n * a * b) / (n - 1);
    return (2 * a * b + C1) * (2 * covariance + C2) /
           ((a * a + b * b + C1) * (var_a + var_b + C2));
}

static void add_similarity(const planes *p, sums *s) {
    for (int y = 0; y + WINDOW <= p->lines; y += STEP)
        for (int x = 0; x + WINDOW <= p->width; x += STEP) {
            s->similarity += similarity(p, x, y);
            s->windows++;
        }
}

void wf_difference_add(wf_difference *d, const wf_video_frame *frame,
                       const wf_video_frame *reference) {
    for (int p = 0; p < d->planes; p++)
        for (int which = FRAME; which <= BOTTOM; which++) {
            planes both = planes_of(d, frame, reference, p, (lines_of)which);
            add_squares(&both, &d->sum[p][which]);
            add_similarity(&both, &d->sum[p][which]);
        }
}

static double psnr_of(double rmse) {
    return -20 * log10(rmse);
}

static wf_plane_difference figures_of(const sums *s) {
    double rmse = sqrt(s->squares / s->samples);
    return (wf_plane_difference){rmse, psnr_of(rmse),
                                 s->windows > 0 ? s->similarity / s->windows : NAN};
}

void wf_difference_finish(const wf_difference *d, wf_figures *figures) {
    static const char *const rgb[3] = {"r", "g", "b"}, *const ycbcr[3] = {"y", "cb", "cr"};
    sums all = {0};
    for (int p = 0; p < d->planes; p++) {
        for (int which = FRAME; which <= BOTTOM; which++)
            figures->plane[p][which] = figures_of(&d->sum[p][which]);
        const sums *s = &d->sum[p][FRAME];
        all.squares += s->squares, all.samples += s->samples;
        /* planes count by their samples, those too small for a window not at all */
        if (s->windows > 0) {
            all.similarity += figures->plane[p][FRAME].ssim * s->samples;
            all.windows += s->samples;
        }
        figures->plane_name[p] = (d->layout == WF_YCBCR ? ycbcr : rgb)[p];
    }
    wf_plane_difference whole = figures_of(&all);
    figures->rmse = whole.rmse;
    figures->psnr = whole.psnr;
    figures->ssim = whole.ssim;
}
