/* Patches of fields against whole ones. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "filters/gather/samples.h"

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

/* A patch holds all that its samples reach, and its sums are those of the whole. */
static void patches(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof scenarios / sizeof *scenarios; n++) {
        const scenario *s = &scenarios[n];
        bench b = open_bench(s);
        float whole[3][24], part[3][24];
        float *const rows[2][3] = {{whole[0], whole[1], whole[2]}, {part[0], part[1], part[2]}};
        float v[5][COUNT];
        uint32_t seed = 3;
        const double from[5] = {7, 5, -2, 0, 0.1}, to[5] = {12, 9, 2, 1, 2};
        for (int k = 0; k < 5 * COUNT; k++)
            v[k % 5][k / 5] = (float)uniform(&seed, from[k % 5], to[k % 5]);
        const wf_samples samples = {.count = COUNT,
                                    .x = v[0],
                                    .y = v[1],
                                    .t = v[2],
                                    .field = s->field,
                                    .rgb = {v[3], v[3], v[3]},
                                    .weight = v[4]};
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
        cmocka_unit_test(patches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
