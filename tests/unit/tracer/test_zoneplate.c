/* The zone plate through every aperture against its closed form. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/unit/support/scene_fields.h"
#include "tests/unit/support/zoneplate.h"

/* 525i; a smaller picture of the same under sanitizers, which take ten times as long. */
static zoneplate plate = {720, 486, 10.0 / 11.0};
static const char *raster = "525i";

/* ---- Comparison ---- */

/* The picture's outermost pixels see less than their aperture and are left out: the closed
 * forms are of whole ones. Of the shaped aperture's costly truth every third pixel of every
 * second line. */
static double error_of(const float *field, const char *aperture, int step) {
    int skip = step == 1 ? 1 : 2;
    double sum = 0;
    long count = 0;
    /* 525i is bottom first: field 0 has the odd lines. */
    for (int l = 1; l < plate.lines / 2 - 1; l += skip)
        for (int i = 2 + l % step; i < plate.width - 2; i += step) {
            double truth = zoneplate_truth(&plate, aperture, i + 0.5, 2 * l + 1.5);
            double e = (double)field[3 * (l * plate.width + i)] - truth;
            sum += e * e;
            count++;
        }
    return sqrt(sum / (double)count);
}

static void against_closed_forms(void **state) {
    static const struct {
        const char *aperture;
        int step;
    } rows[] = {{"line", 1}, {"box", 1}, {"notch", 1}, {"shaped", 3}};
    (void)state;
    for (size_t n = 0; n < sizeof rows / sizeof *rows; n++)
        for (int count = 64; count <= 256; count *= 4) {
            scene_job job = {.path = "zoneplate.lua",
                             .raster = raster,
                             .aperture = rows[n].aperture,
                             .width = {0, 1},
                             .sampler = WF_SAMPLER_SOBOL,
                             .count = count};
            float *field = scene_field(&job, 0);
            double error = error_of(field, rows[n].aperture, rows[n].step);
            print_message("%-7s %3d samples: RMSE %.2e\n", rows[n].aperture, count, error);
            assert_true(error <= (count == 64 ? 6e-3 : 2e-3));
            free(field);
        }
}

int main(void) {
    const char *sanitizer = getenv("WEFT_SANITIZE");
    if (sanitizer && *sanitizer) {
        raster = "180x122@30i,bff,par=10:11";
        plate.width = 180;
        plate.lines = 122;
        printf("under sanitizers: %s instead of 525i\n", raster);
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(against_closed_forms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
