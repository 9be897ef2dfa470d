/* Crawl: what comes and goes at an edge that drifts by half a line a field, for the eye that
 * follows it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/check/heat.h"
#include "convert/check/histogram.h"
#include "convert/check/measure_flicker.h"
#include "convert/check/same_content.h"
#include "filters/seen/seen.h"

/* Lines come back to the same places of such an edge after four fields, in which it drifts by
 * two lines: what they make of it is a modulation at a quarter of the field rate. */
enum { FIELDS = 4, DRIFT_LINES = 2, FRAMES = 3, REACH_LINES = 4 };

struct wf_crawl {
    int width_px, lines, first; /* first: parity of the field that is first */
    size_t samples;
    int64_t frames;
    wf_histogram values, jnds;
    wf_heat heat;
    wf_seen *seen;
    /* Of frame n at n % FRAMES: its light, and its fields as shown, in the order of time. */
    float *light[FRAMES], *field[FRAMES][2];
    bool any;   /* of the frames in hand: something comes and goes */
    bool *same; /* [width_px] */
    /* [lines][width_px]: something moves among the lines that are looked at for the pixel: a
     * still grating may look as if it drifted; something of it does not follow the drift; and
     * what is counted. */
    bool *moves, *strays, *counted;
    /* [2 * lines][width_px], of half lines, for the amplitude turns about once in two lines. */
    float *real, *imaginary, *mean, *jnd;
};

/* ---- Memory ---- */

void wf_crawl_free(wf_crawl *c) {
    if (!c) return;
    wf_histogram_free(&c->values);
    wf_histogram_free(&c->jnds);
    wf_heat_free(&c->heat);
    wf_seen_free(c->seen);
    for (int k = 0; k < FRAMES; k++) {
        free(c->light[k]);
        free(c->field[k][0]);
        free(c->field[k][1]);
    }
    bool *masks[] = {c->same, c->moves, c->strays, c->counted};
    float *planes[] = {c->real, c->imaginary, c->mean, c->jnd};
    for (size_t i = 0; i < sizeof masks / sizeof *masks; i++) free(masks[i]);
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) free(planes[i]);
    free(c);
}

static bool make_planes(wf_crawl *c) {
    float **half_lines[] = {&c->real, &c->imaginary, &c->mean, &c->jnd};
    bool made = true;
    for (int k = 0; k < FRAMES; k++) {
        float **frame[] = {&c->light[k], &c->field[k][0], &c->field[k][1]};
        for (int i = 0; i < 3; i++) made &= !!(*frame[i] = malloc(c->samples * sizeof(float)));
    }
    for (size_t i = 0; i < sizeof half_lines / sizeof *half_lines; i++)
        made &= !!(*half_lines[i] = malloc(2 * c->samples * sizeof(float)));
    c->same = malloc((size_t)c->width_px * sizeof *c->same);
    c->moves = malloc(c->samples * sizeof *c->moves);
    c->strays = malloc(c->samples * sizeof *c->strays);
    c->counted = malloc(c->samples * sizeof *c->counted);
    return made && c->same && c->moves && c->strays && c->counted;
}

wf_crawl *wf_crawl_new(const wf_video_info *info, const wf_measure_options *options,
                       int threads) {
    wf_crawl *c = calloc(1, sizeof *c);
    if (!c) return NULL;
    double field_hz = 2 * wf_ratio_value(info->raster.frame_rate);
    wf_viewing viewing = wf_screen_viewing(info, options, field_hz / FIELDS);
    viewing.lines *= 2; /* half lines */
    viewing.pixel_aspect *= 2;
    c->width_px = info->width_px;
    c->lines = info->lines;
    c->samples = (size_t)info->width_px * (size_t)info->lines;
    c->first = info->raster.top_first ? 0 : 1;
    c->seen = wf_seen_new(&viewing, 2, threads);
    bool made = c->seen && make_planes(c);
    made &= wf_histogram_init(&c->values, 1);
    made &= wf_histogram_init(&c->jnds, 1);
    if (options->want_heat && options->heat == WF_HEAT_CRAWL)
        made &= wf_heat_init(&c->heat, c->samples);
    if (made) return c;
    wf_crawl_free(c);
    return NULL;
}

/* ---- One direction ---- */

/* Marks the pixels for which a line is looked at where it is not the same as in another frame.
 */
static void mark_about(wf_crawl *c, int y, bool *marked) {
    size_t width = (size_t)c->width_px;
    int from = y > REACH_LINES ? y - REACH_LINES : 0;
    for (int line = from; line < c->lines && line <= y + REACH_LINES; line++)
        for (size_t x = 0; x < width; x++) marked[(size_t)line * width + x] |= !c->same[x];
}

/* Marks in `marked` what is not the same `frames` frames after frame n and so many lines lower.
 */
