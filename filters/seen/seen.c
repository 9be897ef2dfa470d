/* A modulation through the eye's bank of low passes, by tiles of lines. */
#include "filters/seen/seen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "filters/seen/blur.h"
#include "filters/seen/seen_ops.h"

#define LEAST_CD_M2  0.01
#define LOCAL_DEGREE 0.5 /* deviation of what the eye adapts to */

enum { LOCAL = WF_EYE_BANDS, BLURS }; /* blurs: the bands', and that of the local luminance */

/* What one thread needs; tiles of lines of s->stride floats. */
typedef struct worker {
    wf_blur_room room;
    float *part[WF_EYE_BANDS], *luminance, *sum[2];
    bool *live[WF_EYE_BANDS]; /* [spans] */
    bool *anywhere;           /* [spans]: for the luminance, which is */
} worker;

struct wf_seen {
    wf_viewing viewing;
    wf_eye eye;
    int every, workers;
    size_t stride, margin;
    wf_blur blur[BLURS];
    wf_blur_marks marks[2];
    worker *worker; /* [workers] */
    const float *picture[2], *mean;
    float *jnd;
};

/* ---- Making it ---- */

static bool make_blurs(wf_seen *s) {
    const wf_viewing *v = &s->viewing;
    bool made = true;
    for (int i = 0; i < BLURS; i++) {
        double degrees = i == LOCAL ? LOCAL_DEGREE : 1 / (2 * M_PI * wf_eye_width[i]);
        double down = degrees * wf_viewing_lines_degree(v);
        made &= wf_blur_init(&s->blur[i], v->width_px, v->lines, down, down / v->pixel_aspect);
        size_t margin = wf_blur_margin(&s->blur[i]);
        if (margin > s->margin) s->margin = margin;
    }
    s->stride = (size_t)v->width_px + 2 * s->margin;
    for (int p = 0; p < 2; p++) made &= wf_blur_marks_init(&s->marks[p], v->width_px, v->lines);
    return made;
}

/* Tiles begin with a margin before their first line. */
static float *tile_of(const wf_seen *s) {
    return calloc(WF_BLUR_TILE * s->stride, sizeof(float));
}

static bool make_worker(const wf_seen *s, worker *w) {
    size_t spans = (size_t)wf_blur_spans(s->viewing.width_px);
    bool made = wf_blur_room_init(&w->room, s->blur, BLURS, s->every);
    for (int i = 0; i < WF_EYE_BANDS; i++) {
        made &= !!(w->part[i] = tile_of(s));
        made &= !!(w->live[i] = malloc(spans * sizeof *w->live[i]));
    }
    for (int p = 0; p < 2; p++) made &= !!(w->sum[p] = tile_of(s));
    made &= !!(w->luminance = tile_of(s));
    made &= !!(w->anywhere = malloc(spans * sizeof *w->anywhere));
    return made;
}

static void free_worker(worker *w) {
    wf_blur_room_free(&w->room);
    for (int i = 0; i < WF_EYE_BANDS; i++) {
        free(w->part[i]);
        free(w->live[i]);
    }
    for (int p = 0; p < 2; p++) free(w->sum[p]);
    free(w->luminance);
    free(w->anywhere);
}

wf_seen *wf_seen_new(const wf_viewing *viewing, int every, int workers) {
    wf_seen *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->viewing = *viewing;
    s->every = every;
    wf_eye_init(&s->eye, viewing);
    s->worker = calloc((size_t)workers, sizeof *s->worker);
    bool made = make_blurs(s) && s->worker;
    for (; made && s->workers < workers; s->workers++)
        made = make_worker(s, &s->worker[s->workers]);
    if (made) return s;
    wf_seen_free(s);
    return NULL;
}

void wf_seen_free(wf_seen *s) {
    if (!s) return;
    for (int i = 0; i < BLURS; i++) wf_blur_free(&s->blur[i]);
    for (int p = 0; p < 2; p++) wf_blur_marks_free(&s->marks[p]);
    for (int i = 0; i < s->workers; i++) free_worker(&s->worker[i]);
    free(s->worker);
    free(s);
}

/* ---- What is seen ---- */

void wf_seen_begin(wf_seen *s, const float *real, const float *imaginary, const float *mean,
                   float *jnd) {
    s->picture[0] = real;
    s->picture[1] = imaginary;
    s->mean = mean;
    s->jnd = jnd;
}

/* Of the mean, and of each picture its marks and bands. */
int wf_seen_preparations(const wf_seen *s) {
    return 1 + (s->picture[1] ? 2 : 1) * (1 + WF_EYE_BANDS);
}

void wf_seen_prepare(wf_seen *s, int number, int n) {
    wf_blur_room *room = &s->worker[number].room;
    int which = (n - 1) / (1 + WF_EYE_BANDS), band = (n - 1) % (1 + WF_EYE_BANDS) - 1;
    if (n == 0)
        wf_blur_prepare(&s->blur[LOCAL], room, s->mean, 0);
    else if (band < 0)
        wf_blur_mark(&s->marks[which], s->picture[which], s->viewing.width_px,
                     s->viewing.lines);
    else
        wf_blur_prepare(&s->blur[band], room, s->picture[which], which);
}

/* Lines of a picture that are wanted, among them the first of a tile and how many it has. */
static int lines_wanted(const wf_seen *s) {
    return (s->viewing.lines + s->every - 1) / s->every;
}

int wf_seen_tiles(const wf_seen *s) {
    return (lines_wanted(s) + WF_BLUR_TILE - 1) / WF_BLUR_TILE;
}

