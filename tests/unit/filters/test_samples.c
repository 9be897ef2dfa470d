/* Irregular samples against the sums of filters/README.md written down pixel by pixel. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "filters/gather/samples.h"
#include "tests/unit/support/sizes.h"

#define COUNT 6000

typedef struct cloud {
    float x[COUNT], y[COUNT], t[COUNT], rgb[3][COUNT], weight[COUNT];
    wf_samples samples;
} cloud;

static uint32_t draw(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static float uniform(uint32_t *state, double low, double high) {
    return (float)(low + (high - low) * draw(state) / 16777216.0);
}

/* Samples in and around a raster, some on edges of pixels, lines and windows, some spikes. */
static cloud *make_cloud(const wf_raster *raster, double t0, double t1, bool weighted) {
    cloud *c = calloc(1, sizeof *c);
    uint32_t seed = 5;
    assert_non_null(c);
    for (int i = 0; i < COUNT; i++) {
        c->x[i] = uniform(&seed, -3, raster->width_px + 3);
        c->y[i] = uniform(&seed, -3, raster->lines + 3);
        c->t[i] = uniform(&seed, t0, t1);
        if (i % 7 == 0) c->x[i] = floorf(c->x[i]);
        if (i % 11 == 0) c->y[i] = floorf(2 * c->y[i]) / 2;
        if (i % 13 == 0) c->t[i] = floorf(4 * c->t[i]) / 4;
        for (int k = 0; k < 3; k++) c->rgb[k][i] = i % 50 ? uniform(&seed, 0, 1) : 65504;
        c->weight[i] = uniform(&seed, 0.1, 2);
    }
    c->samples = (wf_samples){.count = COUNT,
                              .x = c->x,
                              .y = c->y,
                              .t = c->t,
                              .field = 3,
                              .rgb = {c->rgb[0], c->rgb[1], c->rgb[2]},
                              .weight = weighted ? c->weight : NULL};
    return c;
}

/* ---- The definition ---- */

static double f(double v) {
    double s = fabs(v);
    return s < 1 ? 0.5 - s * s / 4 : s < 2 ? s * s / 4 - s + 1 : 0;
}

static double mitchell(double v) {
    const double b = 1.0 / 3, c = 1.0 / 3, x = fabs(v);
    if (x < 1)
        return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) /
               6;
    if (x < 2)
        return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
                8 * b + 24 * c) /
               6;
    return 0;
}

static bool within(double z, double width) {
    return fabs(z) <= width / 2;
}

/* `crisp`: its steps as they stand, an eighth of a line each. */
static double crisp(double u, double v) {
    static wf_aperture a;
    char why[256];
    if (!a.kind) assert_true(wf_aperture_parse("crisp", &a, why, sizeof why));
    int step = (int)(fabs(v) * 8);
    return within(u, 1.6) && step < a.stairs.count ? a.stairs.height[step] : 0;
}

static double h(const char *name, double tau, double u, double v, double q) {
    if (!within(q, tau > 0 ? tau : 2 * 0x1p-12)) return 0;
    if (!strcmp(name, "line")) return within(u, 1) && within(v, 1);
    if (!strcmp(name, "box")) return within(u, 1) && within(v, 2);
    if (!strcmp(name, "notch")) return within(u, 1) ? f(v) : 0;
    if (!strcmp(name, "shaped")) return fabs(u) < 2 * f(v);
    if (!strcmp(name, "crisp")) return crisp(u, v);
    if (!strcmp(name, "diamond") && tau > 0)
        return within(u, 1) && fabs(v) + fabs(2 * q / tau) <= 1;
    if (!strcmp(name, "diamond")) return within(u, 1) ? fmax(0, 1 - fabs(v)) : 0;
    return within(u, 1) ? mitchell(v) : 0;
}

typedef struct scenario {
    const char *raster, *name, *aperture;
    wf_rational width, skew;
    wf_position position;
    int64_t field;
    bool weighted;
} scenario;

typedef struct sums {
    double light, weight, scale;
} sums;

