/* The door for renderers: what is pushed comes out as the rules of irregular samples say, in
 * any order of pushing, and what makes no sense is refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/weft.h"

#define WIDTH 16
#define LINES 12
#define EACH  8
#define COUNT (WIDTH * LINES * EACH)

typedef struct cloud {
    float v[6][COUNT];
} cloud;

static float drawn(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) * 0x1p-24f;
}

static void draw(cloud *c, uint32_t seed) {
    for (int k = 0; k < COUNT; k++) {
        c->v[0][k] = (float)(k / EACH % WIDTH) + drawn(&seed);
        c->v[1][k] = (float)(k / EACH / WIDTH) + drawn(&seed);
        c->v[2][k] = 0.5f * drawn(&seed);
        for (int n = 3; n < 6; n++) c->v[n][k] = drawn(&seed);
    }
}

static weft_samples block_of(const cloud *c, size_t first, size_t count, int64_t field) {
    return (weft_samples){count,
                          c->v[0] + first,
                          c->v[1] + first,
                          c->v[2] + first,
                          field,
                          c->v[3] + first,
                          c->v[4] + first,
                          c->v[5] + first,
                          NULL,
                          NULL};
}

typedef struct taken {
    float rgb[4][3 * WIDTH * LINES];
    int64_t count;
} taken;

static void take(const weft_field *field, void *user) {
    taken *t = user;
    assert_int_equal(field->index, t->count);
    assert_int_equal(field->lines, LINES / 2);
    assert_int_equal(field->first_line, field->index % 2);
    memcpy(t->rgb[t->count++], field->rgb,
           (size_t)(3 * field->lines * field->width_px) * sizeof(float));
}

static weft_job *make_job(const char *aperture) {
    weft_error err;
    weft_job *job = weft_job_new();
    assert_non_null(job);
    assert_int_equal(weft_job_set(job, "raster", "16x12@30i,tff", &err), WEFT_OK);
    assert_int_equal(weft_job_set(job, "aperture", aperture, &err), WEFT_OK);
    return job;
}

/* One pixel of the box aperture, summed in double. */
static double box_at(const cloud *c, int channel, int i, int j) {
    double light = 0, weight = 0;
    for (int k = 0; k < COUNT; k++) {
        bool in = fabs((double)c->v[0][k] - i - 0.5) <= 0.5 &&
                  fabs((double)c->v[1][k] - j - 0.5) <= 1;
        light += in ? (double)c->v[3 + channel][k] : 0;
        weight += in;
    }
    return light / weight;
}

static void sums(void **state) {
    static cloud clouds[4];
    static taken t;
    weft_error err;
    weft_fields *fields;
    weft_job *job = make_job("box");
    (void)state;
    t.count = 0;
    assert_int_equal(weft_fields_new(job, 2, take, &t, &fields, &err), WEFT_OK);
    for (int n = 0; n < 4; n++) {
        draw(&clouds[n], (uint32_t)n);
        /* In blocks, the last first. */
        for (size_t at = COUNT; at > 0; at -= 96) {
            weft_samples block = block_of(&clouds[n], at - 96, 96, n);
            if (weft_fields_push(fields, &block, &err)) fail_msg("%s", err.text);
        }
        assert_int_equal(weft_fields_until(fields, n + 1, &err), WEFT_OK);
        assert_int_equal(t.count, n + 1);
    }
    assert_int_equal(weft_fields_finish(fields, &err), WEFT_OK);
    for (int n = 0; n < 4; n++)
        for (int l = 0; l < LINES / 2; l++)
            for (int i = 0; i < WIDTH; i++)
                for (int c = 0; c < 3; c++) {
                    double should = box_at(&clouds[n], c, i, 2 * l + n % 2);
                    assert_true(fabs((double)t.rgb[n][3 * (l * WIDTH + i) + c] - should) <
                                1e-6);
                }
    weft_fields_free(fields);
    weft_job_free(job);
}

