/* Shares of the picture outside of what is legal. */
#include <stdint.h>
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
    bool all_codes;        /* full range: there is nothing outside it */
    float *line;           /* R' G' B' */
    uint8_t *out, *column; /* [width_px]: what is outside of a line, and of its chroma */
    double outside_range, outside_r103, reserved, pixels;
} legal;

static void legal_free(void *state) {
    legal *l = state;
    if (!l) return;
    free(l->line);
    free(l->out);
    free(l->column);
    free(l);
}

static void *legal_begin(const wf_video_info *info, const wf_measure_options *options) {
    (void)options;
    legal *l = calloc(1, sizeof *l);
    if (!l) return NULL;
    l->luma = wf_colors_of(info->raster.matrix)->luma;
    l->all_codes = info->full_range && info->layout != WF_LINEAR;
    l->line = malloc(3 * (size_t)info->width_px * sizeof *l->line);
    l->out = malloc((size_t)info->width_px);
    l->column = malloc((size_t)info->width_px);
    if (l->line && l->out && l->column) return l;
    legal_free(l);
    return NULL;
}

/* Codes of a plane, and what they may be: offset + scale v is in low .. high. */
typedef struct span {
    float offset, scale, low, high;
} span;

/* Marks what is beyond. All are looked at, for vectors have no branches. */
static void mark(const float *restrict v, size_t count, span s, uint8_t *restrict out) {
    for (size_t i = 0; i < count; i++) {
        float code = s.offset + s.scale * v[i];
        out[i] |= (code < s.low) | (code > s.high);
    }
}

/* What is marked of chroma is so of the pixels that it lies on. */
static void spread(const uint8_t *restrict column, size_t across, size_t width,
                   uint8_t *restrict out) {
    size_t x = 0;
    for (; across == 2 && x + 1 < width; x += 2) {
        out[x] |= column[x / 2];
        out[x + 1] |= column[x / 2];
    }
    for (; x < width; x++) out[x] |= column[x / across];
}

/* Pixels of line y of which a code is beyond; spans are of luma and of the others. */
static double beyond(const legal *l, const wf_signal *s, int y, span luma, span chroma) {
    const wf_video_frame *f = &s->coded;
    size_t width = (size_t)s->width_px, across = (size_t)s->across;
    int count = 0;
    memset(l->out, 0, width);
    for (int p = 0; p < 3; p++) {
        int line = p ? wf_signal_chroma_line(s, y) : y;
        const float *v = f->plane[p] + (size_t)line * (size_t)f->width_px[p];
        if (!p || across == 1) {
            mark(v, width, p ? chroma : luma, l->out);
            continue;
        }
        size_t columns = (width + across - 1) / across;
        memset(l->column, 0, columns);
        mark(v, columns, chroma, l->column);
        spread(l->column, across, width, l->out);
    }
    for (size_t x = 0; x < width; x++) count += l->out[x];
    return count;
}

/* A pixel is outside if one of the codes that make it is. */
static double outside_range(const legal *l, const wf_signal *s, int y) {
    const span unsigned_code = {0, 1, 0 - ROUNDING, 1 + ROUNDING};
    const span signed_code = {0, 1, -0.5f - ROUNDING, 0.5f + ROUNDING};
    if (l->all_codes) return 0;
    return beyond(l, s, y, unsigned_code, s->is_ycbcr ? signed_code : unsigned_code);
}

/* Rec. ITU-R BT.601 and BT.709 keep codes 0 and 255 of 8 bits for synchronization, and with
 * more bits all that begin with those eight: in units of 8 bits what is below 1, or 255 and
 * above. */
static double reserved(const legal *l, const wf_signal *s, int y) {
    const float low = 1 - CODE_ROUNDING, high = 255 - CODE_ROUNDING;
    if (l->all_codes || !s->is_ycbcr) return 0;
    return beyond(l, s, y, (span){16, 219, low, high}, (span){128, 224, low, high});
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
