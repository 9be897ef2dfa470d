/* What OpenEXRCore alone takes to decode EXRs of scan lines into planes as the files have them.
 * bench-core THREADS FILE.. ; ends with 1 where the library does not read their compression. */
#include <omp.h>
#include <openexr.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct reading {
    exr_context_t exr;
    exr_decode_pipeline_t pipeline;
    unsigned char *planes; /* of a chunk */
    size_t room;
    bool started;
} reading;

static void hush(exr_const_context_t exr, exr_result_t code, const char *message) {
    (void)exr, (void)code, (void)message;
}

static bool grow(reading *r, size_t bytes) {
    if (bytes <= r->room) return true;
    free(r->planes);
    r->planes = malloc(bytes);
    r->room = r->planes ? bytes : 0;
    return r->planes;
}

/* Where the samples of each channel are to go. */
static void place_channels(reading *r) {
    unsigned char *to = r->planes;
    for (int c = 0; c < r->pipeline.channel_count; c++) {
        exr_coding_channel_info_t *channel = &r->pipeline.channels[c];
        int line = channel->width * channel->bytes_per_element;
        channel->decode_to_ptr = to;
        channel->user_bytes_per_element = channel->bytes_per_element;
        channel->user_data_type = channel->data_type;
        channel->user_pixel_stride = channel->bytes_per_element;
        channel->user_line_stride = line;
        to += (size_t)line * (size_t)channel->height;
    }
}

static bool read_chunk(reading *r, int y) {
    exr_chunk_info_t chunk;
    if (exr_read_scanline_chunk_info(r->exr, 0, y, &chunk) || !grow(r, chunk.unpacked_size) ||
        (r->started ? exr_decoding_update(r->exr, 0, &chunk, &r->pipeline)
                    : exr_decoding_initialize(r->exr, 0, &chunk, &r->pipeline)))
        return false;
    place_channels(r);
    if (!r->started && exr_decoding_choose_default_routines(r->exr, 0, &r->pipeline))
        return false;
    r->started = true;
    return !exr_decoding_run(r->exr, 0, &r->pipeline);
}

static bool read_file(const char *path) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    reading r = {.pipeline = EXR_DECODE_PIPELINE_INITIALIZER};
    exr_attr_box2i_t data;
    int lines = 0;
    how.error_handler_fn = hush;
    if (exr_start_read(&r.exr, path, &how)) return false;
    exr_get_data_window(r.exr, 0, &data);
    bool fine = !exr_get_scanlines_per_chunk(r.exr, 0, &lines) && lines > 0;
    for (int y = data.min.y; fine && y <= data.max.y; y += lines) fine = read_chunk(&r, y);
    if (r.started) exr_decoding_destroy(r.exr, &r.pipeline);
    exr_finish(&r.exr);
    free(r.planes);
    return fine;
}

int main(int argc, char **argv) {
    int threads = argc > 2 ? atoi(argv[1]) : 0, failed = 0;
    if (threads < 1) {
        fprintf(stderr, "usage: bench-core THREADS FILE..\n");
        return 2;
    }
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1) reduction(+ : failed)
    for (int i = 2; i < argc; i++) failed += !read_file(argv[i]);
    return failed != 0;
}
