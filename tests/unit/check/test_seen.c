/* What is seen of flicker and of crawl, measured of files, against thresholds and closed forms.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/check/measure.h"
#include "filters/seen/eye.h"
#include "filters/seen/sensitivity.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"

/* ---- Pictures of light ---- */

/* Light of frame `frame`, at the middle of a pixel. */
typedef double light_fn(const void *user, int frame, double x, double y);

typedef struct picture {
    light_fn *light;
    const void *user;
    int frame;
} picture;

static float light_at(const void *user, int channel, int x, int y) {
    const picture *p = user;
    (void)channel;
    return (float)p->light(p->user, p->frame, x + 0.5, y + 0.5);
}

/* Writes frames of linear light and measures them as `raster`. */
static wf_figures measured(const char *raster, int frames, light_fn *light, const void *user,
                           wf_measure_options options) {
    static wf_raster r;
    char path[160], why[256];
    wf_figures figures;
    weft_error err = {""};
    assert_true(wf_raster_parse(raster, &r, why, sizeof why));
    for (int n = 0; n < frames; n++) {
        const picture p = {light, user, n};
        const exr_part part = {.display = {0, 0, r.width_px, r.lines},
                               .data = {0, 0, r.width_px, r.lines},
                               .channels = "B G R",
                               .type = EXR_PIXEL_FLOAT,
                               .compression = EXR_COMPRESSION_ZIP,
                               .value = light_at,
                               .user = &p};
        snprintf(path, sizeof path, "%s/f.%04d.exr", job_directory, n);
        assert_true(exr_write(path, &part, 1));
    }
    snprintf(path, sizeof path, "%s/f.####.exr", job_directory);
    options.raster = &r;
    options.max_memory_bytes = (size_t)1 << 30;
    weft_status status = wf_measure(path, &options, &figures, &err);
    if (status) print_message("%s\n", err.text);
    assert_int_equal(status, WEFT_OK);
    snprintf(path, sizeof path, "rm %s/f.*", job_directory);
    assert_int_equal(system(path), 0);
    return figures;
}

static void assert_near(double value, double expected, double relative, const char *what) {
    print_message("%s: %.5g, expected %.5g\n", what, value, expected);
    if (!(fabs(value / expected - 1) <= relative))
        fail_msg("%s: %.6g, expected %.6g within %.2g of it", what, value, expected, relative);
}

/* ---- The whole field ---- */

typedef struct flicker {
    double light, contrast;
} flicker;

/* Lines of one field brighter than those of the other: all that is shown comes and goes. */
static double whole_field(const void *user, int frame, double x, double y) {
    const flicker *f = user;
    (void)frame, (void)x;
    return f->light * (1 + f->contrast * ((int)y % 2 ? -1 : 1));
}

static double threshold(double hz, double cd_m2, double heights, double aspect) {
    double degree = 180 / M_PI, half = 0.5 / heights;
    double area = 4 * atan(half) * atan(half * aspect) * degree * degree;
    return 1 / wf_sensitivity_disk(hz, cd_m2, sqrt(area / M_PI));
}

/* At the threshold that the published sensitivity has for a disk of the picture's size the
 * whole field is seen by one just noticeable difference. */
