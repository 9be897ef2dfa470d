/* Hashes of whole cells: where samples lie in them. */
#include "filters/base/isa_file.h"
#include "tracer/sample/sampler_inside.h"

static inline uint32_t reverse_bits(uint32_t v) {
    v = (v >> 1 & 0x55555555u) | (v & 0x55555555u) << 1;
    v = (v >> 2 & 0x33333333u) | (v & 0x33333333u) << 2;
    v = (v >> 4 & 0x0f0f0f0fu) | (v & 0x0f0f0f0fu) << 4;
    v = (v >> 8 & 0x00ff00ffu) | (v & 0x00ff00ffu) << 8;
    return v >> 16 | v << 16;
}

/* 24 bits are all that a float between 0 and 1 can hold everywhere. */
static inline float unit(uint32_t v) {
    return (float)(int32_t)(v >> 8) * 0x1p-24f;
}

static void scramble(const uint32_t *reversed, int count, uint32_t seed, float *out) {
    for (int i = 0; i < count; i++) {
        uint32_t v = reversed[i] + seed;
        v ^= v * 0x6c50b47cu;
        v ^= v * 0xb82f1e52u;
        v ^= v * 0xc7afe638u;
        v ^= v * 0x8d22f6e6u;
        out[i] = unit(reverse_bits(v));
    }
}

static void random(int count, uint32_t seed, float *out) {
    for (int i = 0; i < count; i++) {
        uint32_t v = (uint32_t)i * 0x9e3779b9u + seed;
        v = (v ^ v >> 16) * 0x21f0aaadu;
        v = (v ^ v >> 15) * 0x735a2d97u;
        out[i] = unit(v ^ v >> 15);
    }
}

const wf_sampler_ops WF_ISA_TABLE(wf_sampler_ops) = {scramble, random};