static void mark_changes(wf_crawl *c, int64_t n, int frames, int down_lines, bool *marked) {
    size_t width = (size_t)c->width_px;
    memset(marked, 0, c->samples * sizeof *marked);
    for (int y = 0; y < c->lines; y++) {
        bool outside = y + down_lines < 0 || y + down_lines >= c->lines;
        wf_same_content(c->light[n % FRAMES], c->light[(n + frames) % FRAMES], c->width_px,
                        c->lines, y, down_lines, c->same);
        if (!outside)
            mark_about(c, y, marked);
        else
            for (size_t x = 0; x < width; x++) marked[(size_t)y * width + x] = true;
    }
}

/* Two lines of one field. */
typedef struct two_lines {
    const float *above, *below;
} two_lines;

/* Those of field k of frame n, a later one, between which line y of its first field lies when
 * it has drifted. */
static two_lines lines_about(const wf_crawl *c, int64_t n, int k, int y, int down) {
    int at = (2 * y + k * down) >> 1, parity = (c->first + k) & 1;
    int above = at - ((at ^ parity) & 1), below = above + 2;
    above = above < 0 ? below : above;
    below = below < c->lines ? below : above;
    const float *light = c->light[(n + k / 2) % FRAMES];
    return (two_lines){light + (size_t)above * (size_t)c->width_px,
                       light + (size_t)below * (size_t)c->width_px};
}

static float less(float a, float b) {
    return a < b ? a : b;
}

static float more(float a, float b) {
    return a > b ? a : b;
}

/* How far a value is from what two lines span. */
static float outside_of(two_lines t, size_t x, float value) {
    float low = less(t.above[x], t.below[x]), high = more(t.above[x], t.below[x]);
    return more(0, more(low - value, value - high));
}

/* Marks what the fields in between do not lead to: what has come back to its like, as a wheel's
 * spokes do, or is the same again after something has passed, has not drifted. Where something
 * drifts, a line of the first field is about what the lines of each other field span that pass
 * by the same place, but for details that are no larger than a line. */
static void mark_jumps(wf_crawl *c, int64_t n, int down, bool *marked) {
    const float most = 0.6f, same = 0.01f; /* of what all lines span; of white */
    size_t width = (size_t)c->width_px;
    for (int y = 2 + c->first; y < c->lines - 2; y += 2) {
        const float *own = c->light[n % FRAMES] + (size_t)y * width;
        two_lines field[FIELDS];
        for (int k = 1; k < FIELDS; k++) field[k] = lines_about(c, n, k, y, down);
        for (size_t x = 0; x < width; x++) {
            float low = own[x], high = own[x], farthest = 0;
            for (int k = 1; k < FIELDS; k++) {
                low = less(low, less(field[k].above[x], field[k].below[x]));
                high = more(high, more(field[k].above[x], field[k].below[x]));
                farthest = more(farthest, outside_of(field[k], x, own[x]));
            }
            c->same[x] = farthest <= same + most * (high - low);
        }
        mark_about(c, y, marked);
    }
}

/* Line y of a field, y in half lines: between two lines their mean. */
static two_lines lines_at_half(const wf_crawl *c, const float *field, int half_y) {
    int most = c->lines - 1, y = half_y >> 1, next = y + (half_y & 1);
    y = y < 0 ? 0 : y < most ? y : most;
    next = next < 0 ? 0 : next < most ? next : most;
    size_t width = (size_t)c->width_px;
    return (two_lines){field + (size_t)y * width, field + (size_t)next * width};
}

static float mean_of(two_lines t, size_t x) {
    return 0.5f * (t.above[x] + t.below[x]);
}

/* Whether any pixel of a line moves and does not stray. */
static bool drifts(const bool *moves, const bool *strays, size_t width) {
    bool any = false;
    for (size_t x = 0; x < width; x++) any |= moves[x] & !strays[x];
    return any;
}

/* The part of four fields that has one period in them, as a complex amplitude, and their mean,
 * on half line half_y of the first; those after it are looked at where what was there has
 * drifted to. What may drift either way is taken for what has more of it. */
static void modulation_of_line(wf_crawl *c, const float *const field[FIELDS], int half_y,
                               int down) {
    size_t width = (size_t)c->width_px, at = (size_t)half_y * width;
    const bool *moves = c->moves + (size_t)(half_y / 2) * width;
    const bool *strays = c->strays + (size_t)(half_y / 2) * width;
    two_lines line[FIELDS];
    if (!drifts(moves, strays, width)) return;
    for (int k = 0; k < FIELDS; k++) line[k] = lines_at_half(c, field[k], half_y + k * down);
    for (size_t x = 0; x < width; x++, at++) {
        float light[FIELDS];
        if (!moves[x] || strays[x]) continue;
        for (int k = 0; k < FIELDS; k++) light[k] = mean_of(line[k], x);
        float real = 0.5f * (light[0] - light[2]), imaginary = 0.5f * (light[3] - light[1]);
        float before = c->real[at] * c->real[at] + c->imaginary[at] * c->imaginary[at];
        if (real * real + imaginary * imaginary <= before) continue;
        c->real[at] = real;
        c->imaginary[at] = imaginary;
        c->mean[at] = 0.25f * (light[0] + light[1] + light[2] + light[3]);
    }
}

