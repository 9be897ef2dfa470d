/* Measurements against closed forms, on pictures that are written for it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/check/histogram.h"
#include "convert/check/measure.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"
#include "tests/unit/support/zoneplate.h"

static void path_of(char path[128], const char *name) {
    snprintf(path, 128, "%s/%s", job_directory, name);
}

/* ---- Pictures of light ---- */

typedef double light_fn(const void *user, double x, double y);

typedef struct picture {
    light_fn *light;
    const void *user;
} picture;

static float light_at(const void *user, int channel, int x, int y) {
    const picture *p = user;
    (void)channel;
    return (float)p->light(p->user, x + 0.5, y + 0.5);
}

static void write_exr(const char *name, int width, int lines, light_fn *light,
                      const void *user) {
    char path[128];
    const picture p = {light, user};
    const exr_part part = {.display = {0, 0, width, lines},
                           .data = {0, 0, width, lines},
                           .channels = "B G R",
                           .type = EXR_PIXEL_FLOAT,
                           .compression = EXR_COMPRESSION_ZIP,
                           .value = light_at,
                           .user = &p};
    path_of(path, name);
    assert_true(exr_write(path, &part, 1));
}

static wf_figures measured(const char *name, const wf_measure_options *options) {
    char path[128];
    wf_measure_options o = *options;
    wf_figures figures;
    weft_error err = {""};
    path_of(path, name);
    o.max_memory_bytes = (size_t)1 << 30;
    weft_status status = wf_measure(path, &o, &figures, &err);
    if (status) print_message("%s\n", err.text);
    assert_int_equal(status, WEFT_OK);
    return figures;
}

static const wf_measure_options plain = {.raster = NULL};

static void assert_close(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        print_message("%.8g, expected %.8g within %.2g\n", value, expected, tolerance);
    assert_true(fabs(value - expected) <= tolerance);
}

/* ---- Distributions ---- */

static void histogram_of_a_ramp(void **state) {
    (void)state;
    wf_histogram s;
    assert_true(wf_histogram_init(&s, 0.25f));
    assert_true(isnan(wf_histogram_rms(&s)) && isnan(wf_histogram_quantile(&s, 0.5)));
    for (int i = 0; i < 10000; i++) wf_histogram_add(&s, (float)i / 10000);
    wf_histogram_add(&s, NAN);
    assert_close(wf_histogram_rms(&s), 1 / sqrt(3), 1e-4);
    for (double q = 0.1; q < 1; q += 0.1) assert_close(wf_histogram_quantile(&s, q), q, 6e-4);
    assert_close(wf_histogram_quantile(&s, 0.999), 0.999, 1e-3);
    assert_close(wf_histogram_share(&s), 0.75, 2e-4);
    wf_histogram_free(&s);
}

/* ---- Flicker ---- */

typedef struct grating {
    double f, phase;
} grating;

static double grating_light(const void *user, double x, double y) {
    const grating *g = user;
    (void)x;
    return 0.5 + 0.5 * cos(2 * M_PI * g->f * y + g->phase);
}

/* Stretching a field multiplies a grating by cos(2 pi f) on the lines between: half the
 * difference of the fields is the grating's own times sin^2(pi f). */
static void flicker_of_gratings(void **state) {
    (void)state;
    const int lines = 480;
    for (double f = 0.05; f < 0.46; f += 0.1) {
        const grating g = {f, 0.3};
        double squares = 0;
        write_exr("grating.exr", 16, lines, grating_light, &g);
        for (int y = 1; y < lines - 1; y++) {
            double v = 0.5 * cos(2 * M_PI * f * (y + 0.5) + 0.3) * pow(sin(M_PI * f), 2);
            squares += v * v;
        }
        /* At the edges the one line there is stands for both. */
        for (int y = 0; y < lines; y += lines - 1) {
            int other = y ? y - 1 : 1;
            double v = (grating_light(&g, 0, y + 0.5) - grating_light(&g, 0, other + 0.5)) / 2;
            squares += v * v;
        }
        wf_figures m = measured("grating.exr", &plain);
        assert_close(m.flicker_rms, sqrt(squares / lines), 1e-6);
    }
}

