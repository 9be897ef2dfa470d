/* x^2.4 and x^(1/2.4) in vectors, for line_isa.c: an exact power of 2^e from a table, times a
 * polynomial of the mantissa. */
#ifndef WF_COLOR_LINE_GAMMA_H
#define WF_COLOR_LINE_GAMMA_H

#include "color/line/lanes.h"

/* Signals below twice this have no light: theirs would be 4e-15 and less. */
#define WF_GAMMA_BLACK 0x1p-21f

/* c[0] + c[1] t + .. c[degree] t^degree */
static inline lanes polynomial(const float *c, int degree, lanes t) {
    lanes sum = lanes_of(c[degree]);
    for (int k = degree - 1; k >= 0; k--) sum = sum * t + c[k];
    return sum;
}

/* The mantissa of x, from 1 to 2, less 1.5. */
static inline lanes mantissa(lanes x) {
    whole_lanes bits = ((whole_lanes)x & 0x007fffff) | 0x3f800000;
    return (lanes)bits - 1.5f;
}

/* x^2.4 to 2e-7 of itself, x from WF_GAMMA_BLACK to 2047. The polynomial is within 2.2e-8 by
 * itself; power[i] is 2^(2.4 (i - 21)), but power[0] is 0. */
static inline lanes to_gamma(lanes x) {
    static const float mantissas[] = {2.64617777f,   4.23388481f,    1.97580874f,
                                      0.175608993f,  -0.0175139327f, 0.00390834501f,
                                      -0.0012575608f};
    static const float power[32] = {0,
                                    3.55271368e-15f,
                                    1.87513352e-14f,
                                    9.89701406e-14f,
                                    5.22367534e-13f,
                                    2.75707237e-12f,
                                    1.45519152e-11f,
                                    7.6805469e-11f,
                                    4.05381696e-10f,
                                    2.13961742e-09f,
                                    1.12929684e-08f,
                                    5.96046448e-08f,
                                    3.14595201e-07f,
                                    1.66044343e-06f,
                                    8.76387295e-06f,
                                    4.62559987e-05f,
                                    0.000244140625f,
                                    0.00128858194f,
                                    0.00680117628f,
                                    0.0358968236f,
                                    0.189464571f,
                                    1.0f,
                                    5.27803164f,
                                    27.857618f,
                                    147.033389f,
                                    776.046882f,
                                    4096.0f,
                                    21618.8176f,
                                    114104.803f,
                                    602248.763f,
                                    3178688.03f,
                                    16777216.0f};
    whole_lanes octave = ((whole_lanes)x >> 23) - (127 - 21);
    return look_up_32(power, octave) * polynomial(mantissas, 6, mantissa(x));
}

/* x^(1/2.4) to 2e-7 of itself, x from 0 on, but that 0 and denormals give anything small. The
 * polynomial is within 2.3e-8 by itself. Twelve octaves of x are five of the result, exactly;
 * power[r] is 2^(5 r / 12). */
static inline lanes from_gamma(lanes x) {
    static const float mantissas[] = {1.18405366f,     0.328903615f,    -0.0639566854f,
                                      0.0225090589f,   -0.00962592475f, 0.00455271453f,
                                      -0.00274351495f, 0.00156488747f};
    static const float power[16] = {1.0f,        1.33483985f, 1.78179744f, 2.37841423f,
                                    3.1748021f,  4.23785238f, 5.65685425f, 7.5509945f,
                                    10.0793684f, 13.4543426f, 17.9593928f, 23.9729132f};
    whole_lanes octave = ((whole_lanes)x >> 23) + 5; /* 132, eleven times twelve, for x = 1 */
    whole_lanes twelfth = (octave * 171) >> 11;      /* octave / 12, from 0 to 170 */
    lanes some =
        look_up_16(power, octave - 12 * twelfth) * polynomial(mantissas, 7, mantissa(x));
    return (lanes)((whole_lanes)some + ((5 * (twelfth - 11)) << 23));
}

#endif
