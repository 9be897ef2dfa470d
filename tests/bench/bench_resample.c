/* Time of the resampler alone, by stage: adding subframes of half samples, and finishing lines.
 * One thread; pictures of 1440x972 to 525i, eight a field. */
#include <stdio.h>
#include <stdlib.h>

#include "convert/base/clock.h"
#include "filters/resample/resampler.h"

enum { CELLS_X = 1440, CELLS_Y = 972, SUBFRAMES = 32, FIELDS = 4 };

static void add_field(const wf_resampler *rs, wf_field *field, wf_scratch *scratch,
                      const uint16_t *pixel) {
    wf_cells data = {0, 0, CELLS_X, CELLS_Y};
    wf_window window = wf_resampler_window(rs, 1);
    wf_field_begin_batch(field, true, false);
    for (int band = 0; band < wf_resampler_bands(rs); band++) {
        wf_span rows = wf_resampler_band_rows(rs, band);
        wf_cells here = {0, rows.first < 0 ? 0 : rows.first, CELLS_X,
                         rows.end > CELLS_Y ? CELLS_Y : rows.end};
        wf_band_open(field, band, scratch, 0);
        for (int64_t k = window.first; k < window.first + window.count; k++) {
            wf_band_input in = {.k = &k,
                                .k_count = 1,
                                .data = data,
                                .here = here,
                                .line_stride = CELLS_X,
                                .channels = 3,
                                .half = true};
            for (int c = 0; c < 3; c++) in.plane[c] = pixel + (c * 16 * CELLS_X);
            if (here.y0 < here.y1) wf_band_add(field, band, scratch, 0, &in);
        }
        wf_band_close(field, band, scratch, 0, false);
    }
    wf_field_end_batch(field);
}

static void measure(const char *name) {
    wf_raster raster;
    char why[512];
    wf_resample_desc d = {.raster = &raster, .channels = 3, .band_rows = 16};
    if (!wf_raster_parse("525i", &raster, why, sizeof why) ||
        !wf_aperture_parse(name, &d.aperture, why, sizeof why))
        exit(1);
    d.timing = (wf_timing_desc){.raster = &raster,
                                .subframe_rate = {480000, 1001},
                                .subframes = SUBFRAMES,
                                .width = {1, 1},
                                .skew = {0, 1}};
    d.x = (wf_fitting){raster.width_px, CELLS_X, {1, 2}, false};
    d.y = (wf_fitting){raster.lines, CELLS_Y, {1, 2}, false};
    wf_resampler *rs;
    if (!wf_resampler_new(&d, &rs, why, sizeof why)) exit(1);
    wf_scratch *scratch = wf_scratch_new(rs, 1);
    uint16_t *pixel = malloc(16 * 3 * CELLS_X * sizeof *pixel);
    float *line = malloc(3 * CELLS_X * sizeof *line),
          *rgb[3] = {line, line + CELLS_X, line + 2 * CELLS_X};
    if (!scratch || !pixel || !line) exit(1);
    for (int i = 0; i < 16 * 3 * CELLS_X; i++) pixel[i] = (uint16_t)(0x3000 + i % 2048);
    double add_s = 1e9, finish_s = 1e9;
    for (int run = 0; run < 5; run++) {
        wf_field *field = wf_field_new(rs, 1);
        double start = wf_now_s();
        add_field(rs, field, scratch, pixel);
        double added = wf_now_s();
        for (int l = 0; l < raster.lines / 2; l++) wf_field_line(field, l, scratch, rgb);
        double finished = wf_now_s();
        if (added - start < add_s) add_s = added - start;
        if (finished - added < finish_s) finish_s = finished - added;
        wf_field_free(field);
    }
    printf("%-10s add %6.3f ms a subframe, finish %6.3f ms a field\n", name,
           1e3 * add_s / (double)wf_resampler_window(rs, 1).count, 1e3 * finish_s);
    free(pixel);
    free(line);
    wf_scratch_free(scratch);
    wf_resampler_free(rs);
}

int main(void) {
    const char *names[] = {"line", "box", "notch", "shaped", "diamond"};
    for (int n = 0; n < 5; n++) measure(names[n]);
    return 0;
}
