/* Flicker that is weighed or bounded, through the whole program: light of all lines at a
 * field's own instant, its nearest picture (test_least.c has the proof of that), colors, codes.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "convert/read/source.h"
#include "filters/least/least.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"

enum { WIDTH = 40, LINES = 48, COUNT = WIDTH * LINES };

/* A pixel of the raster is one of a subframe, so that `line` at an instant is the subframe. */
#define RASTER "raster=40x48@30i,tff overwrite temporal-width=0 "

/* ---- Pictures ---- */

static double hash(int k, int c, int x, int y) {
    uint64_t v = (uint64_t)(((k * 7 + c) * 64 + y) * 64 + x) * 6364136223846793005u +
                 1442695040888963407u;
    v ^= v >> 29;
    v *= 0xbf58476d1ce4e5b9u;
    return (double)(v >> 11) * 0x1p-53;
}

typedef struct picture {
    double (*of)(int k, int c, int x, int y); /* c: 0 red, 1 green, 2 blue, 3 alpha */
    int k;
} picture;

static double gray_noise(int k, int c, int x, int y) {
    (void)c;
    return hash(k, 0, x, y);
}

/* Black, white and what lies between, in runs of lines; highlights above white. */
static double letters(int k, int c, int x, int y) {
    (void)c;
    double part = hash(k, 0, x, y / 3);
    return part < 0.4 ? 0 : part < 0.8 ? 1 : part < 0.9 ? hash(k, 1, x, y) : 2;
}

static double bright_letters(int k, int c, int x, int y) {
    double light = letters(k, c, x, y);
    return light > 1.5 ? 60 : 3 * light;
}

/* Any color in gamut, and its corners. */
static double colors(int k, int c, int x, int y) {
    double v = hash(k, c, x, y);
    return x % 4 == 0 ? floor(2 * v) : v;
}

/* Premultiplied. */
static double partly_clear(int k, int c, int x, int y) {
    double alpha = hash(k, 3, x, y / 2);
    return c == 3 ? alpha : alpha * hash(k, c, x, y);
}

static float pixel(const void *user, int channel, int x, int y) {
    static const int of_bgr[] = {2, 1, 0}, of_abgr[] = {3, 2, 1, 0};
    const picture *p = user;
    bool has_alpha = p->of == partly_clear;
    return (float)p->of(p->k, has_alpha ? of_abgr[channel] : of_bgr[channel], x, y);
}

static void write_pictures(double (*of)(int, int, int, int), int count, bool still) {
    job_clean();
    for (int k = 0; k < count; k++) {
        char name[32], path[512];
        const picture shown = {of, still ? 0 : k};
        exr_part p = {.display = {0, 0, WIDTH, LINES},
                      .data = {0, 0, WIDTH, LINES},
                      .channels = of == partly_clear ? "A B G R" : "B G R",
                      .type = EXR_PIXEL_FLOAT,
                      .compression = EXR_COMPRESSION_NONE,
                      .value = pixel,
                      .user = &shown};
        snprintf(name, sizeof name, "in.%04d.exr", k + 1);
        job_path(path, name);
        assert_true(exr_write(path, &p, 1));
    }
}

/* Frame `n` of the output, [channels][LINES][WIDTH]. */
static float *read_frame(int n, int channels) {
    char name[32], path[512];
    wf_source_options options = {.nan_fix = WF_NAN_NONE,
                                 .want_alpha = channels == 4,
                                 .max_memory_bytes = (size_t)1 << 30};
    wf_subframe *frame;
    wf_reader *reader;
    wf_rows rows;
    weft_error err = {""};
    float *out = malloc((size_t)channels * COUNT * sizeof *out);
    snprintf(name, sizeof name, "out.%04d.exr", n);
    job_path(path, name);
    if (wf_subframe_open(path, -1, &options, &frame, &err)) fail_msg("%s", err.text);
    assert_int_equal(wf_reader_new(&options, &reader, &err), WEFT_OK);
    assert_int_equal(wf_reader_rows(reader, frame, 0, LINES, &rows, &err), WEFT_OK);
    for (int c = 0; c < channels; c++)
        for (int j = 0; j < LINES; j++)
            memcpy(out + (c * LINES + j) * WIDTH,
                   (const float *)rows.plane[c] + (size_t)j * rows.line_stride,
                   WIDTH * sizeof *out);
    wf_reader_free(reader);
    wf_subframe_close(frame);
    return out;
}

