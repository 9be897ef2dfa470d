/* The inner loops of color: curves, matrices, chroma and codes along lines of samples.
 * Nothing here branches on a sample, so that the compiler makes vectors of all of it. */
#include "color/line/gamma.h"
#include "color/line/line.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "filters/base/isa_file.h"

/* ---- Powers and logarithms ---- */

static inline uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline float float_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* x = 2^e m with m from sqrt(1/2) to sqrt(2), for x positive and normal: gives e, and m - 1. */
static inline float split(float x, float *e) {
    const uint32_t root_half = 0x3f3504f3;
    uint32_t bits = bits_of(x) - root_half;
    *e = (float)((int32_t)bits >> 23);
    return float_of((bits & 0x007fffff) + root_half) - 1;
}

/* log2((1 + s) / (1 - s)) to 1e-7 of itself, s from -0.172 to 0.172: the series of 2
 * artanh(s) / ln 2, made a polynomial of s^2 that is within 7e-10 by itself. 1 + f has
 * s = f / (2 + f). */
static inline float log2_ratio(float s) {
    float z = s * s;
    return s * (2.88539008f + z * (0.96179885f + z * (0.57671441f + z * 0.43173537f)));
}

/* 2^(n + r): n a whole number added to 1.5 * 2^23, r from -0.5 to 0.5, to 1e-7 of itself; the
 * polynomial is within 2e-9 by itself. */
static inline float exp2_shifted(float shifted_n, float r) {
    float high = 0.00961843736f + r * (0.00133988745f + r * 0.000153533621f);
    float low = 0.693147203f + r * (0.240226479f + r * (0.0555033247f + r * high));
    return float_of(bits_of(1 + r * low) + (bits_of(shifted_n) << 23));
}

/* (2^e (1 + s) / (1 - s))^p: p_high e is exact, so that no octave loses accuracy. */
static inline float power_ratio(float e, float s, float p_high, float p_low) {
    const float shift = 12582912; /* 1.5 * 2^23: adding it rounds to a whole number */
    float whole = p_high * e;
    float rest = p_low * e + (p_high + p_low) * log2_ratio(s);
    float shifted = (whole + rest) + shift;
    return exp2_shifted(shifted, (whole - (shifted - shift)) + rest);
}

static inline float power(float x, float p_high, float p_low) {
    float e, f = split(x, &e);
    return power_ratio(e, f / (2 + f), p_high, p_low);
}

/* ---- Powers in double ---- */

/* 2^(p log2(x) + q), x positive and normal, to 1e-9 of itself: for PQ, whose sixth power of a
 * quotient of differences makes much of little, and for HLG. The exponent of 2 that comes out
 * has to be from -126 to 127. */
static inline double power_wide(float x, double p, double q) {
    const float shift = 12582912; /* 1.5 * 2^23: adding it rounds to a whole number */
    float e, f = split(x, &e);
    double s = (double)f / (2 + (double)f), z = s * s;
    double high = 0.41219858311113238 + z * (0.32059889797532520 + z * 0.26230818925253880);
    double ratio = 0.96179669392597556 + z * (0.57707801635558536 + z * high);
    double y = p * ((double)e + s * (2.8853900817779268 + z * ratio)) + q;
    float shifted = (float)y + shift;
    double r = (y - (double)(shifted - shift)) * 0.69314718055994531;
    double end = 1.0 / 120 + r * (1.0 / 720 + r * (1.0 / 5040 + r * (1.0 / 40320)));
    double tail = r * r * (0.5 + r * (1.0 / 6 + r * (1.0 / 24 + r * end)));
    return (1 + (r + tail)) * (double)float_of((bits_of(shifted) << 23) + 0x3f800000);
}

/* ---- Curves ---- */

static inline float within(float x, float most) {
    x = x == x ? x : 0;
    x = x > -most ? x : -most;
    return x < most ? x : most;
}

static inline float signed_as(float magnitude, float x) {
    return x < 0 ? -magnitude : magnitude;
}

#define SIGN 0x80000000u

/* The sign is moved as a bit, since the loop runs for every sample of an output. */
static void any_power_curve(const wf_curve *curve, float *restrict light, size_t count) {
    const wf_curve c = *curve;
    for (size_t i = 0; i < count; i++) {
        uint32_t bits = bits_of(light[i]);
        float x = float_of(bits & ~SIGN);
        x = x == x ? x : 0;
        x = x < WF_MOST_LIGHT ? x : WF_MOST_LIGHT;
        float signal = c.gain * power(x, c.power_high, c.power_low) - c.offset;
        signal = x < c.toe_end ? c.toe_slope * x : signal;
        light[i] = float_of(bits_of(signal) | (bits & SIGN));
    }
}

