#ifndef WF_CONVERT_READ_UNZIP_H
#define WF_CONVERT_READ_UNZIP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What follows inflation in OpenEXR's ZIP and ZIPS chunks: bytes were split into even and odd
 * ones and replaced by differences. One table for each instruction set; all give the same
 * bytes. */
typedef struct wf_unzip_ops {
    const char *name;
    /* Undoes differences and split of count inflated bytes. True if some 16-bit word of the
     * result has all exponent bits of a half set: an Inf or a NaN, where the chunk holds
     * halves. */
    bool (*merge)(uint8_t *restrict out, const uint8_t *restrict inflated, size_t count);
    /* Whether any of count halves is not finite. */
    bool (*odd_halves)(const uint16_t *half, size_t count);
    bool (*odd_floats)(const float *value, size_t count);
} wf_unzip_ops;

/* The tables by index, slowest first; NULL past the last one this processor can run. */
const wf_unzip_ops *wf_unzip_ops_at(size_t index);
const wf_unzip_ops *wf_unzip_ops_best(void);

#endif