/* ---- What is right ---- */

static const double weight_709[3] = {0.2126390, 0.7151687,
                                     0.0721923}; /* from the chromaticities */

/* The nearest picture of a plane, in place. */
static void nearest(float *plane, double weight, double limit, double most) {
    const wf_least_desc d = {LINES, weight, limit, most};
    wf_least *least = wf_least_new(&d);
    wf_least_scratch *scratch = wf_least_scratch_new(least);
    wf_least_counts counts = {0};
    for (int t = 0; t * wf_least_tile_px < WIDTH; t++)
        wf_least_tile(least, scratch, t, WIDTH, WIDTH, plane, plane, &counts);
    assert_int_equal(counts.failed, 0);
    wf_least_scratch_free(scratch);
    wf_least_free(least);
}

static double flicker_at(const float *plane, int x, int j) {
    double above = (double)plane[(j ? j - 1 : 1) * WIDTH + x];
    double below = (double)plane[(j < LINES - 1 ? j + 1 : j - 1) * WIDTH + x];
    return fabs((double)plane[j * WIDTH + x] - (above + below) / 2) / 2;
}

static float *luminance_of(const float *rgb) {
    float *y = malloc(COUNT * sizeof *y);
    for (int i = 0; i < COUNT; i++) {
        double sum = 0;
        for (int c = 0; c < 3; c++) sum += weight_709[c] * (double)rgb[c * COUNT + i];
        y[i] = (float)sum;
    }
    return y;
}

/* The rule of colors, from the page: Y to Y', U the most. */
static void changed(double rgb[3], double from, double to, double most) {
    double s = 1, high = fmax(rgb[0], fmax(rgb[1], rgb[2]));
    if (to <= from) {
        for (int c = 0; c < 3; c++) rgb[c] *= from > 0 ? to / from : 1;
        return;
    }
    if (from > 0) s = fmin(to / from, fmin(most / high, 4));
    for (int c = 0; c < 3; c++) {
        double r = s * rgb[c];
        rgb[c] = isinf(most) ? r + to - s * from
                             : most - (most - r) * (most - to) / (most - s * from);
    }
}

/* ---- Tests ---- */

/* Subframe k is shown at k / 60 s: field n of moving pictures sees subframe n alone, with all
 * its lines. */
static void fields_see_their_own_instant(void **state) {
    (void)state;
    static const char *const options[] = {"flicker-weight=4", "aperture=least:4",
                                          "flicker-limit=0.03",
                                          "flicker-weight=1 flicker-limit=0.05"};
    static const double weights[] = {4, 4, 0, 1}, limits[] = {INFINITY, INFINITY, 0.03, 0.05};
    write_pictures(gray_noise, 6, false);
    for (int n = 0; n < 4; n++) {
        char all[200];
        snprintf(all, sizeof all, RASTER "subframe-rate=60 %s", options[n]);
        job_done(all, "out.####.exr", NULL);
        for (int field = 0; field < 6; field++) {
            float *got = read_frame(field / 2, 3), want[COUNT];
            for (int i = 0; i < COUNT; i++)
                want[i] = (float)gray_noise(field, 0, i % WIDTH, i / WIDTH);
            nearest(want, weights[n], limits[n], INFINITY);
            for (int i = 0; i < 3 * COUNT; i++)
                if (i / WIDTH % 2 == field % 2)
                    assert_true(fabsf(got[i] - want[i % COUNT]) < 2e-5f);
            free(got);
        }
    }
}

