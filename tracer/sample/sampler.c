/* Where the samples of a cell lie: Sobol's points, strata with jitter, or a grid. */
#include "tracer/sample/sampler.h"

#include <math.h>
#include <stdlib.h>

#include "tracer/sample/sampler_inside.h"

struct wf_sampler {
    wf_sampler_kind kind;
    int count;
    uint64_t seed;
    const wf_sampler_ops *ops;
    uint32_t *reversed[3]; /* Sobol's first three dimensions, [count], bits in reverse order */
    float *low[2], *size;  /* strata of x and y: where they begin, how wide they are in x */
    float height;
};

WF_ISA_DISPATCH(wf_sampler_ops)

/* ---- Sobol's sequence ---- */

/* Direction numbers of dimension d by their recurrences: x, 1 + x and 1 + x + x^2 (Joe and Kuo
 * 2008). As bits in reverse order: bit 0 stands for a half. */
static void find_directions(int dimension, uint32_t direction[32]) {
    static const uint32_t first[3][2] = {{1, 1}, {1, 3}, {1, 3}};
    uint32_t m[32] = {first[dimension][0], first[dimension][1]};
    for (int k = 0; k < 32; k++) {
        if (dimension == 0) m[k] = 1;
        if (dimension == 1 && k > 0) m[k] = 2 * m[k - 1] ^ m[k - 1];
        if (dimension == 2 && k > 1) m[k] = 2 * m[k - 1] ^ 4 * m[k - 2] ^ m[k - 2];
        direction[k] = 0;
        for (int bit = 0; bit <= k; bit++)
            if (m[k] >> bit & 1) direction[k] |= 1u << (k - bit);
    }
}

static bool make_sobol(wf_sampler *s) {
    for (int d = 0; d < 3; d++) {
        uint32_t direction[32];
        find_directions(d, direction);
        s->reversed[d] = malloc((size_t)s->count * sizeof **s->reversed);
        if (!s->reversed[d]) return false;
        for (int i = 0; i < s->count; i++) {
            uint32_t v = 0;
            for (int k = 0; k < 32; k++)
                if ((uint32_t)i >> k & 1) v ^= direction[k];
            s->reversed[d][i] = v;
        }
    }
    return true;
}

/* ---- Strata ---- */

/* About as many rows as columns; where the count is no product, rows differ by one. */
static bool make_strata(wf_sampler *s) {
    int rows = (int)floor(sqrt(s->count));
    size_t bytes = (size_t)s->count * sizeof(float);
    s->low[0] = malloc(bytes);
    s->low[1] = malloc(bytes);
    s->size = malloc(bytes);
    if (!s->low[0] || !s->low[1] || !s->size) return false;
    s->height = 1.0f / (float)rows;
    for (int r = 0, i = 0; r < rows; r++) {
        int first = (int)((int64_t)s->count * r / rows);
        int end = (int)((int64_t)s->count * (r + 1) / rows);
        for (; i < end; i++) {
            s->size[i] = 1.0f / (float)(end - first);
            s->low[0][i] = (float)(i - first) * s->size[i];
            s->low[1][i] = (float)r * s->height;
        }
    }
    return true;
}

/* ---- Life ---- */

wf_sampler *wf_sampler_new(wf_sampler_kind kind, int count, uint64_t seed) {
    wf_sampler *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    *s = (wf_sampler){.kind = kind, .count = count, .seed = seed};
    s->ops = wf_sampler_ops_best();
    if (make_sobol(s) && make_strata(s)) return s;
    wf_sampler_free(s);
    return NULL;
}

void wf_sampler_free(wf_sampler *s) {
    if (!s) return;
    for (int d = 0; d < 3; d++) free(s->reversed[d]);
    free(s->low[0]);
    free(s->low[1]);
    free(s->size);
    free(s);
}

/* ---- Drawing ---- */

static uint64_t mix(uint64_t v) {
    v = (v ^ v >> 30) * 0xbf58476d1ce4e5b9u;
    v = (v ^ v >> 27) * 0x94d049bb133111ebu;
    return v ^ v >> 31;
}

/* Three seeds that differ from those of every other cell. */
static void find_seeds(const wf_sampler *s, wf_cell cell, uint32_t seed[3]) {
    uint64_t v = mix(s->seed + 0x9e3779b97f4a7c15u);
    v = mix(v + (uint64_t)cell.time);
    v = mix(v + ((uint64_t)(uint32_t)cell.y << 32 | (uint32_t)cell.x));
    v = mix(v + (uint64_t)cell.set);
    for (int d = 0; d < 3; d++) {
        v += 0x9e3779b97f4a7c15u;
        seed[d] = (uint32_t)(mix(v) >> 32);
    }
}

static void draw_sobol(const wf_sampler *s, const uint32_t seed[3], float *const out[3]) {
    for (int d = 0; d < 3; d++) s->ops->scramble(s->reversed[d], s->count, seed[d], out[d]);
}

void wf_sampler_draw_more(const wf_sampler *s, wf_cell cell, int first, int count, float *x,
                          float *y, float *f) {
    uint32_t seed[3];
    float *const out[3] = {x, y, f};
    find_seeds(s, cell, seed);
    for (int d = 0; d < 3; d++)
        s->ops->scramble(s->reversed[d] + first, count, seed[d], out[d]);
}

/* Strata in x and y, each with a place of its own in time. */
static void draw_jitter(const wf_sampler *s, const uint32_t seed[3], float *const out[3]) {
    s->ops->random(s->count, seed[0], out[0]);
    s->ops->random(s->count, seed[1], out[1]);
    s->ops->scramble(s->reversed[0], s->count, seed[2], out[2]);
    for (int i = 0; i < s->count; i++) {
        out[0][i] = s->low[0][i] + out[0][i] * s->size[i];
        out[1][i] = s->low[1][i] + out[1][i] * s->height;
    }
}

/* The middles of the strata, in times that follow one another as far apart as they can. */
static void draw_grid(const wf_sampler *s, const uint32_t seed[3], float *const out[3]) {
    (void)seed;
    s->ops->scramble(s->reversed[0], s->count, 0, out[2]);
    for (int i = 0; i < s->count; i++) {
        out[0][i] = s->low[0][i] + 0.5f * s->size[i];
        out[1][i] = s->low[1][i] + 0.5f * s->height;
    }
}

typedef void draw_fn(const wf_sampler *s, const uint32_t seed[3], float *const out[3]);

static draw_fn *const draw[] = {[WF_SAMPLER_JITTER] = draw_jitter,
                                [WF_SAMPLER_SOBOL] = draw_sobol,
                                [WF_SAMPLER_GRID] = draw_grid};

void wf_sampler_draw(const wf_sampler *s, wf_cell cell, float *x, float *y, float *f) {
    uint32_t seed[3];
    float *const out[3] = {x, y, f};
    find_seeds(s, cell, seed);
    draw[s->kind](s, seed, out);
    for (int d = 0; d < 3; d++)
        for (int i = 0; i < s->count; i++)
            out[d][i] = out[d][i] < 0x1.fffffep-1f ? out[d][i] : 0x1.fffffep-1f;
}