static void any_power_decode(const wf_curve *curve, float *restrict signal, size_t count) {
    const wf_curve c = *curve;
    for (size_t i = 0; i < count; i++) {
        float given = within(signal[i], WF_MOST_SIGNAL), v = fabsf(given);
        float light = power((v + c.offset) / c.gain, c.inverse_high, c.inverse_low);
        signal[i] = signed_as(v < c.toe_signal ? c.toe_light * v : light, given);
    }
}

/* ---- Powers of 2.4, which are most ---- */

static bool has_gamma(const wf_curve *c) {
    return c->inverse_high == wf_curve_bt1886.inverse_high &&
           c->inverse_low == wf_curve_bt1886.inverse_low;
}

static inline lanes with_sign_of(lanes magnitude, lanes x) {
    return (lanes)((whole_lanes)magnitude | ((whole_lanes)x & (int32_t)SIGN));
}

static inline lanes magnitude_within(lanes x, float most) {
    lanes magnitude = (lanes)((whole_lanes)x & (int32_t)~SIGN);
    return smaller(larger(magnitude, lanes_of(0)), lanes_of(most));
}

static inline lanes gamma_curve(const wf_curve *c, lanes light) {
    lanes x = magnitude_within(light, WF_MOST_LIGHT);
    lanes signal = c->gain * from_gamma(x) - c->offset;
    return with_sign_of(by_limit(x, lanes_of(c->toe_end), c->toe_slope * x, signal), light);
}

static inline lanes gamma_decode(const wf_curve *c, lanes signal) {
    lanes v = magnitude_within(signal, WF_MOST_SIGNAL);
    lanes x = larger((v + c->offset) * (1 / c->gain), lanes_of(WF_GAMMA_BLACK));
    return with_sign_of(by_limit(v, lanes_of(c->toe_signal), c->toe_light * v, to_gamma(x)),
                        signal);
}

/* The same of a curve without offset, gain and toe. */
static inline lanes pure_gamma_curve(const wf_curve *c, lanes light) {
    lanes x = magnitude_within(light, WF_MOST_LIGHT);
    lanes signal = by_limit(x, lanes_of(c->toe_end), lanes_of(0), from_gamma(x));
    return with_sign_of(signal, light);
}

/* What lies below is black for to_gamma, and so is NaN. */
static inline lanes pure_gamma_decode(const wf_curve *c, lanes signal) {
    (void)c;
    lanes v = (lanes)((whole_lanes)signal & (int32_t)~SIGN);
    v = smaller(larger(v, lanes_of(WF_GAMMA_BLACK)), lanes_of(WF_MOST_SIGNAL));
    return with_sign_of(to_gamma(v), signal);
}

static bool is_pure(const wf_curve *c) {
    return c->gain == 1 && c->offset == 0 && c->toe_light == 0 && c->toe_slope == 0;
}

typedef lanes of_lanes(const wf_curve *curve, lanes x);

static inline void each(const wf_curve *curve, of_lanes *of, float *line, size_t count) {
    const wf_curve c = *curve;
    float rest[LANES] = {0};
    size_t whole = count / LANES * LANES, left = count - whole;
    for (size_t i = 0; i < whole; i += LANES) put_lanes(line + i, of(&c, lanes_at(line + i)));
    if (!left) return;
    memcpy(rest, line + whole, left * sizeof *rest);
    put_lanes(rest, of(&c, lanes_at(rest)));
    memcpy(line + whole, rest, left * sizeof *rest);
}

static void power_curve(const wf_curve *curve, float *restrict light, size_t count) {
    if (has_gamma(curve) && is_pure(curve))
        each(curve, pure_gamma_curve, light, count);
    else if (has_gamma(curve))
        each(curve, gamma_curve, light, count);
    else
        any_power_curve(curve, light, count);
}

static void power_decode(const wf_curve *curve, float *restrict signal, size_t count) {
    if (has_gamma(curve) && is_pure(curve))
        each(curve, pure_gamma_decode, signal, count);
    else if (has_gamma(curve))
        each(curve, gamma_decode, signal, count);
    else
        any_power_decode(curve, signal, count);
}

/* ((c1 + c2 t) / (1 + c3 t))^m2, t = x^m1. The base less 1 decides how accurate the power is;
 * it is less / (1 + c3 t), without cancellation because c1 = c3 - c2 + 1. */
