/* The nearest picture whose flicker is weighed and bounded, against a solver of another kind:
 * the alternating direction method of multipliers on dense matrices, run until it stands. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "filters/least/least.h"
#include "filters/least/segments.h"

enum { LINES = 60, WIDE = wf_least_tile_px };

/* ---- Columns ---- */

static double uniform(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static void make_noise(double *s, int lines, uint64_t *seed) {
    for (int j = 0; j < lines; j++) s[j] = uniform(seed);
}

static void make_step(double *s, int lines, uint64_t *seed) {
    int at = 3 + (int)(uniform(seed) * (lines - 6));
    double low = 0.4 * uniform(seed), high = 0.6 + 0.4 * uniform(seed);
    for (int j = 0; j < lines; j++) s[j] = j < at ? low : j == at ? 0.5 : high;
}

/* Black and white in runs of one to six lines, with lines between that are part of both. */
static void make_text(double *s, int lines, uint64_t *seed) {
    for (int j = 0, white = 0; j < lines; white = !white) {
        int run = 1 + (int)(6 * uniform(seed));
        while (run-- > 0 && j < lines) s[j++] = white;
        if (j < lines) s[j++] = uniform(seed);
    }
}

static void make_grating(double *s, int lines, uint64_t *seed) {
    double f = 0.5 * uniform(seed), phase = 6 * uniform(seed);
    for (int j = 0; j < lines; j++) s[j] = 0.5 + 0.5 * sin(2 * M_PI * f * j + phase);
}

/* Highlights of high dynamic range, some above what there may be. */
static void make_bright(double *s, int lines, uint64_t *seed) {
    for (int j = 0; j < lines; j++)
        s[j] = uniform(seed) < 0.1 ? 60 * uniform(seed) : 0.5 * uniform(seed);
}

/* Beyond both bounds, and at the first and last line. */
static void make_beyond(double *s, int lines, uint64_t *seed) {
    for (int j = 0; j < lines; j++) s[j] = 0.5;
    s[0] = -0.3 + 2 * uniform(seed);
    s[lines - 1] = -0.3 + 2 * uniform(seed);
    s[lines / 2] = 1.4;
    s[lines / 3] = -0.2;
}

typedef void make_fn(double *s, int lines, uint64_t *seed);

static const struct {
    const char *name;
    make_fn *make;
    double most;
} kinds[] = {
    {"noise", make_noise, 1},
    {"step", make_step, 1},
    {"text", make_text, 1},
    {"grating", make_grating, 1},
    {"bright", make_bright, 10000 / 203.0},
    {"bright, linear", make_bright, INFINITY},
    {"beyond", make_beyond, 1},
};

enum { KINDS = sizeof kinds / sizeof *kinds };

/* ---- The other solver ---- */

static double flicker_at(const double *l, int lines, int j) {
    double above = l[j ? j - 1 : 1], below = l[j < lines - 1 ? j + 1 : lines - 2];
    return (l[j] - (above + below) / 2) / 2;
}

/* A column of B by its definition. */
static void flicker_matrix(int lines, double *b) {
    double unit[LINES];
    for (int k = 0; k < lines; k++) {
        for (int j = 0; j < lines; j++) unit[j] = j == k;
        for (int j = 0; j < lines; j++) b[j * lines + k] = flicker_at(unit, lines, j);
    }
}

/* In place, lower triangle. */
static void cholesky(double *a, int n) {
    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++) {
            double sum = a[i * n + j];
            for (int k = 0; k < j; k++) sum -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = i == j ? sqrt(sum) : sum / a[j * n + j];
        }
}

static void solve_factored(const double *a, int n, double *x) {
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) x[i] -= a[i * n + k] * x[k];
        x[i] /= a[i * n + i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) x[i] -= a[k * n + i] * x[k];
        x[i] /= a[i * n + i];
    }
}

static double within(double x, double low, double high) {
    return fmin(fmax(x, low), high);
}

/* min 1/2 |L - S|^2 + MU/2 |BL|^2 + (v in bounds), v = (BL, L). False: it never stands. limit:
 * of each line, or NULL: the description's. */
