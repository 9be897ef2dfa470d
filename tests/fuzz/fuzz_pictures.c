/* Pictures that are no EXR, through what weft looks at itself and OpenImageIO: opened, and all
 * rows of them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "convert/read/reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static weft_status read_all(const char *path, const wf_source_options *options,
                            weft_error *err) {
    wf_subframe *s = NULL;
    wf_reader *reader = NULL;
    weft_status status = wf_reader_new(options, &reader, err);
    if (!status) status = wf_subframe_open(path, -1, options, &s, err);
    const wf_image_info *info = status ? NULL : wf_subframe_info(s);
    for (int y = status ? 0 : info->data.y0; !status && y < info->data.y1;
         y += info->band_lines) {
        wf_rows rows;
        int end = info->data.y1 - y < info->band_lines ? info->data.y1 : y + info->band_lines;
        status = wf_reader_rows(reader, s, y, end, &rows, err);
    }
    wf_subframe_close(s);
    wf_reader_free(reader);
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[64];
    weft_error err = {""};
    const wf_source_options options = {.want_alpha = true,
                                       .to_light = size % 2,
                                       .nan_fix = WF_NAN_BOX3,
                                       .max_memory_bytes = (size_t)16 << 20};
    bool is_exr = size > 4 && !memcmp(data, "\x76\x2f\x31\x01", 4);
    if (is_exr) return 0;
    int descriptor = memfd_create("picture", 0);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    if (read_all(path, &options, &err) && !*err.text) abort(); /* every failure says why */
    close(descriptor);
    return 0;
}
