/* Pictures for an error asked for: edges against closed forms, still and moving, what they cost
 * beside a fixed number of samples, and things too thin for the first samples to see. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/unit/support/scene_fields.h"
#include "tests/unit/support/sizes.h"
#include "tracer/sample/adaptive_cells.h"

#define WIDTH  64
#define LINES  48
#define RASTER "64x48@30i,tff,par=1:1"

/* x to the right and y up, in pixels and lines from the middle of the picture. */
#define CAMERA "camera{eye={0, 0, 100}, look_at={0, 0, 0}, ortho_height=raster.lines}\n"
#define FRONT  "halfspace{normal={0, 0, 1}}"

/* Rec. 709: what errors are measured in. */
static double encoded(double v) {
    return v < 0.018 ? 4.5 * v : 1.099 * pow(v, 0.45) - 0.099;
}

/* A strip between two edges, x = y slope + shift and as much more as it is wide, that moves to
 * the right while the window is open. */
typedef struct strip {
    double slope, shift, wide, speed; /* speed: pixels a field */
} strip;

/* How much of the unit interval about 0 lies left of x; its integral; and the integral of that.
 */
static double ramp2(double x) {
    double c = fmin(fmax(x, -0.5), 0.5) + 0.5;
    return c * c * c / 6 + (x > 0.5 ? (x - 0.5) / 2 + (x - 0.5) * (x - 0.5) / 2 : 0);
}

static double ramp(double x) {
    return x < -0.5 ? 0 : x > 0.5 ? x : (x + 0.5) * (x + 0.5) / 2;
}

/* Left of x = a + b y + c t, over a pixel 2 h high and t in -1/2 .. 1/2. */
static double left_of(double a, double b, double c, double h) {
    if (fabs(c) < 1e-9) return (ramp(a + b * h) - ramp(a - b * h)) / (2 * b * h);
    double y = b * h, t = c / 2;
    return (ramp2(a + y + t) - ramp2(a + y - t) - ramp2(a - y + t) + ramp2(a - y - t)) /
           (4 * y * t);
}

static double truth_at(const strip *s, double x, double y, double tau, double h) {
    double a = s->shift + s->slope * y + s->speed * tau / 2 - x, c = s->speed * tau;
    return left_of(a + s->wide, s->slope, c, h) - left_of(a, s->slope, c, h);
}

static void write_scene(const strip *s, char *text, size_t size) {
    snprintf(text, size,
             "background(0.05)\n" CAMERA
             "local function side(at) return halfspace{normal={1, %.17g, 0}, offset=at} end\n"
             "add(((side(%.17g) - side(%.17g)) * " FRONT ")"
             ":velocity{%.17g, 0, 0}:material{unlit=true, color=0.8})",
             -s->slope, s->shift + s->wide, s->shift, s->speed * 60);
}

static int64_t samples_spent;

/* RMSE of display-encoded values of field 0, and the share of pixels that are within the error
 * asked for. */
static double error_of(const strip *s, const scene_job *job, double half_height,
                       double *within) {
    double sum = 0, good = 0, tau = wf_ratio_value(job->width);
    float *field = scene_field(job, 0);
    for (int l = 1; l < LINES / 2 - 1; l++)
        for (int i = 1; i < WIDTH - 1; i++) {
            double x = i + 0.5 - WIDTH / 2.0, y = LINES / 2.0 - 2 * l - 0.5;
            double covered = truth_at(s, x, y, tau, half_height);
            double e =
                encoded((double)field[3 * (l * WIDTH + i)]) - encoded(0.05 + 0.75 * covered);
            sum += e * e;
            good += fabs(e) <= job->error;
        }
    free(field);
    double pixels = (WIDTH - 2) * (LINES / 2 - 2);
    *within = good / pixels;
    return sqrt(sum / pixels);
}

static scene_job job_of(const char *text, const char *aperture, double error) {
    return (scene_job){.text = text,
                       .raster = RASTER,
                       .aperture = aperture,
                       .width = {1, 2},
                       .sampler = WF_SAMPLER_SOBOL,
                       .count = 64,
                       .error = error,
                       .samples = &samples_spent};
}

static const struct {
    const char *aperture;
    double half_height;
} apertures[] = {{"line", 0.5}, {"box", 1}};

