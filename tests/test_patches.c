/* Samples that stand for a stretch of x, and patches of fields, against their definitions. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "filters/samples.h"

#define COUNT 400

static uint32_t draw(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static double uniform(uint32_t *state, double low, double high) {
    return low + (high - low) * draw(state) / 16777216.0;
}

typedef struct scenario {
    const char *raster, *aperture;
    double tau, skew;
    wf_position position;
    int64_t field;
} scenario;

static const scenario scenarios[] = {
    {"24x16@30i,tff,par=1:1", "line", 0.5, 0, WF_START, 0},
    {"24x16@30i,bff,par=1:1", "box", 1, 0, WF_CENTER, 3},
    {"24x16@30i,tff,par=1:1", "box", 0, 0, WF_START, 2},
    {"24x16@30i,tff,par=1:1", "notch", 2, 0, WF_END, 2},
    {"24x16@30i,bff,par=1:1", "shaped", 0.5, 0, WF_START, 1},
    {"24x16@30i,tff,par=1:1", "shaped", 1.5, 0.5, WF_START, 1},
    {"24x16@30i,tff,par=1:1", "diamond", 2, 0, WF_CENTER, 2},
    {"24x16@30i,tff,par=1:1", "diamond", 0, 0, WF_CENTER, 2},
    {"24x16@24p,par=1:1", "mitchell:1/3,1/3", 1, 0, WF_START, 1},
    {"24x16@24psf,tff,par=1:1", "notch", 0.5, 0, WF_START, 3},
};

typedef struct bench {
    wf_raster raster;
    wf_gather_desc desc;
    wf_gather *gather;
    int parity, step, lines;
} bench;

static bench open_bench(const scenario *s) {
    char why[512];
    bench b = {0};
    b.desc.width = wf_ratio((int64_t)(4 * s->tau), 4);
    b.desc.skew = wf_ratio((int64_t)(4 * s->skew), 4);
    b.desc.position = s->position;
    if (!wf_raster_parse(s->raster, &b.raster, why, sizeof why)) fail_msg("%s", why);
    if (!wf_aperture_parse(s->aperture, &b.desc.aperture, why, sizeof why)) fail_msg("%s", why);
    b.parity = wf_raster_parity(&b.raster, s->field);
    b.step = wf_raster_line_step(&b.raster);
    b.lines = wf_raster_field_lines(&b.raster, b.parity);
    return b;
}

static void start(bench *b, const scenario *s) {
    b->desc.raster = &b->raster;
    b->gather = wf_gather_new(&b->desc, s->field, 0, b->lines);
    assert_non_null(b->gather);
}

/* h at an instant, as resampling.md has it; tau 0 is its limit. */
static double height_at(const bench *b, const scenario *s, double u, double v, double q) {
    if (s->tau > 0) {
        bool seen = fabs(q) <= s->tau / 2;
        return seen ? wf_aperture_value(&b->desc.aperture, s->tau, u, v, q) : 0;
    }
    if (fabs(q) > 0x1p-12) return 0;
    if (!strcmp(s->aperture, "diamond")) return fabs(u) <= 0.5 ? fmax(0, 1 - fabs(v)) : 0;
    return wf_aperture_value(&b->desc.aperture, 1, u, v, 0);
}

static double middle_of(const scenario *s) {
    return s->position == WF_START ? s->tau / 2 : s->position == WF_END ? -s->tau / 2 : 0;
}

/* Where the window's middle lies for line j, counted from the instant of field `from`. */
static double middle_on(const bench *b, const scenario *s, int64_t from, int j) {
    bool segmented = b->raster.scan == WF_SEGMENTED;
    double apart = segmented ? (double)(s->field / 2 - from / 2) : (double)(s->field - from);
    return apart + s->skew * j / b->raster.lines + middle_of(s);
}

/* ---- What stretches along x ---- */

typedef struct wide {
    float x[COUNT], y[COUNT], t[COUNT], rgb[COUNT], extent[COUNT];
} wide;

static wide *make_wide(const scenario *s) {
    wide *w = calloc(1, sizeof *w);
    uint32_t seed = 3;
    assert_non_null(w);
    for (int n = 0; n < COUNT; n++) {
        w->x[n] = (float)uniform(&seed, -0.5, 24.5);
        w->y[n] = (float)uniform(&seed, 0, 16);
        w->t[n] = s->tau > 0 ? (float)uniform(&seed, -2, 3) : 0;
        w->rgb[n] = (float)uniform(&seed, 0, 1);
        w->extent[n] = (float)uniform(&seed, 1e-3, 1);
    }
    return w;
}