static bool other_solver(const wf_least_desc *d, const double *limit, const double *given,
                         double *l) {
    static double b[LINES * LINES], a[LINES * LINES], v[2 * LINES], u[2 * LINES], s[LINES];
    int n = d->lines;
    double rho_b = 0.5 / d->limit, rho_l = 1;
    flicker_matrix(n, b);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            double sum = (i == k) * (1 + rho_l);
            for (int j = 0; j < n; j++)
                sum += (d->weight + rho_b) * b[j * n + i] * b[j * n + k];
            a[i * n + k] = sum;
        }
    cholesky(a, n);
    memset(v, 0, sizeof v);
    memset(u, 0, sizeof u);
    for (int j = 0; j < n; j++) s[j] = within(given[j], 0, d->most);
    for (int turn = 0; turn < 100000; turn++) {
        double change = 0;
        for (int j = 0; j < n; j++) {
            l[j] = s[j] + rho_l * (v[n + j] - u[n + j]);
            for (int k = 0; k < n; k++) l[j] += rho_b * b[k * n + j] * (v[k] - u[k]);
        }
        solve_factored(a, n, l);
        for (int j = 0; j < 2 * n; j++) {
            double x = j < n ? flicker_at(l, n, j) : l[j - n];
            double e = j < n && limit ? limit[j] : d->limit;
            double to = j < n ? within(x + u[j], -e, e) : within(x + u[j], 0, d->most);
            change = fmax(change, fmax(fabs(to - v[j]), fabs(x - to)));
            u[j] += x - to;
            v[j] = to;
        }
        if (change < 1e-11) return true;
    }
    return false;
}

/* ---- Solving ---- */

typedef struct solved {
    wf_least *least;
    wf_least_scratch *scratch;
    wf_least_counts counts;
    float *l; /* [lines][WIDE] */
} solved;

static solved solve(const wf_least_desc *d, const float *s) {
    solved out = {wf_least_new(d), NULL, {0}, NULL};
    assert_non_null(out.least);
    out.scratch = wf_least_scratch_new(out.least);
    out.l = malloc((size_t)d->lines * WIDE * sizeof *out.l);
    assert_non_null(out.scratch);
    assert_non_null(out.l);
    wf_least_tile(out.least, out.scratch, 0, WIDE, WIDE, s, out.l, &out.counts);
    return out;
}

static void release(solved *s) {
    wf_least_scratch_free(s->scratch);
    wf_least_free(s->least);
    free(s->l);
}

static float *columns_of(int kind, int lines, uint64_t seed) {
    float *s = malloc((size_t)lines * WIDE * sizeof *s);
    double *column = malloc((size_t)lines * sizeof *column);
    for (int i = 0; i < WIDE; i++) {
        kinds[kind].make(column, lines, &seed);
        for (int j = 0; j < lines; j++) s[j * WIDE + i] = (float)column[j];
    }
    free(column);
    return s;
}

static void column_of(const float *tile, int lines, int i, double *column) {
    for (int j = 0; j < lines; j++) column[j] = (double)tile[j * WIDE + i];
}

static const double weights[] = {0, 1, 4, 30}, limits[] = {0.1, 0.02, 0.006};

/* The largest difference of a column, over max(1, max S); 0 where the other does not stand. */
static double difference(const wf_least_desc *d, const double *limit, const float *s,
                         const solved *got, int i, int *stood) {
    double column[LINES], other[LINES], scale = 1, worst = 0;
    column_of(s, LINES, i, column);
    if (!other_solver(d, limit, column, other)) return 0;
    ++*stood;
    for (int j = 0; j < LINES; j++) scale = fmax(scale, fabs(column[j]));
    for (int j = 0; j < LINES; j++)
        worst = fmax(worst, fabs((double)got->l[j * WIDE + i] - other[j]) / scale);
    return worst;
}

static void test_other_solver_agrees(void **state) {
    (void)state;
    int stood = 0, tried = 0;
    double worst = 0;
    for (int n = 0; n < KINDS * 12; n++) {
        const wf_least_desc d = {LINES, weights[n % 4], limits[n / 4 % 3], kinds[n / 12].most};
        float *s = columns_of(n / 12, LINES, 7);
        solved got = solve(&d, s);
        for (int i = 0; i < 2; i++, tried++)
            worst = fmax(worst, difference(&d, NULL, s, &got, i, &stood));
        release(&got);
        free(s);
    }
    print_message("off by %.2g, %d of %d columns\n", worst, stood, tried);
    assert_true(worst < 1e-5 && stood > tried * 8 / 10);
}

/* ---- Limits of pixels ---- */

