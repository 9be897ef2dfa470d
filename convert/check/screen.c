/* Fields as displays show them: stretched, on their own lines, or deinterlaced by FFmpeg. */
#include "convert/check/screen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/codes/levels.h"
#include "convert/base/module.h"
#include "convert/media/deinterlace/deinterlace.h"

#define LINEAR_BITS 16 /* of the codes that wf_signal has of linear light */

struct wf_screen {
    wf_display_kind kind;
    wf_shown shown;
    float *made[2]; /* what shown.field is of displays that do not deinterlace */
    /* Of those that do: */
    const wf_deinterlacer *deinterlacer;
    void *state;
    wf_video_info info; /* of its pictures */
    bool top_first;
    wf_video_frame picture[2]; /* in the order of time */
    wf_signals *signals;
    wf_signal *signal[2];
    uint16_t *code[3];
    double zero[3], unit[3]; /* a signal's code is signal * unit + zero */
};

const char *wf_display_name(wf_display_kind kind) {
    static const char *const names[] = {"bob", "crt", "bwdif", "yadif", "w3fdif"};
    return names[kind];
}

wf_viewing wf_screen_viewing(const wf_video_info *info, const wf_measure_options *options,
                             double hz) {
    double heights = wf_viewing_usual_heights(info->lines);
    double white_cd_m2 = wf_viewing_usual_white_cd_m2(info->transfer != WF_TRANSFER_BT1886);
    return (wf_viewing){
        .distance_heights = options->view_heights > 0 ? options->view_heights : heights,
        .white_cd_m2 = options->peak_cd_m2 > 0 ? options->peak_cd_m2 : white_cd_m2,
        .hz = hz,
        .width_px = info->width_px,
        .lines = info->lines,
        .pixel_aspect = wf_ratio_value(info->raster.pixel_aspect)};
}

/* ---- Deinterlacers ---- */

/* Linear light is deinterlaced as it is encoded. */
static wf_video_info info_of_pictures(const wf_video_info *info) {
    wf_video_info i = *info;
    i.raster.scan = WF_PROGRESSIVE;
    if (info->layout != WF_LINEAR) return i;
    i.layout = WF_YCBCR;
    i.bits = LINEAR_BITS;
    i.full_range = false;
    i.across = i.width_px % 2 ? 1 : 2;
    return i;
}

static void find_scales(wf_screen *s) {
    const wf_video_info *i = &s->info;
    const wf_encoding e = {
        .ycbcr = i->layout == WF_YCBCR, .full_range = i->full_range, .bits = i->bits};
    for (int p = 0; p < 3; p++) wf_code_scale(&e, p, &s->zero[p], &s->unit[p]);
}

static bool make_pictures(wf_screen *s) {
    const wf_video_info *i = &s->info;
    bool made = true;
    for (int p = 0; p < 3; p++) {
        int across = p ? i->across : 1, down = p ? i->down : 1;
        int width = (i->width_px + across - 1) / across;
        int lines = (i->lines + down - 1) / down;
        size_t count = (size_t)width * (size_t)lines;
        s->code[p] = calloc(count, sizeof *s->code[p]);
        made &= !!s->code[p];
        for (int k = 0; k < 2; k++) {
            s->picture[k].width_px[p] = width;
            s->picture[k].lines[p] = lines;
            s->picture[k].plane[p] = calloc(count, sizeof(float));
            made &= !!s->picture[k].plane[p];
        }
    }
    return made;
}

static weft_status find_deinterlacer(wf_screen *s, weft_error *err) {
    void *symbol;
    char what[80];
    snprintf(what, sizeof what, "--display %s, unlike bob and crt,", wf_display_name(s->kind));
    weft_status status =
        wf_module_symbol("deinterlace", "wf_deinterlacer_of", what, &symbol, err);
    if (status) return status;
    wf_deinterlacer_fn *find;
    memcpy(&find, &symbol, sizeof find);
    s->deinterlacer = find();
    return WEFT_OK;
}

/* Video that is not interlaced is taken for fields of which the top one is first, as FFmpeg
 * does. */
static weft_status open_deinterlacer(wf_screen *s, weft_error *err) {
    const wf_video_info *i = &s->info;
    const wf_woven woven = {.filter = wf_display_name(s->kind),
                            .ycbcr = i->layout == WF_YCBCR,
                            .planes = i->planes,
                            .bits = i->bits,
                            .across = i->across,
                            .down = i->down,
                            .width_px = i->width_px,
                            .lines = i->lines,
                            .top_first = s->top_first,
                            .frame_rate = i->raster.frame_rate};
    weft_status status = find_deinterlacer(s, err);
    if (!status) status = s->deinterlacer->open(&woven, &s->state, err);
    if (!status) status = wf_signals_new(i, &s->signals, err);
    for (int k = 0; k < 2 && !status; k++) {
        status = wf_signal_new(s->signals, &s->signal[k], err);
        if (!status)
            s->shown.field[k == 0 ? !s->top_first : s->top_first] = s->signal[k]->light;
        s->shown.picture[k] = &s->picture[k];
    }
    if (!status && !make_pictures(s))
        status = wf_fail(err, WEFT_NO_MEMORY, "no memory for a frame");
    find_scales(s);
    return status;
}

