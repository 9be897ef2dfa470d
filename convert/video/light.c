/* Rows of light from the codes of a picture. */
#include "convert/video/light.h"

#include <stdlib.h>

#include "color/codes/levels.h"
#include "color/codes/upsample.h"

struct wf_light {
    wf_meaning meaning;
    int width_px, lines;
    int chroma_width_px, chroma_lines;
    bool has_chroma;             /* false: a lone Y */
    double zero[3], per_code[3]; /* signal = (code - zero) per_code */
    wf_upsampler across, down;
    wf_transform decode; /* apply is NULL where R'G'B' is light */
    bool owns_decode;
};

static int parts(int size, int by) {
    return (size + by - 1) / by;
}

static weft_status no_memory(weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the colors of the video");
}

weft_status wf_light_new(const wf_video_info *info, const wf_meaning *meaning,
                         const wf_transform *decode, wf_light **out, weft_error *err) {
    wf_light *l = *out = calloc(1, sizeof *l);
    if (!l) return no_memory(err);
    const wf_encoding encoding = {
        .ycbcr = meaning->ycbcr, .full_range = info->full_range, .bits = info->bits};
    *l = (wf_light){.meaning = *meaning,
                    .width_px = info->width_px,
                    .lines = info->lines,
                    .chroma_width_px = parts(info->width_px, info->across),
                    .chroma_lines = parts(info->lines, info->down),
                    .has_chroma = info->planes == 3,
                    .owns_decode = !decode};
    if (decode) l->decode = *decode;
    for (int p = 0; p < 3; p++) {
        double unit;
        wf_code_scale(&encoding, p, &l->zero[p], &unit);
        l->per_code[p] = 1 / unit;
    }
    /* Lines of chroma lie amid two lines of luma, but for top-left. */
    wf_upsampler_init(&l->across, info->across, info->tags.siting == WF_SITING_CENTER);
    wf_upsampler_init(&l->down, info->down, info->tags.siting != WF_SITING_TOP_LEFT);
    bool made = decode || wf_decoding_transform(&meaning->colors.decoding, &l->decode);
    return made ? WEFT_OK : no_memory(err);
}

void wf_light_free(wf_light *l) {
    if (l && l->owns_decode && l->decode.free) l->decode.free(l->decode.self);
    free(l);
}

size_t wf_light_scratch(const wf_light *l) {
    return (3 * (size_t)l->width_px + (size_t)l->chroma_width_px + 2 * WF_UPSAMPLE_MARGIN) *
           sizeof(double);
}

/* ---- Signals ---- */

static void signal_row(const wf_light *l, int p, const uint16_t *code, int count, double *out) {
    double zero = l->zero[p], per_code = l->per_code[p];
    for (int x = 0; x < count; x++) out[x] = (code[x] - zero) * per_code;
}

/* Chroma as it is at luma row y, at its own columns. */
static void chroma_at_row(const wf_light *l, int p, const uint16_t *plane, int y, double *out) {
    int width = l->chroma_width_px, at = y / l->down.factor;
    const wf_upsample_phase *phase = &l->down.phase[y % l->down.factor];
    if (phase->count == 1) {
        signal_row(l, p, plane + (size_t)at * (size_t)width, width, out);
        return;
    }
    for (int x = 0; x < width; x++) out[x] = -l->zero[p] * l->per_code[p];
    for (int i = 0; i < phase->count; i++) {
        int line =
            wf_upsample_reflected(&l->down, at + phase->first + i, l->chroma_lines, l->lines);
        const uint16_t *code = plane + (size_t)line * (size_t)width;
        double share = phase->tap[i] * l->per_code[p];
        for (int x = 0; share != 0 && x < width; x++) out[x] += share * code[x];
    }
}

static void chroma_row(const wf_light *l, int p, const uint16_t *plane, int y, double *spare,
                       double *out) {
    if (l->across.factor == 1) {
        chroma_at_row(l, p, plane, y, out);
        return;
    }
    chroma_at_row(l, p, plane, y, spare);
    wf_upsample_line(&l->across, spare, l->chroma_width_px, out, l->width_px);
}

/* ---- Light ---- */

static void rgb_of_ycbcr(const wf_light *l, double *const signal[3]) {
    const wf_meaning *m = &l->meaning;
    double kg = 1 - m->kr - m->kb, of_cr = 2 * (1 - m->kr), of_cb = 2 * (1 - m->kb);
    for (int x = 0; x < l->width_px; x++) {
        double y = signal[0][x], r = y + of_cr * signal[2][x], b = y + of_cb * signal[1][x];
        signal[0][x] = r;
        signal[1][x] = (y - m->kr * r - m->kb * b) / kg;
        signal[2][x] = b;
    }
}

static void round_row(const double *signal, int count, float *out) {
    for (int x = 0; x < count; x++) out[x] = (float)signal[x];
}

void wf_light_row(const wf_light *l, const uint16_t *const plane[3], int y, void *scratch,
                  float *const rgb[3]) {
    size_t width = (size_t)l->width_px;
    double *signal[3] = {scratch, (double *)scratch + width, (double *)scratch + 2 * width};
    double *spare = signal[2] + width + WF_UPSAMPLE_MARGIN;
    signal_row(l, 0, plane[0] + (size_t)y * width, l->width_px, signal[0]);
    for (int p = 1; p < 3; p++) {
        for (size_t x = 0; !l->has_chroma && x < width; x++)
            signal[p][x] = l->meaning.ycbcr ? 0 : signal[0][x];
        if (l->has_chroma) chroma_row(l, p, plane[p], y, spare, signal[p]);
    }
    if (l->meaning.ycbcr) rgb_of_ycbcr(l, signal);
    for (int c = 0; c < 3; c++) round_row(signal[c], l->width_px, rgb[c]);
    if (l->decode.apply) l->decode.apply(l->decode.self, rgb[0], rgb[1], rgb[2], width);
}
