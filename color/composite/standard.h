#ifndef WF_COLOR_COMPOSITE_STANDARD_H
#define WF_COLOR_COMPOSITE_STANDARD_H

#include <stdbool.h>
#include <stdint.h>

/* Composite color television, sampled at 13.5 MHz as Rec. ITU-R BT.601 has it:
 *
 *     composite = Y' + U sin a + V cos a (PAL: +-V cos a), white = 1, without setup and sync
 *     U = 0.492111 (B' - Y'), V = 0.877283 (R' - Y')     (SMPTE 170M, BT.1700)
 *
 * The angle a is that of the U subcarrier, carried through every line of the signal:
 * - NTSC: 227.5 cycles a line of 858 samples, 35/132 a sample; the same again after two frames.
 *   Frame 0 is color frame A: a = 0 at the horizontal datum 0H of line 1 (SMPTE 170M with SC/H
 *   phase 0; C. Poynton, "Four-field NTSC sequence", 1997). The burst, at 180 degrees, then
 *   rises through zero at 0H of line 10, where SC/H phase is measured.
 * - PAL: 4433618.75 Hz, 283.7516 cycles a line of 864 samples; the same again after 4 frames.
 *   a = 0 at 0H of line 1 of field 1 of frame 0 (EBU D 23-1984: SC/H phase is that of the +U
 *   component of the burst there). The V switch is + on that line, the burst at 135 degrees,
 *   and alternates from line to line (BT.1700): it is + on lines of odd numbers in even frames
 *   and of even numbers in odd frames.
 * A line's first picture sample lies 122 samples (525 lines) or 132 (625) after 0H (BT.601-7).
 */
typedef enum wf_tv_system { WF_NTSC, WF_PAL } wf_tv_system;

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

#endif
