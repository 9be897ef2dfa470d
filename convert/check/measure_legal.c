/* Shares of the picture outside of what is legal. */
#include <stdlib.h>
#include <string.h>

#include "color/codes/r103.h"
#include "color/codes/ycbcr.h"
#include "convert/check/measurement.h"
#include "convert/job/colors.h"

#define ROUNDING      1e-6f /* of floats is no offense */
#define CODE_ROUNDING 1e-3f /* in codes of 8 bits, of which one of 16 bits is 4e-3 */

/* What has been counted, in pixels. */
typedef struct legal {
    wf_luma luma;
    bool all_codes; /* full range: there is nothing outside it */
    float *line;    /* R' G' B' */
    double outside_range, outside_r103, reserved, pixels;
} legal;

static void legal_free(void *state) {
    legal *l = state;
    if (l) free(l->line);
    free(l);
}

static void *legal_begin(const wf_video_info *info, const wf_measure_options *options) {
    (void)options;
    legal *l = calloc(1, sizeof *l);
    if (!l) return NULL;
    l->luma = wf_colors_of(info->raster.matrix)->luma;
    l->all_codes = info->full_range && info->layout != WF_LINEAR;
    l->line = malloc(3 * (size_t)info->width_px * sizeof *l->line);
    if (l->line) return l;
    legal_free(l);
    return NULL;
}

static bool beyond(float v, float low, float high) {
    return v < low || v > high;
}

/* A pixel is outside if one of the codes that make it is. */
static double outside_range(const legal *l, const wf_signal *s, int y) {
    const wf_video_frame *f = &s->coded;
    double count = 0;
    if (l->all_codes) return 0;
    for (int x = 0; x < s->width_px; x++) {
        bool out = false;
        for (int p = 0; p < 3; p++) {
            bool chroma = s->is_ycbcr && p > 0;
            int column = p ? x / s->across : x, line = p ? wf_signal_chroma_line(s, y) : y;
            float v = f->plane[p][(size_t)line * (size_t)f->width_px[p] + (size_t)column];
            out |= beyond(v, (chroma ? -0.5f : 0) - ROUNDING, (chroma ? 0.5f : 1) + ROUNDING);
        }
        count += out;
    }
    return count;
}

/* Rec. ITU-R BT.601 and BT.709 keep codes 0 and 255 of 8 bits for synchronization, and with
 * more bits all that begin with those eight: in units of 8 bits what is below 1, or 255 and
 * above. */
static double reserved(const legal *l, const wf_signal *s, int y) {
    const wf_video_frame *f = &s->coded;
    double count = 0;
    if (l->all_codes || !s->is_ycbcr) return 0;
    for (int x = 0; x < s->width_px; x++) {
        bool any = false;
        for (int p = 0; p < 3; p++) {
            int column = p ? x / s->across : x, line = p ? wf_signal_chroma_line(s, y) : y;
            float v = f->plane[p][(size_t)line * (size_t)f->width_px[p] + (size_t)column];
            float code = p ? 128 + 224 * v : 16 + 219 * v;
            any |= beyond(code, 1 - CODE_ROUNDING, 255 - CODE_ROUNDING);
        }
        count += any;
    }
    return count;
}

static double outside_r103(const legal *l, const wf_signal *s, int y) {
    size_t width = (size_t)s->width_px, at = (size_t)y * width;
    float *rgb[3] = {l->line, l->line + width, l->line + 2 * width};
    for (int p = 0; p < 3; p++) memcpy(rgb[p], s->ycbcr[p] + at, width * sizeof(float));
    wf_rgb_of_ycbcr(l->luma, rgb[0], rgb[1], rgb[2], width);
    return wf_r103_outside((const float *const *)rgb, width);
}

static void legal_add(void *state, const wf_signal *signal, const wf_signal *before) {
    legal *l = state;
    (void)before;
    for (int y = 0; y < signal->lines; y++) {
        l->outside_range += outside_range(l, signal, y);
        l->outside_r103 += outside_r103(l, signal, y);
        l->reserved += reserved(l, signal, y);
    }
    l->pixels += (double)signal->width_px * signal->lines;
}

static void legal_finish(void *state, const wf_signal *last, const wf_signal *before,
                         wf_figures *figures) {
    const legal *l = state;
    (void)last, (void)before;
    figures->range_share = l->outside_range / l->pixels;
    figures->r103_share = l->outside_r103 / l->pixels;
    figures->reserved_share = l->reserved / l->pixels;
}

const wf_measurement wf_measure_legal = {legal_begin, legal_add, legal_finish, legal_free};
