/* Responses through the public interface against the formulas of filters/README.md, and what
 * the weights of other ratios leave at half a cycle a line against a sum of their own. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "convert/weft.h"
#include "filters/aperture/residue.h"

static double sinc(double z) {
    return fabs(z) < 1e-9 ? 1 : sin(M_PI * z) / (M_PI * z);
}

/* ---- Kernels, written down once more ---- */

static double line_h(double v) {
    return fabs(v) <= 0.5;
}
static double box_h(double v) {
    return fabs(v) <= 1;
}
static double tent_h(double v) {
    return fmax(1 - fabs(v), 0);
}

static double notch_h(double v) {
    v = fabs(v);
    return v < 1 ? 0.5 - v * v / 4 : v < 2 ? v * v / 4 - v + 1 : 0;
}

/* Mitchell and Netravali's cubic, B = C = 1/3. */
static double third_h(double v) {
    v = fabs(v);
    if (v < 1) return (7 * v * v * v - 12 * v * v + 16.0 / 3) / 6;
    return v < 2 ? (-7.0 / 3 * v * v * v + 12 * v * v - 20 * v + 32.0 / 3) / 6 : 0;
}

typedef struct kernel {
    const char *name;
    double (*h)(double v);
} kernel;

static const kernel kernels[] = {
    {"line", line_h},    {"rotated", line_h},
    {"box", box_h},      {"ccd", box_h},
    {"notch", notch_h},  {"shaped", notch_h},
    {"diamond", tent_h}, {"mitchell:0.3333333333333333,0.3333333333333333", third_h}};
#define KERNELS (sizeof kernels / sizeof *kernels)

/* The integral of h over [v0, v1]: Simpson's rule, exact for cubics, between h's knots. */
static double integral(double (*h)(double), double v0, double v1) {
    double sum = 0;
    for (double knot = -2; knot < 2; knot += 0.5) {
        double a = fmax(v0, knot), b = fmin(v1, knot + 0.5), inset = 1e-13;
        if (a < b) sum += (b - a) / 6 * (h(a + inset) + 4 * h((a + b) / 2) + h(b - inset));
    }
    return sum;
}

/* ---- Responses ---- */

static double shaped_formula(double tau, double fx, double fy, double ft) {
    enum { N = 4000 };
    double sum = 0;
    for (int i = 0; i < N; i++) {
        double v = -2 + 4 * (i + 0.5) / N;
        sum += notch_h(v) * sinc(4 * notch_h(v) * fx) * cos(2 * M_PI * fy * v);
    }
    return sum * 4 / N * sinc(tau * ft);
}

static double formula(const char *name, double tau, double fx, double fy, double ft) {
    double space = sinc(fx) * sinc(fy), time = sinc(tau * ft);
    if (!strcmp(name, "least")) return space * time / (1 + 4 * pow(sin(M_PI * fy), 4));
    if (!strcmp(name, "line") || !strcmp(name, "rotated")) return space * time;
    if (!strcmp(name, "box") || !strcmp(name, "ccd")) return sinc(fx) * sinc(2 * fy) * time;
    if (!strcmp(name, "diamond"))
        return sinc(fx) * sinc(fy + tau * ft / 2) * sinc(fy - tau * ft / 2);
    if (!strcmp(name, "shaped")) return shaped_formula(tau, fx, fy, ft);
    return sinc(fx) * sinc(2 * fy) * sinc(fy) * sinc(fy) * time; /* notch */
}

static void responses_are_the_formulas(void **state) {
    (void)state;
    const double taus[] = {0, 0.5, 1, 2, 3.7};
    const char *name;
    for (size_t n = 0; (name = weft_aperture_name(n)); n++) {
        const char *asked = !strcmp(name, "mitchell") ? "mitchell:1.5,-0.25" /* notch */
                            : !strcmp(name, "least")  ? "least:4"
                                                      : name;
        if (strstr("crisp calm design", name)) continue; /* test_design.c has their sums */
        double tolerance = strcmp(name, "shaped") ? 1e-12 : 1e-6;
        for (int t = 0; t < 5; t++)
            for (double fx = -0.6; fx < 1.2; fx += 0.3)
                for (double fy = -0.9; fy < 1.3; fy += 0.1)
                    for (double ft = 0; ft < 1.1; ft += 0.25) {
                        double got, want = formula(name, taus[t], fx, fy, ft);
                        assert_int_equal(
                            weft_aperture_response(asked, taus[t], fx, fy, ft, &got, NULL),
                            WEFT_OK);
                        if (fabs(got - want) > tolerance)
                            fail_msg("%s at %g, %g, %g, tau %g: %g is not %g", name, fx, fy, ft,
                                     taus[t], got, want);
                    }
    }
    assert_int_equal(weft_aperture_name(12) == NULL, 1);
}

static void widths_unless_told(void **state) {
    (void)state;
    const struct {
        const char *name;
        double tau;
    } presets[] = {{"line", 0.5},  {"rotated", 2},  {"box", 0.5},   {"ccd", 1},
                   {"notch", 0.5}, {"shaped", 0.5}, {"diamond", 2}, {"mitchell:0,0.5", 0.5}};
    for (size_t i = 0; i < 8; i++) {
        double own, told;
        assert_int_equal(weft_aperture_response(presets[i].name, -1, 0.1, 0.2, 0.3, &own, NULL),
                         WEFT_OK);
        assert_int_equal(
            weft_aperture_response(presets[i].name, presets[i].tau, 0.1, 0.2, 0.3, &told, NULL),
            WEFT_OK);
        assert_true(own == told);
    }
}