static sums evaluate(const scenario *s, const wf_raster *r, const cloud *c, int i, int j,
                     int channel) {
    sums all = {0};
    double tau = wf_ratio_value(s->width);
    double middle = s->position == WF_START ? tau / 2 : s->position == WF_CENTER ? 0 : -tau / 2;
    double instant =
        r->scan == WF_SEGMENTED ? (double)(s->field / 2 - 3 / 2) : (double)(s->field - 3);
    for (int k = 0; k < COUNT; k++) {
        double q = (double)c->t[k] - instant - wf_ratio_value(s->skew) * j / r->lines - middle;
        double w = h(s->name, tau, (double)c->x[k] - i - 0.5, (double)c->y[k] - j - 0.5, q) *
                   (s->weighted ? (double)c->weight[k] : 1);
        all.weight += w;
        all.light += w * (double)c->rgb[channel][k];
        all.scale += fabs(w * (double)c->rgb[channel][k]);
    }
    return all;
}

static wf_gather_desc describe(const scenario *s, wf_raster *raster) {
    char why[512];
    wf_gather_desc d = {
        .raster = raster, .width = s->width, .position = s->position, .skew = s->skew};
    if (!wf_raster_parse(s->raster, raster, why, sizeof why)) fail_msg("%s", why);
    if (!wf_aperture_parse(s->aperture, &d.aperture, why, sizeof why)) fail_msg("%s", why);
    return d;
}

static int field_lines(const wf_gather_desc *d, int64_t field) {
    return wf_raster_field_lines(d->raster, wf_raster_parity(d->raster, field));
}

static void check_pixel(const scenario *s, const wf_raster *r, const cloud *c, int i, int j,
                        float *const rgb[3]) {
    int channel = (i + j) % 3;
    sums all = evaluate(s, r, c, i, j, channel);
    double is = (double)rgb[channel][i];
    if (all.weight == 0) {
        assert_true(is == 0);
        return;
    }
    double should = all.light / all.weight, bound = 1e-6 * all.scale / fabs(all.weight);
    /* Where positive and negative weights nearly cancel, the quotient says little. */
    bool cancels = fabs(all.weight) < 1e-3;
    if (!cancels && !(fabs(is - should) <= bound))
        fail_msg("%s, field %d, line %d pixel %d: %g, should be %g", s->aperture, (int)s->field,
                 j, i, is, should);
}

static void check(const scenario *s) {
    wf_raster raster;
    wf_gather_desc d = describe(s, &raster);
    cloud *c = make_cloud(&raster, -3, 3, s->weighted);
    float line[3][32], *rgb[3] = {line[0], line[1], line[2]};
    wf_gather *g = wf_gather_new(&d, s->field, 0, field_lines(&d, s->field));
    assert_non_null(g);
    wf_gather_add(g, &c->samples);
    for (int l = 0; l < field_lines(&d, s->field); l++) {
        int j = wf_raster_parity(&raster, s->field) + l * wf_raster_line_step(&raster);
        wf_gather_line(g, l, rgb);
        for (int i = 0; i < raster.width_px; i++) check_pixel(s, &raster, c, i, j, rgb);
    }
    wf_gather_free(g);
    free(c);
}

static const struct {
    const char *name, *aperture;
} apertures[] = {{"line", "line"},       {"line", "rotated"},
                 {"box", "box"},         {"box", "ccd"},
                 {"notch", "notch"},     {"shaped", "shaped"},
                 {"diamond", "diamond"}, {"mitchell", "mitchell:1/3,1/3"},
                 {"crisp", "crisp"}};

static void the_sums(void **state) {
    (void)state;
    static const wf_rational widths[] = {{0, 1}, {1, 2}, {1, 1}, {3, 1}};
    static const char *const rasters[] = {"24x16@30i,bff", "24x17@25p", "24x16@25psf"};
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a++)
        for (int variant = 0; variant < 24; variant += test_step(5)) {
            scenario s = {.raster = rasters[variant % 3],
                          .name = apertures[a].name,
                          .aperture = apertures[a].aperture,
                          .width = widths[variant % 4],
                          .skew = variant % 5 == 0 ? (wf_rational){1, 2} : (wf_rational){0, 1},
                          .position = (wf_position)(variant / 4 % 3),
                          .field = 2 + variant % 3,
                          .weighted = variant % 2 == 1};
            check(&s);
        }
}

