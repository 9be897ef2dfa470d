/* The EXR source under damaged files. The first byte chooses a good file, or none; what follows
 * are patches of three bytes (where, where, what), or the file itself: corpus/exr has weft's own,
 * DWA, and levels of tiles, which are not made here. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/unit/support/exr_write.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define KINDS 32
#define RAW   255

typedef struct good_file {
    uint8_t *bytes;
    size_t size;
} good_file;

static float ramp(const void *user, int channel, int x, int y) {
    (void)user;
    return (float)(x + y * (channel + 1)) / 16.0f;
}

static good_file make(int kind) {
    static const exr_compression_t how[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,
                                            EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
                                            EXR_COMPRESSION_PIZ,  EXR_COMPRESSION_PXR24,
                                            EXR_COMPRESSION_B44,  EXR_COMPRESSION_B44A};
    exr_part part = {.display = {0, 0, 21, 18},
                     .data = {-2, 1, 23, 37},
                     .channels = "A B G R",
                     .type = kind < 16 ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                     .compression = how[kind % 8],
                     .rate = "240/1",
                     .value = ramp};
    if (kind / 8 == 1) part.tile_width = 16, part.tile_height = 8;
    if (kind / 8 == 3) {
        part.channels = kind % 2 ? "BY/2 RY/2 Y" : "A B G R id# mask/2";
        part.data = (wf_box){-2, 2, 24, 38};
    }
    char path[] = "/tmp/weft-fuzz-XXXXXX";
    int descriptor = mkstemp(path);
    good_file good = {NULL, 0};
    if (descriptor >= 0 && exr_write(path, &part, 1)) {
        good.bytes = malloc(1 << 16);
        ssize_t got = good.bytes ? pread(descriptor, good.bytes, 1 << 16, 0) : 0;
        good.size = got > 0 ? (size_t)got : 0;
    }
    if (descriptor >= 0) close(descriptor);
    unlink(path);
    return good;
}

static void patch(uint8_t *file, size_t file_size, const uint8_t *data, size_t size) {
    for (size_t i = 0; i + 3 <= size; i += 3)
        file[((size_t)data[i] << 8 | data[i + 1]) % file_size] = data[i + 2];
}

static void read_all(const char *path, wf_nan_fix how, wf_alpha alpha) {
    wf_source_options options = {.want_alpha = true,
                                 .alpha = alpha,
                                 .nan_fix = how,
                                 .max_memory_bytes = (size_t)64 << 20};
    wf_subframe *s = NULL;
    wf_reader *reader = NULL;
    weft_error err = {""};
    weft_status status = wf_reader_new(&options, &reader, &err);
    if (!status) status = wf_subframe_open(path, -1, &options, &s, &err);
    const wf_image_info *info = status ? NULL : wf_subframe_info(s);
    for (int y = status ? 0 : info->data.y0; !status && y < info->data.y1 && y < 4096;
         y += info->band_lines) {
        wf_rows rows;
        int end = info->data.y1 - y < info->band_lines ? info->data.y1 : y + info->band_lines;
        status = wf_reader_rows(reader, s, y, end, &rows, &err);
    }
    if (status && !*err.text) abort(); /* every failure says why */
    wf_subframe_close(s);
    wf_reader_free(reader);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static good_file good[KINDS];
    static uint8_t file[1 << 16];
    if (size < 1) return 0;
    int kind = data[0] % KINDS;
    size_t file_size = size - 1 < sizeof file ? size - 1 : sizeof file;
    memcpy(file, data + 1, file_size);
    if (data[0] != RAW) {
        if (!good[kind].bytes) good[kind] = make(kind);
        file_size = good[kind].size;
        memcpy(file, good[kind].bytes, file_size);
        patch(file, file_size, data + 1, size - 1);
    }
    char path[64];
    int descriptor = memfd_create("subframe.exr", 0);
    if (descriptor < 0 || write(descriptor, file, file_size) != (ssize_t)file_size) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    read_all(path, size % 2 ? WF_NAN_BOX3 : WF_NAN_BLACK,
             size % 3 ? WF_ALPHA_UNSET : WF_ALPHA_STRAIGHT);
    close(descriptor);
    return 0;
}