/* Without a modulation, and the light of both fields of frame n. */
static void clear_line(wf_crawl *c, int64_t n, int half_y) {
    size_t width = (size_t)c->width_px, at = (size_t)half_y * width;
    two_lines first = lines_at_half(c, c->field[n % FRAMES][0], half_y);
    two_lines second = lines_at_half(c, c->field[n % FRAMES][1], half_y);
    float *restrict mean = c->mean + at;
    memset(c->real + at, 0, width * sizeof *c->real);
    memset(c->imaginary + at, 0, width * sizeof *c->imaginary);
    for (size_t x = 0; x < width; x++)
        mean[x] = 0.5f * (mean_of(first, x) + mean_of(second, x));
}

/* Counts what drifts down, or up: down is 1 or -1. False: there is nothing that moves. What
 * follows the drift is told by the frame two frames later, in which all is two lines lower. */
static bool count_direction(wf_crawl *c, int64_t n, int down) {
    bool any = false;
    mark_changes(c, n, 2, down * DRIFT_LINES, c->strays);
    mark_jumps(c, n, down, c->strays);
    for (size_t i = 0; i < c->samples; i++) {
        c->counted[i] |= !c->strays[i];
        any |= c->moves[i] & !c->strays[i];
    }
    return any;
}

/* Finds the modulation of what drifts either way; false: there is none. */
static bool find_modulation(wf_crawl *c, int64_t n) {
    const float *const field[FIELDS] = {c->field[n % FRAMES][0], c->field[n % FRAMES][1],
                                        c->field[(n + 1) % FRAMES][0],
                                        c->field[(n + 1) % FRAMES][1]};
    bool any = false;
    memset(c->counted, 0, c->samples * sizeof *c->counted);
    mark_changes(c, n, 1, 0, c->moves);
    for (int down = 1; down >= -1; down -= 2) {
        if (!count_direction(c, n, down)) continue;
        for (int y = 0; y < 2 * c->lines && !any; y++) clear_line(c, n, y);
        for (int y = 0; y < 2 * c->lines; y++) modulation_of_line(c, field, y, down);
        any = true;
    }
    return any;
}

/* Counts a pixel of which something comes and goes; at: its place among half lines. */
static void count_pixel(wf_crawl *c, size_t i, size_t at) {
    wf_histogram_add(&c->values, hypotf(c->real[at], c->imaginary[at]));
    wf_histogram_add(&c->jnds, c->jnd[i]);
    wf_heat_add(&c->heat, i, c->jnd[i]);
}

/* Of a frame and the three fields after its first, once the frame two later is known. */
void wf_crawl_count(wf_crawl *c) {
    size_t width = (size_t)c->width_px;
    uint64_t zeros = 0;
    if (c->frames < FRAMES) return;
    for (size_t y = 0, i = 0; y < (size_t)c->lines; y++)
        for (size_t x = 0; x < width; x++, i++) {
            size_t at = i + y * width;
            if (!c->counted[i]) continue;
            if (c->any && (c->jnd[i] > 0 || c->real[at] != 0 || c->imaginary[at] != 0)) {
                count_pixel(c, i, at);
                continue;
            }
            zeros++;
            wf_heat_add(&c->heat, i, 0);
        }
    wf_histogram_add_zeros(&c->values, zeros);
    wf_histogram_add_zeros(&c->jnds, zeros);
}

/* ---- All ---- */

void wf_crawl_find(wf_crawl *c, const wf_signal *frame, const wf_shown *shown) {
    size_t bytes = c->samples * sizeof(float);
    int k = (int)(c->frames % FRAMES);
    memcpy(c->light[k], frame->light, bytes);
    for (int i = 0; i < 2; i++)
        memcpy(c->field[k][i], shown->field[i == 0 ? c->first : 1 - c->first], bytes);
    c->frames++;
    c->any = c->frames >= FRAMES && find_modulation(c, c->frames - FRAMES);
    if (c->any) wf_seen_begin(c->seen, c->real, c->imaginary, c->mean, c->jnd);
}

wf_seen *wf_crawl_begun(const wf_crawl *c) {
    return c->any ? c->seen : NULL;
}

void wf_crawl_finish(wf_crawl *c, wf_figures *figures) {
    figures->crawl_rms = wf_histogram_rms(&c->values);
    figures->crawl_p999 = wf_histogram_quantile(&c->values, 0.999);
    figures->crawl_jnd_p999 = wf_histogram_quantile(&c->jnds, 0.999);
    figures->crawl_share = wf_histogram_share(&c->jnds);
    if (c->heat.square) figures->heat = wf_heat_take(&c->heat);
}
