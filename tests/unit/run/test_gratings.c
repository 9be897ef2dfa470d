/* Gratings through the whole program: what the apertures leave of half a cycle a line, and what
 * the 4:2:2 filter lets through, measured on files. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/read/source.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"

#define PI 3.14159265358979323846

/* ---- The apertures' zero ---- */

typedef struct grating {
    double cycles_a_cell, phase;
} grating;

/* Mean of the wave over the cell, as a renderer's box filter gives it. */
static float wave(const void *user, int channel, int x, int y) {
    const grating *g = user;
    double half = PI * g->cycles_a_cell;
    (void)channel, (void)x;
    return (float)(0.5 + 0.5 * sin(half) / half * cos(2 * half * (y + 0.5) + g->phase));
}

static void write_still(int width, int height, int count,
                        float (*value)(const void *, int, int, int), const void *user) {
    job_clean();
    for (int k = 0; k < count; k++) {
        char name[32], path[512];
        exr_part p = {.display = {0, 0, width, height},
                      .data = {0, 0, width, height},
                      .channels = "B G R",
                      .type = EXR_PIXEL_FLOAT,
                      .compression = EXR_COMPRESSION_ZIP,
                      .value = value,
                      .user = user};
        snprintf(name, sizeof name, "in.%04d.exr", k + 1);
        job_path(path, name);
        assert_true(exr_write(path, &p, 1));
    }
}

/* Amplitude of what is left of the grating in the interior of frame 0, over the 0.5 it had. (At
 * the left and right edges part of the shaped aperture finds no samples, and what is left of it
 * has no zero.) */
static double left_over(int lines) {
    char path[512];
    wf_source_options options = {.nan_fix = WF_NAN_NONE, .max_memory_bytes = (size_t)1 << 30};
    wf_subframe *frame;
    wf_reader *reader;
    wf_rows rows;
    weft_error err = {""};
    job_path(path, "out.0000.exr");
    if (wf_subframe_open(path, -1, &options, &frame, &err)) fail_msg("%s", err.text);
    assert_int_equal(wf_reader_new(&options, &reader, &err), WEFT_OK);
    assert_int_equal(wf_reader_rows(reader, frame, 0, lines, &rows, &err), WEFT_OK);
    double least = 2, most = -2;
    for (int j = 4; j < lines - 4; j++)
        for (int i = 2; i < 6; i++) {
            double value =
                (double)((const float *)
                             rows.plane[1])[(size_t)j * rows.line_stride + (size_t)i];
            least = fmin(least, value);
            most = fmax(most, value);
        }
    wf_reader_free(reader);
    wf_subframe_close(frame);
    return (most - least) / 2 / 0.5;
}

/* At half a cycle a line, for 1 to 5 samples a line, box, notch and shaped leave less than -120
 * dB; line leaves what its response says. */
static void half_a_cycle_a_line(void **state) {
    (void)state;
    static const struct {
        const char *aperture;
        double leaves;
    } cases[] = {
        {"box", 0},      {"notch", 0}, {"shaped", 0}, {"ccd", 0}, {"mitchell:3/2,-1/4", 0},
        {"line", 2 / PI}};
    for (int samples = 1; samples <= 5; samples++)
        for (int quarter = 0; quarter < 4; quarter++) {
            grating g = {0.5 / samples, quarter * PI / 4};
            write_still(16, 48 * samples, 2, wave, &g);
            for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
                char all[256];
                snprintf(all, sizeof all,
                         "raster=8x48@30i,bff subframe-rate=60 overwrite aperture=%s",
                         cases[i].aperture);
                job_done(all, "out.####.exr", NULL);
                double left = left_over(48), most = cases[i].leaves * fabs(sin(g.phase)) + 1e-6;
                if (left > most)
                    fail_msg("%s with %d samples a line leaves %.3g (%.1f dB)",
                             cases[i].aperture, samples, left, 20 * log10(left));
                if (cases[i].leaves > 0 && quarter == 2) assert_true(left > 0.63);
            }
        }
}

/* ---- The 4:2:2 template ---- */

#define WIDTH 1080 /* a multiple of 27, so that the template's corners are whole cycles */
#define KR    0.299
#define KB    0.114

typedef struct tint {
    double cycles_a_pixel; /* of luma */
    double amplitude;      /* of Cb, in R'G'B' units */
} tint;

static double linear_of(double coded) {
    return pow(fmax(coded, 0), 2.4);
}

/* Constant luma, Cb a cosine whose crests are co-sited with even pixels. */
static float chroma_wave(const void *user, int channel, int x, int y) {
    const tint *t = user;
    double luma = 0.5, cb = t->amplitude * cos(2 * PI * t->cycles_a_pixel * x);
    double blue = luma + cb * 2 * (1 - KB),
           green = (luma - KR * luma - KB * blue) / (1 - KR - KB);
    (void)y;
    return (float)linear_of(channel == 0 ? blue : channel == 1 ? green : luma);
}

static int code_at(const uint8_t *plane, int at) {
    return plane[2 * at] | plane[2 * at + 1] << 8;
}

/* Amplitude of Cb at the frequency, away from the edges, over the one put in. */
static double passes(const tint *t) {
    size_t size;
    write_still(WIDTH, 8, 2, chroma_wave, t);
    job_done(
        "raster=1080x8@30i,bff,601-625 subframe-rate=60 aperture=line bits=16 from=lin_rec709 "
        "to=rec709 overwrite",
        "out.y4m", NULL);
    uint8_t *bytes = job_file("out.y4m", &size);
    const uint8_t *frame = (const uint8_t *)memchr(bytes, '\n', size) + 1 + strlen("FRAME\n");
    const uint8_t *cb = frame + 2 * WIDTH * 8 + 2 * (WIDTH / 2) * 3;
    double in_phase = 0, quadrature = 0;
    int from = 27, to = WIDTH / 2 - 27; /* a whole number of cycles of every multiple of 1/27 */
    for (int i = from; i < to; i++) {
        double value = (code_at(cb, i) - 32768) / (224.0 * 256),
               angle = 2 * PI * t->cycles_a_pixel * 2 * i;
        in_phase += value * cos(angle);
        quadrature += value * sin(angle);
    }
    free(bytes);
    bool aliased_on_itself = fabs(t->cycles_a_pixel * 4 - round(t->cycles_a_pixel * 4)) < 1e-9;
    double share = aliased_on_itself ? 1.0 : 2.0;
    return share * hypot(in_phase, quadrature) / (to - from) / t->amplitude;
}

/* Rec. BT.601's template, at multiples of half a 1/13.5 of the luma sampling rate. */
static void chroma_template(void **state) {
    (void)state;
    for (int n = 0; n <= 13; n++) {
        tint t = {n / 27.0, 0.08};
        double decibel = 20 * log10(passes(&t) + 1e-9), x = n / 2.0; /* x: MHz at 13.5 */
        print_message("%4.2f MHz: %7.3f dB\n", x, decibel);
        if (x <= 2.75) assert_true(fabs(decibel) <= 0.05);
        if (x >= 4) assert_true(decibel <= -55);
    }
    tint t = {2.75 / 13.5, 0.08};
    assert_true(fabs(20 * log10(passes(&t))) <= 0.05);
    t.cycles_a_pixel = 0.25;
    double half = 20 * log10(passes(&t));
    print_message("3.375 MHz: %.3f dB\n", half);
    assert_true(fabs(half + 6.02) <= 0.05);
    t.cycles_a_pixel = 4.0 / 13.5;
    assert_true(20 * log10(passes(&t) + 1e-9) <= -55);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_a_cycle_a_line),
        cmocka_unit_test(chroma_template),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