static void flicker_of_flat_light(void **state) {
    (void)state;
    const grating flat = {0, M_PI / 2};
    const wf_measure_options crt = {.display = WF_DISPLAY_CRT};
    write_exr("flat.exr", 16, 16, grating_light, &flat);
    wf_figures m = measured("flat.exr", &plain);
    assert_true(m.flicker_rms < 1e-7 && m.flicker_share == 0);
    assert_null(m.order_verdict);
    assert_true(isnan(m.sharpness) && isnan(m.cross_color_rms) && isnan(m.rmse));
    /* On a CRT the lines themselves come and go: nine tenths of their light. */
    m = measured("flat.exr", &crt);
    assert_close(m.flicker_rms, 0.5 * 0.9 / 2, 1e-6);
}

/* A quarter of the plate, which is alike to the right and the left, above and below. */
typedef struct plate {
    zoneplate geometry;
    float *quarter; /* [lines / 2][width / 2] */
} plate;

static plate make_plate(zoneplate geometry, const char *aperture) {
    int width = geometry.width / 2, lines = geometry.lines / 2;
    plate p = {geometry, malloc((size_t)(width * lines) * sizeof(float))};
    assert_non_null(p.quarter);
#pragma omp parallel for
    for (int y = 0; y < lines; y++)
        for (int x = 0; x < width; x++)
            p.quarter[y * width + x] =
                (float)zoneplate_truth(&geometry, aperture, x + 0.5, y + 0.5);
    return p;
}

static double plate_light(const void *user, double x, double y) {
    const plate *p = user;
    double width = p->geometry.width, lines = p->geometry.lines;
    int column = (int)fmin(x, width - x), line = (int)fmin(y, lines - y);
    return (double)p->quarter[line * (p->geometry.width / 2) + column];
}

/* The zone plate through each aperture: flicker against its closed form, sharpness against the
 * aperture's response, and composite coding as in section 6 of Amanatides and Mitchell, 1990.
 */
static void zone_plates(void **state) {
    (void)state;
    const zoneplate geometry = {720, 486, 10 / 11.0};
    const wf_measure_options chart = {.chart = WF_CHART_ZONEPLATE, .want_heat = true};
    const struct {
        const char *aperture;
        double rms, p999, response;
    } rows[] = {{"line", 0.1387, 0.339, 0.9003},
                {"box", 0.0630, 0.163, 0.6366},
                {"notch", 0.0480, 0.127, 0.5160},
                {"shaped", 0.0395, 0.126, 0.5160}};
    double cross[4];
    for (int i = 0; i < 4; i++) {
        const plate p = make_plate(geometry, rows[i].aperture);
        write_exr("plate.exr", 720, 486, plate_light, &p);
        free(p.quarter);
        wf_figures m = measured("plate.exr", &chart);
        assert_close(m.flicker_rms, rows[i].rms, 0.01 * rows[i].rms);
        assert_close(m.flicker_p999, rows[i].p999, 0.02 * rows[i].p999);
        assert_close(m.sharpness, rows[i].response, 0.003);
        assert_string_equal(m.info.raster.name, "525i");
        double squares = 0;
        for (int k = 0; k < 720 * 486; k++) squares += (double)m.heat[k] * (double)m.heat[k];
        assert_close(sqrt(squares / (720 * 486)), m.flicker_rms, 1e-6);
        cross[i] = m.cross_color_rms;
        assert_close(m.cross_luma_rms, 0, 1e-6);
        free(m.heat);
    }
    print_message("cross-color %.4f %.4f %.4f %.4f\n", cross[0], cross[1], cross[2], cross[3]);
    assert_true(cross[3] < 0.8 * cross[1]);
}

static void sharpness_of_gratings(void **state) {
    (void)state;
    for (double f = 0.1; f < 0.5; f += 0.13) {
        const wf_measure_options chart = {.chart = WF_CHART_GRATING, .grating = f};
        const grating g = {f, 1.1};
        write_exr("grating.exr", 8, 240, grating_light, &g);
        assert_close(measured("grating.exr", &chart).sharpness, 1, 2e-2);
    }
}

/* ---- Video as codes ---- */