/* How many samples a fixed number takes for an error, told from one of its errors: those of
 * points fall as N^-2/3 on edges that move (tests/bench/NOTES.md), and hardly faster on others.
 */
static double samples_for(double error, double fixed) {
    return (double)samples_spent * pow(fixed / error, 1 / 0.7);
}

/* Edges far apart: a fixed number of samples that reaches the same error takes several times
 * as many. */
static void edges_are_found(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof apertures / sizeof *apertures; n++)
        for (int k = 0; k < 4; k += test_step(3))
            for (int moves = 0; moves < 2; moves++) {
                strip s = {0.13 + 0.31 * k, 0.37 * k - 5, 12.3, moves * 1.7};
                char text[1024];
                double within;
                write_scene(&s, text, sizeof text);
                scene_job job = job_of(text, apertures[n].aperture, 0.0025);
                double error = error_of(&s, &job, apertures[n].half_height, &within);
                int64_t spent = samples_spent;
                job.error = 0;
                job.count = 256;
                double fixed = error_of(&s, &job, apertures[n].half_height, &(double){0});
                print_message(
                    "%s, slope %.2f, %s: RMSE %.1e for %5.1f samples a cell, %.1e for "
                    "256\n",
                    apertures[n].aperture, s.slope, moves ? "moving" : "still ", error,
                    (double)spent / (WIDTH * LINES), fixed);
                assert_true(error < 0.0025 / 2);
                assert_true(within >= 0.99);
                assert_true(error < 2 * fixed);
                assert_true((double)spent < samples_for(error, fixed) / 8);
            }
}

/* A strip as thin as a twentieth of a pixel is three things in one cell, or nothing to the
 * first samples. */
static void thin_things(void **state) {
    (void)state;
    for (double wide = 0.05; wide<1; wide *= test_step(4)> 1 ? 8 : 2)
        for (int moves = 0; moves < 2; moves++) {
            strip s = {0.41, -3.3, wide, moves * 1.7};
            char text[1024];
            double within;
            write_scene(&s, text, sizeof text);
            scene_job job = job_of(text, "box", 0.005);
            double error = error_of(&s, &job, 1, &within);
            print_message("%.2f pixels wide, %s: RMSE %.1e, within %.4f\n", wide,
                          moves ? "moving" : "still", error, within);
            assert_true(error <= 0.005);
            assert_true(within >= 0.99);
        }
}

/* The integral of the aperture's square over the square of its integral, both over pixels and
 * lines, of means over the window. */
static double share_of(const wf_aperture *a) {
    enum { STEPS = 64, TIMES = 32 };
    double sum = 0, square = 0, cell = 1.0 / (STEPS * STEPS);
    for (int i = 0; i < 2 * ceil(a->reach_u) * STEPS; i++)
        for (int j = 0; j < 2 * a->reach_v * STEPS; j++) {
            double u = (i + 0.5) / STEPS - ceil(a->reach_u), h = 0;
            for (int k = 0; k < TIMES; k++)
                h += wf_aperture_value(a, 1, u, (j + 0.5) / STEPS - a->reach_v,
                                       (k + 0.5) / TIMES - 0.5) /
                     TIMES;
            sum += h * cell;
            square += h * h * cell;
        }
    return square / (sum * sum);
}

/* Without a share of its own an aperture would have no error, and nothing would be refined. */
static void every_aperture_has_its_share(void **state) {
    (void)state;
    const wf_aperture_kind *kind;
    for (size_t n = 0; (kind = wf_aperture_at(n)); n++) {
        char name[64], why[256];
        wf_sampling s = {0};
        snprintf(name, sizeof name, "%s%s%s", kind->name, kind->follows ? ":" : "",
                 kind->follows ? kind->example : "");
        assert_true(wf_aperture_parse(name, &s.desc.gather.aperture, why, sizeof why));
        double share = wf_adaptive_share(&(wf_adaptive){.s = &s});
        double least = share_of(&s.desc.gather.aperture);
        if (!(share >= 0.99 * least && share <= 1.5 * least + 0.1))
            fail_msg("%s: share %g, integral %g", name, share, least);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(edges_are_found),
                                       cmocka_unit_test(thin_things),
                                       cmocka_unit_test(every_aperture_has_its_share)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
