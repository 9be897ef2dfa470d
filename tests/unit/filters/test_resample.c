/* The resampler against the float64 reference: every aperture, position, order, many awkward
 * ratios, windows, edges; then the properties that hold whatever the weights are. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "filters/resample/resampler.h"
#include "filters/resample/rows.h"
#include "tests/unit/support/reference.h"
#include "tests/unit/support/sizes.h"

/* ---- A sequence in memory ---- */

typedef struct movie {
    int cells_x, cells_y, subframes, channels;
    wf_cells data; /* in display coordinates */
    float *pixel;  /* [subframes][channels][data rows][data columns] */
} movie;

static uint32_t draw(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static double uniform(uint32_t *state) {
    return draw(state) / 16777216.0;
}

static size_t at(const movie *m, int k, int c, int a, int b) {
    size_t width = (size_t)(m->data.x1 - m->data.x0),
           height = (size_t)(m->data.y1 - m->data.y0);
    return (((size_t)k * (size_t)m->channels + (size_t)c) * height + (size_t)(b - m->data.y0)) *
               width +
           (size_t)(a - m->data.x0);
}

static float sample_of(const void *user, int k, int a, int b, int channel) {
    const movie *m = user;
    return m->pixel[at(m, k, channel, a, b)];
}

/* Noise over fourteen decades, with spikes of the largest half beside zeros. */
static float extreme(uint32_t *state) {
    double u = uniform(state);
    if (u < 0.02) return 65504;
    if (u < 0.2) return 0;
    return (float)((uniform(state) < 0.1 ? -1 : 1) * pow(10, 14 * uniform(state) - 9));
}

static movie make_movie(int cells_x, int cells_y, int subframes, wf_cells data, int channels,
                        uint32_t seed) {
    movie m = {cells_x, cells_y, subframes, channels, data, NULL};
    size_t count = (size_t)subframes * (size_t)channels * (size_t)(data.x1 - data.x0) *
                   (size_t)(data.y1 - data.y0);
    m.pixel = malloc((count + 1) * sizeof *m.pixel);
    assert_non_null(m.pixel);
    for (size_t i = 0; i < count; i++) m.pixel[i] = extreme(&seed);
    for (int k = 0; channels == 4 && k < subframes; k++)
        for (int b = data.y0; b < data.y1; b++)
            for (int a = data.x0; a < data.x1; a++)
                m.pixel[at(&m, k, 3, a, b)] = (float)uniform(&seed);
    return m;
}

/* ---- Cases ---- */

typedef struct scenario {
    const char *aperture, *raster, *rate;
    wf_rational width;
    wf_position position;
    wf_rational skew;
    bool center;
    int cells_x, cells_y, subframes;
    wf_cells data;
    int fit; /* 0 stretch, 1 crop, 2 pad */
    int channels;
    float background;
    int band_rows, band_origin;
} scenario;

static void must(bool ok, const char *why) {
    if (!ok) fail_msg("%s", why);
}

static wf_resample_desc describe(const scenario *s, wf_raster *raster) {
    char why[512] = "";
    wf_resample_desc d = {.raster = raster, .channels = s->channels};
    must(wf_raster_parse(s->raster, raster, why, sizeof why), why);
    must(wf_aperture_parse(s->aperture, &d.aperture, why, sizeof why), why);
    d.timing = (wf_timing_desc){.raster = raster,
                                .subframe_center = s->center,
                                .subframes = s->subframes,
                                .width = s->width,
                                .position = s->position,
                                .skew = s->skew};
    must(wf_rate_parse(s->rate, &d.timing.subframe_rate), s->rate);
    for (int c = 0; c < 3; c++) d.background[c] = s->background;
    d.x = (wf_fitting){raster->width_px, s->cells_x, wf_ratio(raster->width_px, s->cells_x),
                       false};
    d.y = (wf_fitting){raster->lines, s->cells_y, wf_ratio(raster->lines, s->cells_y), false};
    if (s->fit) {
        bool x_larger = wf_ratio_value(d.x.cell) > wf_ratio_value(d.y.cell);
        wf_rational cell = x_larger == (s->fit == 1) ? d.x.cell : d.y.cell;
        d.x.cell = d.y.cell = cell;
        d.x.padded = d.y.padded = s->fit == 2;
    }
    d.band_rows = s->band_rows;
    d.band_origin = s->band_origin;
    return d;
}

static reference refer(const scenario *s, const wf_resample_desc *d, const movie *m) {
    const wf_raster *r = d->raster;
    double cell_w = wf_ratio_value(d->x.cell), cell_h = wf_ratio_value(d->y.cell);
    return (reference){
        .width = r->width_px,
        .lines = r->lines,
        .interlaced = r->scan == WF_INTERLACED,
        .psf = r->scan == WF_SEGMENTED,
        .top_first = r->top_first,
        .field_period_s = wf_ratio_value(wf_raster_field_period(r)),
        .aperture = d->aperture.kind->name,
        .b = d->aperture.parameter[0],
        .c = d->aperture.parameter[1],
        .steps = d->aperture.stairs.height,
        .step_count = d->aperture.stairs.count,
        .half_u = d->aperture.half_u,
        .tau = wf_ratio_value(s->width),
        .position = s->position == WF_START    ? 0
                    : s->position == WF_CENTER ? 0.5
                                               : 1,
        .skew = wf_ratio_value(s->skew),
        .rate = wf_ratio_value(d->timing.subframe_rate),
        .center = s->center,
        .subframes = s->subframes,
        .cells_x = s->cells_x,
        .cells_y = s->cells_y,
        .cell_w = cell_w,
        .cell_h = cell_h,
        .origin_x = (r->width_px - s->cells_x * cell_w) / 2,
        .origin_y = (r->lines - s->cells_y * cell_h) / 2,
        .padded = s->fit == 2,
        .background = {s->background, s->background, s->background},
        .data = {s->data.x0, s->data.y0, s->data.x1, s->data.y1},
        .has_alpha = s->channels == 4,
        .sample = sample_of,
        .user = m,
    };
}

static wf_cells rows_within(const movie *m, wf_span rows) {
    wf_cells here = m->data;
    if (here.y0 < rows.first) here.y0 = rows.first;
    if (here.y1 > rows.end) here.y1 = rows.end;
    if (here.y1 < here.y0) here.y1 = here.y0;
    return here;
}

static void add_subframe(wf_field *field, const movie *m, int band, wf_span rows, int64_t k,
                         wf_scratch *scratch) {
    wf_band_input in = {.k = &k,
                        .k_count = 1,
                        .data = m->data,
                        .here = rows_within(m, rows),
                        .line_stride = (size_t)(m->data.x1 - m->data.x0),
                        .channels = m->channels};
    for (int c = 0; c < m->channels && in.here.y0 < in.here.y1; c++)
        in.plane[c] = &m->pixel[at(m, (int)k, c, in.here.x0, in.here.y0)];
    wf_band_add(field, band, scratch, 0, &in);
}

/* All of a field, its window read in batches of batch_size subframes. */
static void add_window(const wf_resampler *rs, const movie *m, wf_field *field, int batch_size,
                       wf_scratch *scratch) {
    wf_window window = wf_resampler_window(rs, wf_field_index(field));
    bool overscan = wf_resampler_overscan(rs, &m->data);
    for (int64_t k = window.first, past = k + window.count; k < past; k += batch_size) {
        int64_t end = k + batch_size < past ? k + batch_size : past;
        assert_true(wf_field_begin_batch(field, end == past, overscan));
        for (int band = 0; band < wf_resampler_bands(rs); band++) {
            wf_band_open(field, band, scratch, 0);
            for (int64_t i = k; i < end; i++)
                add_subframe(field, m, band, wf_resampler_band_rows(rs, band), i, scratch);
            wf_band_close(field, band, scratch, 0, false);
        }
        wf_field_end_batch(field);
    }
    assert_true(wf_field_complete(field));
}

static wf_field *resample(const wf_resampler *rs, const movie *m, int64_t index, int batch_size,
                          wf_scratch *scratch) {
    wf_field *field = wf_field_new(rs, index);
    assert_non_null(field);
    add_window(rs, m, field, batch_size, scratch);
    return field;
}

static double worst_ratio;

static void compare_line(const scenario *s, const reference *r, int64_t index, int j,
                         float *const rgb[3]) {
    for (int i = 0; i < r->width; i++) {
        int c = (i + j) % 3;
        reference_value ref = reference_pixel(r, i, j, index, c);
        double error = fabs((double)rgb[c][i] - ref.value), bound = 1e-6 * ref.scale + 1e-38;
        if (error / bound > worst_ratio) worst_ratio = error / bound;
        if (!(error <= bound))
            fail_msg(
                "%s on %s from %dx%d at %s, tau %g: field %lld line %d pixel %d: %.9g is not "
                "%.9g (bound %.3g)",
                s->aperture, s->raster, s->cells_x, s->cells_y, s->rate, r->tau,
                (long long)index, j, i, (double)rgb[c][i], ref.value, bound);
    }
}

/* Compares a few lines, the edges among them, of some fields. */
static void check_sums(const scenario *s, bool quick) {
    wf_raster raster;
    char why[512] = "";
    wf_resample_desc desc = describe(s, &raster);
    desc.floats = quick;
    movie m = make_movie(s->cells_x, s->cells_y, s->subframes, s->data, s->channels, 7);
    reference r = refer(s, &desc, &m);
    wf_resampler *rs;
    must(wf_resampler_new(&desc, &rs, why, sizeof why), why);
    wf_scratch *scratch = wf_scratch_new(rs, 1);
    float *line = malloc(3 * (size_t)raster.width_px * sizeof *line);
    assert_true(scratch && line);
    float *rgb[3] = {line, line + raster.width_px, line + 2 * raster.width_px};
    int64_t fields = wf_timing_frames(&desc.timing) * wf_raster_fields_per_frame(&raster);
    assert_true(fields >= 1);
    for (int64_t n = 0; n<fields; n += fields> 3 ? fields - 2 : 1) {
        wf_field *field = resample(rs, &m, n, 3, scratch);
        int parity = wf_raster_parity(&raster, n),
            lines = wf_raster_field_lines(&raster, parity);
        for (int l = 0; l < lines; l += l < 2 || l >= lines - 3 ? 1 : lines / 3) {
            wf_field_line(field, l, scratch, rgb);
            compare_line(s, &r, n, parity + l * wf_raster_line_step(&raster), rgb);
        }
        wf_field_free(field);
    }
    free(line);
    wf_scratch_free(scratch);
    wf_resampler_free(rs);
    free(m.pixel);
}

/* Sums in double, and of every third in float where that is accurate enough. */
static void check(const scenario *s) {
    static int checked;
    check_sums(s, false);
    if (s->channels == 3 && checked++ % 3 == 0) check_sums(s, true);
}

static const char *const apertures[] = {"line",
                                        "rotated",
                                        "box",
                                        "ccd",
                                        "notch",
                                        "shaped",
                                        "diamond",
                                        "mitchell:0.3333333,0.3333333",
                                        "mitchell:1.5,-0.25",
                                        "crisp",
                                        "design:support=2.5,sharp=0.6,width=1"};

static const scenario plain = {
    .aperture = "shaped",
    .raster = "24x16@30i,tff",
    .rate = "240",
    .width = {1, 1},
    .skew = {0, 1},
    .cells_x = 48,
    .cells_y = 32,
    .subframes = 24,
    .data = {0, 0, 48, 32},
    .channels = 3,
    .band_rows = 16,
};

static void every_aperture_position_and_width(void **state) {
    (void)state;
    const wf_rational widths[] = {{0, 1}, {1, 4}, {1, 1}, {5, 2}};
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a += (size_t)test_step(3))
        for (size_t w = 0; w < 4; w++)
            for (int position = 0; position < 3; position++) {
                scenario s = plain;
                s.aperture = apertures[a];
                s.width = widths[w];
                s.position = (wf_position)position;
                s.raster = position == 1 ? "24x16@30i,bff" : s.raster;
                check(&s);
            }
}