/* Both fields of a segmented frame are one picture's. */
static void segmented_frames_are_one_picture(void **state) {
    (void)state;
    write_pictures(gray_noise, 4, false);
    job_done(
        "raster=40x48@30psf overwrite temporal-width=0 subframe-rate=30 flicker-limit=0.02",
        "out.####.exr", NULL);
    for (int n = 0; n < 4; n++) { /* which is made once, and written as two fields */
        float *got = read_frame(n, 3), want[COUNT];
        for (int i = 0; i < COUNT; i++) want[i] = (float)gray_noise(n, 0, i % WIDTH, i / WIDTH);
        nearest(want, 0, 0.02, INFINITY);
        for (int i = 0; i < COUNT; i++) assert_true(fabsf(got[i] - want[i]) < 2e-5f);
        free(got);
    }
}

/* Line j of a field looks j / H of a period later, whether it is the field's own or not: 48
 * subframes a period are one for each line. */
static void every_line_has_its_skew(void **state) {
    (void)state;
    write_pictures(gray_noise, 48 * 4, false);
    job_done(RASTER "subframe-rate=2880 scan-skew=1 flicker-weight=2", "out.####.exr", NULL);
    for (int field = 0; field < 2; field++) {
        float *got = read_frame(0, 3), want[COUNT];
        for (int i = 0; i < COUNT; i++)
            want[i] = (float)gray_noise(48 * field + i / WIDTH, 0, i % WIDTH, i / WIDTH);
        nearest(want, 2, INFINITY, INFINITY);
        for (int i = 0; i < COUNT; i++)
            if (i / WIDTH % 2 == field) assert_true(fabsf(got[i] - want[i]) < 2e-5f);
        free(got);
    }
}

static double grating_f;
static double grating(int k, int c, int x, int y) {
    (void)k, (void)c;
    return 0.5 + 0.4 * cos(2 * M_PI * grating_f * y + x);
}

/* What is left of a grating, by least squares in the middle of the picture: 1 / (1 + MU
 * sin^4(pi f)). */
static void gratings_have_the_response(void **state) {
    (void)state;
    static const char *const said[] = {"1", "4", "12.5"};
    for (int m = 0; m < 3; m++)
        for (int n = 1; n <= 10; n++) {
            char all[200];
            grating_f = 0.05 * n;
            write_pictures(grating, 2, true);
            snprintf(all, sizeof all, RASTER "subframe-rate=60 aperture=least:%s", said[m]);
            job_done(all, "out.####.exr", NULL);
            float *got = read_frame(0, 3);
            double want = 1 / (1 + atof(said[m]) * pow(sin(M_PI * grating_f), 4)), sum = 0,
                   own = 0;
            for (int i = 22 * WIDTH; i < 26 * WIDTH; i++) {
                double wave = grating(0, 0, i % WIDTH, i / WIDTH) - 0.5;
                sum += ((double)got[i] - 0.5) * wave;
                own += wave * wave;
            }
            if (!(fabs(sum / own - want) < 1e-5))
                fail_msg("least:%s leaves %.7f of %g, not %.7f", said[m], sum / own, grating_f,
                         want);
            free(got);
        }
}

/* Of a still, what OpenEXR holds keeps the bound at every pixel, first and last line included.
 */
static void light_holds_the_bound(void **state) {
    (void)state;
    double (*const of[])(int, int, int, int) = {gray_noise, letters, bright_letters, colors};
    static const char *const said[] = {"0.1", "0.02", "0.005"};
    for (int n = 0; n < 12; n++) {
        char all[200];
        write_pictures(of[n / 3], 2, true);
        snprintf(all, sizeof all, RASTER "subframe-rate=60 flicker-limit=%s", said[n % 3]);
        job_done(all, "out.####.exr", NULL);
        float *got = read_frame(0, 3), *y = luminance_of(got);
        for (int i = 0; i < COUNT; i++) {
            assert_true(flicker_at(y, i % WIDTH, i / WIDTH) <= atof(said[n % 3]) + 2e-4);
            assert_true(y[i] >= -1e-6f);
        }
        free(got);
        free(y);
    }
}

/* Light goes to its new luminance as the page says, and stays in gamut. Of codes 1 is the most,
 * of OpenEXR there is none; OpenEXR holds R'G'B' where it is asked to. */
