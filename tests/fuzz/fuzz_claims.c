/* The readers of QuickTime's atoms and MXF's sets: both read every input. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/claims.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static void (*const readers[])(FILE *, wf_claims *) = {wf_claims_mov, wf_claims_mxf};
    if (!size) return 0;
    uint8_t *copy = malloc(size);
    if (!copy) abort();
    memcpy(copy, data, size);
    for (size_t i = 0; i < 2; i++) {
        wf_claims claims = {.frame_layout = -1};
        FILE *file = fmemopen(copy, size, "rb");
        if (!file) abort();
        readers[i](file, &claims);
        fclose(file);
        if (!memchr(claims.pattern, 0, sizeof claims.pattern)) abort();
    }
    free(copy);
    return 0;
}