typedef struct codes {
    int width, lines, frames;
    char order;
    const char *rate;
    /* Y' of a pixel of a frame, 0 .. 1. */
    double (*luma)(const void *user, int frame, int x, int y);
    const void *user;
} codes;

static void write_y4m(const char *name, const codes *c) {
    char path[128];
    path_of(path, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "YUV4MPEG2 W%d H%d F%s I%c A1:1 C422p10\n", c->width, c->lines, c->rate,
            c->order);
    for (int n = 0; n < c->frames; n++) {
        fputs("FRAME\n", file);
        for (int y = 0; y < c->lines; y++)
            for (int x = 0; x < c->width; x++) {
                int code = 64 + (int)lround(876 * c->luma(c->user, n, x, y));
                putc(code & 255, file), putc(code >> 8, file);
            }
        for (int i = 0; i < c->width * c->lines; i++) putc(0, file), putc(2, file);
    }
    assert_int_equal(fclose(file), 0);
}

/* A scene: soft disks that move; its time in fields. */
static double scene(double t, double x, double y) {
    double sum = 0.2;
    for (int k = 0; k < 3; k++) {
        double cx = 30 + 30 * k + (3 + k) * t * 0.7, cy = 40 + 18 * k + (k - 1) * t * 0.9;
        double r = hypot(x - cx, y - cy);
        sum += 0.25 / (1 + exp((r - 14) / 1.2));
    }
    return sum + 0.02 * sin(0.9 * y);
}

/* Which instant the lines of a parity of a frame show. */
typedef double instant_fn(int frame, bool top);

static double scene_luma(const void *user, int frame, int x, int y) {
    instant_fn *const *instant = user;
    return scene((*instant)(frame, y % 2 == 0), x, y);
}

static double top_first(int frame, bool top) {
    return 2 * frame + (top ? 0 : 1);
}
static double bottom_first(int frame, bool top) {
    return 2 * frame + (top ? 1 : 0);
}
static double whole(int frame, bool top) {
    (void)top;
    return 2 * frame;
}
static double still(int frame, bool top) {
    (void)frame, (void)top;
    return 5;
}
/* Top fields woven with the bottom fields of the frame before. */
static double shifted(int frame, bool top) {
    return 2 * frame + (top ? 2 : 1);
}
/* Fields of one film frame in 2:3, top first: 3 fields, then 2. */
static double telecined(int frame, bool top) {
    int field = 2 * frame + (top ? 0 : 1);
    return 2.5 * (field / 5 * 2 + (field % 5 >= 3));
}
static double telecined_bottom(int frame, bool top) {
    return telecined(frame, !top);
}
/* 24 frames repeated whole, as 2:2 and as 3:2 in frames: nothing is woven. */
static double doubled(int frame, bool top) {
    (void)top;
    return frame / 2 * 4;
}

static void verdict_is(instant_fn *instant, char label, const char *verdict) {
    const codes c = {128, 96, 11, label, "25:1", scene_luma, (const void *)&instant};
    write_y4m("order.y4m", &c);
    wf_figures m = measured("order.y4m", &plain);
    if (strcmp(m.order_verdict, verdict))
        print_message("%s (%g), not %s\n", m.order_verdict, m.order_ratio, verdict);
    assert_string_equal(m.order_verdict, verdict);
    if (!strcmp(verdict, "tff")) assert_true(m.order_ratio > 1.1);
    if (!strcmp(verdict, "bff")) assert_true(m.order_ratio < 0.9);
}

static void order_from_pixels(void **state) {
    (void)state;
    for (const char *label = "tbp"; *label; label++) { /* whatever the file says */
        verdict_is(top_first, *label, "tff");
        verdict_is(bottom_first, *label, "bff");
        verdict_is(shifted, *label, "bff");
        verdict_is(telecined, *label, "telecined");
        verdict_is(telecined_bottom, *label, "telecined");
        verdict_is(still, *label, "still");
        verdict_is(whole, *label, *label == 'p' ? "progressive" : "psf");
        verdict_is(doubled, *label, *label == 'p' ? "progressive" : "psf");
    }
}

/* Bars that move by a third of their pitch a field: after the three fields of the false order
 * they are where they were. Beside them a disk that moves slowly, if user says so. */