static void awkward_ratios(void **state) {
    (void)state;
    const struct {
        const char *raster, *rate;
        int cells_x, cells_y, subframes;
    } ratios[] = {
        {"97x62@30i,bff", "240", 360, 244, 16},
        {"97x62@30i,bff", "97", 97, 62, 10},
        {"64x36@25p", "1000/7", 48, 27, 30},
        {"96x54@25psf", "250", 128, 72, 30},
        {"40x30@30000/1001i,bff", "480000/1001", 23, 17, 20},
        {"33x20@60p", "24", 100, 61, 6},
        {"24x486@30i,tff", "60", 31, 1080, 4},
        {"160x20@30i,tff", "120", 320, 40, 8},
        {"160x20@30i,tff", "120", 240, 30, 8},
    };
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a += (size_t)test_step(3))
        for (size_t n = 0; n < sizeof ratios / sizeof *ratios; n++) {
            scenario s = plain;
            s.aperture = apertures[a];
            s.raster = ratios[n].raster;
            s.rate = ratios[n].rate;
            s.cells_x = ratios[n].cells_x;
            s.cells_y = ratios[n].cells_y;
            s.subframes = ratios[n].subframes;
            s.data = (wf_cells){0, 0, s.cells_x, s.cells_y};
            s.width = (wf_rational){3, 4};
            s.band_rows = 7;
            check(&s);
        }
}