/* The same where each pixel has its own limit: of one that all have, bit for bit. */
static void test_limits_of_pixels(void **state) {
    (void)state;
    int stood = 0, tried = 0;
    double worst = 0;
    for (int n = 0; n < KINDS * 4; n++) {
        const wf_least_desc d = {LINES, weights[n % 4], 0.02, kinds[n / 4].most};
        float *s = columns_of(n / 4, LINES, 11), *limit = columns_of(n / 4, LINES, 11);
        uint64_t seed = 3;
        solved got = solve(&d, s);
        float *within_it = malloc((size_t)LINES * WIDE * sizeof *within_it);
        assert_non_null(within_it);
        for (int k = 0; k < LINES * WIDE; k++) limit[k] = 0.02f;
        wf_least_tile_within(got.least, got.scratch, 0, WIDE, WIDE, s, limit, within_it,
                             &got.counts);
        double most = 0;
        for (int k = 0; k < LINES * WIDE; k++)
            most = fmax(most, fabs((double)within_it[k] - (double)got.l[k]));
        assert_true(most < 1e-6); /* 0.02f is not 0.02 */
        for (int k = 0; k < LINES * WIDE; k++)
            limit[k] = (float)(k / WIDE / 9 % 2 ? 0.006 : 0.006 + 0.1 * uniform(&seed));
        wf_least_tile_within(got.least, got.scratch, 0, WIDE, WIDE, s, limit, got.l,
                             &got.counts);
        for (int i = 0; i < 2; i++, tried++) {
            double of_column[LINES], column[LINES];
            column_of(limit, LINES, i, of_column);
            column_of(got.l, LINES, i, column);
            for (int j = 0; j < LINES; j++)
                assert_true(fabs(flicker_at(column, LINES, j)) <=
                            of_column[j] + 2e-7 * fmax(1, column[j]));
            worst = fmax(worst, difference(&d, of_column, s, &got, i, &stood));
        }
        assert_int_equal(got.counts.failed, 0);
        release(&got);
        free(within_it);
        free(limit);
        free(s);
    }
    print_message("off by %.2g, %d of %d columns\n", worst, stood, tried);
    assert_true(worst < 1e-5 && stood > tried * 8 / 10);
}

/* ---- The dual ---- */

/* Twice 1/2 |L - S|^2 + MU/2 |BL|^2. */
static double cost(const wf_least_desc *d, const double *s, const double *l) {
    double sum = 0;
    for (int j = 0; j < d->lines; j++) {
        double b = flicker_at(l, d->lines, j);
        sum += (l[j] - s[j]) * (l[j] - s[j]) + d->weight * b * b;
    }
    return sum;
}

/* Twice the least that the Lagrangian of these multipliers can be: no picture within the bounds
 * costs less. */
static double dual(const wf_least_desc *d, const double *s, const double *tension,
                   const double *press) {
    static double b[LINES * LINES], a[LINES * LINES];
    int n = d->lines;
    double l[LINES], sum;
    flicker_matrix(n, b);
    for (int i = 0; i < n; i++) {
        l[i] = s[i] - press[i];
        for (int k = 0; k < n; k++) {
            a[i * n + k] = i == k;
            l[i] -= b[k * n + i] * tension[k];
            for (int j = 0; j < n; j++) a[i * n + k] += d->weight * b[j * n + i] * b[j * n + k];
        }
    }
    cholesky(a, n);
    solve_factored(a, n, l);
    sum = cost(d, s, l);
    for (int j = 0; j < n; j++) {
        sum += 2 * (tension[j] * flicker_at(l, n, j) - d->limit * fabs(tension[j]));
        sum += 2 * (press[j] * l[j] - (press[j] > 0 ? d->most * press[j] : 0));
    }
    return sum;
}

static double gap_of(const wf_least_desc *d, const solved *got, const float *tile, int i) {
    double s[LINES], l[LINES], tension[LINES], press[LINES], scale = 1;
    for (int j = 0; j < d->lines; j++) {
        s[j] = within((double)tile[j * WIDE + i], 0, d->most);
        scale = fmax(scale, s[j]);
        l[j] = got->scratch->l[j * WIDE + i];
        tension[j] = wf_least_tension(got->scratch)[j * WIDE + i];
        press[j] = wf_least_press(got->scratch)[j * WIDE + i];
    }
    return (cost(d, s, l) - dual(d, s, tension, press)) / (scale * scale);
}

