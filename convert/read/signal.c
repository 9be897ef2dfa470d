/* Frames of any finished video as Y'CbCr for every pixel and as light on a display. */
#include "convert/read/signal.h"

#include <stdlib.h>
#include <string.h>

#include "color/codes/encode.h"
#include "color/codes/levels.h"
#include "color/codes/ycbcr.h"
#include "color/space/builtin.h"
#include "convert/job/colors.h"

#define CODE_BITS 16 /* of linear light that is encoded: fine enough to count as exact */

struct wf_signals {
    wf_video_info info;
    const wf_colors *colors;
    wf_display display;
    float *line; /* of R' G' B', and the encoder's scratch */
    /* Linear light only: */
    wf_transform transform;
    wf_encoding encoding;
    wf_video_frame encoded;
    int across; /* of encoded: lines of an odd width have all their chroma */
    uint16_t *code;
};

/* ---- Memory ---- */

static bool make_encoded(wf_signals *s) {
    s->across = s->info.width_px % 2 ? 1 : 2;
    s->encoding = (wf_encoding){.luma = s->colors->luma,
                                .chroma = s->across == 2 ? WF_CHROMA_BT601 : WF_CHROMA_444,
                                .ycbcr = true,
                                .bits = CODE_BITS,
                                .width_px = s->info.width_px};
    s->code = malloc(3 * (size_t)s->info.width_px * sizeof *s->code);
    for (int p = 0; p < 3; p++) {
        int width = p ? s->info.width_px / s->across : s->info.width_px;
        s->encoded.width_px[p] = width;
        s->encoded.lines[p] = s->info.lines;
        s->encoded.plane[p] = malloc((size_t)width * (size_t)s->info.lines * sizeof(float));
        if (!s->encoded.plane[p]) return false;
    }
    return s->code;
}

static bool make_room(wf_signals *s) {
    size_t width = (size_t)s->info.width_px, scratch = wf_chroma_scratch(width);
    bool made = s->info.layout != WF_LINEAR || make_encoded(s);
    s->line = malloc((3 * width + scratch) * sizeof *s->line);
    return made && s->line;
}

weft_status wf_signals_new(const wf_video_info *info, wf_signals **out, weft_error *err) {
    char why[512];
    wf_signals *s = calloc(1, sizeof *s);
    if (!s) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    s->info = *info;
    s->colors = wf_colors_of(info->raster.matrix);
    wf_display_init(&s->display, s->colors->primaries, info->transfer);
    weft_status status = WEFT_OK;
    if (info->layout == WF_LINEAR &&
        !wf_builtin_transform("lin_rec709", s->colors->space, &s->transform, why, sizeof why))
        status = wf_fail(err, WEFT_NO_MEMORY, "%s", why); /* both spaces are known */
    if (!status && !make_room(s))
        status = wf_fail(err, WEFT_NO_MEMORY, "no memory for a frame");
    if (status)
        wf_signals_free(s);
    else
        *out = s;
    return status;
}

void wf_signals_free(wf_signals *s) {
    if (!s) return;
    if (s->transform.free) s->transform.free(s->transform.self);
    for (int p = 0; p < 3; p++) free(s->encoded.plane[p]);
    free(s->line);
    free(s->code);
    free(s);
}

weft_status wf_signal_new(const wf_signals *signals, wf_signal **out, weft_error *err) {
    const wf_video_info *info = &signals->info;
    size_t samples = (size_t)info->width_px * (size_t)info->lines;
    wf_signal *s = calloc(1, sizeof *s);
    float *planes = malloc(4 * samples * sizeof *planes);
    if (!s || !planes) {
        free(s);
        free(planes);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for a frame of %dx%d", info->width_px,
                       info->lines);
    }
    s->width_px = info->width_px;
    s->lines = info->lines;
    s->light = planes;
    for (int p = 0; p < 3; p++) s->ycbcr[p] = planes + (size_t)(p + 1) * samples;
    *out = s;
    return WEFT_OK;
}

void wf_signal_free(wf_signal *signal) {
    if (!signal) return;
    free(signal->light);
    free(signal);
}

/* ---- Chroma back to every pixel ---- */

/* The chroma line that goes with luma line y. Where there are half as many, the chroma lines
 * of a field go with the lines of that field. */
int wf_signal_chroma_line(const wf_signal *s, int y) {
    if (s->down == 1) return y;
    if (!s->fields) return y / s->down;
    int lines = (s->lines + s->down - 1) / s->down, line = y / 2 / s->down * 2 + y % 2;
    return line < lines ? line : lines - 1;
}