static void time_cells_centered_skewed_and_sparse(void **state) {
    (void)state;
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a += (size_t)test_step(3))
        for (int variant = 0; variant < 4; variant++) {
            scenario s = plain;
            s.aperture = apertures[a];
            s.center = variant & 1;
            s.skew = variant & 2 ? (wf_rational){3, 4} : (wf_rational){0, 1};
            s.rate = variant == 3 ? "30" : "97";
            s.subframes = 12;
            s.position = (wf_position)(variant % 3);
            check(&s);
            s.width = (wf_rational){0, 1};
            check(&s);
        }
}

static void data_windows(void **state) {
    (void)state;
    const wf_cells windows[] = {{5, 3, 40, 20}, {-6, -5, 53, 37}, {-3, 4, 20, 40},
                                {50, 1, 55, 9}, {-9, -9, -2, -1}, {10, 12, 11, 13}};
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a += (size_t)test_step(3))
        for (size_t w = 0; w < sizeof windows / sizeof *windows; w++)
            for (int channels = 3; channels <= 4; channels++) {
                scenario s = plain;
                s.aperture = apertures[a];
                s.data = windows[w];
                s.subframes = 10;
                s.channels = channels;
                s.background = channels == 4 ? 0.5f : 0;
                s.band_origin = w == 1 ? -5 : 3;
                check(&s);
            }
}