static void test_dual_proves_it(void **state) {
    (void)state;
    double worst = 0;
    for (int kind = 0; kind < KINDS; kind++)
        for (int n = 0; n < 12; n++) {
            const wf_least_desc d = {LINES, weights[n % 4], limits[n / 4], kinds[kind].most};
            float *s = columns_of(kind, LINES, 70 + (uint64_t)n);
            solved got = solve(&d, s);
            if (isfinite(d.most) && got.counts.solved == WIDE)
                for (int i = 0; i < WIDE; i++)
                    worst = fmax(worst, fabs(gap_of(&d, &got, s, i)));
            assert_int_equal(got.counts.failed, 0);
            assert_true(got.counts.gap <= 1e-10);
            release(&got);
            free(s);
        }
    print_message("largest duality gap of a column, of max(1, max S)^2: %.2g\n", worst);
    assert_true(worst > 0 && worst <= 1e-10);
}

/* ---- Bounds ---- */

static void hold_bounds(const wf_least_desc *d, const float *l) {
    for (int i = 0; i < WIDE; i++) {
        double column[1080];
        column_of(l, d->lines, i, column);
        for (int j = 0; j < d->lines; j++) {
            double b = flicker_at(column, d->lines, j), rounding = 2e-7 * fmax(1, column[j]);
            assert_true(fabs(b) <= d->limit + rounding);
            assert_true(column[j] >= -rounding && column[j] <= d->most + rounding);
        }
    }
}

static void test_bounds_hold(void **state) {
    (void)state;
    static const int heights[] = {2, 4, 5, 7, 486, 1080};
    static const double hard[] = {1, 0.1, 0.02, 0.005, 0.001};
    for (int kind = 0; kind < KINDS; kind++)
        for (int n = 0; n < 30; n++) {
            const wf_least_desc d = {heights[n % 6], weights[n % 4], hard[n / 6],
                                     kinds[kind].most};
            if (d.lines < 7 && kinds[kind].make == make_step) continue;
            float *s = columns_of(kind, d.lines, 700 + (uint64_t)n);
            solved got = solve(&d, s);
            hold_bounds(&d, got.l);
            assert_int_equal(got.counts.failed, 0);
            release(&got);
            free(s);
        }
}

/* What holds its bounds already is not touched. */
static void test_what_holds_stays(void **state) {
    (void)state;
    const wf_least_desc d = {LINES, 0, 0.02, 1};
    float s[LINES * WIDE];
    for (int n = 0; n < LINES * WIDE; n++) {
        int i = n % WIDE, j = n / WIDE;
        s[n] = (float)(0.5 + 0.01 * i * cos(2 * M_PI * j / (LINES - 1)));
    }
    solved got = solve(&d, s);
    assert_memory_equal(got.l, s, sizeof s);
    assert_int_equal(got.counts.solved, 0);
    release(&got);
}

static void test_clipped_is_counted(void **state) {
    (void)state;
    const wf_least_desc d = {LINES, 0, 0.05, 1};
    float s[LINES * WIDE];
    for (int n = 0; n < LINES * WIDE; n++) s[n] = 0.5f;
    s[5 * WIDE + 2] = 1.5f;
    s[9 * WIDE + 3] = -0.1f;
    s[9 * WIDE + 4] = NAN;
    solved got = solve(&d, s);
    assert_int_equal(got.counts.clipped, 2);
    hold_bounds(&d, got.l);
    release(&got);
}

/* ---- What follows from being nearest ---- */

/* Pictures do not come to lie farther apart: nothing pumps, nothing pops. */
static void test_non_expansive(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int n = 0; n < 48; n++) {
        const wf_least_desc d = {LINES, weights[n % 4], limits[n / 4 % 3], 1};
        int kind = n % 4;
        float *one = columns_of(kind, LINES, 11 + (uint64_t)n),
              *two = columns_of(kind, LINES, 12 + (uint64_t)n);
        if (n % 2) /* or they differ a little */
            for (int i = 0; i < LINES * WIDE; i++)
                two[i] = (float)within((double)one[i] + 0.01 * uniform(&seed), 0, 1);
        solved a = solve(&d, one), b = solve(&d, two);
        for (int i = 0; i < WIDE; i++) {
            double before = 0, after = 0;
            for (int j = i; j < LINES * WIDE; j += WIDE) {
                before += pow((double)one[j] - (double)two[j], 2);
                after += pow((double)a.l[j] - (double)b.l[j], 2);
            }
            assert_true(sqrt(after) <= sqrt(before) + 2e-6);
        }
        release(&a);
        release(&b);
        free(one);
        free(two);
    }
}

static double response(double weight, double f) {
    return 1 / (1 + weight * pow(sin(M_PI * f), 4));
}