static void whole_fields_at_threshold(void **state) {
    (void)state;
    const struct {
        const char *raster;
        double hz, light, heights, peak, aspect;
        bool asked;
    } rows[] = {
        {"180x120@30i", 30, 0.2, 6, 100, 1.5, false},
        {"180x120@30i", 30, 0.8, 6, 100, 1.5, false},
        {"180x120@30000/1001i", 29.97, 0.05, 6, 100, 1.5, false},
        {"180x120@25i", 25, 0.5, 6, 100, 1.5, false},
        {"180x120@30i", 30, 0.5, 3, 300, 1.5, true},
        {"180x120@25psf", 25, 0.5, 6, 100, 1.5, false},
        {"96x720@30i", 30, 0.5, 3, 100, 96.0 / 720, false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double cd_m2 = rows[i].light * rows[i].peak;
        flicker f = {rows[i].light,
                     threshold(rows[i].hz, cd_m2, rows[i].heights, rows[i].aspect)};
        wf_measure_options o = {.view_heights = rows[i].asked ? rows[i].heights : 0,
                                .peak_cd_m2 = rows[i].asked ? rows[i].peak : 0};
        wf_figures m = measured(rows[i].raster, 2, whole_field, &f, o);
        assert_near(m.visible_jnd_p999, 1, 0.02, rows[i].raster);
        f.contrast *= 1.1;
        m = measured(rows[i].raster, 1, whole_field, &f, o);
        assert_near(m.visible_share, 1, 0.001, "above it the share is all");
        f.contrast /= 1.21;
        m = measured(rows[i].raster, 1, whole_field, &f, o);
        assert_true(m.visible_share == 0);
    }
}

/* Without contrast nothing is seen but, on a CRT from near by, its lines. */
static void even_light(void **state) {
    (void)state;
    const flicker even = {0.5, 0}, dark = {0, 0};
    wf_figures m =
        measured("180x120@30i", 3, whole_field, &even, (wf_measure_options){.view_heights = 0});
    assert_true(m.visible_jnd_p999 == 0 && m.visible_share == 0);
    assert_true(m.crawl_p999 == 0 && m.crawl_jnd_p999 == 0);
    m = measured("180x120@30i", 1, whole_field, &dark, (wf_measure_options){.chart = 0});
    assert_true(m.visible_jnd_p999 == 0 && isnan(m.crawl_rms));
    wf_measure_options near = {.display = WF_DISPLAY_CRT, .view_heights = 3};
    assert_true(measured("180x120@30i", 1, whole_field, &even, near).visible_jnd_p999 > 1);
    near.view_heights = 24;
    assert_true(measured("180x120@30i", 1, whole_field, &even, near).visible_jnd_p999 < 1);
}

/* ---- Gratings ---- */

static double grating(const void *user, int frame, double x, double y) {
    const double *f = user;
    (void)frame, (void)x;
    return 0.4 * (1 + f[1] * cos(M_PI * (y - 0.5) + 2 * M_PI * f[0] * (y - 60)));
}

/* Near half a cycle a line a grating flickers in stripes: of half its own frequency's distance
 * from that, by a bob display's cos^2(pi f) of its contrast. */
static void gratings(void **state) {
    (void)state;
    for (int n = 7; n < 36; n += 5) {
        /* From half a cycle a line; it has its turning points at the edges. */
        double f = n / 119.0;
        double contrast = 0.3, user[] = {f, contrast}, degree = 180 / M_PI;
        double cycles_degree = f / (degree * atan(1 / (24.0 * 120)));
        double area = 4 * atan(0.5 / 24) * atan(0.75 / 24) * degree * degree;
        double shown = contrast * cos(M_PI * f) * cos(M_PI * f);
        wf_figures m =
            measured("180x120@30i", 1, grating, user, (wf_measure_options){.view_heights = 24});
        assert_near(m.visible_jnd_p999, shown * wf_sensitivity(cycles_degree, 30, 40, area),
                    0.1, "a grating");
    }
}

/* ---- Crawl ---- */

/* An edge through an aperture: the integral of a box of two lines. */
static double edge(double y) {
    double up = (y + 1) / 2;
    return 0.2 + 0.6 * (up < 0 ? 0 : up > 1 ? 1 : up);
}

enum { CRAWL_LINES = 120 };

typedef struct drift {
    double from, lines_field;
    bool top_first;
} drift;

static double drifting(const void *user, int frame, double x, double y) {
    const drift *d = user;
    bool top = (int)y % 2 == 0;
    int field = 2 * frame + (top == d->top_first ? 0 : 1);
    (void)x;
    return edge(y - d->from - d->lines_field * field);
}

/* What a field with lines at z = offset + 2 k from the edge shows there: straight lines. */
static double shown_at(double z, double offset) {
    double k = floor((z - offset) / 2), low = offset + 2 * k, t = (z - low) / 2;
    return (1 - t) * edge(low) + t * edge(low + 2);
}

/* The amplitude of what comes and goes in four fields at a distance z from the edge: their
 * lines lie half a line further each. */
static void amplitude(double z, double first, double step, double *real, double *imaginary,
                      double *mean) {
    double f[4];
    for (int k = 0; k < 4; k++) f[k] = shown_at(z, first + k * step);
    *real = (f[0] - f[2]) / 2;
    *imaginary = (f[3] - f[1]) / 2;
    *mean = (f[0] + f[1] + f[2] + f[3]) / 4;
}

/* A part of the amplitude, or the mean, blurred by a Gaussian of so many lines about z. */
static double blurred(int part, double deviation, double z, double first, double step) {
    double sum = 0, all = 0;
    for (double d = -6 * deviation; d <= 6 * deviation; d += deviation / 16) {
        double v[3], w = exp(-0.5 * d * d / (deviation * deviation));
        amplitude(z + d, first, step, &v[0], &v[1], &v[2]);
        sum += w * v[part];
        all += w;
    }
    return sum / all;
}

/* What is seen at a distance z: bands of the sensitivity, each of the edge's amplitude through
 * its Gaussian, about the mean through that of half a degree. */
static double seen_at(double z, double first, double step, const wf_viewing *v,
                      const wf_eye *eye) {
    double degree = wf_viewing_lines_degree(v), parts[2] = {0};
    double local = blurred(2, 0.5 * degree, z, first, step);
    for (int k = 0; k < WF_EYE_BANDS; k++) {
        double deviation = degree / (2 * M_PI * wf_eye_width[k]);
        wf_eye one = {{{0}}};
        for (int i = 0; i < WF_EYE_KNOTS; i++) one.weight[i][k] = eye->weight[i][k];
        double weight = wf_eye_sensitivity(&one, 0, local * v->white_cd_m2);
        for (int p = 0; p < 2; p++) parts[p] += weight * blurred(p, deviation, z, first, step);
    }
    return hypot(parts[0], parts[1]) / local;
}

/* The 99.9th percentile is of all pixels, and an edge's few lines are more than a thousandth of
 * them: it is the highest value there is. */
static void check_crawl(const char *raster, const drift *d) {
    wf_figures m = measured(raster, 5, drifting, d, (wf_measure_options){.view_heights = 24});
    double highest = 0, squares = 0, seen = 0;
    double fields_hz = 2 * wf_ratio_value(m.info.raster.frame_rate);
    const wf_viewing v = {24, 100, fields_hz / 4, 40, CRAWL_LINES, 1};
    static wf_eye eye;
    wf_eye_init(&eye, &v);
    /* Lines of the first field are at y = parity + 1/2 + 2 k. */
    double parity = d->top_first ? 0 : 1;
    double first = parity + 0.5 - d->from, step = 1 - d->lines_field;
    for (int frame = 0; frame < 3; frame++)
        for (int y = 0; y < CRAWL_LINES; y++) {
            double re, im, mean, z = y + 0.5 - d->from - 2 * d->lines_field * frame;
            amplitude(z, first + 2 * frame * step, step, &re, &im, &mean);
            highest = fmax(highest, hypot(re, im));
            squares += re * re + im * im;
            if (fabs(z) < 6)
                seen = fmax(seen, seen_at(z, first + 2 * frame * step, step, &v, &eye));
        }
    assert_near(m.crawl_p999, highest, 0.01, "crawl's amplitude");
    assert_near(m.crawl_rms, sqrt(squares / (3 * CRAWL_LINES)), 0.05, "its RMS");
    assert_near(m.crawl_jnd_p999, seen, 0.05, "what is seen of it");
}

static void edges_that_drift(void **state) {
    (void)state;
    const drift rows[] = {
        {60, 0.5, true}, {60.3, -0.5, true}, {59.7, 0.5, false}, {61.25, -0.5, false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        check_crawl(rows[i].top_first ? "40x120@30i,tff" : "40x120@30i,bff", &rows[i]);
        check_crawl(rows[i].top_first ? "40x120@25i,tff" : "40x120@25i,bff", &rows[i]);
    }
}

/* Bars that move across, and are where their like was after as many fields as user says. */
static double passing(const void *user, int frame, double x, double y) {
    const int *fields = user;
    int field = 2 * frame + (int)y % 2;
    double across = fmod(x + 16.0 * field / *fields, 16);
    return y > 40 && y < 80 && across < 5 ? 0.9 : 0.2;
}

/* Edges that stand still or move otherwise do not count, and nor does a wrong order. */
static void other_edges(void **state) {
    (void)state;
    const drift still = {60, 0, true}, fast = {60, 0.8, true}, right = {60, 0.5, true};
    const wf_measure_options o = {.chart = 0};
    assert_true(measured("40x120@30i,tff", 5, drifting, &still, o).crawl_p999 < 1e-6);
    assert_true(measured("40x120@30i,tff", 5, drifting, &fast, o).crawl_p999 < 1e-6);
    for (int fields = 2; fields < 5; fields++)
        assert_true(measured("40x120@30i,tff", 5, passing, &fields, o).crawl_p999 < 1e-6);
    double crawl = measured("40x120@30i,tff", 5, drifting, &right, o).crawl_p999;
    double wrong = measured("40x120@30i,bff", 5, drifting, &right, o).crawl_p999;
    assert_true(crawl > 0.02 && wrong != crawl);
    assert_true(isnan(measured("40x120@30p", 5, drifting, &right, o).crawl_p999));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_fields_at_threshold),
        cmocka_unit_test(even_light),
        cmocka_unit_test(gratings),
        cmocka_unit_test(edges_that_drift),
        cmocka_unit_test(other_edges),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
