/* The readers of QuickTime's atoms and MXF's sets: both read every input. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/media/metadata_mov.h"
#include "convert/media/metadata_mxf.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static void (*const readers[])(FILE *, wf_metadata *) = {wf_metadata_mov, wf_metadata_mxf};
    if (!size) return 0;
    uint8_t *copy = malloc(size);
    if (!copy) abort();
    memcpy(copy, data, size);
    for (size_t i = 0; i < 2; i++) {
        wf_metadata metadata = {.frame_layout = -1};
        FILE *file = fmemopen(copy, size, "rb");
        if (!file) abort();
        readers[i](file, &metadata);
        fclose(file);
        if (!memchr(metadata.pattern, 0, sizeof metadata.pattern)) abort();
    }
    free(copy);
    return 0;
}
