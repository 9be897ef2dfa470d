#ifndef WF_COLOR_LINE_CURVE_H
#define WF_COLOR_LINE_CURVE_H

/* Transfer curves: linear light, 1.0 being reference white, to R'G'B' and back. Both ways are
 * odd: what is negative gives the negative of what its magnitude gives, so that codes below
 * black and colors out of gamut survive. NaN gives what 0 gives; light beyond +-WF_MOST_LIGHT,
 * Inf with it, gives what that gives. Signals above 1 are kept. */

/* The largest half: what EXR files hold at most, and far beyond every code. */
#define WF_MOST_LIGHT 65504.0f

/* Beyond a signal of 2 the formula of PQ has no light; R'G'B' of narrow Y'CbCr codes reaches
 * 2.2. Light here is on the standard's scale, 1 being 10000 cd/m2. */
#define WF_PQ_LINE_SIGNAL 1.25f
#define WF_PQ_LINE_LIGHT  12.8668041f
#define WF_PQ_LINE_SLOPE  143.16833f /* of light by signal */

typedef enum wf_curve_kind {
    WF_CURVE_POWER, /* gain x^p - offset, below toe_end: toe_slope x */
    WF_CURVE_PQ,  /* inverse EOTF of Rec. ITU-R BT.2100 table 4 (SMPTE ST 2084), which ends at a
                     signal of 1; a straight line goes on from WF_PQ_LINE_SIGNAL */
    WF_CURVE_HLG, /* OETF of Rec. ITU-R BT.2100 table 5 */
    WF_CURVE_KINDS,
} wf_curve_kind;

typedef struct wf_curve {
    wf_curve_kind kind;
    float scale;                 /* PQ and HLG: reference white on the standard's scale */
    float power_high, power_low; /* p; high has few enough bits to be multiplied exactly */
    float gain, offset, toe_end, toe_slope;
    /* A power's inverse, ((signal + offset) / gain)^(1 / p): 1 / p, and the signal below which
     * light is toe_light times the signal. */
    float inverse_high, inverse_low, toe_signal, toe_light;
} wf_curve;

/* Inverse of the display of Rec. ITU-R BT.1886 annex 1 with black at 0: gamma 2.4. */
extern const wf_curve wf_curve_bt1886;
/* OETF of Rec. ITU-R BT.709-6 item 1.2, its four constants as printed; BT.601-7's too. */
extern const wf_curve wf_curve_bt709;
/* OETF of Rec. ITU-R BT.2020-2 table 4, with alpha and beta as its note defines them. */
extern const wf_curve wf_curve_bt2020;
/* Reference white at 203 cd/m2 in PQ and at 75 % in HLG: Report ITU-R BT.2408 table 1. */
extern const wf_curve wf_curve_pq;
extern const wf_curve wf_curve_hlg;
/* IEC 61966-2-1, its constants as printed. */
extern const wf_curve wf_curve_srgb;

/* Light to the power of 1 / exponent, times gain. */
wf_curve wf_curve_gamma(double exponent, double gain);

#endif
