/* RMS and quantiles of very many values in little memory. */
#include "convert/check/histogram.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A float shifted right by this much leaves 8 bits of exponent and 11 of mantissa. */
#define BIN_SHIFT 12
#define BINS      ((size_t)1 << (31 - BIN_SHIFT))

bool wf_histogram_init(wf_histogram *h, float limit) {
    *h = (wf_histogram){.limit = limit};
    h->bin = calloc(BINS, sizeof *h->bin);
    return h->bin;
}

void wf_histogram_free(wf_histogram *h) {
    free(h->bin);
    h->bin = NULL;
}

void wf_histogram_add(wf_histogram *h, float value) {
    uint32_t bits;
    if (!(value >= 0)) return;
    value += 0.0f; /* -0 is 0 */
    memcpy(&bits, &value, sizeof bits);
    h->bin[(bits & 0x7fffffff) >> BIN_SHIFT]++;
    h->squares += (double)value * (double)value;
    h->over += value > h->limit;
    h->count++;
}

void wf_histogram_add_zeros(wf_histogram *h, uint64_t count) {
    h->bin[0] += count;
    h->count += count;
}

double wf_histogram_rms(const wf_histogram *h) {
    return h->count ? sqrt(h->squares / (double)h->count) : NAN;
}

double wf_histogram_share(const wf_histogram *h) {
    return h->count ? (double)h->over / (double)h->count : NAN;
}

/* The middle of a bin. */
static double bin_value(size_t bin) {
    uint32_t bits = (uint32_t)bin << BIN_SHIFT | 1u << (BIN_SHIFT - 1);
    float value;
    memcpy(&value, &bits, sizeof value);
    return bin ? (double)value : 0;
}

double wf_histogram_quantile(const wf_histogram *h, double share) {
    double wanted = share * (double)h->count, below = 0;
    if (!h->count) return NAN;
    for (size_t bin = 0; bin < BINS; bin++) {
        below += (double)h->bin[bin];
        if (below >= wanted && h->bin[bin]) return bin_value(bin);
    }
    return NAN;
}
