/* Apertures against their definitions: cell integrals against h itself, responses against the
 * Fourier sum of h, the notch where it must be zero. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "filters/aperture/aperture.h"
#include "filters/resample/lattice.h"

static const char *const names[] = {"line",
                                    "rotated",
                                    "box",
                                    "ccd",
                                    "notch",
                                    "shaped",
                                    "diamond",
                                    "mitchell:0.3333333333333333,0.3333333333333333",
                                    "mitchell:1.5,-0.25",
                                    "mitchell:0,0.5",
                                    "crisp",
                                    "calm",
                                    "design:sharp=0.6,support=2.5,width=2"};

static wf_aperture named(const char *name) {
    wf_aperture a;
    char why[256];
    if (!wf_aperture_parse(name, &a, why, sizeof why)) fail_msg("%s", why);
    return a;
}

/* Midpoint sum of h over u, v and q; tau is 1. */
static double integral_of_value(const wf_aperture *a, const double lo[3], const double hi[3],
                                int n) {
    double sum = 0, step[3];
    for (int d = 0; d < 3; d++) step[d] = (hi[d] - lo[d]) / n;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++)
                sum +=
                    wf_aperture_value(a, 1, lo[0] + (i + 0.5) * step[0],
                                      lo[1] + (j + 0.5) * step[1], lo[2] + (k + 0.5) * step[2]);
    return sum * step[0] * step[1] * step[2];
}

static double cell(const wf_aperture *a, const double lo[3], const double hi[3]) {
    if (a->kind->couples_vq)
        return wf_cell_u(a, lo[0], hi[0]) * a->kind->cell_vq(1, lo[1], hi[1], lo[2], hi[2]);
    return a->kind->cell_uv(a, lo[0], hi[0], lo[1], hi[1]) * (hi[2] - lo[2]);
}

static void cells_are_integrals_of_h(void **state) {
    (void)state;
    const double boxes[][2][3] = {{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}},
                                  {{0.1, 0.2, -0.3}, {0.45, 1.4, 0.45}},
                                  {{-0.9, -1.9, 0.05}, {-0.05, -0.3, 0.2}},
                                  {{-0.31, 0.7, -0.5}, {0.92, 1.7, 0.1}},
                                  {{0.5, -2, -0.5}, {1, 2, 0.5}}};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        wf_aperture a = named(names[n]);
        for (size_t b = 0; b < sizeof boxes / sizeof *boxes; b++) {
            double exact = cell(&a, boxes[b][0], boxes[b][1]);
            double summed = integral_of_value(&a, boxes[b][0], boxes[b][1], 64);
            if (fabs(exact - summed) > 0.04)
                fail_msg("%s, box %zu: %g is not %g", names[n], b, exact, summed);
        }
    }
}

/* Splitting a cell anywhere splits its integral: to rounding, at the cubic pieces' knots too.
 */
static void cells_add_up(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        wf_aperture a = named(names[n]);
        double lo[3] = {-1, -2, -0.5}, hi[3] = {1, 2, 0.5}, whole = cell(&a, lo, hi);
        for (int parts = 2; parts < 40; parts++) {
            double sum = 0;
            for (int i = 0; i < parts; i++)
                for (int j = 0; j < parts; j++) {
                    double l[3] = {-1 + 2.0 * i / parts, -2 + 4.0 * j / parts, -0.5};
                    double h[3] = {-1 + 2.0 * (i + 1) / parts, -2 + 4.0 * (j + 1) / parts, 0.5};
                    sum += cell(&a, l, h);
                }
            assert_true(fabs(sum - whole) < 1e-12);
        }
    }
}

static double h_at(const wf_aperture *a, double tau, const double z[3]) {
    return wf_aperture_value(a, tau, z[0], z[1], z[2]);
}

/* The response as the normalized Fourier sum of h on a fine grid. */
static double fourier_sum(const wf_aperture *a, double tau, const double f[3]) {
    enum { N = 64 };
    double real = 0, total = 0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < 8 * N; j++)
            for (int k = 0; k < N; k++) {
                double z[3] = {-1 + 2 * (i + 0.5) / N, -4 + (j + 0.5) / N,
                               tau * ((k + 0.5) / N - 0.5)};
                double h = h_at(a, tau, z);
                if (h == 0) continue;
                total += h;
                real += h * cos(2 * M_PI * (f[0] * z[0] + f[1] * z[1] + f[2] * z[2]));
            }
    return real / total;
}

static void responses_are_fourier_transforms_of_h(void **state) {
    (void)state;
    const double f[][3] = {{0, 0.25, 0}, {0.3, 0.1, 0.2}, {0.5, 0.7, 0.6}};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        wf_aperture a = named(names[n]);
        for (size_t i = 0; i < sizeof f / sizeof *f; i++) {
            double closed = wf_response(&a, 1.5, f[i][0], f[i][1], f[i][2]);
            double summed = fourier_sum(&a, 1.5, f[i]);
            if (fabs(closed - summed) > 0.025)
                fail_msg("%s at %zu: %g is not %g", names[n], i, closed, summed);
        }
    }
}