/* A constant tile is a constant field, through any aperture and over several fields. */
static void tiles(void **state) {
    static float gray[3 * 64 * 48];
    static taken t;
    (void)state;
    for (size_t k = 0; k < sizeof gray / sizeof *gray; k++) gray[k] = 0.375f;
    for (size_t a = 0; weft_aperture_name(a); a++) {
        weft_error err;
        weft_fields *fields;
        const char *name = weft_aperture_name(a);
        weft_job *job = make_job(!strcmp(name, "mitchell") ? "mitchell:0.5,0.25"
                                 : !strcmp(name, "design") ? "design:sharp=0.7"
                                 : !strcmp(name, "least")  ? "least:4"
                                                           : name);
        t.count = 0;
        assert_int_equal(weft_fields_new(job, 2, take, &t, &fields, &err), WEFT_OK);
        for (int n = 0; n < 6; n++)
            for (int k = 0; k < 8; k++) {
                const weft_tile tile = {0, 0, WIDTH, LINES, k / 8.0, n, 64, 48, gray, NULL};
                if (weft_fields_push_tile(fields, &tile, &err)) fail_msg("%s", err.text);
            }
        assert_int_equal(weft_fields_finish(fields, &err), WEFT_OK);
        assert_int_equal(t.count, 4);
        for (int k = 0; k < 3 * WIDTH * LINES / 2; k++) assert_true(t.rgb[3][k] == 0.375f);
        weft_fields_free(fields);
        weft_job_free(job);
    }
}

static void refusals(void **state) {
    static cloud c;
    static taken t;
    weft_error err;
    weft_fields *fields;
    weft_job *job = make_job("box");
    weft_samples block;
    (void)state;
    t.count = 0;
    assert_int_equal(weft_fields_new(job, 0, take, &t, &fields, &err), WEFT_USAGE);
    assert_int_equal(weft_fields_new(job, 2, take, &t, &fields, &err), WEFT_OK);
    draw(&c, 1);
    block = block_of(&c, 0, COUNT, 0);
    assert_int_equal(weft_fields_push(fields, &block, &err), WEFT_OK);
    assert_int_equal(weft_fields_until(fields, 1, &err), WEFT_OK);
    assert_int_equal(weft_fields_push(fields, &block, &err), WEFT_USAGE);
    assert_non_null(strstr(err.text, "field 0 is finished"));
    c.v[4][77] = NAN;
    block.field = 1;
    assert_int_equal(weft_fields_push(fields, &block, &err), WEFT_USAGE);
    assert_int_equal(weft_fields_finish(fields, &err),
                     WEFT_FAILED); /* field 1 has no samples */
    assert_non_null(strstr(err.text, "field 1, line 0, pixel 0"));
    weft_fields_free(fields);
    weft_job_free(job);
}

/* A sample at a time beyond all fields, in whatever field it is said to be, takes none of the
 * others with it. */
static void far_times(void **state) {
    static const int64_t fields_of[] = {INT64_MIN, INT64_MAX};
    static float t[WIDTH * LINES * 3], x[WIDTH * LINES * 3], y[WIDTH * LINES * 3],
        gray[WIDTH * LINES * 3];
    static taken taken_fields;
    weft_error err = {""};
    weft_fields *fields;
    weft_job *job = make_job("box");
    (void)state;
    for (int i = 0; i < 3 * WIDTH * LINES; i++) {
        x[i] = (float)(i / 3 % WIDTH) + 0.5f;
        y[i] = (float)(i / 3 / WIDTH) + 0.5f;
        t[i] = (float)(i % 3 - 1) * 1e30f;
        gray[i] = 0.25f;
    }
    taken_fields.count = 0;
    assert_int_equal(weft_fields_new(job, 1, take, &taken_fields, &fields, &err), WEFT_OK);
    weft_samples block = {.count = sizeof x / sizeof *x,
                          .x = x,
                          .y = y,
                          .t = t,
                          .red = gray,
                          .green = gray,
                          .blue = gray};
    for (block.field = 0; block.field < 2; block.field++)
        if (weft_fields_push(fields, &block, &err)) fail_msg("%s", err.text);
    for (int i = 0; i < 2; i++) {
        block.field = fields_of[i];
        if (weft_fields_push(fields, &block, &err)) fail_msg("%s", err.text);
    }
    if (weft_fields_finish(fields, &err)) fail_msg("%s", err.text);
    assert_int_equal(taken_fields.count, 2);
    weft_fields_free(fields);
    weft_job_free(job);
}

