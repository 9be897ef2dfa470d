/* Brings lines within EBU R 103 by a soft clip of luma and by compressing saturation. */
#include "color/codes/legal.h"

#include <math.h>
#include <string.h>

#include "color/codes/levels.h"
#include "color/codes/r103.h"
#include "color/codes/ycbcr.h"

#define SOFT                                                                                   \
    (2.5f / 876)     /* of a signal: the clip of luma is soft and loses less than a code       \
                      */
#define REACH  4     /* pixels to each side over which saturation is compressed alike */
#define ROUNDS 16    /* of compression: each leaves less to the next */
#define GRAY   1e-4f /* chroma that is rounded to none */

typedef struct limits {
    float low, high;             /* of R', G', B' */
    float luma_low, luma_high;   /* of Y' */
    float knee;                  /* the clip begins this far below luma_high */
    float slack;                 /* rounding to codes may move R', G' and B' this far */
    float red, blue;             /* R' - Y' = red Cr, B' - Y' = blue Cb */
    float green_red, green_blue; /* G' - Y' = green_red (R' - Y') + green_blue (B' - Y') */
} limits;

/* Rounding moves Y' by half a code, and by as much the chroma that R', G' and B' depend on
 * most, which interpolation may add to; noise moves both by a whole code besides. Where the
 * codes are R'G'B' the limits are codes themselves, and rounding leaves nothing outside. */
static float slack_of(const wf_encoding *e) {
    const double most_of_chroma = 1.9,
                 taps = 2.21; /* sum of their sizes, between two samples */
    double zero, luma, chroma, noise = e->dither ? 1 : 0;
    wf_code_scale(e, 0, &zero, &luma);
    wf_code_scale(e, 1, &zero, &chroma);
    if (!e->ycbcr) return (float)(noise / luma);
    double between = e->chroma == WF_CHROMA_444 ? 1 : taps;
    return (float)((0.5 + noise) / luma + (0.5 * between + noise) * most_of_chroma / chroma);
}

/* Codes of full range hold no more than 0 to 1, of Y' or of R', G' and B'. */
static limits limits_of(const wf_encoding *e) {
    wf_ycbcr w = wf_ycbcr_of(e->luma);
    float kg = 1 - w.kr - w.kb, noise = e->dither ? slack_of(e) : 0;
    limits l = {.low = (float)WF_R103_LOW,
                .high = (float)WF_R103_HIGH,
                .luma_low = (float)WF_R103_LOW + noise,
                .luma_high = (float)WF_R103_HIGH - noise,
                .knee = SOFT,
                .slack = slack_of(e),
                .red = 1 / w.cr_scale,
                .blue = 1 / w.cb_scale,
                .green_red = -w.kr / kg,
                .green_blue = -w.kb / kg};
    if (e->full_range) l.luma_low = l.knee = 0, l.luma_high = 1;
    if (e->full_range && !e->ycbcr) l.low = 0, l.high = 1, l.slack = 0;
    l.low += l.slack;
    l.high -= l.slack;
    /* The tails of interpolation reach far into white, but not as far as to a code. */
    if (!e->full_range) l.luma_high -= 0.6f / (e->bits > 8 ? 876 : 219);
    return l;
}

wf_legal_range wf_legal_range_of(const wf_encoding *e) {
    limits l = limits_of(e);
    return (wf_legal_range){l.low, l.high};
}

/* Beyond a knee signals come ever closer to the limit. */
static float soft_clip(const limits *l, float y) {
    float over = y - (l->luma_high - l->knee);
    if (over > 0) return l->luma_high - (l->knee > 0 ? l->knee * expf(-over / l->knee) : 0);
    return y < l->luma_low ? l->luma_low : y;
}

static float least(float a, float b) {
    return a < b ? a : b;
}

/* What the difference of R', G' or B' from luma y may be multiplied by. */
static float allowed(const limits *l, float y, float difference) {
    float up = l->high - y, down = y - l->low;
    if (difference > 0) return up > 0 ? up / difference : 0;
    return difference < 0 ? (down > 0 ? down / -difference : 0) : 1;
}

/* What the chroma of a pixel may be multiplied by, at most 1. */
static float factor(const limits *l, float y, float cb, float cr) {
    float red = cr * l->red, blue = cb * l->blue;
    float green = l->green_red * red + l->green_blue * blue;
    float s = least(allowed(l, y, red), allowed(l, y, blue));
    return least(least(s, allowed(l, y, green)), 1);
}