/* How far the aperture reaches along x at v: by bisection of its own value. */
static double half_at(const bench *b, const scenario *s, double v, double q) {
    double low = 0, high = 3;
    if (!(height_at(b, s, 0, v, q) != 0)) return 0;
    for (int n = 0; n < 60; n++) {
        double middle = (low + high) / 2;
        if (height_at(b, s, middle, v, q) != 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void check_wide(const scenario *s, const bench *b, const wide *w) {
    float *rgb[3];
    for (int c = 0; c < 3; c++) rgb[c] = malloc((size_t)b->raster.width_px * sizeof(float));
    for (int l = 0; l < b->lines; l++) {
        wf_gather_line(b->gather, l, rgb);
        int j = b->parity + l * b->step;
        for (int i = 0; i < b->raster.width_px; i++) {
            double light = 0, weight = 0;
            for (int n = 0; n < COUNT; n++) {
                double v = (double)w->y[n] - (j + 0.5), q = (double)w->t[n];
                q -= middle_on(b, s, s->field, j);
                double half = half_at(b, s, v, q), extent = (double)w->extent[n];
                double from = fmax(i + 0.5 - half, (double)w->x[n] - extent / 2);
                double to = fmin(i + 0.5 + half, (double)w->x[n] + extent / 2);
                double h = height_at(b, s, 0, v, q) * fmax(to - from, 0) / extent;
                weight += h;
                light += h * (double)w->rgb[n];
            }
            double should = light / weight, is = (double)rgb[1][i];
            if (fabs(weight) > 1e-3 && fabs(is - should) > 2e-6)
                fail_msg("%s: line %d pixel %d is %g, should be %g", s->aperture, j, i, is,
                         should);
        }
    }
    for (int c = 0; c < 3; c++) free(rgb[c]);
}

static void extents(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof scenarios / sizeof *scenarios; n++) {
        const scenario *s = &scenarios[n];
        bench b = open_bench(s);
        wide *w = make_wide(s);
        const wf_samples samples = {.count = COUNT,
                                    .x = w->x,
                                    .y = w->y,
                                    .t = w->t,
                                    .field = s->field,
                                    .rgb = {w->rgb, w->rgb, w->rgb},
                                    .extent = w->extent};
        start(&b, s);
        wf_gather_add(b.gather, &samples);
        check_wide(s, &b, w);
        wf_gather_free(b.gather);
        free(w);
    }
}

/* ---- Patches ---- */

/* A patch holds all that its samples reach, and its sums are those of the whole. */
static void patches(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof scenarios / sizeof *scenarios; n++) {
        const scenario *s = &scenarios[n];
        bench b = open_bench(s);
        float whole[3][24], part[3][24];
        float *const rows[2][3] = {{whole[0], whole[1], whole[2]}, {part[0], part[1], part[2]}};
        float x[2] = {7.25f, 11.5f}, y[2] = {5.5f, 8.75f}, t[2] = {0, 0}, v[2] = {1, 0.5f};
        const wf_samples samples = {
            .count = 2, .x = x, .y = y, .t = t, .field = s->field, .rgb = {v, v, v}};
        start(&b, s);
        wf_gather_add(b.gather, &samples);
        wf_patch patch =
            wf_gather_patch(&b.desc, s->field, (double[]){7, 12}, (double[]){5, 9});
        wf_gather *small = wf_gather_new_patch(&b.desc, s->field, patch);
        wf_gather *sum = wf_gather_new(&b.desc, s->field, 0, b.lines);
        assert_non_null(small);
        assert_non_null(sum);
        assert_true(patch.left > 0 && patch.right < 24);
        wf_gather_add(small, &samples);
        wf_gather_merge(sum, small);
        for (int l = 0; l < b.lines; l++) {
            wf_gather_line(b.gather, l, rows[0]);
            wf_gather_line(sum, l, rows[1]);
            assert_memory_equal(whole, part, sizeof whole);
        }
        wf_gather_free(small);
        wf_gather_free(sum);
        wf_gather_free(b.gather);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extents),
        cmocka_unit_test(patches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
