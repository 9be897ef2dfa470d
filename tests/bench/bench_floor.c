/* The least that a reader of ZIP-compressed EXR does, as a floor to hold conversions against:
 * OpenEXRCore reads the chunks, libdeflate inflates them, a scalar loop undoes the predictor.
 * No pixel is looked at. bench-floor THREADS FILE.. prints seconds. */
#include <libdeflate.h>
#include <omp.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert/base/clock.h"

typedef struct buffers {
    struct libdeflate_decompressor *inflate;
    unsigned char *packed, *inflated, *out;
    size_t room;
} buffers;

static void unpredict(unsigned char *out, unsigned char *in, size_t count) {
    size_t evens = (count + 1) / 2;
    for (size_t i = 1; i < count; i++) in[i] = (unsigned char)(in[i - 1] + in[i] - 128);
    for (size_t i = 0; i < count; i++) out[i] = in[i % 2 ? evens + i / 2 : i / 2];
}

static int grow(buffers *b, size_t bytes) {
    if (bytes <= b->room) return 1;
    free(b->packed), free(b->inflated), free(b->out);
    b->packed = malloc(bytes), b->inflated = malloc(bytes), b->out = malloc(bytes);
    b->room = bytes;
    return b->packed && b->inflated && b->out;
}

static int read_chunk(exr_context_t exr, int y, buffers *b) {
    exr_chunk_info_t chunk;
    if (exr_read_scanline_chunk_info(exr, 0, y, &chunk) || !grow(b, chunk.unpacked_size) ||
        exr_read_chunk(exr, 0, &chunk, b->packed))
        return 0;
    if (chunk.packed_size == chunk.unpacked_size) return 1;
    if (libdeflate_zlib_decompress(b->inflate, b->packed, chunk.packed_size, b->inflated,
                                   chunk.unpacked_size, NULL))
        return 0;
    unpredict(b->out, b->inflated, chunk.unpacked_size);
    return 1;
}

static int read_file(const char *path, buffers *b) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t exr;
    exr_attr_box2i_t data;
    int lines = 0, fine = 1;
    if (exr_start_read(&exr, path, &how)) return 0;
    exr_get_data_window(exr, 0, &data);
    exr_get_scanlines_per_chunk(exr, 0, &lines);
    for (int y = data.min.y; fine && y <= data.max.y; y += lines) fine = read_chunk(exr, y, b);
    exr_finish(&exr);
    return fine;
}

int main(int argc, char **argv) {
    int threads = argc > 2 ? atoi(argv[1]) : 0, failed = 0;
    if (threads < 1) {
        fprintf(stderr, "usage: bench-floor THREADS FILE..\n");
        return 2;
    }
    double start = wf_now_s();
#pragma omp parallel num_threads(threads) reduction(+ : failed)
    {
        buffers b = {.inflate = libdeflate_alloc_decompressor()};
#pragma omp for schedule(dynamic, 1)
        for (int i = 2; i < argc; i++) failed += !b.inflate || !read_file(argv[i], &b);
        free(b.packed), free(b.inflated), free(b.out);
        if (b.inflate) libdeflate_free_decompressor(b.inflate);
    }
    printf("%.4f\n", wf_now_s() - start);
    if (failed) fprintf(stderr, "bench-floor: %d files failed\n", failed);
    return failed != 0;
}