/* ---- Lines of Y'CbCr ---- */

/* The parts of the scratch, each as long as a line. */
typedef struct scratch_lines {
    float *chroma[2]; /* at every pixel */
    float *factors, *eroded, *luma, *touched;
} scratch_lines;

#define SCRATCH_LINES 6

static scratch_lines lay_out(float *scratch, size_t width) {
    return (scratch_lines){{scratch, scratch + width},
                           scratch + 2 * width,
                           scratch + 3 * width,
                           scratch + 4 * width,
                           scratch + 5 * width};
}

size_t wf_legal_scratch(size_t width_px) {
    return SCRATCH_LINES * width_px;
}

/* The chroma of every pixel, as a receiver interpolates it. */
static void interpolate(const wf_encoding *e, float *const ycbcr[3], float *chroma[2]) {
    size_t width = (size_t)e->width_px;
    const wf_chroma_filter *half_band = wf_chroma_filter_of(WF_CHROMA_BT601);
    for (int p = 0; p < 2; p++)
        if (e->chroma == WF_CHROMA_444)
            memcpy(chroma[p], ycbcr[1 + p], width * sizeof(float));
        else
            wf_chroma_interpolate(half_band, ycbcr[1 + p], width, chroma[p]);
}

static int is_beyond(float v, float low, float high) {
    return (v < low) | (v > high);
}

/* How many pixels of the line are outside by more than half the slack: down to the last of it,
 * the rounds would not end. */
static int count_beyond(const limits *l, const float *y, float *const chroma[2], size_t width) {
    float low = l->low - 0.5f * l->slack, high = l->high + 0.5f * l->slack;
    int count = 0;
    for (size_t x = 0; x < width; x++) {
        float red = chroma[1][x] * l->red, blue = chroma[0][x] * l->blue;
        float green = l->green_red * red + l->green_blue * blue;
        count += is_beyond(y[x] + red, low, high) | is_beyond(y[x] + green, low, high) |
                 is_beyond(y[x] + blue, low, high);
    }
    return count;
}

/* Finds what the chroma of each pixel may be multiplied by; false where all may stay as it is.
 */
static bool find_factors(const wf_encoding *e, const limits *l, float *const ycbcr[3],
                         scratch_lines *lines) {
    size_t width = (size_t)e->width_px;
    interpolate(e, ycbcr, lines->chroma);
    if (!count_beyond(l, ycbcr[0], lines->chroma, width)) return false;
    for (size_t x = 0; x < width; x++)
        lines->factors[x] = factor(l, ycbcr[0][x], lines->chroma[0][x], lines->chroma[1][x]);
    return true;
}

/* to[x] is the least of the pixels within reach of x. There is a pass for each distance, so
 * that the compiler makes vectors of them. */
static void erode(const float *from, float *to, ptrdiff_t width) {
    memcpy(to, from, (size_t)width * sizeof *to);
    for (ptrdiff_t off = 1; off <= REACH; off++) {
        for (ptrdiff_t x = off; x < width; x++) to[x] = least(to[x], from[x - off]);
        for (ptrdiff_t x = 0; x + off < width; x++) to[x] = least(to[x], from[x + off]);
    }
}

/* The mean within reach of x. After erode it is nowhere more than the pixel's own factor, and
 * it has no steps: interpolation would ring at them and so turn hues. */
static float smooth(const float *from, ptrdiff_t x, ptrdiff_t width) {
    float sum = 0;
    for (ptrdiff_t i = x - REACH; i <= x + REACH; i++)
        sum += from[i < 0 ? 0 : i < width ? i : width - 1];
    return sum / (2 * REACH + 1);
}

/* Multiplies each sample of chroma by its factor. */
static void compress(const wf_encoding *e, float *const ycbcr[3], const float *factors,
                     float *touched) {
    ptrdiff_t width = e->width_px, step = e->chroma == WF_CHROMA_444 ? 1 : 2;
    for (ptrdiff_t i = 0; i < width / step; i++) {
        float s = step == 1 ? factors[i] : smooth(factors, i * step, width);
        if (s >= 1) continue;
        ycbcr[1][i] *= s;
        ycbcr[2][i] *= s;
        for (ptrdiff_t x = i * step; x < i * step + step; x++) touched[x] = 1;
    }
}

