/* Which code stands for which signal, in narrow and full range at every depth. */
#include "color/codes/levels.h"

/* Levels at 8 bits in narrow range: the codes of signals 0 and 1 are zero and zero + unit
 * (chroma goes half a unit to each side), and what is legal. */
typedef struct levels {
    double zero, unit, legal_low, legal_high;
} levels;

static const levels narrow_luma = {16, 219, 16, 235}; /* R', G' and B' as well */
static const levels narrow_chroma = {128, 224, 16, 240};

static wf_quantizer narrow_quantizer(const wf_encoding *e, levels at) {
    double step = (double)(1 << (e->bits - 8)); /* of one 8-bit code */
    bool clip = e->legalize == WF_LEGAL_CLIP;
    return (wf_quantizer){.scale = step * at.unit,
                          .offset = step * at.zero,
                          .low = step * (clip ? at.legal_low : 1),
                          /* above lie the codes that are kept for synchronization */
                          .high = clip ? step * at.legal_high : step * 255 - 1};
}

static wf_quantizer full_quantizer(const wf_encoding *e, bool chroma) {
    double most = (double)((1 << e->bits) - 1);
    return (wf_quantizer){.scale = most,
                          .offset = chroma ? (double)(1 << (e->bits - 1)) : 0,
                          .low = 0,
                          .high = most};
}

wf_quantizer wf_quantizer_of(const wf_encoding *e, int plane) {
    bool chroma = e->ycbcr && plane > 0;
    if (e->full_range) return full_quantizer(e, chroma);
    return narrow_quantizer(e, chroma ? narrow_chroma : narrow_luma);
}

void wf_code_scale(const wf_encoding *encoding, int plane, double *zero, double *unit) {
    wf_quantizer q = wf_quantizer_of(encoding, plane);
    *zero = q.offset;
    *unit = q.scale;
}

void wf_decode_line(const wf_encoding *encoding, int plane, const uint16_t *code, float *signal,
                    size_t count) {
    double zero, unit;
    wf_code_scale(encoding, plane, &zero, &unit);
    for (size_t i = 0; i < count; i++) signal[i] = (float)((code[i] - zero) / unit);
}
