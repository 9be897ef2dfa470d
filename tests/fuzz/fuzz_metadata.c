/* The readers of QuickTime's atoms and MXF's sets, and of the structure of every container: all
 * read every input. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/media/metadata_mov.h"
#include "convert/media/metadata_mxf.h"
#include "convert/media/structure/structure.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void read_structures(uint8_t *data, size_t size) {
    static const char *const containers[] = {"mxf", "mov", "matroska", "avi", "mpegts", "mpeg"};
    for (size_t i = 0; i < sizeof containers / sizeof *containers; i++) {
        wf_structure structure;
        FILE *file = fmemopen(data, size, "rb");
        if (!file) abort();
        wf_structure_of(file, containers[i], &structure);
        fclose(file);
        if (!structure.known || !memchr(structure.missing, 0, sizeof structure.missing))
            abort();
    }
}

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
    read_structures(copy, size);
    free(copy);
    return 0;
}
