#ifndef WF_CONVERT_READ_EXR_UNZIP_H
#define WF_CONVERT_READ_EXR_UNZIP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "filters/base/isa.h"

/* What follows inflation in OpenEXR's ZIP and ZIPS chunks: bytes were split into even and odd
 * ones and replaced by differences. One table for each instruction set; all give the same
 * bytes. */
typedef struct wf_unzip_ops {
    /* Undoes differences and split of count inflated bytes. True if some 16-bit word of the
     * result has all exponent bits of a half set: an Inf or a NaN, where the chunk holds
     * halves. */
    bool (*merge)(uint8_t *restrict out, const uint8_t *restrict inflated, size_t count);
    /* Whether any of count halves is not finite. */
    bool (*odd_halves)(const uint16_t *half, size_t count);
    bool (*odd_floats)(const float *value, size_t count);
} wf_unzip_ops;

WF_ISA_DECLARE(wf_unzip_ops);

#endif
