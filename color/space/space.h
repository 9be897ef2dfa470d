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

/* Linear RGB to CIE XYZ, white having Y = 1; whites other than D65 are adapted to it by
 * Bradford's matrix, as the builtin transforms of OpenColorIO are. */
void wf_rgb_to_xyz(wf_primaries primaries, double matrix[3][3]);

/* Linear RGB of one set of primaries to that of another. Rows add up to 1. */
void wf_rgb_to_rgb(wf_primaries from, wf_primaries to, double matrix[3][3]);

/* A space by its name in color/weft.ocio. */
typedef struct wf_space {
    const char *name, *alias; /* alias: another name, or NULL */
    wf_primaries primaries;
    const wf_curve *curve; /* NULL: scene-linear */
} wf_space;

/* Space i, NULL past the last. */
const wf_space *wf_space_at(size_t index);

/* The space of a name or alias, whatever its case; NULL with a reason, which lists the names
 * there are and points out one that is spelled alike. */
const wf_space *wf_space_find(const char *name, char *why, size_t why_size);

#endif
