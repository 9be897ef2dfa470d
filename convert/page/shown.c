/* Frames of any finished video as fields of codes. */
#include "convert/page/shown.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "color/codes/ycbcr.h"
#include "color/space/builtin.h"
#include "convert/job/colors.h"
#include "convert/read/signal.h"

struct wf_page_shown {
    wf_video_info info;
    wf_page_form form;
    wf_signals *signals;
    wf_signal *signal;
    wf_luma luma;
    wf_transform to_709;                /* of colors that are brought there */
    float *line;                        /* [3][width_px] */
    uint16_t *plane[2][WF_PACK_PLANES]; /* by parity */
};

/* ---- Settling ---- */

/* Colors that a screen of Rec. 709 shows nearly right as they are coded stay so. */
static const char *space_to_bring(const wf_video_info *info) {
    if (info->layout == WF_LINEAR) return NULL; /* encoded as the raster has it, below */
    if (info->transfer == WF_TRANSFER_PQ) return "rec2100-pq";
    if (info->transfer == WF_TRANSFER_HLG) return "rec2100-hlg";
    return info->raster.matrix == WF_2020 ? "rec2020" : NULL;
}

static int weight(double factor) {
    return (int)lround(65536 * factor);
}

/* How codes of luma stand for Y'. Of more than 8 bits they have 255 steps to white, so that a
 * gray is the nearest R'G'B', and room for what is below black and above white. */
typedef struct steps {
    int black, luma, chroma; /* of black; from black to white; of a chroma of 1 */
} steps;

static steps steps_of(const wf_video_info *info) {
    bool full = info->full_range && info->layout != WF_LINEAR;
    steps s = {full ? 0 : 16, full ? 255 : 219, full ? 255 : 224};
    if (info->bits > 8) s.black = 64, s.luma = 255;
    return s;
}

static wf_page_colors colors_of(wf_luma luma, steps s) {
    const wf_ycbcr m = wf_ycbcr_of(luma);
    double kr = (double)m.kr, kb = (double)m.kb, kg = 1 - kr - kb;
    double red = 2 * (1 - kr) * 255 / s.chroma, blue = 2 * (1 - kb) * 255 / s.chroma;
    return (wf_page_colors){.black = s.black,
                            .luma = weight(255.0 / s.luma),
                            .red_cr = weight(red),
                            .green_cb = weight(kb * blue / kg),
                            .green_cr = weight(kr * red / kg),
                            .blue_cb = weight(blue)};
}

static wf_page_form form_of(const wf_video_info *info, bool brought) {
    bool linear = info->layout == WF_LINEAR, even = info->width_px % 2 == 0;
    bool ycbcr = info->layout != WF_RGB && !brought;
    int across = linear ? (even ? 2 : 1) : info->across;
    int chroma = ycbcr && across == 2 && even ? info->width_px / 2 : info->width_px;
    wf_page_form form = {.shape = {.planes = 3,
                                   .width_px = {info->width_px, chroma, chroma},
                                   .lines = (info->lines + 1) / 2}, /* of the upper field */
                         .ycbcr = ycbcr,
                         .rounded = info->bits > 8,
                         .brought = brought};
    form.colors = colors_of(wf_colors_of(info->raster.matrix)->luma, steps_of(info));
    return form;
}

static bool make_room(wf_page_shown *s) {
    bool made = (s->line = malloc(3 * (size_t)s->info.width_px * sizeof *s->line));
    for (int p = 0; p < WF_PACK_PLANES; p++)
        for (int parity = 0; parity < 2; parity++) {
            size_t samples = (size_t)s->form.shape.width_px[p] * (size_t)s->form.shape.lines;
            made = made && (s->plane[parity][p] = malloc(samples * sizeof(uint16_t)));
        }
    return made;
}

weft_status wf_page_shown_new(const wf_video_info *info, wf_page_shown **out, weft_error *err) {
    char why[512];
    const char *space = space_to_bring(info);
    wf_page_shown *s = calloc(1, sizeof *s);
    if (!s) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    s->info = *info;
    s->luma = wf_colors_of(info->raster.matrix)->luma;
    s->form = form_of(info, space);
    weft_status status = WEFT_OK;
    if (space && !wf_builtin_transform(space, "rec709", &s->to_709, why, sizeof why))
        status = wf_fail(err, WEFT_NO_MEMORY, "%s", why);
    if (!status) status = wf_signals_new(info, &s->signals, err);
    if (!status) status = wf_signal_new(s->signals, &s->signal, err);
    if (!status && !make_room(s))
        status = wf_fail(err, WEFT_NO_MEMORY, "no memory for fields of %dx%d", info->width_px,
                         s->form.shape.lines);
    if (status)
        wf_page_shown_free(s);
    else
        *out = s;
    return status;
}