static void spread_line(const float *from, int across, int width_px, float *to) {
    const wf_chroma_filter *half_band = wf_chroma_filter_of(WF_CHROMA_BT601);
    int count = (width_px + across - 1) / across;
    if (across == 1) {
        memcpy(to, from, (size_t)width_px * sizeof *to);
        return;
    }
    if (across == 2 && width_px % 2 == 0) {
        wf_chroma_interpolate(half_band, from, (size_t)width_px, to);
        return;
    }
    for (int x = 0; x < width_px; x++) {
        int i = x / across, next = i + 1 < count ? i + 1 : i;
        float rest = (float)(x % across) / (float)across;
        to[x] = from[i] + rest * (from[next] - from[i]);
    }
}

static void spread_chroma(const wf_signal *signal, int y) {
    for (int p = 1; p < 3; p++) {
        const wf_video_frame *f = &signal->coded;
        int line = wf_signal_chroma_line(signal, y);
        spread_line(f->plane[p] + (size_t)line * (size_t)f->width_px[p], signal->across,
                    signal->width_px, signal->ycbcr[p] + (size_t)y * (size_t)signal->width_px);
    }
}

/* ---- Taking a frame ---- */

static void linear_light(const wf_video_frame *f, size_t at, size_t width, float *light) {
    for (size_t i = at; i < at + width; i++)
        light[i] =
            0.2126f * f->plane[0][i] + 0.7152f * f->plane[1][i] + 0.0722f * f->plane[2][i];
}

/* Encodes one line of scene-linear light to codes and decodes them to the planes of
 * `encoded`. */
static void encode_line(wf_signals *s, const wf_video_frame *frame, int y) {
    size_t width = (size_t)s->info.width_px, at = (size_t)y * width;
    float *rgb[3] = {s->line, s->line + width, s->line + 2 * width};
    uint16_t *code[3] = {s->code, s->code + width, s->code + 2 * width};
    for (int c = 0; c < 3; c++) memcpy(rgb[c], frame->plane[c] + at, width * sizeof(float));
    s->transform.apply(s->transform.self, rgb[0], rgb[1], rgb[2], width);
    wf_encode_line(&s->encoding, rgb, s->line + 3 * width, code);
    for (int p = 0; p < 3; p++) {
        size_t count = (size_t)s->encoded.width_px[p];
        wf_decode_line(&s->encoding, p, code[p], s->encoded.plane[p] + (size_t)y * count,
                       count);
    }
}

/* Turns a line of what is coded into Y'CbCr for every pixel. */
static void take_coded(const wf_signals *s, const wf_signal *signal, int y) {
    size_t width = (size_t)s->info.width_px, at = (size_t)y * width;
    memcpy(signal->ycbcr[0] + at, signal->coded.plane[0] + at, width * sizeof(float));
    if (signal->is_ycbcr) {
        spread_chroma(signal, y);
        return;
    }
    for (int p = 1; p < 3; p++)
        memcpy(signal->ycbcr[p] + at, signal->coded.plane[p] + at, width * sizeof(float));
    wf_ycbcr_of_rgb(s->colors->luma, signal->ycbcr[0] + at, signal->ycbcr[1] + at,
                    signal->ycbcr[2] + at, width);
}

static void displayed_light(wf_signals *s, const wf_signal *signal, int y) {
    size_t width = (size_t)s->info.width_px, at = (size_t)y * width;
    float *rgb[3] = {s->line, s->line + width, s->line + 2 * width};
    for (int p = 0; p < 3; p++) memcpy(rgb[p], signal->ycbcr[p] + at, width * sizeof(float));
    wf_rgb_of_ycbcr(s->colors->luma, rgb[0], rgb[1], rgb[2], width);
    wf_display_luminance(&s->display, (const float *const *)rgb, signal->light + at, width);
}

void wf_signals_take(wf_signals *s, const wf_video_frame *frame, wf_signal *signal) {
    bool linear = s->info.layout == WF_LINEAR;
    signal->coded = linear ? s->encoded : *frame;
    signal->coded.index = frame->index;
    signal->is_ycbcr = s->info.layout != WF_RGB;
    signal->across = linear ? s->across : s->info.across;
    signal->down = s->info.down;
    signal->fields = s->info.raster.scan != WF_PROGRESSIVE;
    for (int y = 0; y < s->info.lines; y++) {
        if (linear) encode_line(s, frame, y);
        take_coded(s, signal, y);
        if (linear)
            linear_light(frame, (size_t)y * (size_t)s->info.width_px, (size_t)s->info.width_px,
                         signal->light);
        else
            displayed_light(s, signal, y);
    }
}
