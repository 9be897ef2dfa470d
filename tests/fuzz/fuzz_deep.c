/* Sample buffers (deep EXR) of a raster of 6x4, whatever they hold: opened, and all lines of
 * them. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "convert/read/deep_read.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static weft_status read_all(const char *path, weft_error *err) {
    wf_raster raster;
    wf_deep_file *file = NULL;
    wf_deep_buffers buffers = {0};
    char why[256];
    bool deep;
    if (!wf_raster_parse("6x4@30i", &raster, why, sizeof why)) abort();
    weft_status status = wf_deep_is(path, &deep, err);
    if (!status) status = wf_deep_open(path, &raster, &file, err);
    bool opened = !status;
    for (int y = 0; !status && y < raster.lines; y++) {
        status = wf_deep_read(file, &buffers, y, err);
        if (!status && buffers.line.upto[raster.width_px - 1] < 0) abort();
    }
    if (opened) wf_deep_close(file);
    wf_deep_buffers_free(&buffers);
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[64];
    weft_error err = {""};
    int descriptor = memfd_create("deep.exr", 0);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    if (read_all(path, &err) && !*err.text) abort(); /* every failure says why */
    close(descriptor);
    return 0;
}
