#ifndef WF_COLOR_SPACE_SPACE_H
#define WF_COLOR_SPACE_SPACE_H

#include <stdbool.h>
#include <stddef.h>

#include "color/line/curve.h"

typedef enum wf_primaries {
    WF_PRIMARIES_709,
    WF_PRIMARIES_SMPTE_C,
    WF_PRIMARIES_EBU,
    WF_PRIMARIES_2020,
    WF_PRIMARIES_P3,
    WF_PRIMARIES_AP0,
    WF_PRIMARIES_AP1,
    WF_PRIMARIES_COUNT,
} wf_primaries;

/* CIE 1931 chromaticities, and where they are written down. */
typedef struct wf_chromaticities {
    const char *name, *source;
    double red[2], green[2], blue[2], white[2]; /* x, y */
} wf_chromaticities;

extern const wf_chromaticities wf_chromaticities_of[WF_PRIMARIES_COUNT];

/* The same of a code point of Rec. ITU-T H.273 table 2; NULL if it names none. */
const wf_chromaticities *wf_chromaticities_of_code_point(int code_point);

/* Whether colors can be told from them: finite, no primary on the line of the two others,
 * white with a luminance. */
bool wf_chromaticities_usable(const wf_chromaticities *primaries);

/* The known primaries that these are, to the four digits that files hold; WF_PRIMARIES_COUNT
 * if none. */
wf_primaries wf_primaries_like(const wf_chromaticities *primaries);

/* Linear RGB to CIE XYZ, white having Y = 1; whites other than D65 are adapted to it by
 * Bradford's matrix, as the builtin transforms of OpenColorIO are. */
void wf_rgb_to_xyz(wf_primaries primaries, double matrix[3][3]);

/* Linear RGB of one set of primaries to that of another. Rows add up to 1. */
void wf_rgb_to_rgb(wf_primaries from, wf_primaries to, double matrix[3][3]);

/* The same for any usable ones. */
void wf_rgb_matrix(const wf_chromaticities *from, const wf_chromaticities *to,
                   double matrix[3][3]);

/* A space by its name in color/weft.ocio. */
typedef struct wf_space {
    const char *name, *alias; /* alias: another name, or NULL */
    wf_primaries primaries;
    const wf_curve *curve; /* NULL: scene-linear */
} wf_space;

/* The scene-linear space of these primaries; NULL: it has no name. */
const wf_space *wf_space_linear(wf_primaries primaries);

/* Space i, NULL past the last. */
const wf_space *wf_space_at(size_t index);

/* The space of a name or alias, whatever its case; NULL with a reason, which lists the names
 * there are and points out one that is spelled alike. */
const wf_space *wf_space_find(const char *name, char *why, size_t why_size);

#endif
