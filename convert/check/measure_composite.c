/* What composite coding makes of a picture: color of its luma, and luma of its color. */
#include <math.h>
#include <stdlib.h>

#include "color/composite/decode.h"
#include "color/composite/encode.h"
#include "convert/check/histogram.h"
#include "convert/check/measurement.h"
#include "convert/read/television.h"

#define FLAT                                                                                   \
    0.5f /* the level luma under the picture's color when luma is what is looked for           \
          */

typedef struct composite {
    wf_composite *coder; /* NULL: the raster has no composite system */
    wf_histogram color, luma;
    float *memory; /* what the following point into */
    float *plane[3], *row, *scratch;
    size_t samples;
    int64_t frame;
} composite;

static void composite_free(void *state) {
    composite *c = state;
    if (!c) return;
    wf_composite_free(c->coder);
    wf_histogram_free(&c->color);
    wf_histogram_free(&c->luma);
    free(c->memory);
    free(c);
}

static bool make_planes(composite *c, const wf_video_info *info) {
    size_t rows = wf_composite_row(c->coder) * (size_t)info->lines;
    c->memory =
        malloc((3 * c->samples + rows + wf_composite_scratch(c->coder)) * sizeof(float));
    if (!c->memory) return false;
    for (int p = 0; p < 3; p++) c->plane[p] = c->memory + (size_t)p * c->samples;
    c->row = c->memory + 3 * c->samples;
    c->scratch = c->row + rows;
    return wf_histogram_init(&c->color, 0) && wf_histogram_init(&c->luma, 0);
}

/* The worst coder and decoder: luma that is not filtered, seen on a television with a notch. */
static void *composite_begin(const wf_video_info *info, const wf_measure_options *options) {
    (void)options;
    wf_tv tv = {.encoder = WF_ENCODER_CHEAP, .decoder = WF_DECODER_NOTCH};
    composite *c = calloc(1, sizeof *c);
    if (!c || !wf_television_of(&info->raster, &tv)) return c;
    c->samples = (size_t)info->width_px * (size_t)info->lines;
    c->coder = wf_composite_new(&tv);
    if (c->coder && make_planes(c, info)) return c;
    composite_free(c);
    return NULL;
}

/* Through the coder and back, in place. */
static void code(const composite *c) {
    wf_composite_encode(c->coder, c->frame, c->plane, c->row, c->scratch);
    wf_composite_decode(c->coder, c->frame, c->row, c->plane, c->scratch);
}

static void luma_alone(composite *c, const wf_signal *s) {
    for (size_t i = 0; i < c->samples; i++) {
        c->plane[0][i] = s->ycbcr[0][i];
        c->plane[1][i] = c->plane[2][i] = 0;
    }
    code(c);
    for (size_t i = 0; i < c->samples; i++)
        wf_histogram_add(&c->color, hypotf((float)WF_U_OF_CB * c->plane[1][i],
                                           (float)WF_V_OF_CR * c->plane[2][i]));
}

static void color_alone(composite *c, const wf_signal *s) {
    for (size_t i = 0; i < c->samples; i++) {
        c->plane[0][i] = FLAT;
        c->plane[1][i] = s->ycbcr[1][i];
        c->plane[2][i] = s->ycbcr[2][i];
    }
    code(c);
    for (size_t i = 0; i < c->samples; i++)
        wf_histogram_add(&c->luma, fabsf(c->plane[0][i] - FLAT));
}

static void composite_add(void *state, const wf_signal *signal, const wf_signal *before) {
    composite *c = state;
    (void)before;
    if (!c->coder) return;
    luma_alone(c, signal);
    color_alone(c, signal);
    c->frame++;
}

static void composite_finish(void *state, const wf_signal *last, const wf_signal *before,
                             wf_figures *figures) {
    const composite *c = state;
    (void)last, (void)before;
    if (!c->coder) return;
    figures->cross_color_rms = wf_histogram_rms(&c->color);
    figures->cross_color_p999 = wf_histogram_quantile(&c->color, 0.999);
    figures->cross_luma_rms = wf_histogram_rms(&c->luma);
    figures->cross_luma_p999 = wf_histogram_quantile(&c->luma, 0.999);
}

const wf_measurement wf_measure_composite = {composite_begin, composite_add, composite_finish,
                                             composite_free};
