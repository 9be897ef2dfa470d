/* Irregular samples into a field: nanoseconds a sample by aperture, 64 samples a pixel and line
 * as a renderer draws them. */
#include <stdio.h>
#include <stdlib.h>

#include "convert/base/clock.h"
#include "filters/gather/samples.h"

#define PER_PIXEL 64

typedef struct block {
    float *x, *y, *t, *rgb[3];
    size_t count;
} block;

static float drawn(unsigned *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) * 0x1p-24f;
}

/* The samples of eight lines. */
static void draw(block *b, const wf_raster *raster, int line) {
    unsigned seed = (unsigned)line;
    b->count = 0;
    for (int j = line; j < line + 8 && j < raster->lines; j++)
        for (int i = 0; i < raster->width_px; i++)
            for (int k = 0; k < PER_PIXEL; k++, b->count++) {
                b->x[b->count] = (float)i + drawn(&seed);
                b->y[b->count] = (float)j + drawn(&seed);
                b->t[b->count] = 0.5f * drawn(&seed);
                for (int c = 0; c < 3; c++) b->rgb[c][b->count] = drawn(&seed);
            }
}

static double run(const wf_gather_desc *d, block *b) {
    const wf_raster *r = d->raster;
    wf_gather *g = wf_gather_new(d, 0, 0, wf_raster_field_lines(r, 0));
    double spent = 0, samples = 0;
    if (!g) return 0;
    for (int line = 0; line < r->lines; line += 8) {
        draw(b, r, line);
        const wf_samples s = {.count = b->count,
                              .x = b->x,
                              .y = b->y,
                              .t = b->t,
                              .rgb = {b->rgb[0], b->rgb[1], b->rgb[2]}};
        double start = wf_now_s();
        wf_gather_add(g, &s);
        spent += wf_now_s() - start;
        samples += (double)b->count;
    }
    wf_gather_free(g);
    return 1e9 * spent / samples;
}

int main(void) {
    char why[512];
    wf_raster raster;
    if (!wf_raster_parse("525i", &raster, why, sizeof why)) return 1;
    size_t room = (size_t)raster.width_px * 8 * PER_PIXEL;
    block b = {0};
    float **const arrays[] = {&b.x, &b.y, &b.t, &b.rgb[0], &b.rgb[1], &b.rgb[2]};
    for (int n = 0; n < 6; n++)
        if (!(*arrays[n] = malloc(room * sizeof(float)))) return 1;
    for (size_t n = 0; wf_aperture_at(n); n++) {
        char name[64];
        const wf_aperture_kind *kind = wf_aperture_at(n);
        snprintf(name, sizeof name, "%s%s%s", kind->name, kind->follows ? ":" : "",
                 kind->follows ? kind->example : "");
        wf_gather_desc d = {.raster = &raster, .width = {1, 2}};
        if (!wf_aperture_parse(name, &d.aperture, why, sizeof why)) return 1;
        printf("%-20s %5.1f ns a sample\n", name, run(&d, &b));
    }
    for (int n = 0; n < 6; n++) free(*arrays[n]);
    return 0;
}
