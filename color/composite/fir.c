/* Filters along a line of composite video. */
#include "color/composite/fir.h"

/* Least squares for a raised cosine edge (chroma from 0.9 to 2.4 MHz, luma from 1.4 to 2.4 MHz,
 * at 13.5 MHz), the stop band counted thirtyfold, held to be 1 at 0 Hz and 0 at fsc and 2 fsc
 * of both systems: 3.580, 4.434 MHz and, folded, 6.341, 4.633 MHz. At least 42 dB down from 2.4
 * MHz on and 56 dB from 3 MHz on. tests/unit/color/test_composite.c measures them. */
static const wf_fir chroma = {12,
                              {0.244490936f, 0.21838522f, 0.151428565f, 0.0706238374f,
                               0.00452812808f, -0.0303081665f, -0.0339540541f, -0.0196698941f,
                               -0.00310210907f, 0.00645021209f, 0.00765320938f, 0.00442712288f,
                               0.00129246712f}};

static const wf_fir luma = {18,
                            {0.281446427f, 0.244820863f, 0.152592167f, 0.0472451821f,
                             -0.0284137614f, -0.0535309911f, -0.0364004448f, -0.00351966568f,
                             0.0196210723f, 0.0223298352f, 0.0100424066f, -0.00422808435f,
                             -0.0107260523f, -0.00831276551f, -0.00193963421f, 0.00287252595f,
                             0.00389023498f, 0.00233571022f, 0.000598191458f}};

const wf_fir *wf_fir_chroma(void) {
    return &chroma;
}

const wf_fir *wf_fir_luma(void) {
    return &luma;
}

void wf_fir_apply(const wf_fir *fir, float *restrict out, const float *restrict in,
                  size_t count) {
    const float *middle = in + fir->reach;
    for (size_t i = 0; i < count; i++) out[i] = fir->tap[0] * middle[i];
    for (int k = 1; k <= fir->reach; k++) {
        const float *before = middle - k, *after = middle + k;
        float tap = fir->tap[k];
        for (size_t i = 0; i < count; i++) out[i] += tap * (before[i] + after[i]);
    }
}

static int reflected(int x, int width) {
    if (width == 1) return 0;
    while (x < 0 || x >= width) x = x < 0 ? -x : 2 * (width - 1) - x;
    return x;
}

void wf_fir_reflect(float *restrict out, const float *restrict line, int width, int margin) {
    float *middle = out + margin;
    for (int x = 0; x < width; x++) middle[x] = line[x];
    for (int k = 1; k <= margin; k++) {
        middle[-k] = line[reflected(-k, width)];
        middle[width - 1 + k] = line[reflected(width - 1 + k, width)];
    }
}
