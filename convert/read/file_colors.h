#ifndef WF_CONVERT_READ_FILE_COLORS_H
#define WF_CONVERT_READ_FILE_COLORS_H

#include "color/space/decode.h"
#include "convert/job/taken.h"
#include "convert/media/image.h"

/* What a file's samples are taken for, by what the file says of itself. */
typedef struct wf_file_colors {
    wf_chromaticities primaries; /* usable */
    bool primaries_said;         /* false: Rec. 709's, for want of anything else */
    bool transfer_said;
    wf_decoding decoding;
    char trouble[320]; /* why they cannot be brought to light without --from; "" if they can */
    char warning[320]; /* what may be wrong about it; "": nothing */
} wf_file_colors;

/* EXR, HDR and float TIFF are light, of the primaries that weft:colorSpace, colorInteropID or
 * chromaticities name. PNG goes by cICP, then sRGB, then gAMA and cHRM; DPX by its transfer
 * field; what says nothing is sRGB. */
wf_file_colors wf_file_colors_of(const wf_color_said *said);

/* The name of the space that they are in ("ACEScg", "sRGB"), or the chromaticities. */
void wf_file_colors_name(const wf_file_colors *colors, char *text, size_t size);

/* Adds "space" and "transfer". */
void wf_file_colors_take(const wf_file_colors *colors, wf_taken_list *list);

/* Whether two files' samples are taken for the same. */
bool wf_file_colors_same(const wf_file_colors *a, const wf_file_colors *b);

#endif
