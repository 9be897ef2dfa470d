/* Flicker and sharpness of stills in OpenEXR, in luminance: FILE's flicker, RMS and 99.9th
 * percentile, and its distance from SHARP, RMS. bench_nearest.sh draws the comparison from it.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert/read/source.h"

typedef struct plane {
    int width, lines;
    double *y;
} plane;

static bool read_luminance(const char *path, plane *p) {
    const wf_source_options options = {.nan_fix = WF_NAN_NONE,
                                       .max_memory_bytes = (size_t)1 << 30};
    wf_subframe *file;
    wf_reader *reader = NULL;
    wf_rows rows;
    weft_error err = {""};
    if (wf_subframe_open(path, -1, &options, &file, &err)) return false;
    const wf_image_info *info = wf_subframe_info(file);
    *p = (plane){info->data.x1, info->data.y1, NULL};
    p->y = malloc((size_t)p->width * (size_t)p->lines * sizeof *p->y);
    bool good = p->y && !wf_reader_new(&options, &reader, &err) &&
                !wf_reader_rows(reader, file, 0, p->lines, &rows, &err);
    for (int i = 0; good && i < p->width * p->lines; i++) {
        size_t at = (size_t)(i / p->width) * rows.line_stride + (size_t)(i % p->width);
        const float *const *rgb = (const float *const *)rows.plane;
        p->y[i] = 0.2126 * (double)rgb[0][at] + 0.7152 * (double)rgb[1][at] +
                  0.0722 * (double)rgb[2][at];
    }
    wf_reader_free(reader);
    wf_subframe_close(file);
    return good;
}

static double flicker_at(const plane *p, int i) {
    int j = i / p->width, above = j ? i - p->width : i + p->width;
    int below = j < p->lines - 1 ? i + p->width : i - p->width;
    return fabs(p->y[i] - (p->y[above] + p->y[below]) / 2) / 2;
}

static int ascending(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static void tell(const plane *p, const plane *sharp) {
    size_t count = (size_t)p->width * (size_t)p->lines;
    double *b = malloc(count * sizeof *b), square = 0, off = 0;
    if (!b) return;
    for (size_t i = 0; i < count; i++) {
        b[i] = flicker_at(p, (int)i);
        square += b[i] * b[i];
        off += (p->y[i] - sharp->y[i]) * (p->y[i] - sharp->y[i]);
    }
    qsort(b, count, sizeof *b, ascending);
    printf("%.6f %.6f %.6f\n", sqrt(square / (double)count), b[(size_t)(0.999 * (double)count)],
           sqrt(off / (double)count));
    free(b);
}

int main(int argc, char **argv) {
    plane file = {0}, sharp = {0};
    bool good = argc == 3 && read_luminance(argv[1], &file) && read_luminance(argv[2], &sharp);
    good = good && file.width == sharp.width && file.lines == sharp.lines;
    if (good) tell(&file, &sharp);
    if (!good) fprintf(stderr, "usage: bench-nearest FILE.exr SHARP.exr, of one size\n");
    free(file.y);
    free(sharp.y);
    return !good;
}
