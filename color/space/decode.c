/* Decodes R'G'B' to light by curves that spaces, files and code points name. */
#include "color/space/decode.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/line/line.h"

wf_decoding wf_decoding_of(const wf_curve *curve) {
    if (!curve) return (wf_decoding){.scale = 1};
    return (wf_decoding){.curve = *curve, .encoded = true, .scale = 1};
}

/* ST 428-1: a signal of 1 is 52.37 cd/m2, of which white is 48. */
static wf_curve cinema(void) {
    return wf_curve_gamma(2.6, pow(48 / 52.37, 1 / 2.6));
}

bool wf_decoding_changes(const wf_decoding *d) {
    return d->encoded || d->scale != 1 || d->offset != 0;
}

bool wf_decoding_of_code_point(int code_point, wf_decoding *out) {
    static const wf_curve *const curves[] = {
        [1] = &wf_curve_bt1886,  [6] = &wf_curve_bt1886, [11] = &wf_curve_bt1886,
        [12] = &wf_curve_bt1886, [13] = &wf_curve_srgb,  [14] = &wf_curve_bt1886,
        [15] = &wf_curve_bt1886, [16] = &wf_curve_pq,    [18] = &wf_curve_hlg,
    };
    wf_curve made = code_point == 4   ? wf_curve_gamma(2.2, 1)
                    : code_point == 5 ? wf_curve_gamma(2.8, 1)
                                      : cinema();
    bool listed = code_point >= 0 && code_point < (int)(sizeof curves / sizeof *curves);
    const wf_curve *curve = listed ? curves[code_point] : NULL;
    if (code_point == 4 || code_point == 5 || code_point == 17) curve = &made;
    *out = wf_decoding_of(curve);
    return curve || code_point == 8;
}

static bool is_power(const wf_curve *a, const wf_curve *b) {
    return a->kind == WF_CURVE_POWER && a->gain == b->gain && a->offset == b->offset &&
           a->inverse_high == b->inverse_high && a->inverse_low == b->inverse_low;
}

const char *wf_decoding_name(const wf_decoding *d, char text[24]) {
    static const struct {
        const wf_curve *curve;
        const char *name;
    } powers[] = {{&wf_curve_bt1886, "BT.1886"},
                  {&wf_curve_srgb, "sRGB"},
                  {&wf_curve_bt709, "BT.709 OETF"},
                  {&wf_curve_bt2020, "BT.2020 OETF"}};
    const wf_curve *c = &d->curve;
    if (!d->encoded) return "linear";
    if (c->kind == WF_CURVE_PQ) return "PQ";
    if (c->kind == WF_CURVE_HLG) return "HLG";
    for (size_t i = 0; i < sizeof powers / sizeof *powers; i++)
        if (is_power(c, powers[i].curve)) return powers[i].name;
    snprintf(text, 24, "gamma %.4g", (double)c->inverse_high + (double)c->inverse_low);
    return text;
}

typedef struct decoder {
    const wf_line_ops *ops;
    wf_decoding decoding;
} decoder;

static void decode(const void *self, float *r, float *g, float *b, size_t width_px) {
    const decoder *d = self;
    const wf_decoding *how = &d->decoding;
    float *plane[3] = {r, g, b};
    for (int c = 0; c < 3; c++) {
        if (how->scale != 1 || how->offset != 0)
            for (size_t i = 0; i < width_px; i++)
                plane[c][i] = how->scale * plane[c][i] + how->offset;
        if (how->encoded) d->ops->decode[how->curve.kind](&how->curve, plane[c], width_px);
    }
}

bool wf_decoding_transform(const wf_decoding *decoding, wf_transform *out) {
    decoder *d = malloc(sizeof *d);
    *out = (wf_transform){0};
    if (!d) return false;
    *d = (decoder){wf_line_ops_best(), *decoding};
    *out = (wf_transform){decode, free, d};
    return true;
}