static weft_status put(wf_screen *s, const wf_signal *frame, weft_error *err) {
    if (!frame) return s->deinterlacer->put(s->state, NULL, err);
    float most = (float)((1 << s->info.bits) - 1);
    for (int p = 0; p < s->info.planes; p++) {
        const wf_video_frame *f = &frame->coded;
        size_t count = (size_t)f->width_px[p] * (size_t)f->lines[p];
        float zero = (float)s->zero[p], unit = (float)s->unit[p];
        for (size_t i = 0; i < count; i++) {
            float code = f->plane[p][i] * unit + zero + 0.5f;
            s->code[p][i] = (uint16_t)(code > 0 ? code < most + 0.5f ? code : most : 0);
        }
    }
    const uint16_t *const plane[3] = {s->code[0], s->code[1], s->code[2]};
    return s->deinterlacer->put(s->state, plane, err);
}

static weft_status take(wf_screen *s, int k, weft_error *err) {
    bool more = false;
    const wf_encoding e = {.ycbcr = s->info.layout == WF_YCBCR,
                           .full_range = s->info.full_range,
                           .bits = s->info.bits};
    weft_status status = s->deinterlacer->take(s->state, s->code, &more, err);
    if (!status && !more)
        status = wf_fail(err, WEFT_FAILED, "--display %s: it gave no picture of a field",
                         wf_display_name(s->kind));
    for (int p = 0; p < s->info.planes && !status; p++) {
        const wf_video_frame *f = &s->picture[k];
        wf_decode_line(&e, p, s->code[p], f->plane[p],
                       (size_t)f->width_px[p] * (size_t)f->lines[p]);
    }
    if (!status) wf_signals_take(s->signals, &s->picture[k], s->signal[k]);
    return status;
}

/* ---- Displays that show lines of one frame ---- */

/* The lines of a field as they are; those between, by a bob display, the mean of the lines
 * above and below, or at the picture's edge the one there is, and by a CRT nothing. */
static void show_field(const wf_signal *frame, bool bob, int parity, float *to) {
    ptrdiff_t width = frame->width_px;
    for (int y = 0; y < frame->lines; y++, to += width) {
        const float *at = frame->light + y * width;
        const float *above = y > 0 ? at - width : at + width;
        const float *below = y < frame->lines - 1 ? at + width : at - width;
        if (y % 2 == parity)
            memcpy(to, at, (size_t)width * sizeof *to);
        else
            for (ptrdiff_t x = 0; x < width; x++)
                to[x] = bob ? 0.5f * (above[x] + below[x]) : 0;
    }
}

/* ---- The screen ---- */

weft_status wf_screen_new(const wf_video_info *info, wf_display_kind kind, wf_screen **out,
                          weft_error *err) {
    size_t samples = (size_t)info->width_px * (size_t)info->lines;
    wf_screen *s = calloc(1, sizeof *s);
    if (!s) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    s->kind = kind;
    s->info = info_of_pictures(info);
    s->top_first = info->raster.scan == WF_PROGRESSIVE || info->raster.top_first;
    weft_status status = WEFT_OK;
    if (kind >= WF_DISPLAY_BWDIF) status = open_deinterlacer(s, err);
    for (int p = 0; p < 2 && kind < WF_DISPLAY_BWDIF && !status; p++) {
        s->shown.field[p] = s->made[p] = malloc(samples * sizeof(float));
        if (!s->made[p]) status = wf_fail(err, WEFT_NO_MEMORY, "no memory for a frame");
    }
    if (status)
        wf_screen_free(s);
    else
        *out = s;
    return status;
}

void wf_screen_free(wf_screen *s) {
    if (!s) return;
    if (s->deinterlacer) s->deinterlacer->close(s->state);
    for (int k = 0; k < 2; k++) {
        free(s->made[k]);
        wf_signal_free(s->signal[k]);
        for (int p = 0; p < 3; p++) free(s->picture[k].plane[p]);
    }
    for (int p = 0; p < 3; p++) free(s->code[p]);
    wf_signals_free(s->signals);
    free(s);
}

weft_status wf_screen_show(wf_screen *s, const wf_signal *frame, const wf_signal *next,
                           const wf_shown **shown, weft_error *err) {
    weft_status status = WEFT_OK;
    *shown = frame ? &s->shown : NULL;
    if (s->deinterlacer) {
        status = put(s, next, err);
        for (int k = 0; k < 2 && frame && !status; k++) status = take(s, k, err);
    } else if (frame) {
        for (int p = 0; p < 2; p++)
            show_field(frame, s->kind == WF_DISPLAY_BOB, p, s->shown.field[p]);
    }
    return status;
}

const wf_video_info *wf_screen_info(const wf_screen *screen) {
    return screen->deinterlacer ? &screen->info : NULL;
}