static void fits(void **state) {
    (void)state;
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a += (size_t)test_step(3))
        for (int fit = 1; fit <= 2; fit++)
            for (int shape = 0; shape < 4; shape++) {
                scenario s = plain;
                s.aperture = apertures[a];
                s.fit = fit;
                s.cells_x = shape == 0 ? 48 : shape == 1 ? 37 : 60;
                s.cells_y = shape == 3 ? 36 : 32;
                s.data = (wf_cells){0, 0, s.cells_x, s.cells_y};
                s.subframes = 9;
                s.background = 0.25f;
                s.channels = shape == 2 ? 4 : 3;
                s.skew = shape == 3 ? (wf_rational){1, 2} : (wf_rational){0, 1};
                check(&s);
            }
    print_message("worst error: %.3f of the bound\n", worst_ratio);
}

/* ---- Properties ---- */

static void constants_stay_constant(void **state) {
    (void)state;
    const char *rasters[] = {"97x62@30i,bff", "24x16@30i,tff", "64x37@25p"};
    const float values[] = {1, 0.18f, 65504, 5.9604645e-8f, 1.0f / 3, 0.7310586f};
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a += (size_t)test_step(3))
        for (size_t r = 0; r < 3; r++)
            for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
                scenario s = plain;
                s.aperture = apertures[a];
                s.raster = rasters[r];
                s.rate = "1000/3";
                s.width = (wf_rational){7, 5};
                wf_raster raster;
                char why[512];
                wf_resample_desc desc = describe(&s, &raster);
                movie m = make_movie(s.cells_x, s.cells_y, s.subframes, s.data, 3, 1);
                for (size_t i = 0; i < (size_t)(24 * 3 * 48 * 32); i++) m.pixel[i] = values[v];
                wf_resampler *rs;
                must(wf_resampler_new(&desc, &rs, why, sizeof why), why);
                wf_scratch *scratch = wf_scratch_new(rs, 1);
                float line[3][97], *rgb[3] = {line[0], line[1], line[2]};
                wf_field *field = resample(rs, &m, 1, 64, scratch);
                for (int l = 0; l < 8; l++) {
                    wf_field_line(field, l, scratch, rgb);
                    for (int i = 0; i < raster.width_px; i++)
                        if (fabs((double)line[1][i] / (double)values[v] - 1) > 4 * 0x1p-23)
                            fail_msg("%s: %.9g became %.9g", s.aperture, (double)values[v],
                                     (double)line[1][i]);
                }
                wf_field_free(field);
                wf_scratch_free(scratch);
                wf_resampler_free(rs);
                free(m.pixel);
            }
}