static void colors_follow(void **state) {
    (void)state;
    for (int encoded = 0; encoded < 2; encoded++) {
        double most = encoded ? 1 : INFINITY, gamma = encoded ? 2.4 : 1;
        write_pictures(colors, 2, true);
        job_done(encoded ? RASTER
                     "subframe-rate=60 flicker-weight=3 flicker-limit=0.04 to=rec709"
                         : RASTER "subframe-rate=60 flicker-weight=3 flicker-limit=0.04",
                 "out.####.exr", NULL);
        float *got = read_frame(0, 3), rgb[3 * COUNT];
        for (int i = 0; i < 3 * COUNT; i++)
            rgb[i] = (float)colors(0, i / COUNT, i % WIDTH, i % COUNT / WIDTH);
        float *from = luminance_of(rgb), *to = luminance_of(rgb);
        nearest(to, 3, 0.04, most);
        for (int i = 0; i < COUNT; i++) {
            double want[3] = {(double)rgb[i], (double)rgb[COUNT + i],
                              (double)rgb[2 * COUNT + i]};
            changed(want, (double)from[i], (double)to[i], most);
            for (int c = 0; c < 3; c++) {
                double light = pow(fmax((double)got[c * COUNT + i], 0), gamma);
                assert_true(fabs(light - want[c]) < 3e-5);
                assert_true(!encoded ||
                            (got[c * COUNT + i] >= 0 && got[c * COUNT + i] <= 1.00001f));
            }
        }
        free(got);
        free(from);
        free(to);
    }
}

/* ---- Codes ---- */

static double bt1886_light(double v) {
    return pow(fmax(v, 0), 2.4);
}

static double pq_light(double v) {
    double e = pow(fmax(v, 0), 32 / 2523.0);
    return 10000 / 203.0 *
           pow(fmax(e - 0.8359375, 0) / (18.8515625 - 18.6875 * e), 16384 / 2610.0);
}

static double hlg_light(double v) {
    double a = 0.17883277, b = 0.28466892, c = 0.55991073, at = fmax(v, 0);
    double scene = at <= 0.5 ? at * at / 3 : (exp((at - c) / a) + b) / 12;
    return pow(scene / 0.26496256042100718, 1.2);
}

/* Codes of luma, 10 bits, narrow; grays. Rounding moves each by half a code. */
static void hold_codes(const uint16_t *code, double (*light_of)(double), double limit) {
    for (int i = 0; i < COUNT; i++) {
        int x = i % WIDTH, j = i / WIDTH;
        double light[3], one = 0, at[3] = {j, j ? j - 1 : 1, j < LINES - 1 ? j + 1 : j - 1};
        for (int k = 0; k < 3; k++) {
            double v = (code[(int)at[k] * WIDTH + x] - 64) / 876.0;
            light[k] = light_of(v);
            one = fmax(one, light_of(v + 0.5 / 876) - light_of(v - 0.5 / 876));
        }
        assert_true(fabs(light[0] - (light[1] + light[2]) / 2) / 2 <= limit + one + 2e-4);
    }
}

static void codes_hold_the_bound(void **state) {
    (void)state;
    static const struct {
        const char *options;
        double (*light)(double);
    } rows[] = {{"raster=40x48@30i,tff", bt1886_light},
                {"raster=40x48@30i,tff,2020 to=rec2100-pq", pq_light},
                {"raster=40x48@30i,tff,2020 to=rec2100-hlg", hlg_light}};
    for (int n = 0; n < 6; n++) {
        char all[256], report[JOB_REPORT];
        size_t size;
        write_pictures(n / 3 ? bright_letters : letters, 2, true);
        snprintf(all, sizeof all,
                 "%s overwrite temporal-width=0 subframe-rate=60 bits=10 chroma=444 "
                 "flicker-limit=0.03",
                 rows[n % 3].options);
        job_done(all, "out.y4m", report);
        uint8_t *file = job_file("out.y4m", &size), *data = file;
        while (memcmp(data, "FRAME", 5)) data++;
        while (*data++ != '\n') {
        }
        uint16_t code[COUNT];
        memcpy(code, data, sizeof code);
        hold_codes(code, rows[n % 3].light, 0.03);
        /* What is above the most is clipped and counted, of both fields. */
        assert_true((job_number(report, "clipped") > 0) == (n % 3 == 0 || (n / 3 == 1)));
        free(file);
    }
}