static void responses_at_dc_and_at_the_notch(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        wf_aperture a = named(names[n]);
        assert_true(fabs(wf_response(&a, 0.5, 0, 0, 0) - 1) < 1e-12);
    }
    const char *const notched[] = {
        "box",   "ccd",  "notch",           "shaped", "mitchell:1.5,-0.25",
        "crisp", "calm", "design:sharp=0.7"};
    for (size_t n = 0; n < sizeof notched / sizeof *notched; n++) {
        wf_aperture a = named(notched[n]);
        assert_true(fabs(wf_response(&a, 0.5, 0, 0.5, 0)) < 1e-12);
    }
    wf_aperture line = named("line"), diamond = named("diamond");
    assert_true(fabs(wf_response(&line, 0, 0, 0.5, 0) - 2 / M_PI) < 1e-14);
    assert_true(fabs(wf_response(&diamond, 0, 0, 0.5, 0) - 4 / (M_PI * M_PI)) < 1e-14);
}

/* The family's member (3/2, -1/4) is the notch (paper, section 5), weight by weight. */
static void notch_is_a_member_of_the_family(void **state) {
    (void)state;
    wf_aperture notch = named("notch"), member = named("mitchell:1.5,-0.25");
    for (double v = -2.2; v < 2.2; v += 0.0173) {
        double a = notch.kind->cell_v(&notch, v, v + 0.2),
               b = member.kind->cell_v(&member, v, v + 0.2);
        assert_true(fabs(a - b) < 1e-14);
        assert_true(fabs(wf_response(&notch, 0.5, 0.1, v, 0.3) -
                         wf_response(&member, 0.5, 0.1, v, 0.3)) < 1e-12);
    }
}

/* At one sample a line: box is 1/4 1/2 1/4, notch .0104 .25 .4792 .25 .0104. */
static void kernels_at_one_sample_a_line(void **state) {
    (void)state;
    wf_aperture box = named("box"), notch = named("notch");
    const double box_is[] = {0, 0.25, 0.5, 0.25, 0};
    const double notch_is[] = {1.0 / 96, 0.25, 23.0 / 48, 0.25, 1.0 / 96};
    for (int b = -2; b <= 2; b++) {
        assert_true(fabs(box.kind->cell_v(&box, b - 0.5, b + 0.5) / 2 - box_is[b + 2]) < 1e-15);
        assert_true(fabs(notch.kind->cell_v(&notch, b - 0.5, b + 0.5) - notch_is[b + 2]) <
                    1e-15);
    }
}

/* With s samples a line and 2s whole, the weights keep the zero at half a cycle a line. */
static void whole_samples_keep_the_zero(void **state) {
    (void)state;
    const char *const zeros[] = {"box", "notch", "shaped", "ccd", "crisp", "calm"};
    for (size_t n = 0; n < sizeof zeros / sizeof *zeros; n++)
        for (int s = 1; s <= 9; s++) {
            wf_aperture a = named(zeros[n]);
            wf_axis axis;
            assert_true(wf_axis_init(&axis, &(wf_fitting){40, 40 * s, {1, s}, false}));
            wf_span reach = wf_axis_reach(&axis, a.reach_v, 20);
            double sum = 0, total = 0;
            for (int b = reach.first; b < reach.end; b++) {
                double v0 = wf_axis_edge(&axis, b, 20), v1 = wf_axis_edge(&axis, b + 1, 20);
                double w = a.kind->cell_v(&a, v0, v1);
                total += w;
                sum += w * cos(M_PI * (v0 + v1) / 2);
            }
            assert_true(fabs(sum / total) < 1e-14);
        }
}

static void names_are_checked(void **state) {
    (void)state;
    wf_aperture a;
    char why[256];
    const char *const wrong[] = {
        "",           "boxx",        "box:1",          "mitchell",       "mitchell:",
        "mitchell:1", "mitchell:1,", "mitchell:1,2,3", "mitchell:nan,0", "mitchell:1e9,0",
        "crisp:1",    "design",      "design:",        "design:sharp"};
    for (size_t n = 0; n < sizeof wrong / sizeof *wrong; n++) {
        why[0] = '\0';
        assert_false(wf_aperture_parse(wrong[n], &a, why, sizeof why));
        assert_true(why[0]);
    }
    assert_non_null((wf_aperture_parse("sharp", &a, why, sizeof why), strstr(why, "shaped")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_are_integrals_of_h),
        cmocka_unit_test(cells_add_up),
        cmocka_unit_test(responses_are_fourier_transforms_of_h),
        cmocka_unit_test(responses_at_dc_and_at_the_notch),
        cmocka_unit_test(notch_is_a_member_of_the_family),
        cmocka_unit_test(kernels_at_one_sample_a_line),
        cmocka_unit_test(whole_samples_keep_the_zero),
        cmocka_unit_test(names_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
