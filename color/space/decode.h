#ifndef WF_COLOR_SPACE_DECODE_H
#define WF_COLOR_SPACE_DECODE_H

#include <stdbool.h>

#include "color/space/space.h"
#include "color/space/transform.h"

/* R'G'B' to light: what is encoded is decoded before it is filtered. Light keeps the primaries
 * that R'G'B' had, and 1 is reference white as everywhere in color/. */

/* How encoded samples become R'G'B' and that light: signal = scale sample + offset, decoded by
 * the curve. */
typedef struct wf_decoding {
    wf_curve curve;
    bool encoded; /* false: the signal is light, and the curve does not count */
    float scale, offset;
} wf_decoding;

/* The decoding of samples that are R'G'B' of this curve. NULL: they are light. */
wf_decoding wf_decoding_of(const wf_curve *curve);

/* The decoding that a transfer characteristic of Rec. ITU-T H.273 table 3 asks for: those of
 * cameras (1, 6, 11, 12, 14, 15) are decoded as their display does, by BT.1886. False for code
 * points that name none (2 is unspecified) or that are logarithmic (9, 10). */
bool wf_decoding_of_code_point(int code_point, wf_decoding *out);

/* For people: "BT.1886", "sRGB", "PQ", "HLG", "linear", "gamma 2.2", "power". Static storage or
 * text. */
const char *wf_decoding_name(const wf_decoding *decoding, char text[24]);

/* Decodes three planes in place, as a transform whose self is released by its free. False: no
 * memory. A decoding that changes nothing gives a transform that does nothing. */
bool wf_decoding_changes(const wf_decoding *decoding);
bool wf_decoding_transform(const wf_decoding *decoding, wf_transform *out);

#endif