/* ---- Alpha ---- */

/* All four channels alike, as a filter: so what lies over a constant background is the same
 * whether it is laid over it before or after. */
static void alpha_is_filtered_alike(void **state) {
    (void)state;
    write_pictures(partly_clear, 2, true);
    job_done(RASTER "subframe-rate=60 aperture=least:4 alpha-out", "out.####.exr", NULL);
    float *got = read_frame(0, 4), want[COUNT];
    for (int c = 0; c < 4; c++) {
        for (int i = 0; i < COUNT; i++)
            want[i] = (float)partly_clear(0, c, i % WIDTH, i / WIDTH);
        nearest(want, 4, INFINITY, INFINITY);
        for (int i = 0; i < COUNT; i++)
            assert_true(fabsf(got[c * COUNT + i] - want[i]) < 2e-6f);
    }
    free(got);
    job_refused(RASTER "subframe-rate=60 alpha-out flicker-limit=0.1", "out.####.exr",
                WEFT_USAGE, "--flicker-weight");
}

/* ---- The same bytes ---- */

static void threads_and_chunks_change_nothing(void **state) {
    (void)state;
    static const char *const ways[] = {"threads=1", "threads=2", "threads=3",
                                       "threads=2 skip=off"};
    size_t size = 0;
    uint8_t *first = NULL;
    write_pictures(colors, 8, false);
    for (int n = 0; n < 4; n++) {
        char all[256];
        snprintf(all, sizeof all,
                 "raster=40x48@30i,tff overwrite temporal-width=3/2 subframe-rate=60 "
                 "flicker-weight=1 flicker-limit=0.03 %s",
                 ways[n]);
        job_done(all, "out.y4m", NULL);
        if (first) job_same("out.y4m", first, size);
        if (!first) first = job_file("out.y4m", &size);
    }
    job_done("raster=40x48@30i,tff overwrite temporal-width=3/2 subframe-rate=60 "
             "flicker-weight=1 flicker-limit=0.03 chunk=1/2",
             "one.y4m", NULL);
    job_done("raster=40x48@30i,tff overwrite temporal-width=3/2 subframe-rate=60 "
             "flicker-weight=1 flicker-limit=0.03 chunk=2/2",
             "two.y4m", NULL);
    size_t a, b;
    uint8_t *one = job_file("one.y4m", &a), *two = job_file("two.y4m", &b);
    assert_int_equal(a + b, size);
    assert_memory_equal(one, first, a);
    assert_memory_equal(two, first + a, b);
    free(one);
    free(two);
    free(first);
}

/* ---- Refusals ---- */

static void what_makes_no_sense_is_refused(void **state) {
    (void)state;
    write_pictures(gray_noise, 2, true);
    job_refused("raster=40x48@30p subframe-rate=60 flicker-weight=1", "out.####.exr",
                WEFT_USAGE, "progressive");
    job_refused("raster=40x48@30p subframe-rate=60 aperture=least:1", "out.####.exr",
                WEFT_USAGE, "progressive");
    job_refused(RASTER "subframe-rate=60 aperture=least:1 flicker-weight=2", "out.####.exr",
                WEFT_USAGE, "give one of them");
    job_refused(RASTER "subframe-rate=60 key=key.y4m flicker-limit=0.1", "out.y4m", WEFT_USAGE,
                "beside alpha");
    static const char *const wrong[][2] = {
        {"flicker-weight", "-1"},  {"flicker-weight", "nan"},  {"flicker-weight", "inf"},
        {"flicker-limit", "0"},    {"flicker-limit", "-0.02"}, {"flicker-limit", "nan"},
        {"aperture", "least"},     {"aperture", "least:"},     {"aperture", "least:-1"},
        {"aperture", "least:nan"}, {"aperture", "least:1,2"}};
    weft_job *job = weft_job_new();
    for (size_t n = 0; n < sizeof wrong / sizeof *wrong; n++) {
        weft_error err = {""};
        assert_int_equal(weft_job_set(job, wrong[n][0], wrong[n][1], &err), WEFT_USAGE);
        assert_non_null(strstr(err.text, "such as"));
    }
    weft_job_free(job);
}