static void batches_do_not_change_bits(void **state) {
    (void)state;
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a += (size_t)test_step(3)) {
        scenario s = plain;
        s.aperture = apertures[a];
        s.width = (wf_rational){2, 1};
        wf_raster raster;
        char why[512];
        wf_resample_desc desc = describe(&s, &raster);
        movie m = make_movie(s.cells_x, s.cells_y, s.subframes, s.data, 3, 5);
        wf_resampler *rs;
        must(wf_resampler_new(&desc, &rs, why, sizeof why), why);
        wf_scratch *scratch = wf_scratch_new(rs, 1);
        float once[3][24], again[3][24], *x[3] = {once[0], once[1], once[2]},
                                         *y[3] = {again[0], again[1], again[2]};
        wf_field *whole = resample(rs, &m, 2, 64, scratch),
                 *parts = resample(rs, &m, 2, 1, scratch);
        for (int l = 0; l < 8; l++) {
            wf_field_line(whole, l, scratch, x);
            wf_field_line(parts, l, scratch, y);
            assert_memory_equal(once, again, sizeof once);
        }
        wf_field_free(whole);
        wf_field_free(parts);
        wf_scratch_free(scratch);
        wf_resampler_free(rs);
        free(m.pixel);
    }
}

/* Every line of a field is finished with the last of its bands, which come from the bottom up.
 */
static void take_at_once(const wf_resampler *rs, const movie *m, wf_field *field,
                         wf_scratch *scratch, float taken[][3][24]) {
    wf_window window = wf_resampler_window(rs, wf_field_index(field));
    assert_true(wf_field_begin_batch(field, true, false));
    for (int band = wf_resampler_bands(rs); band-- > 0;) {
        wf_band_open(field, band, scratch, 0);
        for (int64_t k = window.first; k < window.first + window.count; k++)
            add_subframe(field, m, band, wf_resampler_band_rows(rs, band), k, scratch);
        wf_band_close(field, band, scratch, 0, true);
        wf_span lines = wf_band_lines(field, band);
        for (int l = lines.first; l < lines.end; l++)
            if (wf_field_line_ready(field, l))
                wf_field_line(field, l, scratch,
                              (float *[3]){taken[l][0], taken[l][1], taken[l][2]});
    }
    wf_field_end_batch(field);
    assert_true(wf_field_lines_taken(field));
}

static void take_lines(const scenario *s, bool quick) {
    wf_raster raster;
    char why[512];
    wf_resample_desc desc = describe(s, &raster);
    desc.band_rows = 11; /* of which there are whole lines' */
    desc.floats = quick;
    movie m = make_movie(s->cells_x, s->cells_y, s->subframes, s->data, 3, 5);
    wf_resampler *rs;
    must(wf_resampler_new(&desc, &rs, why, sizeof why), why);
    wf_scratch *scratch = wf_scratch_new(rs, 1), *other = wf_scratch_new(rs, 1);
    wf_field *taken = wf_field_new(rs, 0);
    for (int64_t n = 0; n < 4; n++) { /* in the memory of the one before */
        float lines[8][3][24], later[3][24], *rgb[3] = {later[0], later[1], later[2]};
        wf_field *whole = resample(rs, &m, n, 64, other);
        assert_true(n == 0 || wf_field_renew(taken, n));
        if (n < 2)
            take_at_once(rs, &m, taken, scratch, lines);
        else /* what the scratch has of an earlier field is not this one's */
            add_window(rs, &m, taken, 64, other);
        for (int l = 0; l < 8; l++) {
            float *late[3] = {lines[l][0], lines[l][1], lines[l][2]};
            if (n >= 2) wf_field_line(taken, l, scratch, late);
            wf_field_line(whole, l, other, rgb);
            assert_memory_equal(lines[l], later, sizeof later);
        }
        wf_field_free(whole);
    }
    wf_field_free(taken);
    wf_scratch_free(scratch);
    wf_scratch_free(other);
    wf_resampler_free(rs);
    free(m.pixel);
}

static void lines_taken_at_once_have_the_same_bits(void **state) {
    (void)state;
    for (size_t a = 0; a < sizeof apertures / sizeof *apertures; a += (size_t)test_step(3)) {
        scenario s = plain;
        s.aperture = apertures[a];
        take_lines(&s, false);
        take_lines(&s, true);
        s.cells_x = 24;
        s.cells_y = 16;
        s.data = (wf_cells){0, 0, 24, 16};
        s.width = (wf_rational){1, 8};
        take_lines(&s, true);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_aperture_position_and_width),
        cmocka_unit_test(awkward_ratios),
        cmocka_unit_test(time_cells_centered_skewed_and_sparse),
        cmocka_unit_test(data_windows),
        cmocka_unit_test(fits),
        cmocka_unit_test(constants_stay_constant),
        cmocka_unit_test(batches_do_not_change_bits),
        cmocka_unit_test(lines_taken_at_once_have_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