static int lines_of(const wf_seen *s, int n) {
    int left = lines_wanted(s) - n * WF_BLUR_TILE;
    return left < WF_BLUR_TILE ? left : WF_BLUR_TILE;
}

/* The local luminance, white being 1. */
static void find_luminance(const wf_seen *s, worker *w, const float *light, int n) {
    float least = (float)(LEAST_CD_M2 / s->viewing.white_cd_m2);
    wf_blur_tile(&s->blur[LOCAL], &w->room, light, 0, NULL, n * WF_BLUR_TILE * s->every,
                 s->every, lines_of(s, n), w->luminance + s->margin, s->stride, w->anywhere);
    for (int i = 0; i < lines_of(s, n); i++) {
        float *line = w->luminance + s->margin + (size_t)i * s->stride;
        for (int x = 0; x < s->viewing.width_px; x++)
            line[x] = line[x] > least ? line[x] : least;
    }
}

/* Where a span of a line is among tiles. */
static size_t place_of(const wf_seen *s, int line, int span) {
    return s->margin + (size_t)line * s->stride + (size_t)span * WF_BLUR_SPAN;
}

static size_t width_of(const wf_seen *s, int span) {
    int left = s->viewing.width_px - span * WF_BLUR_SPAN;
    return (size_t)(left < WF_BLUR_SPAN ? left : WF_BLUR_SPAN);
}

/* What the eye makes of a span of a line at the local luminance. */
static void weigh_span(const wf_seen *s, worker *w, int line, int span, float *sum) {
    const float *part[WF_EYE_BANDS];
    size_t at = place_of(s, line, span);
    bool any = false;
    for (int band = 0; band < WF_EYE_BANDS; band++) {
        part[band] = w->live[band][span] ? w->part[band] + at : NULL;
        any |= w->live[band][span];
    }
    if (any)
        wf_seen_ops_best()->weigh(sum + at, part, w->luminance + at, &s->eye,
                                  (float)s->viewing.white_cd_m2, width_of(s, span));
    else
        memset(sum + at, 0, width_of(s, span) * sizeof *sum);
}

/* What the eye makes of a tile of one of the two pictures. */
static void weigh_tile(const wf_seen *s, worker *w, int which, int n) {
    for (int band = 0; band < WF_EYE_BANDS; band++)
        wf_blur_tile(&s->blur[band], &w->room, s->picture[which], which, &s->marks[which],
                     n * WF_BLUR_TILE * s->every, s->every, lines_of(s, n),
                     w->part[band] + s->margin, s->stride, w->live[band]);
    for (int i = 0; i < lines_of(s, n); i++)
        for (int j = 0; j < wf_blur_spans(s->viewing.width_px); j++)
            weigh_span(s, w, i, j, w->sum[which]);
}

void wf_seen_tile(wf_seen *s, int number, int n) {
    worker *w = &s->worker[number];
    size_t width = (size_t)s->viewing.width_px;
    float *jnd = s->jnd + (size_t)n * WF_BLUR_TILE * width;
    find_luminance(s, w, s->mean, n);
    for (int p = 0; p < 2 && s->picture[p]; p++) weigh_tile(s, w, p, n);
    for (int i = 0; i < lines_of(s, n); i++, jnd += width) {
        size_t at = place_of(s, i, 0);
        wf_seen_ops_best()->see(jnd, w->sum[0] + at, s->picture[1] ? w->sum[1] + at : NULL,
                                w->luminance + at, width);
    }
}

void wf_seen_jnd(wf_seen *s, const float *real, const float *imaginary, const float *mean,
                 float *jnd) {
    wf_seen_begin(s, real, imaginary, mean, jnd);
    for (int n = 0; n < wf_seen_preparations(s); n++) wf_seen_prepare(s, 0, n);
    for (int n = 0; n < wf_seen_tiles(s); n++) wf_seen_tile(s, 0, n);
}

/* ---- The bound ---- */

/* Where nothing is seen of any modulation it is not bounded, to speak of. */
#define LEAST_SENSITIVITY 1e-6f

static void bound_line(const wf_seen *s, worker *w, int line, float jnd, float *bound) {
    size_t at = place_of(s, line, 0), width = (size_t)s->viewing.width_px;
    const float *part[WF_EYE_BANDS], *local = w->luminance + at;
    float *whole = w->sum[0] + at;
    for (int band = 0; band < WF_EYE_BANDS; band++) part[band] = w->part[0] + at;
    wf_seen_ops_best()->weigh(whole, part, local, &s->eye, (float)s->viewing.white_cd_m2,
                              width);
    for (size_t x = 0; x < width; x++)
        bound[x] =
            jnd * local[x] / (whole[x] > LEAST_SENSITIVITY ? whole[x] : LEAST_SENSITIVITY);
}

void wf_seen_bound(wf_seen *s, const float *light, double jnd, float *bound) {
    size_t width = (size_t)s->viewing.width_px;
    worker *w = &s->worker[0];
    wf_blur_prepare(&s->blur[LOCAL], &w->room, light, 0);
    for (size_t i = 0; i < WF_BLUR_TILE * s->stride; i++) w->part[0][i] = 1;
    for (int n = 0; n < wf_seen_tiles(s); n++) {
        find_luminance(s, w, light, n);
        for (int i = 0; i < lines_of(s, n); i++, bound += width)
            bound_line(s, w, i, (float)jnd, bound);
    }
}