void wf_page_shown_free(wf_page_shown *s) {
    if (!s) return;
    for (int p = 0; p < WF_PACK_PLANES; p++)
        for (int parity = 0; parity < 2; parity++) free(s->plane[parity][p]);
    free(s->line);
    if (s->to_709.free) s->to_709.free(s->to_709.self);
    wf_signal_free(s->signal);
    wf_signals_free(s->signals);
    free(s);
}

const wf_page_form *wf_page_shown_form(const wf_page_shown *s) {
    return &s->form;
}

const uint16_t *const *wf_page_shown_field(const wf_page_shown *s, int parity) {
    return (const uint16_t *const *)s->plane[parity];
}

/* ---- Frames ---- */

/* Halves are rounded up, whatever rounding in float has done to them. */
static uint16_t code(float value, float most) {
    const float half = 0.5001f;
    if (!(value > 0)) return 0;
    return (uint16_t)(value >= most ? most : value + half);
}

static uint16_t *line_of(const wf_page_shown *s, int p, int y) {
    return s->plane[y % 2][p] + (size_t)(y / 2) * (size_t)s->form.shape.width_px[p];
}

static void take_ycbcr(wf_page_shown *s, int p, int y) {
    const wf_signal *signal = s->signal;
    int width = s->form.shape.width_px[p];
    bool halves = p && width < s->info.width_px;
    const float *from = signal->ycbcr[p] + (size_t)y * (size_t)s->info.width_px;
    if (halves)
        from = signal->coded.plane[p] +
               (size_t)wf_signal_chroma_line(signal, y) * (size_t)signal->coded.width_px[p];
    steps of = steps_of(&s->info);
    float unit = (float)(p ? of.chroma : of.luma), zero = (float)(p ? 128 : of.black);
    float most = p || s->info.bits <= 8 ? 255 : WF_PACK_MOST;
    uint16_t *to = line_of(s, p, y);
    for (int x = 0; x < width; x++) to[x] = code(zero + unit * from[x], most);
}

void wf_page_shown_rgb(const wf_page_shown *s, int y, float *const rgb[3]) {
    size_t width = (size_t)s->info.width_px, at = (size_t)y * width;
    bool coded = !s->signal->is_ycbcr;
    for (int p = 0; p < 3; p++) {
        const float *from = coded ? s->signal->coded.plane[p] : s->signal->ycbcr[p];
        memcpy(rgb[p], from + at, width * sizeof *rgb[p]);
    }
    if (!coded) wf_rgb_of_ycbcr(s->luma, rgb[0], rgb[1], rgb[2], width);
    if (s->form.brought) s->to_709.apply(s->to_709.self, rgb[0], rgb[1], rgb[2], width);
}

static void take_rgb(wf_page_shown *s, int y) {
    size_t width = (size_t)s->info.width_px;
    float *rgb[3] = {s->line, s->line + width, s->line + 2 * width};
    uint16_t *to[3] = {line_of(s, 0, y), line_of(s, 1, y), line_of(s, 2, y)};
    wf_page_shown_rgb(s, y, rgb);
    for (int x = 0; x < s->info.width_px; x++) {
        uint16_t r = code(255 * rgb[0][x], 255), g = code(255 * rgb[1][x], 255),
                 b = code(255 * rgb[2][x], 255);
        to[0][x] = g;
        to[1][x] = (r - g) & 255;
        to[2][x] = (b - g) & 255;
    }
}

void wf_page_shown_take(wf_page_shown *s, const wf_video_frame *frame) {
    wf_signals_take(s->signals, frame, s->signal);
    for (int y = 0; y < s->info.lines; y++) {
        if (!s->form.ycbcr) take_rgb(s, y);
        for (int p = 0; p < WF_PACK_PLANES && s->form.ycbcr; p++) take_ycbcr(s, p, y);
    }
}
