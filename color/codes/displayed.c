/* Light that a display shows: from R'G'B', changed in luminance, and back. */
#include "color/codes/displayed.h"

#include <math.h>

#include "color/line/line.h"

#define HLG_GAMMA 1.2 /* of the display, each color by itself, as wf_display has it */

static const wf_curve *curve_of(wf_transfer transfer) {
    static const wf_curve *const curves[] = {[WF_TRANSFER_BT1886] = &wf_curve_bt1886,
                                             [WF_TRANSFER_PQ] = &wf_curve_pq,
                                             [WF_TRANSFER_HLG] = &wf_curve_hlg};
    return curves[transfer];
}

static void weigh(const double xyz[3][3], float weight[3]) {
    for (int c = 0; c < 3; c++) weight[c] = (float)xyz[1][c];
}

wf_displayed wf_displayed_of_codes(wf_primaries primaries, wf_transfer transfer) {
    static const float most[] = {[WF_TRANSFER_BT1886] = 1,
                                 [WF_TRANSFER_PQ] = 10000 / 203.0f,
                                 [WF_TRANSFER_HLG] = 1000 / 203.0f};
    wf_displayed shown = {.encoded = true,
                          .transfer = transfer,
                          .most = most[transfer],
                          .gamma = wf_curve_gamma(HLG_GAMMA, 1)};
    double xyz[3][3];
    wf_rgb_to_xyz(primaries, xyz);
    weigh(xyz, shown.weight);
    return shown;
}

wf_displayed wf_displayed_of_light(const wf_chromaticities *primaries) {
    wf_displayed shown = {.most = INFINITY};
    double xyz[3][3], own[3][3], to_709[3][3];
    wf_rgb_to_xyz(WF_PRIMARIES_709, xyz);
    wf_rgb_matrix(primaries, &wf_chromaticities_of[WF_PRIMARIES_709], to_709);
    for (int c = 0; c < 3; c++) {
        own[1][c] = 0;
        for (int k = 0; k < 3; k++) own[1][c] += xyz[1][k] * to_709[k][c];
    }
    weigh(own, shown.weight);
    return shown;
}

/* ---- Light ---- */

static void decode(const wf_displayed *s, float *plane, size_t count) {
    const wf_line_ops *ops = wf_line_ops_best();
    const wf_curve *curve = curve_of(s->transfer);
    for (size_t x = 0; x < count; x++) plane[x] = plane[x] > 0 ? plane[x] : 0;
    ops->decode[curve->kind](curve, plane, count);
    if (s->transfer == WF_TRANSFER_HLG) ops->decode[s->gamma.kind](&s->gamma, plane, count);
}

void wf_displayed_encode(const wf_displayed *s, float *const rgb[3], size_t count) {
    const wf_line_ops *ops = wf_line_ops_best();
    const wf_curve *curve = curve_of(s->transfer);
    for (int c = 0; s->encoded && c < 3; c++) {
        for (size_t x = 0; x < count; x++) rgb[c][x] = rgb[c][x] > 0 ? rgb[c][x] : 0;
        if (s->transfer == WF_TRANSFER_HLG) ops->curve[s->gamma.kind](&s->gamma, rgb[c], count);
        ops->curve[curve->kind](curve, rgb[c], count);
    }
}

/* Rounding of the curves puts white itself a little beyond it. */
#define WHITE 1.000001f

static int64_t clip_pixels(float most, float *const rgb[3], bool *clipped, size_t count) {
    int64_t out = 0;
    for (size_t x = 0; x < count; x++) {
        bool beyond = false;
        for (int c = 0; c < 3; c++) {
            beyond |= rgb[c][x] > most * WHITE;
            rgb[c][x] = rgb[c][x] < most ? rgb[c][x] : most;
        }
        if (clipped) clipped[x] = beyond;
        out += beyond;
    }
    return out;
}

int64_t wf_displayed_light(const wf_displayed *s, float *const rgb[3], float *luminance,
                           bool *clipped, bool clip, size_t count) {
    int64_t out = 0;
    for (int c = 0; s->encoded && c < 3; c++) decode(s, rgb[c], count);
    for (size_t x = 0; clipped && x < count; x++) clipped[x] = false;
    if (clip && s->encoded) out = clip_pixels(s->most, rgb, clipped, count);
    for (size_t x = 0; x < count; x++)
        luminance[x] =
            s->weight[0] * rgb[0][x] + s->weight[1] * rgb[1][x] + s->weight[2] * rgb[2][x];
    return out;
}

/* ---- Luminance ---- */

static float largest(const float rgb[3]) {
    return fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
}

static float smallest(const float rgb[3]) {
    return fminf(rgb[0], fminf(rgb[1], rgb[2]));
}

/* Where scaling would make more of colors out of gamut than light: a gray is added. */
static void add_gray(float rgb[3], float more) {
    for (int c = 0; c < 3; c++) rgb[c] += more;
}

static void darken(float rgb[3], float from, float to) {
    bool scales = from > 0 && (to >= 0 || smallest(rgb) >= 0);
    for (int c = 0; scales && c < 3; c++) rgb[c] *= to / from;
    if (!scales) add_gray(rgb, to - from);
}

static void brighten(float most, float rgb[3], float from, float to) {
    float high = largest(rgb), s = 1;
    if (from > 0 && high <= most) s = fminf(to / from, fminf(most / high, 4));
    float scaled = s * from, room = most - scaled;
    for (int c = 0; c < 3; c++) rgb[c] *= s;
    bool bounded = most < INFINITY && room > 0 && high <= most;
    if (!bounded) add_gray(rgb, to - scaled);
    for (int c = 0; bounded && c < 3; c++) rgb[c] += (most - rgb[c]) * (to - scaled) / room;
}

void wf_displayed_change(const wf_displayed *s, float *const rgb[3], const float *from,
                         const float *to, size_t count) {
    for (size_t x = 0; x < count; x++) {
        float own[3] = {rgb[0][x], rgb[1][x], rgb[2][x]};
        if (to[x] == from[x]) continue;
        if (to[x] < from[x])
            darken(own, from[x], to[x]);
        else
            brighten(s->most, own, from[x], to[x]);
        for (int c = 0; c < 3; c++) rgb[c][x] = own[c];
    }
}