/* ---- Samples that are handed over ---- */

typedef struct handed {
    float rgb[4][3 * COUNT];
    int64_t count;
} handed;

static void take(const weft_field *field, void *user) {
    handed *h = user;
    assert_int_equal(field->lines, LINES / 2);
    assert_int_equal(field->line_step, 2);
    assert_int_equal(field->first_line, field->index % 2);
    memcpy(h->rgb[h->count++], field->rgb, (size_t)3 * COUNT / 2 * sizeof(float));
}

/* A sample in the middle of each pixel of so many lines. */
static weft_status push(weft_fields *fields, int field, int step, weft_error *err) {
    static float v[6][COUNT];
    size_t count = 0;
    for (int i = 0; i < COUNT; i++) {
        if (i / WIDTH % step) continue;
        v[0][count] = (float)(i % WIDTH) + 0.5f;
        v[1][count] = (float)(i / WIDTH) + 0.5f;
        v[2][count] = 0;
        for (int c = 0; c < 3; c++)
            v[3 + c][count] = (float)gray_noise(field, 0, i % WIDTH, i / WIDTH);
        count++;
    }
    const weft_samples s = {count, v[0], v[1], v[2], field, v[3], v[4], v[5], NULL, NULL};
    return weft_fields_push(fields, &s, err);
}

static weft_job *pushed_job(void) {
    weft_error err;
    weft_job *job = weft_job_new();
    assert_int_equal(weft_job_set(job, "raster", "40x48@30i,tff", &err), WEFT_OK);
    assert_int_equal(weft_job_set(job, "temporal-width", "0", &err), WEFT_OK);
    assert_int_equal(weft_job_set(job, "flicker-limit", "0.03", &err), WEFT_OK);
    return job;
}

static void samples_are_handed_over(void **state) {
    (void)state;
    static handed h;
    weft_error err = {""};
    weft_fields *fields;
    weft_job *job = pushed_job();
    assert_int_equal(weft_fields_new(job, 1, take, &h, &fields, &err), WEFT_OK);
    for (int n = 0; n < 2; n++) assert_int_equal(push(fields, n, 1, &err), WEFT_OK);
    if (weft_fields_finish(fields, &err)) fail_msg("%s", err.text);
    for (int n = 0; n < 2; n++) {
        float want[COUNT];
        for (int i = 0; i < COUNT; i++) want[i] = (float)gray_noise(n, 0, i % WIDTH, i / WIDTH);
        nearest(want, 0, 0.03, INFINITY);
        for (int i = 0; i < COUNT / 2; i++) {
            int at = (2 * (i / WIDTH) + n) * WIDTH + i % WIDTH;
            for (int c = 0; c < 3; c++)
                assert_true(fabsf(h.rgb[n][3 * i + c] - want[at]) < 2e-5f);
        }
    }
    weft_fields_free(fields);
    /* Samples of every other line leave lines empty. */
    assert_int_equal(weft_fields_new(job, 1, take, &h, &fields, &err), WEFT_OK);
    assert_int_equal(push(fields, 0, 2, &err), WEFT_OK);
    assert_int_equal(weft_fields_finish(fields, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "all lines"));
    weft_fields_free(fields);
    weft_job_free(job);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_see_their_own_instant),
        cmocka_unit_test(segmented_frames_are_one_picture),
        cmocka_unit_test(every_line_has_its_skew),
        cmocka_unit_test(gratings_have_the_response),
        cmocka_unit_test(light_holds_the_bound),
        cmocka_unit_test(colors_follow),
        cmocka_unit_test(codes_hold_the_bound),
        cmocka_unit_test(alpha_is_filtered_alike),
        cmocka_unit_test(threads_and_chunks_change_nothing),
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(samples_are_handed_over),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
