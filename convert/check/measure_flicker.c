/* Interline flicker: what differs between the two fields of a frame where nothing moves, and
 * how much of that is seen. */
#include "convert/check/measure_flicker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/check/heat.h"
#include "convert/check/histogram.h"
#include "convert/check/same_content.h"
#include "filters/seen/seen.h"

#define SEEN     0.02f /* of white: flicker above this counts for the share */
#define CRT_LEFT 0.1f  /* of a line's light is left when the next field is drawn */

struct wf_flicker {
    int width_px, lines;
    float drop; /* what a line loses until the next field, as a share */
    wf_heat_kind heat_kind;
    wf_heat heat;
    wf_histogram values, jnds;
    wf_seen *seen;
    bool *same;                     /* [lines][width_px] */
    bool any;                       /* of the frame in hand: something comes and goes */
    float *modulation, *mean, *jnd; /* the same */
};

void wf_flicker_free(wf_flicker *f) {
    if (!f) return;
    wf_histogram_free(&f->values);
    wf_histogram_free(&f->jnds);
    wf_heat_free(&f->heat);
    wf_seen_free(f->seen);
    free(f->same);
    free(f->modulation);
    free(f->mean);
    free(f->jnd);
    free(f);
}

wf_flicker *wf_flicker_new(const wf_video_info *info, const wf_measure_options *options,
                           int threads) {
    wf_flicker *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    size_t samples = (size_t)info->width_px * (size_t)info->lines;
    wf_viewing viewing =
        wf_screen_viewing(info, options, wf_ratio_value(info->raster.frame_rate));
    f->width_px = info->width_px;
    f->lines = info->lines;
    f->drop = options->display == WF_DISPLAY_CRT ? 1 - CRT_LEFT : 1;
    f->heat_kind = options->heat;
    f->seen = wf_seen_new(&viewing, 1, threads);
    f->same = malloc(samples * sizeof *f->same);
    f->modulation = malloc(samples * sizeof *f->modulation);
    f->mean = malloc(samples * sizeof *f->mean);
    f->jnd = malloc(samples * sizeof *f->jnd);
    bool made = f->seen && f->same && f->modulation && f->mean && f->jnd;
    made &= wf_histogram_init(&f->values, SEEN);
    made &= wf_histogram_init(&f->jnds, 1);
    if (options->want_heat && options->heat != WF_HEAT_CRAWL)
        made &= wf_heat_init(&f->heat, samples);
    if (made) return f;
    wf_flicker_free(f);
    return NULL;
}

/* Half of what differs between the fields, and what they have in common; what moves has no
 * modulation. False: none has. */
static bool find_modulation(wf_flicker *f, const wf_shown *shown) {
    size_t samples = (size_t)f->width_px * (size_t)f->lines;
    const float *top = shown->field[0], *bottom = shown->field[1];
    bool any = false;
    for (size_t i = 0; i < samples; i++) {
        float half = 0.5f * (top[i] - bottom[i]);
        f->modulation[i] = f->same[i] ? half : 0;
        f->mean[i] = 0.5f * (top[i] + bottom[i]);
        any |= f->modulation[i] != 0;
    }
    return any;
}

void wf_flicker_count(wf_flicker *f) {
    size_t samples = (size_t)f->width_px * (size_t)f->lines;
    uint64_t zeros = 0, unseen = 0;
    if (!f->any) memset(f->jnd, 0, samples * sizeof *f->jnd);
    for (size_t i = 0; i < samples; i++) {
        if (!f->same[i]) continue;
        float value = f->drop * fabsf(f->modulation[i]), seen = f->jnd[i];
        if (value > 0)
            wf_histogram_add(&f->values, value);
        else
            zeros++;
        if (seen > 0)
            wf_histogram_add(&f->jnds, seen);
        else
            unseen++;
        if (f->heat.square)
            wf_heat_add(&f->heat, i, f->heat_kind == WF_HEAT_FLICKER ? value : seen);
    }
    wf_histogram_add_zeros(&f->values, zeros);
    wf_histogram_add_zeros(&f->jnds, unseen);
}

void wf_flicker_find(wf_flicker *f, const wf_signal *frame, const wf_signal *other,
                     const wf_shown *shown) {
    size_t width = (size_t)f->width_px;
    if (!other) other = frame;
    for (int y = 0; y < f->lines; y++)
        wf_same_content(frame->light, other->light, f->width_px, f->lines, y, 0,
                        f->same + (size_t)y * width);
    f->any = find_modulation(f, shown);
    if (f->any) wf_seen_begin(f->seen, f->modulation, NULL, f->mean, f->jnd);
}

wf_seen *wf_flicker_begun(const wf_flicker *f) {
    return f->any ? f->seen : NULL;
}

void wf_flicker_finish(wf_flicker *f, wf_figures *figures) {
    figures->flicker_rms = wf_histogram_rms(&f->values);
    figures->flicker_p999 = wf_histogram_quantile(&f->values, 0.999);
    figures->flicker_share = wf_histogram_share(&f->values);
    figures->visible_jnd_p999 = wf_histogram_quantile(&f->jnds, 0.999);
    figures->visible_share = wf_histogram_share(&f->jnds);
    if (f->heat.square) figures->heat = wf_heat_take(&f->heat);
}
