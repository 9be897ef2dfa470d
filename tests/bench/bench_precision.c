/* The converter's arithmetic, error and time: bench-precision LINES APERTURE. A field of that
 * many frame lines, 16:9, from eight subframes of halves of twice the size, one thread. The
 * halves are noise over eleven decades with spikes of 65504. Prints milliseconds a field,
 * nanoseconds an input sample, and the largest error at some hundred pixels against a float64
 * reference, as a share of sum |W c| / sum W. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert/base/clock.h"
#include "filters/base/half.h"
#include "filters/resample/resampler.h"
#include "tests/unit/support/reference.h"

#define SUBFRAMES 8
#define PIXELS    120
#define RUNS      3

/* Lines overlap in memory: line b begins so many samples behind line b - 1. */
#define LINE_STRIDE  17
#define FRAME_STRIDE 5003
#define PLANE_STRIDE 211

typedef struct field_bench {
    int cells_x, cells_y;
    uint16_t *noise;
    wf_raster raster;
    wf_resample_desc desc;
    wf_resampler *rs;
    wf_scratch *scratch;
    wf_field *field;
} field_bench;

static double drawn(unsigned *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) * 0x1p-24;
}

static const uint16_t *at(const field_bench *b, int64_t k, int c, int y) {
    return b->noise + FRAME_STRIDE * k + PLANE_STRIDE * c + (ptrdiff_t)LINE_STRIDE * y;
}

static float sample(const void *user, int k, int x, int y, int channel) {
    return wf_half_value(at(user, k, channel, y)[x]);
}

static void die(const char *why) {
    fprintf(stderr, "bench-precision: %s\n", why);
    exit(1);
}

static void open_bench(field_bench *b, int lines, const char *aperture) {
    char text[64], why[512];
    int width = (lines * 16 / 9 + 1) / 2 * 2;
    snprintf(text, sizeof text, "%dx%d@30i,tff,par=1:1", width, lines);
    b->cells_x = 2 * width, b->cells_y = 2 * lines;
    b->desc = (wf_resample_desc){.raster = &b->raster, .channels = 3, .band_rows = 16};
    if (!wf_raster_parse(text, &b->raster, why, sizeof why) ||
        !wf_aperture_parse(aperture, &b->desc.aperture, why, sizeof why))
        die(why);
    b->desc.timing = (wf_timing_desc){.raster = &b->raster,
                                      .subframe_rate = {60 * SUBFRAMES, 1},
                                      .subframes = SUBFRAMES,
                                      .width = {1, 1},
                                      .skew = {0, 1}};
    b->desc.x = (wf_fitting){width, b->cells_x, {1, 2}, false};
    b->desc.y = (wf_fitting){lines, b->cells_y, {1, 2}, false};
    if (!wf_resampler_new(&b->desc, &b->rs, why, sizeof why)) die(why);
    size_t count = (size_t)(b->cells_x + LINE_STRIDE * b->cells_y + FRAME_STRIDE * SUBFRAMES +
                            PLANE_STRIDE * 4);
    b->noise = malloc(count * sizeof *b->noise);
    b->scratch = wf_scratch_new(b->rs, 1);
    if (!b->noise || !b->scratch) die("no memory");
    unsigned seed = 1;
    for (size_t i = 0; i < count; i++)
        b->noise[i] = drawn(&seed) < 0.02  ? 0x7bff
                      : drawn(&seed) < 0.2 ? 0
                                           : (uint16_t)(0x7800 * drawn(&seed));
}

static void make_field(field_bench *b) {
    wf_field_begin_batch(b->field, true, false);
    for (int band = 0; band < wf_resampler_bands(b->rs); band++) {
        wf_span rows = wf_resampler_band_rows(b->rs, band);
        wf_cells here = {0, rows.first < 0 ? 0 : rows.first, b->cells_x,
                         rows.end > b->cells_y ? b->cells_y : rows.end};
        wf_band_open(b->field, band, b->scratch, 0);
        for (int64_t k = 0; k < SUBFRAMES; k++) {
            wf_band_input in = {.k = &k,
                                .k_count = 1,
                                .data = {0, 0, b->cells_x, b->cells_y},
                                .here = here,
                                .line_stride = LINE_STRIDE,
                                .channels = 3,
                                .half = true};
            for (int c = 0; c < 3; c++) in.plane[c] = at(b, k, c, here.y0);
            if (here.y0 < here.y1) wf_band_add(b->field, band, b->scratch, 0, &in);
        }
        wf_band_close(b->field, band, b->scratch, 0, false);
    }
    wf_field_end_batch(b->field);
}

static void finish_lines(field_bench *b, float *out) {
    size_t width = (size_t)b->raster.width_px;
    for (int l = 0; l < b->raster.lines / 2; l++) {
        float *line = out + 3 * width * (size_t)l;
        wf_field_line(b->field, l, b->scratch,
                      (float *[]){line, line + width, line + 2 * width});
    }
}

static double worst_error(const field_bench *b, const float *out) {
    const reference r = {.width = b->raster.width_px,
                         .lines = b->raster.lines,
                         .interlaced = 1,
                         .top_first = 1,
                         .field_period_s = 1.0 / 60,
                         .aperture = b->desc.aperture.kind->name,
                         .b = b->desc.aperture.parameter[0],
                         .c = b->desc.aperture.parameter[1],
                         .steps = b->desc.aperture.stairs.height,
                         .step_count = b->desc.aperture.stairs.count,
                         .half_u = b->desc.aperture.half_u,
                         .tau = 1,
                         .rate = 60 * SUBFRAMES,
                         .subframes = SUBFRAMES,
                         .cells_x = b->cells_x,
                         .cells_y = b->cells_y,
                         .cell_w = 0.5,
                         .cell_h = 0.5,
                         .data = {0, 0, b->cells_x, b->cells_y},
                         .sample = sample,
                         .user = b};
    double worst = 0;
    unsigned seed = 7;
    for (int n = 0; n < PIXELS; n++) {
        int l = (int)(drawn(&seed) * (b->raster.lines / 2)), c = n % 3;
        int i = (int)(drawn(&seed) * b->raster.width_px);
        reference_value truth = reference_pixel(&r, i, 2 * l, 0, c);
        double is = (double)out[((size_t)l * 3 + (size_t)c) * (size_t)r.width + (size_t)i];
        double error = fabs(is - truth.value) / truth.scale;
        if (!(error <= worst)) worst = error; /* NaN is the worst of all */
    }
    return worst;
}

int main(int argc, char **argv) {
    field_bench b = {0};
    if (argc != 3) {
        fprintf(stderr, "usage: bench-precision LINES APERTURE\n");
        return 2;
    }
    open_bench(&b, atoi(argv[1]), argv[2]);
    float *out = malloc(sizeof(float) * 3 * (size_t)b.raster.width_px * (size_t)b.raster.lines);
    if (!out) die("no memory");
    double least = 1e9;
    for (int run = 0; run < RUNS; run++) {
        b.field = wf_field_new(b.rs, 0);
        if (!b.field) die("no memory");
        double start = wf_now_s();
        make_field(&b);
        finish_lines(&b, out);
        least = fmin(least, wf_now_s() - start);
        wf_field_free(b.field);
    }
    double samples = 3.0 * SUBFRAMES * b.cells_x * b.cells_y;
    printf("%.4f %.5f %.4g\n", 1e3 * least, 1e9 * least / samples, worst_error(&b, out));
    free(out);
    free(b.noise);
    wf_scratch_free(b.scratch);
    wf_resampler_free(b.rs);
    return 0;
}