/* Bands gathered apart and merged give what one gather of the same bands in order gives. */
static void bands_merge(void **state) {
    (void)state;
    scenario s = {.raster = "24x16@30i,tff", .aperture = "shaped", .width = {1, 1}, .field = 3};
    wf_raster raster;
    wf_gather_desc d = describe(&s, &raster);
    cloud *c = make_cloud(&raster, 0, 1, false);
    wf_gather *whole = wf_gather_new(&d, 3, 0, 8), *again = wf_gather_new(&d, 3, 0, 8);
    for (int round = 0; round < 2; round++)
        for (int band = 0; band < 4; band++) {
            int first, end;
            wf_samples part = c->samples;
            part.x += band * 1500, part.y += band * 1500, part.t += band * 1500,
                part.count = 1500;
            for (int k = 0; k < 3; k++) part.rgb[k] += band * 1500;
            wf_gather_lines(&d, 3, -3, 19, &first, &end);
            wf_gather *g = wf_gather_new(&d, 3, first, end);
            wf_gather_add(g, &part);
            wf_gather_merge(round ? again : whole, g);
            wf_gather_free(g);
        }
    for (int l = 0; l < 8; l++) {
        float a[3][24], b[3][24], *x[3] = {a[0], a[1], a[2]}, *y[3] = {b[0], b[1], b[2]};
        wf_gather_line(whole, l, x);
        wf_gather_line(again, l, y);
        assert_memory_equal(a, b, sizeof a);
    }
    wf_gather_free(whole);
    wf_gather_free(again);
    free(c);
}

/* The lines and fields said to be reached are those that are. */
static void what_is_reached(void **state) {
    (void)state;
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a++)
        for (int k = 0; k < 200; k += test_step(7)) {
            uint32_t seed = (uint32_t)k + 1;
            scenario s = {.raster = k % 2 ? "8x16@30i,bff" : "8x16@25psf",
                          .aperture = apertures[a].aperture,
                          .width = {k % 4, 2},
                          .position = (wf_position)(k % 3),
                          .field = 0};
            wf_raster raster;
            wf_gather_desc d = describe(&s, &raster);
            float x = 4, y = uniform(&seed, -3, 19), t = uniform(&seed, -3, 3), one = 1;
            wf_samples sample = {
                .count = 1, .x = &x, .y = &y, .t = &t, .field = 10, .rgb = {&one, &one, &one}};
            int64_t first_field, last_field;
            wf_gather_fields(&d, 10, (double)t, (double)t, &first_field, &last_field);
            for (int64_t n = 2; n < 20; n++) {
                wf_gather *g = wf_gather_new(&d, n, 0, 8);
                int first, end;
                float line[3][8], *rgb[3] = {line[0], line[1], line[2]};
                wf_gather_lines(&d, n, (double)y, (double)y, &first, &end);
                wf_gather_add(g, &sample);
                for (int l = 0; l < 8; l++) {
                    wf_gather_line(g, l, rgb);
                    bool reached = line[0][3] != 0 || line[0][4] != 0;
                    if (reached)
                        assert_true(n >= first_field && n <= last_field && l >= first &&
                                    l < end);
                }
                wf_gather_free(g);
            }
        }
}

static void empty_pixels(void **state) {
    (void)state;
    scenario s = {.raster = "8x4@30i,tff", .aperture = "line", .width = {1, 1}, .field = 0};
    wf_raster raster;
    wf_gather_desc d = describe(&s, &raster);
    float x[2] = {1.5f, 6.5f}, y[2] = {0.5f, 2.5f}, t[2] = {0.5f, 0.5f}, red[2] = {1, 2};
    wf_samples samples = {.count = 2, .x = x, .y = y, .t = t, .rgb = {red, red, red}};
    wf_gather *g = wf_gather_new(&d, 0, 0, 2);
    float line[3][8], *rgb[3] = {line[0], line[1], line[2]}, nearest[4];
    assert_false(wf_gather_nearest(g, 0, 3, nearest));
    wf_gather_add(g, &samples);
    assert_int_equal(wf_gather_line(g, 0, rgb), 0);
    assert_true(line[0][1] == 1 && line[0][2] == 0);
    assert_true(wf_gather_nearest(g, 0, 3, nearest) && nearest[0] == 1);
    assert_true(wf_gather_nearest(g, 0, 6, nearest) && nearest[0] == 2);
    assert_true(wf_gather_nearest(g, 1, 0, nearest) && nearest[2] == 1);
    wf_gather_free(g);
}

