#ifndef WF_CONVERT_READ_EXR_LITTLE_H
#define WF_CONVERT_READ_EXR_LITTLE_H

#include <stdint.h>

/* Whole numbers of 2 to 8 bytes at any address, the lowest byte first, as EXR stores them. */

static inline uint32_t wf_little16(const uint8_t *b) {
    return (uint32_t)b[0] | (uint32_t)b[1] << 8;
}

static inline uint32_t wf_little32(const uint8_t *b) {
    return wf_little16(b) | wf_little16(b + 2) << 16;
}

static inline uint64_t wf_little64(const uint8_t *b) {
    return wf_little32(b) | (uint64_t)wf_little32(b + 4) << 32;
}

#endif