static void nonsense_is_refused(void **state) {
    (void)state;
    weft_error err = {""};
    double r = 7;
    assert_int_equal(weft_aperture_response("sharp", 1, 0, 0, 0, &r, &err), WEFT_USAGE);
    assert_non_null(strstr(err.text, "shaped"));
    assert_int_equal(weft_aperture_response("box", 1, NAN, 0, 0, &r, &err), WEFT_USAGE);
    assert_int_equal(weft_aperture_response("box", 1, 0, INFINITY, 0, &r, &err), WEFT_USAGE);
    assert_int_equal(weft_aperture_response("box", NAN, 0, 0, 0, &r, &err), WEFT_USAGE);
    assert_non_null(strstr(err.text, "finite"));
    assert_true(r == 7);
}

/* ---- What other ratios leave ---- */

static wf_aperture named(const char *name) {
    wf_aperture a;
    char why[256];
    if (!wf_aperture_parse(name, &a, why, sizeof why)) fail_msg("%s", why);
    return a;
}

/* How much of a grating cos(2 pi f y + phase) line j takes from the cells of `lines` /
 * input_lines lines that its kernel meets, their centers being y, relative to what it takes of
 * a level picture. */
static double seen(const kernel *k, int j, int input_lines, int lines, double f, double phase) {
    double cell = (double)lines / input_lines, center = j + 0.5, sum = 0, total = 0;
    for (int b = (int)floor((center - 2) / cell) - 1; b <= (int)ceil((center + 2) / cell) + 1;
         b++) {
        double weight = integral(k->h, b * cell - center, (b + 1) * cell - center);
        sum += weight * cos(2 * M_PI * f * (b + 0.5) * cell + phase);
        total += weight;
    }
    return fabs(sum / total);
}

/* The most that any line takes at any phase. Two phases a quarter apart tell of every other. */
static double worst(const kernel *k, int input_lines, int lines, double f) {
    double most = 0;
    for (int j = 0; j < lines; j++)
        most = fmax(most, hypot(seen(k, j, input_lines, lines, f, 0),
                                seen(k, j, input_lines, lines, f, M_PI / 2)));
    return most;
}

static void residues_are_the_worst_of_all_lines(void **state) {
    (void)state;
    const int ratios[][2] = {{1080, 486}, {1440, 1080}, {972, 486}, {244, 62},
                             {100, 100},  {61, 97},     {1, 30},    {729, 486}};
    for (size_t n = 0; n < KERNELS; n++)
        for (size_t r = 0; r < sizeof ratios / sizeof *ratios; r++)
            for (double f = 0; f < 1.01; f += 0.125) {
                wf_aperture a = named(kernels[n].name);
                double got = wf_line_residue(&a, ratios[r][0], ratios[r][1], f);
                double want = worst(&kernels[n], ratios[r][0], ratios[r][1], f);
                if (fabs(got - want) > 2e-12)
                    fail_msg("%s, %d to %d at %g: %g is not %g", kernels[n].name, ratios[r][0],
                             ratios[r][1], f, got, want);
            }
}

/* The figures of filters/README.md for half a cycle a line, in whole decibels. */
static void figures_of_residues(void **state) {
    (void)state;
    const struct {
        const char *name;
        int input_lines, lines;
        double db;
    } figures[] = {{"box", 1080, 486, -28},    {"notch", 1080, 486, -65},
                   {"box", 1440, 1080, -19},   {"notch", 1440, 1080, -50},
                   {"shaped", 1080, 486, -65}, {"shaped", 1440, 1080, -50}};
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++) {
        wf_aperture a = named(figures[i].name);
        double db =
            20 * log10(wf_line_residue(&a, figures[i].input_lines, figures[i].lines, 0.5));
        if (fabs(db - figures[i].db) > 0.6)
            fail_msg("%s: %g dB, not %g", figures[i].name, db, figures[i].db);
    }
}

/* Whole half lines: nothing is left of it. At 3/2 cells a line something is. */
static void whole_ratios_leave_nothing(void **state) {
    (void)state;
    const char *const notched[] = {"box",   "ccd", "notch", "shaped", "mitchell:1.5,-0.25",
                                   "crisp", "calm"};
    for (size_t n = 0; n < sizeof notched / sizeof *notched; n++) {
        wf_aperture a = named(notched[n]);
        for (int s = 1; s < 12; s++) assert_true(wf_line_residue(&a, 486 * s, 486, 0.5) == 0);
        assert_true(wf_line_residue(&a, 487, 486, 0.5) > 1e-9);
        assert_true(fabs(wf_line_residue(&a, 1080, 486, 0) - 1) < 1e-15);
    }
    wf_aperture box = named("box"), line = named("line");
    assert_true(wf_line_residue(&box, 729, 486, 0.5) == 0); /* 3 cells to 2 lines */
    assert_true(wf_line_residue(&line, 972, 486, 0.5) > 0.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(responses_are_the_formulas),
        cmocka_unit_test(widths_unless_told),
        cmocka_unit_test(nonsense_is_refused),
        cmocka_unit_test(residues_are_the_worst_of_all_lines),
        cmocka_unit_test(figures_of_residues),
        cmocka_unit_test(whole_ratios_leave_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
