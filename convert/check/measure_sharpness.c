/* Vertical response, from a chart of which the light is known. */
#include <math.h>
#include <stdlib.h>

#include "convert/check/measurement.h"

#define FREQUENCY 0.25 /* cycles a line, of the zone plate */
#define HALF_BAND                                                                              \
    0.01             /* pixels whose frequency is off by no more are fitted, cycles a line     \
                      */
#define CONTRAST 0.5 /* amplitude of both charts */
#define MARGIN   8   /* lines at the upper and lower edge that no grating is looked for in */

typedef struct sharpness {
    wf_chart chart;
    double grating, aspect;
    double sum;
    int64_t frames;
} sharpness;

static void *sharpness_begin(const wf_video_info *info, const wf_measure_options *options) {
    sharpness *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->chart = options->chart;
    s->grating = options->grating;
    s->aspect = wf_ratio_value(info->raster.pixel_aspect);
    return s;
}

/* A fit of light to a + b wave, by least squares. */
typedef struct fit {
    double n, w, ww, l, lw;
} fit;

static void fit_add(fit *f, double light, double wave) {
    f->n++;
    f->w += wave;
    f->ww += wave * wave;
    f->l += light;
    f->lw += light * wave;
}

static double fit_amplitude(const fit *f) {
    double deviation = f->ww - f->w * f->w / f->n;
    return f->n > 2 && deviation > 0 ? (f->lw - f->l * f->w / f->n) / deviation : NAN;
}

/* 1/2 + 1/2 cos(pi r^2 / H): about (0, +-H / 4) its frequency is FREQUENCY, straight up. */
static double zoneplate_response(const sharpness *s, const wf_signal *signal) {
    fit f = {0};
    double lines = signal->lines;
    for (int y = 0; y < signal->lines; y++) {
        double v = y + 0.5 - lines / 2;
        if (fabs(fabs(v) / lines - FREQUENCY) > HALF_BAND) continue;
        for (int x = 0; x < signal->width_px; x++) {
            double u = (x + 0.5 - signal->width_px / 2.0) * s->aspect;
            if (fabs(u) / lines > HALF_BAND) continue;
            double light =
                (double)signal->light[(size_t)y * (size_t)signal->width_px + (size_t)x];
            fit_add(&f, light, cos(M_PI * (u * u + v * v) / lines));
        }
    }
    return fit_amplitude(&f) / CONTRAST;
}

/* 1/2 + 1/2 cos(2 pi f y + phase), the phase unknown: sine and cosine about the lines' mean. */
static double grating_response(const sharpness *s, const wf_signal *signal) {
    double mean = 0, cc = 0, cs = 0, ss = 0, lc = 0, ls = 0;
    int first = MARGIN, end = signal->lines - MARGIN;
    size_t width = (size_t)signal->width_px;
    for (int pass = 0; pass < 2; pass++)
        for (int y = first; y < end; y++) {
            double line = 0, turn = 2 * M_PI * s->grating * y;
            for (size_t x = 0; x < width; x++)
                line += (double)signal->light[(size_t)y * width + x];
            line /= (double)width;
            if (!pass) {
                mean += line / (end - first);
                continue;
            }
            cc += cos(turn) * cos(turn), cs += cos(turn) * sin(turn),
                ss += sin(turn) * sin(turn);
            lc += (line - mean) * cos(turn), ls += (line - mean) * sin(turn);
        }
    double det = cc * ss - cs * cs;
    if (end - first < 4) return NAN;
    if (det < 1e-6 * cc * cc) return fabs(lc / cc) / CONTRAST; /* 0.5: there are no sines */
    double c = (lc * ss - ls * cs) / det, sine = (ls * cc - lc * cs) / det;
    return hypot(c, sine) / CONTRAST;
}

static void sharpness_add(void *state, const wf_signal *signal, const wf_signal *before) {
    sharpness *s = state;
    (void)before;
    if (s->chart == WF_CHART_NONE) return;
    s->sum += s->chart == WF_CHART_ZONEPLATE ? zoneplate_response(s, signal)
                                             : grating_response(s, signal);
    s->frames++;
}

static void sharpness_finish(void *state, const wf_signal *last, const wf_signal *before,
                             wf_figures *figures) {
    const sharpness *s = state;
    (void)last, (void)before;
    if (s->frames) figures->sharpness = s->sum / (double)s->frames;
}

const wf_measurement wf_measure_sharpness = {sharpness_begin, sharpness_add, sharpness_finish,
                                             free};
