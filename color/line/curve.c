/* The transfer curves as constants of their standards. */
#include "color/line/curve.h"

#include <float.h>

/* A power in two floats: 12 bits after the point, and the rest. */
#define HIGH(p) ((float)(int)((p)*4096) / 4096)
#define POWER(p)                                                                               \
    .power_high = HIGH(p), .power_low = (float)((p) - (double)HIGH(p)),                        \
    .inverse_high = HIGH(1 / (p)), .inverse_low = (float)(1 / (p) - (double)HIGH(1 / (p)))

/* Below this a power that has no straight toe makes no light: gamma 2.4 would make 7e-16. */
#define NO_LIGHT_SIGNAL 0x1p-21f

const wf_curve wf_curve_bt1886 = {.kind = WF_CURVE_POWER,
                                  POWER(1 / 2.4),
                                  .gain = 1,
                                  .toe_end = FLT_MIN,
                                  .toe_signal = NO_LIGHT_SIGNAL};

const wf_curve wf_curve_bt709 = {.kind = WF_CURVE_POWER,
                                 POWER(0.45),
                                 .gain = 1.099f,
                                 .offset = 0.099f,
                                 .toe_end = 0.018f,
                                 .toe_slope = 4.5f,
                                 .toe_signal = 0.081f,
                                 .toe_light = (float)(1 / 4.5)};

const wf_curve wf_curve_bt2020 = {.kind = WF_CURVE_POWER,
                                  POWER(0.45),
                                  .gain = 1.09929682680944f,
                                  .offset = 0.09929682680944f,
                                  .toe_end = 0.018053968510807f,
                                  .toe_slope = 4.5f,
                                  .toe_signal = (float)(4.5 * 0.018053968510807),
                                  .toe_light = (float)(1 / 4.5)};

const wf_curve wf_curve_srgb = {.kind = WF_CURVE_POWER,
                                POWER(1 / 2.4),
                                .gain = 1.055f,
                                .offset = 0.055f,
                                .toe_end = 0.0031308f,
                                .toe_slope = 12.92f,
                                .toe_signal = 0.04045f,
                                .toe_light = (float)(1 / 12.92)};

wf_curve wf_curve_gamma(double exponent, double gain) {
    return (wf_curve){.kind = WF_CURVE_POWER,
                      POWER(1 / exponent),
                      .gain = (float)gain,
                      .toe_end = FLT_MIN,
                      .toe_signal = NO_LIGHT_SIGNAL};
}

/* m1 = 2610 / 16384 of ST 2084. */
const wf_curve wf_curve_pq = {
    .kind = WF_CURVE_PQ, .scale = 203.0f / 10000, POWER(2610.0 / 16384)};

/* (e^((0.75 - c) / a) + b) / 12: the light of which the OETF makes 0.75. */
const wf_curve wf_curve_hlg = {.kind = WF_CURVE_HLG, .scale = 0.26496256042100718f};
