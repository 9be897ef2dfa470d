/* luma-adjust: the Y' that gives the light which decimated chroma has taken or added. */
#include "color/codes/adjust.h"

#include <math.h>

#include "color/codes/legal.h"
#include "color/line/line.h"

#define LEAST_LUMA (-1 / 16.0f)
#define MOST_LUMA  1.09f
#define KEPT       5e-5f /* of a signal: a difference that no code shows */
#define TOLERANCE  1e-5f /* of white: light is as good as right */
#define STEPS      24    /* of Newton, at most; three do for most pixels */

size_t wf_adjust_scratch(size_t width_px) {
    return 2 * width_px;
}

typedef struct pixel {
    const wf_display *display;
    float difference[3]; /* R' - Y', G' - Y', B' - Y' */
    float least, most;   /* of Y' */
} pixel;

/* The light of the pixel with luma y; *slope is its derivative. */
static float luminance(const pixel *p, float y, float *slope) {
    float light = 0;
    *slope = 0;
    for (int c = 0; c < 3; c++) {
        float own;
        light +=
            p->display->weight[c] * wf_display_light(p->display, y + p->difference[c], &own);
        *slope += p->display->weight[c] * own;
    }
    return light;
}

/* Newton's method, within a bracket of a Y' that is too dark and one that is too bright,
 * because luminance grows with luma (though it stands still where R', G' and B' are all black).
 * A step that would leave the bracket tries its end first and halves it after that: often no
 * code gives the light that is wanted, and then the end is the answer. */
static float solve(const pixel *p, float y, float want) {
    float dark = p->least, bright = p->most, slope;
    bool tried_dark = false, tried_bright = false;
    if (y < dark || y > bright) y = 0.5f * (dark + bright);
    for (int n = 0; n < STEPS; n++) {
        float error = luminance(p, y, &slope) - want;
        if (fabsf(error) < TOLERANCE) return y;
        if (error > 0)
            bright = y, tried_bright = true;
        else
            dark = y, tried_dark = true;
        if (bright <= dark) return y;
        float next = slope > 0 ? y - error / slope : dark;
        if (next >= bright)
            next = tried_bright ? 0.5f * (dark + bright) : bright;
        else if (next <= dark)
            next = tried_dark ? 0.5f * (dark + bright) : dark;
        y = next;
    }
    return y;
}

static bool is_kept(const pixel *p, float y, const float rgb[3]) {
    float off = 0;
    for (int c = 0; c < 3; c++) off = fmaxf(off, fabsf(y + p->difference[c] - rgb[c]));
    return off < KEPT;
}

/* Sets what Y' may become. Under r103 it may not take R', G' or B' past the limits (nor further
 * past them than y does already): that would cost the saturation of all the pixels around. */
static void bound(pixel *p, const wf_legal_range *legal, float y) {
    float up = 0, down = 0;
    p->least = LEAST_LUMA;
    p->most = MOST_LUMA;
    if (!legal) return;
    for (int c = 0; c < 3; c++) {
        up = fmaxf(up, p->difference[c]);
        down = fminf(down, p->difference[c]);
    }
    p->least = fminf(MOST_LUMA, fmaxf(LEAST_LUMA, fminf(y, legal->low - down)));
    p->most = fmaxf(p->least, fminf(MOST_LUMA, fmaxf(y, legal->high - up)));
}

void wf_adjust_luma(const wf_encoding *e, float *const ycbcr[3], const float *const rgb[3],
                    float *scratch) {
    size_t width = (size_t)e->width_px;
    float *cb = scratch, *cr = scratch + width;
    const wf_chroma_filter *half_band = wf_chroma_filter_of(WF_CHROMA_BT601);
    wf_ycbcr w = wf_ycbcr_of(e->luma);
    const wf_legal_range range = wf_legal_range_of(e);
    float kg = 1 - w.kr - w.kb;
    wf_chroma_interpolate(half_band, ycbcr[1], width, cb);
    wf_chroma_interpolate(half_band, ycbcr[2], width, cr);
    for (size_t x = 0; x < width; x++) {
        float red = cr[x] / w.cr_scale, blue = cb[x] / w.cb_scale, *y = &ycbcr[0][x];
        const float was[3] = {rgb[0][x], rgb[1][x], rgb[2][x]};
        const float *const one[3] = {&was[0], &was[1], &was[2]};
        pixel p = {e->display, {red, -(w.kr * red + w.kb * blue) / kg, blue}, 0, 0};
        if (is_kept(&p, *y, was)) continue;
        float light;
        bound(&p, e->legalize == WF_LEGAL_R103 ? &range : NULL, *y);
        wf_display_luminance(e->display, one, &light, 1);
        *y = solve(&p, *y, light);
    }
}
