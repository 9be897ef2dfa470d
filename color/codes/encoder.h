#ifndef WF_COLOR_CODES_ENCODER_H
#define WF_COLOR_CODES_ENCODER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "color/line/luma.h"

/* luma-adjust decimates as bt601 does and then chooses Y' so that the luminance, once chroma is
 * interpolated, is that of the picture before. */
typedef enum wf_chroma {
    WF_CHROMA_BT601,
    WF_CHROMA_121,
    WF_CHROMA_BOX,
    WF_CHROMA_444,
    WF_CHROMA_LUMA_ADJUST
} wf_chroma;

/* clip: codes within the narrow range; r103: within the limits of EBU R 103 (color/legal.h). */
typedef enum wf_legalize { WF_LEGAL_NONE, WF_LEGAL_CLIP, WF_LEGAL_R103 } wf_legalize;

/* What r103 has done: pixels seen, of those changed, and of those outside still. */
typedef struct wf_legal_counts {
    int64_t pixels, touched, outside;
} wf_legal_counts;

struct wf_display;

/* tpdf: noise of triangular distribution, one code to each side, is added before rounding, so
 * that a gradient has no steps: the mean of the codes is the signal, whatever it is, and their
 * variance a quarter. It is fixed to the pixels of the frame: the fields of a still share it
 * with those of the same parity, and no two lines or planes are alike. */
typedef enum wf_dither { WF_DITHER_NONE, WF_DITHER_TPDF } wf_dither;

/* How display-encoded R'G'B' becomes codes. */
typedef struct wf_encoding {
    wf_luma luma;
    wf_chroma chroma; /* ignored for R'G'B' */
    wf_legalize legalize;
    wf_dither dither;
    int line;   /* of the frame, from the top: which noise it gets */
    bool ycbcr; /* false: the codes are R'G'B' */
    bool full_range;
    int bits; /* 8, 10, 12 or 16 */
    int width_px;
    const struct wf_display *display; /* luma-adjust: what the picture is made for */
    wf_legal_counts *legal;           /* r103: added to; NULL: nobody counts */
} wf_encoding;

/* What codes of plane `plane` mean: the signal is (code - zero) / unit, from 0 to 1, chroma
 * from -1/2 to 1/2. Of the encoding only ycbcr, full_range and bits are looked at. */
void wf_code_scale(const wf_encoding *encoding, int plane, double *zero, double *unit);

/* Those signals, of count codes. */
void wf_decode_line(const wf_encoding *encoding, int plane, const uint16_t *code, float *signal,
                    size_t count);

/* Samples of float scratch that wf_encode_line needs. */
size_t wf_encode_scratch(const wf_encoding *encoding);

/* One line of display-encoded R'G'B' planes (width_px each; overwritten) to codes: Y Cb Cr (Cb,
 * Cr width_px / 2 samples, co-sited with even luma, unless 444) or R G B. NaN never reaches a
 * code: it counts as 0. */
void wf_encode_line(const wf_encoding *encoding, float *const rgb[3], float *scratch,
                    uint16_t *const code[3]);

#endif
