#ifndef WF_CONVERT_READ_EXR_RLE_H
#define WF_CONVERT_READ_EXR_RLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* OpenEXR's runs of bytes: a count n from 0 to 127 and a byte that comes n + 1 times, or a
 * count -n and n bytes as they are. False unless they become `count` bytes exactly. */
bool wf_exr_expand_runs(const uint8_t *packed, size_t size, uint8_t *out, size_t count);

#endif
