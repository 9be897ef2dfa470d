/* Noise that is added before rounding to codes. */
#include "color/codes/dither.h"

#include <stdint.h>

/* A bijection of 32 bits that leaves no pattern (the finalizer of MurmurHash3). */
static uint32_t scramble(uint32_t h) {
    h = (h ^ h >> 16) * 0x85ebca6b;
    h = (h ^ h >> 13) * 0xc2b2ae35;
    return h ^ h >> 16;
}

/* The two halves of a hash, each evenly distributed over one code, are summed about 0. */
void wf_dither_add(int line, int plane, double unit, float *signal, size_t count) {
    uint32_t seed = scramble((uint32_t)line * 3 + (uint32_t)plane);
    for (size_t i = 0; i < count; i++) {
        uint32_t h = scramble(seed ^ (uint32_t)i * 0x9e3779b9);
        double noise = ((double)(h & 0xffff) + (double)(h >> 16) - 65535) / 65536;
        signal[i] += (float)(noise / unit);
    }
}
