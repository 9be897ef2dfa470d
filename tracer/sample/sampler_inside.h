#ifndef WF_TRACER_SAMPLE_SAMPLER_INSIDE_H
#define WF_TRACER_SAMPLE_SAMPLER_INSIDE_H

#include "filters/base/isa.h"
#include "tracer/sample/sampler.h"

/* Nested uniform scrambling in Owen's sense of points whose bits are given in reverse order, by
 * a hash in which every bit depends on lower ones alone (Laine and Karras 2011; constants by
 * Burley, Practical hash-based Owen scrambling, 2020): [count] values in [0, 1). */
typedef void wf_scramble_fn(const uint32_t *reversed, int count, uint32_t seed, float *out);

/* Numbers at random in [0, 1), independent for each index and seed. */
typedef void wf_random_fn(int count, uint32_t seed, float *out);

typedef struct wf_sampler_ops {
    wf_scramble_fn *scramble;
    wf_random_fn *random;
} wf_sampler_ops;

WF_ISA_DECLARE(wf_sampler_ops);

#endif