static void pq_curve(const wf_curve *curve, float *restrict light, size_t count) {
    const wf_curve c = *curve;
    const float c3 = 18.6875f, c3_less_c2 = -0.1640625f, m2 = 78.84375f;
    for (size_t i = 0; i < count; i++) {
        float given = within(light[i], WF_MOST_LIGHT), x = c.scale * fabsf(given);
        float t = power(x, c.power_high, c.power_low);
        t = x < FLT_MIN ? 0 : t;
        float less = c3_less_c2 * (1 - t);
        float signal = power_ratio(0, less / (2 * (1 + c3 * t) + less), m2, 0);
        float line = WF_PQ_LINE_SIGNAL + (x - WF_PQ_LINE_LIGHT) * (1 / WF_PQ_LINE_SLOPE);
        light[i] = signed_as(x > WF_PQ_LINE_LIGHT ? line : signal, given);
    }
}

/* Signals below this are black: their light is 1e-19 and less. */
#define PQ_BLACK 1e-6f

/* (max(t - c1, 0) / (c2 - c3 t))^(1 / m1), t = v^(1 / m2). */
static void pq_decode(const wf_curve *curve, float *restrict signal, size_t count) {
    const double scale = 1 / (double)curve->scale;
    const double c1 = 0.8359375, c2 = 18.8515625, c3 = 18.6875;
    for (size_t i = 0; i < count; i++) {
        float given = within(signal[i], WF_MOST_SIGNAL), v = fabsf(given);
        float bent = v < WF_PQ_LINE_SIGNAL ? v : WF_PQ_LINE_SIGNAL;
        double t = power_wide(bent < PQ_BLACK ? PQ_BLACK : bent, 1 / 78.84375, 0);
        float ratio = (float)((t - c1) / (c2 - c3 * t));
        double light = power_wide(ratio, 16384.0 / 2610, 0);
        light = v < PQ_BLACK ? 0 : light;
        double line = (double)WF_PQ_LINE_SLOPE * ((double)v - (double)bent);
        signal[i] = signed_as((float)(scale * (light + line)), given);
    }
}

static void hlg_curve(const wf_curve *curve, float *restrict light, size_t count) {
    const wf_curve c = *curve;
    const float a = 0.17883277f, b = 0.28466892f, c_offset = 0.55991073f, ln2 = 0.693147181f;
    for (size_t i = 0; i < count; i++) {
        float given = within(light[i], WF_MOST_LIGHT), x = c.scale * fabsf(given), e;
        float above = x > 1.0f / 12 ? 12 * x - b : 1; /* 1 where the root is taken */
        float f = split(above, &e);
        float log = a * ln2 * (e + log2_ratio(f / (2 + f))) + c_offset;
        light[i] = signed_as(x > 1.0f / 12 ? log : sqrtf(3 * x), given);
    }
}

/* v^2 / 3, above 1/2 (e^((v - c) / a) + b) / 12; the light of 2.75 is 65504 and more. */
static void hlg_decode(const wf_curve *curve, float *restrict signal, size_t count) {
    const double scale = 1 / (double)curve->scale, per_octave = 1 / (0.17883277 * M_LN2);
    const double b = 0.28466892, c_offset = 0.55991073;
    for (size_t i = 0; i < count; i++) {
        float given = within(signal[i], 2.75f);
        double v = fabs((double)given);
        double power = power_wide(1, 0, (v - c_offset) * per_octave);
        double light = v > 0.5 ? (power + b) / 12 : v * v / 3;
        signal[i] = signed_as((float)(scale * light), given);
    }
}

/* ---- Matrices ---- */

/* In double: out of gamut, the sums come near 0, where the curves that follow are steepest. */
static void mix(const wf_mix *m, float *restrict r, float *restrict g, float *restrict b,
                size_t count) {
    const wf_mix w = *m;
    for (size_t i = 0; i < count; i++) {
        double red = (double)within(r[i], WF_MOST_LINEAR);
        double green = (double)within(g[i], WF_MOST_LINEAR);
        double blue = (double)within(b[i], WF_MOST_LINEAR);
        double gr = green - red, br = blue - red, bg = blue - green;
        r[i] = (float)(red + (w.of_red[0] * gr + w.of_red[1] * br));
        g[i] = (float)(green + (w.of_green[1] * bg - w.of_green[0] * gr));
        b[i] = (float)(blue - (w.of_blue[0] * br + w.of_blue[1] * bg));
    }
}

static inline lanes signals_within(const float *from) {
    lanes x = larger(numbers(lanes_at(from)), lanes_of(-WF_MOST_SIGNAL));
    return smaller(x, lanes_of(WF_MOST_SIGNAL));
}

static inline void ycbcr_lanes(const wf_ycbcr *w, float *r, float *g, float *b) {
    lanes red = signals_within(r), green = signals_within(g), blue = signals_within(b);
    lanes luma = green + (w->kr * (red - green) + w->kb * (blue - green));
    put_lanes(r, luma);
    put_lanes(g, w->cb_scale * (blue - luma));
    put_lanes(b, w->cr_scale * (red - luma));
}

