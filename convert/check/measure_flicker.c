/* Interline flicker: what differs between the two fields of a frame where nothing moves. */
#include <math.h>
#include <stdlib.h>

#include "convert/check/histogram.h"
#include "convert/check/measurement.h"

#define SAME     0.01f /* of white: fields of one parity that differ by no more show the same */
#define SEEN     0.02f /* of white: flicker above this counts for the share */
#define CRT_LEFT 0.1f  /* of a line's light is left when the next field is drawn */

typedef struct flicker {
    wf_histogram values;
    wf_display_kind display;
    size_t samples;
    float *heat;    /* [lines][width]: sums of the flicker's squares; NULL: not wanted */
    unsigned *seen; /* [lines][width]: how many frames each is the sum of */
} flicker;

static void flicker_free(void *state) {
    flicker *f = state;
    if (!f) return;
    wf_histogram_free(&f->values);
    free(f->heat);
    free(f->seen);
    free(f);
}

static void *flicker_begin(const wf_video_info *info, const wf_measure_options *options) {
    flicker *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    f->display = options->display;
    f->samples = (size_t)info->width_px * (size_t)info->lines;
    bool made = wf_histogram_init(&f->values, SEEN);
    if (options->want_heat) {
        f->heat = calloc(f->samples, sizeof *f->heat);
        f->seen = calloc(f->samples, sizeof *f->seen);
        made &= f->heat && f->seen;
    }
    if (made) return f;
    flicker_free(f);
    return NULL;
}

/* A line of the raster and the two lines of the other field about it, from which a bob display
 * makes the light of that field here. At the picture's edge both are the only one there is. */
typedef struct line_pair {
    const float *own, *above, *below;
} line_pair;

static line_pair lines_at(const wf_signal *s, int y) {
    const float *own = s->light + (size_t)y * (size_t)s->width_px;
    ptrdiff_t width = s->width_px;
    const float *above = y > 0 ? own - width : own + width;
    const float *below = y < s->lines - 1 ? own + width : own - width;
    return (line_pair){own, above, below};
}

static float stretched(line_pair p, int x) {
    return 0.5f * (p.above[x] + p.below[x]);
}

static bool same_content(line_pair a, line_pair b, int x) {
    return fabsf(a.own[x] - b.own[x]) <= SAME &&
           fabsf(stretched(a, x) - stretched(b, x)) <= SAME;
}

static float flicker_at(const flicker *f, line_pair p, int x) {
    if (f->display == WF_DISPLAY_CRT) return 0.5f * (1 - CRT_LEFT) * fabsf(p.own[x]);
    return 0.5f * fabsf(p.own[x] - stretched(p, x));
}

/* Adds the flicker of a frame's two fields where another frame shows the same content, or
 * everywhere if there is no other. */
static void add_pair(flicker *f, const wf_signal *s, const wf_signal *other) {
    for (int y = 0; y < s->lines; y++) {
        line_pair p = lines_at(s, y), q = lines_at(other ? other : s, y);
        for (int x = 0; x < s->width_px; x++) {
            if (!same_content(p, q, x)) continue;
            float value = flicker_at(f, p, x);
            wf_histogram_add(&f->values, value);
            if (!f->heat) continue;
            size_t at = (size_t)y * (size_t)s->width_px + (size_t)x;
            f->heat[at] += value * value;
            f->seen[at]++;
        }
    }
}

static void flicker_add(void *state, const wf_signal *signal, const wf_signal *before) {
    if (before) add_pair(state, before, signal);
}

static float *heat_of(flicker *f) {
    float *heat = f->heat;
    for (size_t i = 0; heat && i < f->samples; i++)
        heat[i] = f->seen[i] ? sqrtf(heat[i] / (float)f->seen[i]) : 0;
    f->heat = NULL;
    return heat;
}

static void flicker_finish(void *state, const wf_signal *last, const wf_signal *before,
                           wf_figures *figures) {
    flicker *f = state;
    add_pair(f, last, before);
    figures->flicker_rms = wf_histogram_rms(&f->values);
    figures->flicker_p999 = wf_histogram_quantile(&f->values, 0.999);
    figures->flicker_share = wf_histogram_share(&f->values);
    figures->heat = heat_of(f);
}

const wf_measurement wf_measure_flicker = {flicker_begin, flicker_add, flicker_finish,
                                           flicker_free};