/* ---- Cells ---- */

#define GRID 48 /* samples across and down a cell, which stand for its integral */

static float color_of(int x, int y) {
    return (float)((x * 7 + y * 13) % 10) / 10;
}

/* Every cell of an 8 x 16 raster by a grid of samples, in the middle of the window. */
static void add_grids(wf_gather *g, float late) {
    enum { COUNT_EACH = GRID * GRID };
    static float x[COUNT_EACH], y[COUNT_EACH], t[COUNT_EACH], c[COUNT_EACH];
    for (int cell = 0; cell < 8 * 16; cell++) {
        for (int n = 0; n < COUNT_EACH; n++) {
            x[n] = (float)(cell % 8) + ((float)(n % GRID) + 0.5f) / GRID;
            y[n] = (float)(cell / 8) + ((float)(n / GRID) + 0.5f) / GRID;
            t[n] = late;
            c[n] = color_of(cell % 8, cell / 8);
        }
        const wf_samples samples = {
            .count = COUNT_EACH, .x = x, .y = y, .t = t, .field = 0, .rgb = {c, c, c}};
        wf_gather_add(g, &samples);
    }
}

static void add_cells(wf_gather *g, int64_t field) {
    int x[8 * 16], y[8 * 16];
    float c[8 * 16];
    for (int cell = 0; cell < 8 * 16; cell++) {
        x[cell] = cell % 8;
        y[cell] = cell / 8;
        c[cell] = color_of(x[cell], y[cell]);
    }
    const wf_sample_cells cells = {8 * 16, x, y, {c, c, c}, NULL};
    const wf_samples samples = {.field = field, .cells = &cells};
    wf_gather_add(g, &samples);
}

/* Colors of cells are weighed by the integral of the aperture over each. */
static void cells_are_weighed(void **state) {
    (void)state;
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a++) {
        scenario s = {
            .raster = "8x16@30i,tff", .aperture = apertures[a].aperture, .width = {1, 2}};
        wf_raster raster;
        wf_gather_desc d = describe(&s, &raster);
        if (d.aperture.kind->couples_vq) continue;
        wf_gather *grids = wf_gather_new(&d, 0, 0, 8), *cells = wf_gather_new(&d, 0, 0, 8);
        float one[3][8], two[3][8];
        add_grids(grids, 0.25f);
        add_cells(cells, 0);
        add_cells(cells, 2); /* of another time */
        for (int l = 0; l < 8; l++) {
            assert_int_equal(wf_gather_line(grids, l, (float *[3]){one[0], one[1], one[2]}),
                             -1);
            assert_int_equal(wf_gather_line(cells, l, (float *[3]){two[0], two[1], two[2]}),
                             -1);
            for (int i = 0; i < 8; i++)
                if (fabsf(one[0][i] - two[0][i]) > 0.004f)
                    fail_msg("%s, line %d, pixel %d: %g, not %g", s.aperture, l, i,
                             (double)two[0][i], (double)one[0][i]);
        }
        wf_gather_free(grids);
        wf_gather_free(cells);
    }
}

/* What samples differ from their cells adds color alone. */
static void differences_weigh_nothing(void **state) {
    (void)state;
    scenario s = {.raster = "8x16@30i,tff", .aperture = "box", .width = {1, 2}};
    wf_raster raster;
    wf_gather_desc d = describe(&s, &raster);
    wf_gather *g = wf_gather_new(&d, 0, 0, 8);
    static const wf_sample_cells none;
    float x = 3.5f, y = 4.5f, t = 0.25f, red = 0.5f, line[3][8];
    add_cells(g, 0);
    wf_gather_line(g, 2, (float *[3]){line[0], line[1], line[2]});
    float before = line[0][3];
    const wf_samples samples = {
        .count = 1, .x = &x, .y = &y, .t = &t, .rgb = {&red, &red, &red}, .cells = &none};
    wf_gather_add(g, &samples);
    wf_gather_line(g, 2, (float *[3]){line[0], line[1], line[2]});
    assert_true(fabsf(line[0][3] - before - 0.25f) < 1e-6f); /* box: half of two cells */
    wf_gather_free(g);
}

/* ---- Alpha ---- */

#define B 0.375f /* what lies behind */

/* Alpha of a channel's samples is that channel to the bit, through merging too, and color
 * beside it is what it is without. */
