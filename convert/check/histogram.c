#include "convert/check/histogram.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sign 0, 8 bits of exponent and 11 of mantissa. */
#define BIN_SHIFT 12
#define BINS      ((size_t)1 << (31 - BIN_SHIFT))

bool wf_histogram_init(wf_histogram *spread, float limit) {
    *spread = (wf_histogram){.limit = limit};
    spread->bin = calloc(BINS, sizeof *spread->bin);
    return spread->bin;
}

void wf_histogram_free(wf_histogram *spread) {
    free(spread->bin);
    spread->bin = NULL;
}

void wf_histogram_add(wf_histogram *spread, float value) {
    uint32_t bits;
    if (!(value >= 0)) return;
    value += 0.0f; /* -0 is 0 */
    memcpy(&bits, &value, sizeof bits);
    spread->bin[(bits & 0x7fffffff) >> BIN_SHIFT]++;
    spread->squares += (double)value * (double)value;
    spread->over += value > spread->limit;
    spread->count++;
}

double wf_histogram_rms(const wf_histogram *spread) {
    return spread->count ? sqrt(spread->squares / (double)spread->count) : NAN;
}

double wf_histogram_share(const wf_histogram *spread) {
    return spread->count ? (double)spread->over / (double)spread->count : NAN;
}

/* The middle of a bin. */
static double bin_value(size_t bin) {
    uint32_t bits = (uint32_t)bin << BIN_SHIFT | 1u << (BIN_SHIFT - 1);
    float value;
    memcpy(&value, &bits, sizeof value);
    return bin ? (double)value : 0;
}

double wf_histogram_quantile(const wf_histogram *spread, double share) {
    double wanted = share * (double)spread->count, below = 0;
    if (!spread->count) return NAN;
    for (size_t bin = 0; bin < BINS; bin++) {
        below += (double)spread->bin[bin];
        if (below >= wanted && spread->bin[bin]) return bin_value(bin);
    }
    return NAN;
}
