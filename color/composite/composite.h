#ifndef WF_COLOR_COMPOSITE_COMPOSITE_H
#define WF_COLOR_COMPOSITE_COMPOSITE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Composite color television at 13.5 MHz (Rec. ITU-R BT.601's sampling): a coder from whole
 * frames of Y'CbCr 4:4:4 to the composite signal and the decoders that televisions have.
 *
 *     composite = Y' + U sin a + V cos a (PAL: +-V cos a), white = 1, without setup and sync
 *     U = 0.492111 (B' - Y'), V = 0.877283 (R' - Y')     (SMPTE 170M, BT.1700)
 *
 * The angle a is that of the U subcarrier, carried through every line of the signal:
 * - NTSC: 227.5 cycles a line of 858 samples, 35/132 a sample; the same again after two frames.
 *   Frame 0 is color frame A: a = 0 at the horizontal datum 0H of line 1 (SMPTE 170M with SC/H
 *   phase 0; C. Poynton, "Four-field NTSC sequence", 1997). The burst, at 180 degrees, then
 *   rises through zero at 0H of line 10, where SC/H phase is measured.
 * - PAL: 4433618.75 Hz, 283.7516 cycles a line of 864 samples; the same again after four
 * frames. a = 0 at 0H of line 1 of field 1 of frame 0 (EBU D 23-1984: SC/H phase is that of the
 * burst's +U component there). The V switch is + on that line, the burst at 135 degrees, and
 *   alternates from line to line through the signal (BT.1700): lines of odd numbers in
 *   even frames, of even numbers in odd ones.
 * A line's first picture sample lies 122 samples (525 lines) or 132 (625) after 0H (BT.601-7).
 */
typedef enum wf_tv_system { WF_NTSC, WF_PAL } wf_tv_system;

/* cheap adds chroma to the luma as it is; filtered first takes out of the luma what lies around
 * the subcarrier, by a filter along the line. */
typedef enum wf_tv_encoder { WF_ENCODER_CHEAP, WF_ENCODER_FILTERED } wf_tv_encoder;

/* notch takes all that lies around the subcarrier for chroma. comb2 and comb3 take the part of
 * it that changes sign, as the subcarrier does, between a line and one or both of its neighbors
 * half a cycle off: the next lines of its field (NTSC), those after the next (PAL). What is not
 * chroma is luma. At the first and last lines the neighbor on the other side serves. */
typedef enum wf_tv_decoder {
    WF_DECODER_NOTCH,
    WF_DECODER_COMB2,
    WF_DECODER_COMB3
} wf_tv_decoder;

/* U of Cb and V of Cr, both from -1/2 to 1/2, by BT.601's weights. */
#define WF_U_OF_CB (2 * (1 - 0.114) * 0.492111)
#define WF_V_OF_CR (2 * (1 - 0.299) * 0.877283)

/* What a system's numbers are; static storage. */
typedef struct wf_tv_standard {
    const char *name;    /* "ntsc" */
    int total_lines;     /* of a frame */
    int line_samples;    /* of a line */
    int first_sample;    /* of the picture, after 0H */
    int64_t cycles[2];   /* of the subcarrier a sample, as a fraction in its lowest terms */
    int sequence_frames; /* after which phase and V switch are the same again */
    bool v_switch;
    int burst_degrees[2]; /* of the burst against +U, where the V switch is +, - */
    int comb_lines;       /* lines of a field after which the chroma is half a cycle off */
} wf_tv_standard;

const wf_tv_standard *wf_tv_standard_of(wf_tv_system system);

typedef struct wf_tv {
    wf_tv_system system;
    wf_tv_encoder encoder;
    wf_tv_decoder decoder;
    int width_px, lines; /* of the frame, both fields woven; 13.5 MHz samples */
    int line1, line2; /* number of the first picture line of field 1 (first in time), field 2 */
    bool top_first;   /* field 1 owns the top picture line */
} wf_tv;

/* Unchanging once made: any number of threads may use it, each with buffers of its own. */
typedef struct wf_composite wf_composite;

/* NULL: no memory. The picture is from 1x1 up to what fits in the system's lines. */
wf_composite *wf_composite_new(const wf_tv *tv);
void wf_composite_free(wf_composite *c);

/* Samples of a row of composite: the picture's, and as many before and after it that a decoder
 * looks at there; they are coded from the picture reflected about its first and last samples
 * (c b | a b c). Picture sample x is row[x + wf_composite_margin(c)]. */
size_t wf_composite_row(const wf_composite *c);
size_t wf_composite_margin(const wf_composite *c);

/* Floats of scratch that encoding and decoding need. */
size_t wf_composite_scratch(const wf_composite *c);

/* The subcarrier at a sample of a picture line of the frame (0: the top one), exactly. */
typedef struct wf_subcarrier {
    int64_t num, den;  /* its phase in cycles, 0 <= num / den < 1 */
    int v_sign;        /* 1 or -1 */
    int burst_degrees; /* of this line's burst against +U */
    int line_number;   /* from 1 in the whole frame, as the raster's map counts */
} wf_subcarrier;

wf_subcarrier wf_composite_subcarrier(const wf_composite *c, int64_t frame, int line,
                                      int sample);

/* A frame, from 0, of planes Y' (0..1), Cb, Cr (-0.5..0.5, BT.601's weights), [lines][width_px]
 * each, to composite [lines][row]. Fields never mix. Never fails; numbers must be finite. */
void wf_composite_encode(const wf_composite *c, int64_t frame, float *const ycbcr[3],
                         float *composite, float *scratch);

/* And back. The planes do not overlap composite. */
void wf_composite_decode(const wf_composite *c, int64_t frame, const float *composite,
                         float *const ycbcr[3], float *scratch);

#endif