static void clip_luma(const limits *l, float *y, float *touched, size_t width) {
    for (size_t x = 0; x < width; x++) {
        float clipped = soft_clip(l, y[x]);
        touched[x] = clipped != y[x];
        y[x] = clipped;
    }
}

/* Interpolation rings from saturated colors into bright or dark pixels beside them. What is
 * outside there after all rounds is put right by moving luma: as far as it takes where luma was
 * outside by itself, elsewhere by less than a code. */
static void settle_luma(const wf_encoding *e, const limits *l, float *const ycbcr[3],
                        scratch_lines *lines) {
    const float least_code = 0.9f / 876;
    interpolate(e, ycbcr, lines->chroma);
    for (int x = 0; x < e->width_px; x++) {
        float red = lines->chroma[1][x] * l->red, blue = lines->chroma[0][x] * l->blue;
        float green = l->green_red * red + l->green_blue * blue, was = lines->luma[x];
        float up = fmaxf(red, fmaxf(green, blue)), down = fminf(red, fminf(green, blue));
        float y = fmaxf(fminf(ycbcr[0][x], l->high - up), l->low - down);
        bool inside = was >= WF_R103_LOW && was <= WF_R103_HIGH;
        if (inside) y = fmaxf(fminf(y, was + least_code), was - least_code);
        if (up - down < GRAY || y == ycbcr[0][x]) continue;
        ycbcr[0][x] = y;
        lines->touched[x] = 1;
    }
}

void wf_legal_ycbcr(const wf_encoding *e, float *const ycbcr[3], float *scratch) {
    const limits l = limits_of(e);
    size_t width = (size_t)e->width_px;
    scratch_lines lines = lay_out(scratch, width);
    bool whole = e->chroma == WF_CHROMA_444;
    int round = 0;
    memcpy(lines.luma, ycbcr[0], width * sizeof(float));
    clip_luma(&l, ycbcr[0], lines.touched, width);
    for (; round < ROUNDS && find_factors(e, &l, ycbcr, &lines); round++) {
        erode(lines.factors, lines.eroded, e->width_px);
        compress(e, ycbcr, whole ? lines.factors : lines.eroded, lines.touched);
    }
    if (round == ROUNDS) settle_luma(e, &l, ycbcr, &lines);
    if (!e->legal) return;
    for (size_t x = 0; x < width; x++) e->legal->touched += lines.touched[x] > 0;
    e->legal->pixels += (int64_t)width;
}

/* ---- Lines of R'G'B' ---- */

void wf_legal_rgb(const wf_encoding *e, float *const rgb[3]) {
    const limits l = limits_of(e);
    wf_ycbcr w = wf_ycbcr_of(e->luma);
    for (int x = 0; x < e->width_px; x++) {
        float *r = &rgb[0][x], *g = &rgb[1][x], *b = &rgb[2][x];
        float y = *g + w.kr * (*r - *g) + w.kb * (*b - *g);
        float clipped = soft_clip(&l, y);
        float s = factor(&l, clipped, (*b - y) / l.blue, (*r - y) / l.red);
        if (e->legal) e->legal->touched += s < 1 || clipped != y;
        if (s >= 1 && clipped == y) continue;
        *r = clipped + s * (*r - y);
        *g = clipped + s * (*g - y);
        *b = clipped + s * (*b - y);
    }
    if (e->legal) e->legal->pixels += e->width_px;
}

/* ---- What is left ---- */

void wf_legal_count(const wf_encoding *e, uint16_t *const code[3], float *scratch) {
    size_t width = (size_t)e->width_px;
    scratch_lines lines = lay_out(scratch, width);
    float *decoded[3] = {lines.factors, lines.eroded, lines.luma};
    float *full[3] = {decoded[0], lines.chroma[0], lines.chroma[1]};
    float **rgb = e->ycbcr ? full : decoded;
    bool halved = e->ycbcr && e->chroma != WF_CHROMA_444;
    for (int p = 0; p < 3; p++)
        wf_decode_line(e, p, code[p], decoded[p], p && halved ? width / 2 : width);
    if (e->ycbcr) {
        interpolate(e, decoded, rgb + 1);
        wf_rgb_of_ycbcr(e->luma, rgb[0], rgb[1], rgb[2], width);
    }
    e->legal->outside += wf_r103_outside((const float *const *)rgb, width);
}