static double bars_luma(const void *user, int frame, int x, int y) {
    double t = top_first(frame, y % 2 == 0);
    if (user && x < 48)
        return 0.2 + 0.5 / (1 + exp((hypot(x - 20 - 0.9 * t, y - 40 - t) - 14) / 1.2));
    return 0.5 + 0.4 * sin(2 * M_PI * (x - 4 * t) / 12);
}

/* Fields in one order on the left and in the other on the right. */
static double halves_luma(const void *user, int frame, int x, int y) {
    (void)user;
    double t = x < 64 ? top_first(frame, y % 2 == 0) : bottom_first(frame, y % 2 == 0);
    return scene(t, x < 64 ? x : x - 64, y);
}

static void regions_that_disagree(void **state) {
    (void)state;
    codes c = {128, 96, 11, 't', "25:1", halves_luma, NULL};
    write_y4m("halves.y4m", &c);
    wf_figures m = measured("halves.y4m", &plain);
    assert_string_equal(m.order_verdict, "open");
    assert_true(m.order_agreement > 1.0 / 3 && m.order_agreement < 2.0 / 3);
    c.luma = bars_luma;
    write_y4m("bars.y4m", &c);
    m = measured("bars.y4m", &plain);
    assert_true(m.order_ratio < 0.9); /* it looks as if bottom came first */
    assert_string_equal(m.order_verdict, "open");
    c.user = &c;
    write_y4m("disk.y4m", &c);
    m = measured("disk.y4m", &plain);
    assert_string_equal(m.order_verdict, "open"); /* and the disk says that it does not */
    assert_close(m.order_agreement, 0, 1e-9);
}

/* Noise of a code or two is no motion. */
static double noisy_luma(const void *user, int frame, int x, int y) {
    uint32_t h = (uint32_t)(frame * 7919 + y * 104729 + x) * 2654435761u;
    (void)user;
    return scene(5, x, y) + ((h >> 28) % 5 - 2.0) / 876;
}

static void stills_with_noise(void **state) {
    (void)state;
    const codes c = {128, 96, 6, 't', "25:1", noisy_luma, NULL};
    write_y4m("noise.y4m", &c);
    assert_string_equal(measured("noise.y4m", &plain).order_verdict, "still");
}

/* The left half stands still, a grating; the right half changes from frame to frame. */
static double half_still(const void *user, int frame, int x, int y) {
    (void)user;
    if (x >= 64) return 0.2 + 0.5 * ((y + 2 * frame) % 4 < 2);
    return 0.5 + 0.3 * cos(2 * M_PI * 0.25 * y);
}

static double light_of_luma(double luma) {
    return pow(round(876 * luma) / 876, 2.4);
}

static void flicker_where_nothing_moves(void **state) {
    (void)state;
    const codes c = {128, 96, 4, 't', "25:1", half_still, NULL};
    double squares = 0;
    write_y4m("half.y4m", &c);
    for (int y = 0; y < 96; y++) {
        int above = y > 0 ? y - 1 : 1, below = y < 95 ? y + 1 : 94;
        double own = light_of_luma(half_still(NULL, 0, 0, y));
        double other = (light_of_luma(half_still(NULL, 0, 0, above)) +
                        light_of_luma(half_still(NULL, 0, 0, below))) /
                       2;
        squares += pow((own - other) / 2, 2);
    }
    assert_close(measured("half.y4m", &plain).flicker_rms, sqrt(squares / 96), 1e-5);
}

/* ---- Legality ---- */

/* Column 0 is black, 1 a code below, 2 white, 3 a code above; 4 and 5 lie at R103's bounds, 6
 * and 7 a code beyond. */
static double legal_luma(const void *user, int frame, int x, int y) {
    static const int code[8] = {64, 63, 940, 941, 20, 984, 19, 985};
    (void)user, (void)frame, (void)y;
    return (code[x % 8] - 64) / 876.0;
}

static void legality(void **state) {
    (void)state;
    const codes c = {64, 16, 2, 't', "25:1", legal_luma, NULL};
    write_y4m("legal.y4m", &c);
    wf_figures m = measured("legal.y4m", &plain);
    assert_close(m.range_share, 6 / 8.0, 1e-12);
    assert_close(m.r103_share, 2 / 8.0, 1e-12);
}