static void ycbcr(const wf_ycbcr *weights, float *restrict r, float *restrict g,
                  float *restrict b, size_t count) {
    const wf_ycbcr w = *weights;
    float rest[3][LANES] = {{0}}, *const plane[3] = {r, g, b};
    size_t whole = count / LANES * LANES, left = count - whole;
    for (size_t i = 0; i < whole; i += LANES) ycbcr_lanes(&w, r + i, g + i, b + i);
    for (int c = 0; c < 3; c++) memcpy(rest[c], plane[c] + whole, left * sizeof(float));
    ycbcr_lanes(&w, rest[0], rest[1], rest[2]);
    for (int c = 0; c < 3; c++) memcpy(plane[c] + whole, rest[c], left * sizeof(float));
}

/* ---- Chroma ---- */

static void deinterleave(float *restrict even, float *restrict odd, const float *restrict line,
                         size_t count) {
    for (size_t i = 0; i < count; i++) {
        even[i] = line[2 * i];
        odd[i] = line[2 * i + 1];
    }
}

enum { BESIDE = 4 }; /* vectors, so that no sum waits for another */

/* In single precision: ten additions leave an error of -130 dB, 16-bit codes one of -98 dB. */
static void half_band(float *restrict out, const float *restrict even,
                      const float *restrict odd, const float *restrict pair, size_t pairs,
                      size_t count) {
    size_t i = 0;
    for (; i + BESIDE * LANES <= count; i += BESIDE * LANES) {
        lanes sum[BESIDE];
        for (size_t n = 0; n < BESIDE; n++) sum[n] = 0.5f * lanes_at(even + i + n * LANES);
        for (size_t j = 0; j < pairs; j++) {
            const float *after = odd + i + j, *before = odd + i - j - 1;
            for (size_t n = 0; n < BESIDE; n++)
                sum[n] +=
                    pair[j] * (lanes_at(after + n * LANES) + lanes_at(before + n * LANES));
        }
        for (size_t n = 0; n < BESIDE; n++) put_lanes(out + i + n * LANES, sum[n]);
    }
    for (; i < count; i++) {
        float sum = 0.5f * even[i];
        for (size_t j = 0; j < pairs; j++) sum += pair[j] * (odd[i + j] + *(odd + i - j - 1));
        out[i] = sum;
    }
}

/* ---- Codes ---- */

/* In double a signal's 24 bits times the scale, and the offset, leave a half what it is. */
static inline uint16_t code_of(const wf_quantizer *q, float signal) {
    float finite = signal == signal ? signal : 0;
    double level = q->scale * (double)finite + q->offset;
    level = level > q->low ? level : q->low;
    level = level < q->high ? level : q->high;
    return (uint16_t)(int32_t)(level + 0.5);
}

/* In float it is right but near halves, which few codes are: scale, offset and limits are whole
 * numbers, and the level is within two roundings of 2^-24 of what is below 2 high. */
static inline void quantize_lanes(const wf_quantizer *q, uint16_t *code, const float *signal) {
    const float shift = 12582912; /* 1.5 * 2^23: adding it rounds to a whole number */
    lanes level = (float)q->scale * numbers(lanes_at(signal)) + (float)q->offset;
    level = smaller(larger(level, lanes_of((float)q->low)), lanes_of((float)q->high));
    lanes next = level + 0.5f, off = next - ((next + shift) - shift);
    lanes away = (lanes)((whole_lanes)off & (int32_t)~SIGN);
    if (any_below(away, lanes_of((float)q->high * 0x1p-21f))) {
        for (int i = 0; i < LANES; i++) code[i] = code_of(q, signal[i]);
        return;
    }
    put_codes(code, next);
}

static void quantize(const wf_quantizer *quantizer, uint16_t *restrict code,
                     const float *restrict signal, size_t count) {
    const wf_quantizer q = *quantizer;
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) quantize_lanes(&q, code + i, signal + i);
    for (; i < count; i++) code[i] = code_of(&q, signal[i]);
}

const wf_line_ops WF_ISA_TABLE(wf_line_ops) = {
    .mix = mix,
    .curve =
        {[WF_CURVE_POWER] = power_curve, [WF_CURVE_PQ] = pq_curve, [WF_CURVE_HLG] = hlg_curve},
    .decode = {[WF_CURVE_POWER] = power_decode,
               [WF_CURVE_PQ] = pq_decode,
               [WF_CURVE_HLG] = hlg_decode},
    .ycbcr = ycbcr,
    .deinterleave = deinterleave,
    .half_band = half_band,
    .quantize = quantize,
};