/* ---- Alpha ---- */

typedef struct keyed {
    float rgb[3 * WIDTH * LINES], alpha[WIDTH * LINES];
    bool has_alpha;
} keyed;

static void take_keyed(const weft_field *field, void *user) {
    keyed *k = user;
    size_t pixels = (size_t)(field->lines * field->width_px);
    memcpy(k->rgb, field->rgb, 3 * pixels * sizeof(float));
    k->has_alpha = field->alpha;
    if (k->has_alpha) memcpy(k->alpha, field->alpha, pixels * sizeof(float));
}

/* The first of two fields of a cloud whose alpha is its red, and a tile of alpha .25 over half
 * of it; color is premultiplied. */
static void push_keyed(weft_job *job, keyed *out) {
    static cloud c;
    static float gray[3 * 8 * 6], quarter[8 * 6];
    weft_error err = {""};
    weft_fields *fields;
    draw(&c, 7);
    for (int k = 0; k < COUNT; k++)
        for (int n = 4; n < 6; n++) c.v[n][k] *= c.v[3][k];
    for (int k = 0; k < 8 * 6; k++) quarter[k] = gray[3 * k + 1] = 0.25f;
    assert_int_equal(weft_fields_new(job, 1, take_keyed, out, &fields, &err), WEFT_OK);
    weft_samples block = block_of(&c, 0, COUNT, 0);
    block.alpha = c.v[3];
    const weft_tile tile = {0, 0, 8, 6, 0.125, 0, 8, 6, gray, quarter};
    if (weft_fields_push(fields, &block, &err)) fail_msg("%s", err.text);
    if (weft_fields_push_tile(fields, &tile, &err)) fail_msg("%s", err.text);
    if (weft_fields_until(fields, 1, &err)) fail_msg("%s", err.text);
    weft_fields_free(fields);
}

/* filter(A over B) = filter(A) + (1 - alpha) B, whichever way. */
static void alpha_goes_along(void **state) {
    static keyed key, over;
    static const float behind[3] = {0.5f, 0.25f, 2};
    weft_error err;
    (void)state;
    weft_job *job = make_job("shaped");
    push_keyed(job, &over);
    assert_false(over.has_alpha);
    assert_int_equal(weft_job_set(job, "background", "0.5,0.25,2", &err), WEFT_OK);
    push_keyed(job, &over);
    assert_int_equal(weft_job_set(job, "alpha-out", NULL, &err), WEFT_OK);
    weft_fields *none = NULL;
    assert_int_equal(weft_fields_new(job, 1, NULL, NULL, &none, &err), WEFT_USAGE);
    assert_non_null(strstr(err.text, "--background"));
    assert_int_equal(weft_job_set(job, "background", "0,0,0", &err), WEFT_OK);
    push_keyed(job, &key);
    assert_true(key.has_alpha);
    for (int i = 0; i < WIDTH * LINES / 2; i++) {
        assert_true(key.alpha[i] > 0 && key.alpha[i] < 1);
        for (int c = 0; c < 3; c++) {
            float want = key.rgb[3 * i + c] + (1 - key.alpha[i]) * behind[c];
            assert_true(fabsf(over.rgb[3 * i + c] - want) < 1e-6f);
        }
    }
    weft_job_free(job);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(alpha_goes_along),
                                       cmocka_unit_test(sums), cmocka_unit_test(tiles),
                                       cmocka_unit_test(refusals), cmocka_unit_test(far_times)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