/* Planes by hand: 16 x 8, 8 bits. */
static void write_planes(const char *name, const char *header, const uint8_t *bytes,
                         size_t count) {
    char path[128];
    path_of(path, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "YUV4MPEG2 W16 H8 F25:1 %s\nFRAME\n", header);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    assert_int_equal(fclose(file), 0);
}

/* Chroma line 1 of interlaced 4:2:0 is the bottom field's: it goes with luma lines 1 and 3. */
static void legality_of_fields(void **state) {
    (void)state;
    uint8_t bytes[16 * 8 * 3];
    memset(bytes, 128, sizeof bytes);
    memset(bytes + 16 * 8 + 8, 250, 8);
    write_planes("fields.y4m", "It C420", bytes, 16 * 8 * 3 / 2);
    assert_close(measured("fields.y4m", &plain).range_share, 2 / 8.0, 1e-12);
    memset(bytes + 16 * 2, 5, 16); /* and luma line 2 */
    write_planes("fields.y4m", "It C420", bytes, 16 * 8 * 3 / 2);
    assert_close(measured("fields.y4m", &plain).range_share, 3 / 8.0, 1e-12);
    write_planes("whole.y4m", "Ip C420", bytes, 16 * 8 * 3 / 2);
    assert_close(measured("whole.y4m", &plain).range_share, 2 / 8.0, 1e-12);
    memset(bytes, 0, sizeof bytes);
    write_planes("full.y4m", "It C444 XCOLORRANGE=FULL", bytes, 16 * 8 * 3);
    assert_close(measured("full.y4m", &plain).range_share, 0, 1e-12);
}

/* ---- Differences ---- */

static double shade(const void *user, int frame, int x, int y) {
    double noise = *(const double *)user;
    uint32_t h = (uint32_t)(frame * 31 + y * 677 + x * 97) * 2246822519u;
    double luma = 0.5 + 0.3 * sin(0.11 * x) * cos(0.07 * y);
    return luma + (y % 2 ? noise : 0) * ((h >> 24) % 2 ? 1 : -1);
}

/* SSIM of the luma of a field, in two passes. */
static double similarity_of(const codes *a, const codes *b, int first_line) {
    double sum = 0, windows = 0;
    for (int n = 0; n < a->frames; n++)
        for (int y0 = 0; y0 + 8 <= a->lines / 2; y0 += 4)
            for (int x0 = 0; x0 + 8 <= a->width; x0 += 4) {
                double mean[2] = {0}, var[2] = {0}, both = 0;
                for (int pass = 0; pass < 2; pass++)
                    for (int k = 0; k < 64; k++) {
                        int x = x0 + k % 8, y = 2 * (y0 + k / 8) + first_line;
                        double v[2] = {a->luma(a->user, n, x, y), b->luma(b->user, n, x, y)};
                        for (int i = 0; i < 2; i++) {
                            v[i] = (64 + round(876 * v[i])) / 1023;
                            if (!pass) mean[i] += v[i] / 64;
                            if (pass) var[i] += (v[i] - mean[i]) * (v[i] - mean[i]) / 63;
                        }
                        if (pass) both += (v[0] - mean[0]) * (v[1] - mean[1]) / 63;
                    }
                sum +=
                    (2 * mean[0] * mean[1] + 1e-4) * (2 * both + 9e-4) /
                    ((mean[0] * mean[0] + mean[1] * mean[1] + 1e-4) * (var[0] + var[1] + 9e-4));
                windows++;
            }
    return sum / windows;
}