static void test_response_of_gratings(void **state) {
    (void)state;
    for (int m = 0; m < 4; m++)
        for (int n = 0; n <= 20; n++) {
            const wf_least_desc d = {486, weights[m], INFINITY, 1};
            double f = 0.025 * n;
            float *s = malloc(486 * WIDE * sizeof *s);
            for (int i = 0; i < 486 * WIDE; i++)
                s[i] = (float)cos(2 * M_PI * f * (i / WIDE) + i % WIDE);
            solved got = solve(&d, s);
            for (int i = 200 * WIDE; i < 286 * WIDE; i++)
                assert_true(fabs((double)got.l[i] - (double)s[i] * response(d.weight, f)) <
                            1e-6);
            release(&got);
            free(s);
        }
}

/* Distance from S and flicker of a kernel of three or five taps, edges as b has them. */
static void by_kernel(const double *s, int n, double side, double far, double *l) {
    for (int j = 0; j < n; j++) {
        double sum = (1 - 2 * side - 2 * far) * s[j];
        for (int k = 1; k <= 2; k++) {
            int above = abs(j - k), below = j + k < n ? j + k : 2 * (n - 1) - j - k;
            sum += (k == 1 ? side : far) * (s[above] + s[below]);
        }
        l[j] = sum;
    }
}

static double distance(const double *a, const double *b, int n) {
    double sum = 0;
    for (int j = 0; j < n; j++) sum += (a[j] - b[j]) * (a[j] - b[j]);
    return sqrt(sum);
}

static double flicker_rms(const double *l, int n) {
    double sum = 0;
    for (int j = 0; j < n; j++) sum += pow(flicker_at(l, n, j), 2);
    return sqrt(sum);
}

static void weigh(const float *tile, double weight, int i, double *l) {
    const wf_least_desc d = {LINES, weight, INFINITY, 1};
    solved got = solve(&d, tile);
    for (int j = 0; j < LINES; j++) l[j] = got.scratch->l[j * WIDE + i];
    release(&got);
}

/* The weight whose flicker is as much as a kernel's, found by halving. */
static void test_no_kernel_is_nearer(void **state) {
    (void)state;
    static const double taps[][2] = {
        {0.25, 0}, {0.25, 0.0104}, {0.1, 0}, {0.3, -0.05}, {0.2, 0.05}};
    for (int kind = 0; kind < 3; kind++)
        for (int n = 0; n < 5; n++) {
            float *tile = columns_of(kind, LINES, 40);
            double s[LINES], by[LINES], l[LINES], low = 0, high = 1e6;
            column_of(tile, LINES, 0, s);
            by_kernel(s, LINES, taps[n][0], taps[n][1], by);
            for (int turn = 0; turn < 60; turn++) {
                double middle = turn < 20 ? sqrt((low + 1e-3) * high) : (low + high) / 2;
                weigh(tile, middle, 0, l);
                *(flicker_rms(l, LINES) > flicker_rms(by, LINES) ? &low : &high) = middle;
            }
            assert_true(distance(l, s, LINES) <= distance(by, s, LINES) + 1e-6);
            free(tile);
        }
}

/* ---- Tiles ---- */

/* A column is the same wherever the picture's width leaves it. */
static void test_width_does_not_matter(void **state) {
    (void)state;
    const wf_least_desc d = {LINES, 1, 0.02, 1};
    float *s = columns_of(2, LINES, 5);
    solved got = solve(&d, s);
    for (int width = 1; width < WIDE; width += 9) {
        float *narrow = calloc((size_t)LINES * WIDE, sizeof *narrow);
        wf_least_counts counts = {0};
        wf_least_tile(got.least, got.scratch, 0, width, WIDE, s, narrow, &counts);
        for (int n = 0; n < LINES * WIDE; n++)
            assert_true(fabsf(narrow[n] - (n % WIDE < width ? got.l[n] : 0)) < 1e-6f);
        free(narrow);
    }
    release(&got);
    free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_other_solver_agrees),
        cmocka_unit_test(test_limits_of_pixels),
        cmocka_unit_test(test_dual_proves_it),
        cmocka_unit_test(test_bounds_hold),
        cmocka_unit_test(test_what_holds_stays),
        cmocka_unit_test(test_clipped_is_counted),
        cmocka_unit_test(test_non_expansive),
        cmocka_unit_test(test_response_of_gratings),
        cmocka_unit_test(test_no_kernel_is_nearer),
        cmocka_unit_test(test_width_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