static void alpha_is_gathered_as_color(void **state) {
    (void)state;
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a++) {
        scenario s = {.raster = "24x16@30i,bff",
                      .name = apertures[a].name,
                      .field = 3,
                      .aperture = apertures[a].aperture,
                      .width = {1, 1},
                      .weighted = a % 2};
        wf_raster raster;
        wf_gather_desc d = describe(&s, &raster);
        cloud *c = make_cloud(&raster, -3, 3, s.weighted);
        float plain[3][32], line[3][32], alpha[32];
        wf_gather *without = wf_gather_new(&d, 3, 0, 8);
        d.alpha = true;
        wf_gather *g = wf_gather_new(&d, 3, 0, 8), *all = wf_gather_new(&d, 3, 0, 8);
        assert_true(without && g && all);
        wf_gather_add(without, &c->samples);
        c->samples.alpha = c->rgb[1];
        wf_gather_add(g, &c->samples);
        wf_gather_merge(all, g);
        for (int l = 0; l < 8; l++) {
            wf_gather_line(without, l, (float *[3]){plain[0], plain[1], plain[2]});
            wf_gather_line(all, l, (float *[3]){line[0], line[1], line[2]});
            wf_gather_alpha(all, l, alpha);
            for (int i = 0; i < 24; i++) {
                assert_memory_equal(&alpha[i], &line[1][i], sizeof *alpha);
                for (int k = 0; k < 3; k++) assert_true(line[k][i] == plain[k][i]);
            }
        }
        wf_gather_free(without);
        wf_gather_free(g);
        wf_gather_free(all);
        free(c);
    }
}

/* filter(A over B) = filter(A) + (1 - alpha) B; samples without alpha are opaque, and so is
 * what fills pixels. */
static void what_is_over_lies_over(void **state) {
    (void)state;
    scenario s = {.raster = "24x16@30i,bff", .aperture = "shaped", .width = {1, 1}};
    wf_raster raster;
    wf_gather_desc d = describe(&s, &raster);
    cloud *c = make_cloud(&raster, -3, 3, true);
    uint32_t seed = 9;
    static float light[COUNT], over[COUNT], alpha[COUNT];
    for (int i = 0; i < COUNT; i++) {
        alpha[i] = i % 5 ? uniform(&seed, 0, 1) : (float)(i % 2);
        light[i] = alpha[i] * uniform(&seed, 0, 1);
        over[i] = light[i] + (1 - alpha[i]) * B;
    }
    c->samples.rgb[0] = light;
    c->samples.rgb[1] = over;
    c->samples.alpha = alpha;
    d.alpha = true;
    wf_gather *g = wf_gather_new(&d, 3, 0, 8);
    float line[3][24], key[24], white[3] = {1, 1, 1}, nearest[4];
    wf_gather_add(g, &c->samples);
    for (int l = 0; l < 8; l++) {
        wf_gather_line(g, l, (float *[3]){line[0], line[1], line[2]});
        wf_gather_alpha(g, l, key);
        for (int i = 0; i < 24; i++)
            if (wf_gather_reached(g, l, i))
                assert_true(fabsf(line[1][i] - (line[0][i] + (1 - key[i]) * B)) < 1e-6f);
    }
    for (int i = 0; i < 24; i++)
        if (wf_gather_reached(g, 7, i))
            assert_true(wf_gather_nearest(g, 7, i, nearest) && nearest[3] == key[i]);
    wf_gather_free(g);
    g = wf_gather_new(&d, 3, 0, 8);
    wf_gather_fill(g, &(wf_sample_tile){.right = 24, .end = 16}, white);
    c->samples.alpha = NULL;
    wf_gather_add(g, &c->samples);
    wf_gather_alpha(g, 3, key);
    for (int i = 0; i < 24; i++) assert_true(fabsf(key[i] - 1) < 1e-6f);
    wf_gather_free(g);
    free(c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alpha_is_gathered_as_color),
        cmocka_unit_test(what_is_over_lies_over),
        cmocka_unit_test(cells_are_weighed),
        cmocka_unit_test(differences_weigh_nothing),
        cmocka_unit_test(the_sums),
        cmocka_unit_test(bands_merge),
        cmocka_unit_test(what_is_reached),
        cmocka_unit_test(empty_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