/* 20 codes in half of the luma: in the bottom field only. */
static void differences(void **state) {
    (void)state;
    char reference[128];
    const double none = 0, some = 20 / 876.0, step = 20 / 1023.0;
    const codes a = {96, 64, 2, 't', "25:1", shade, &none};
    const codes b = {96, 64, 2, 't', "25:1", shade, &some};
    write_y4m("a.y4m", &a);
    write_y4m("b.y4m", &b);
    path_of(reference, "a.y4m");
    const wf_measure_options against = {.against = reference};
    wf_figures m = measured("b.y4m", &against);
    assert_close(m.plane[0][0].rmse, step / sqrt(2), 1e-7);
    assert_close(m.plane[0][1].rmse, 0, 1e-9);
    assert_close(m.plane[0][2].rmse, step, 1e-7);
    assert_close(m.plane[0][2].psnr, -20 * log10(step), 1e-4);
    assert_close(m.plane[1][0].rmse, 0, 1e-9);
    assert_close(m.rmse, step / 2, 1e-7); /* half of all samples are chroma */
    assert_close(m.psnr, -20 * log10(step / 2), 1e-4);
    assert_close(m.plane[0][1].ssim, 1, 1e-9);
    assert_close(m.plane[0][2].ssim, similarity_of(&a, &b, 1), 1e-5);
    assert_true(m.plane[0][2].ssim < 0.99);
    m = measured("a.y4m", &against);
    assert_true(m.rmse == 0 && isinf(m.psnr));
    assert_close(m.ssim, 1, 1e-9);
}

/* ---- What is refused ---- */

static void refused(const char *name, const wf_measure_options *options, weft_status status,
                    const char *word) {
    char path[128];
    wf_figures figures;
    weft_error err = {""};
    wf_measure_options o = *options;
    o.max_memory_bytes = (size_t)1 << 30;
    path_of(path, name);
    assert_int_equal(wf_measure(path, &o, &figures, &err), status);
    if (!strstr(err.text, word)) print_message("%s\n", err.text);
    assert_non_null(strstr(err.text, word));
}

static void cut(const char *name, long bytes) {
    char path[128];
    path_of(path, name);
    assert_int_equal(truncate(path, bytes), 0);
}

static void bad_input(void **state) {
    (void)state;
    char reference[128];
    instant_fn *instant = top_first;
    const codes odd = {32, 33, 2, 't', "25:1", scene_luma, (const void *)&instant};
    const codes fine = {32, 32, 3, 't', "25:1", scene_luma, (const void *)&instant};
    const codes longer = {32, 32, 4, 't', "25:1", scene_luma, (const void *)&instant};
    write_y4m("odd.y4m", &odd);
    refused("odd.y4m", &plain, WEFT_FAILED, "33 lines");
    write_y4m("cut.y4m", &fine);
    cut("cut.y4m", 10000);
    refused("cut.y4m", &plain, WEFT_FAILED, "frame 2");
    cut("cut.y4m", 20);
    refused("cut.y4m", &plain, WEFT_FAILED, "header");
    write_y4m("longer.y4m", &longer);
    write_y4m("fine.y4m", &fine);
    path_of(reference, "longer.y4m");
    refused("fine.y4m", &(wf_measure_options){.against = reference}, WEFT_FAILED, "fewer");
    path_of(reference, "odd.y4m");
    refused("fine.y4m", &(wf_measure_options){.against = reference}, WEFT_USAGE, "32x33");
    refused("fine.y4m", &(wf_measure_options){.raster = wf_raster_at(0)}, WEFT_USAGE, "525i");
    refused("absent.y4m", &plain, WEFT_FAILED, "No such file");
    const grating g = {0.1, 0};
    write_exr("mixed.0001.exr", 32, 32, grating_light, &g);
    write_exr("mixed.0002.exr", 32, 30, grating_light, &g);
    refused("mixed.####.exr", &plain, WEFT_FAILED, "32x30");
    write_exr("gap.0001.exr", 32, 32, grating_light, &g);
    write_exr("gap.0003.exr", 32, 32, grating_light, &g);
    refused("gap.####.exr", &plain, WEFT_FAILED, "number 2");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(histogram_of_a_ramp),
        cmocka_unit_test(flicker_of_gratings),
        cmocka_unit_test(flicker_of_flat_light),
        cmocka_unit_test(zone_plates),
        cmocka_unit_test(sharpness_of_gratings),
        cmocka_unit_test(order_from_pixels),
        cmocka_unit_test(regions_that_disagree),
        cmocka_unit_test(stills_with_noise),
        cmocka_unit_test(flicker_where_nothing_moves),
        cmocka_unit_test(legality),
        cmocka_unit_test(legality_of_fields),
        cmocka_unit_test(differences),
        cmocka_unit_test(bad_input),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
