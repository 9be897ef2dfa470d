/* What colors a raster's video is in, and what files call them. */
#include "convert/job/colors.h"

#include <string.h>

const wf_colors *wf_colors_of(wf_matrix matrix) {
    static const wf_colors rows[] = {
        [WF_601_525] = {"rec601-525", WF_LUMA_601, WF_PRIMARIES_SMPTE_C},
        [WF_601_625] = {"rec601-625", WF_LUMA_601, WF_PRIMARIES_EBU},
        [WF_709] = {"rec709", WF_LUMA_709, WF_PRIMARIES_709},
        [WF_2020] = {"rec2020", WF_LUMA_2020, WF_PRIMARIES_2020},
    };
    return &rows[matrix];
}

static const struct {
    const char *space;
    int primaries, transfer;
} tagged[] = {
    {"rec601-525", 6, 1}, {"rec601-625", 5, 1},  {"rec709", 1, 1},
    {"rec2020", 9, 14},   {"rec2100-pq", 9, 16}, {"rec2100-hlg", 9, 18},
};

enum { TAGGED = sizeof tagged / sizeof *tagged };

/* The row of a space; TAGGED if it has none. A space that ends in -camera has the row of the
 * same name without it, since code points do not tell a BT.1886 display's inverse from the
 * camera's curve. */
static size_t find_tags(const char *space) {
    const char *dash = space ? strstr(space, "-camera") : NULL;
    size_t length = dash ? (size_t)(dash - space) : space ? strlen(space) : 0, i = 0;
    while (i < TAGGED && (strlen(tagged[i].space) != length ||
                          strncmp(tagged[i].space, space ? space : "", length)))
        i++;
    return i;
}

bool wf_color_has_tags(const char *space) {
    return find_tags(space) < TAGGED;
}

wf_matrix wf_color_matrix_of(const char *space, wf_matrix of_raster) {
    return space && !strncmp(space, "rec2100-", 8) ? WF_2020 : of_raster;
}

wf_transfer wf_color_transfer_of(const char *space) {
    enum { PQ = 16, HLG = 18 }; /* of Rec. ITU-T H.273 */
    size_t row = find_tags(space);
    int transfer = row < TAGGED ? tagged[row].transfer : 0;
    return transfer == PQ    ? WF_TRANSFER_PQ
           : transfer == HLG ? WF_TRANSFER_HLG
                             : WF_TRANSFER_BT1886;
}

/* Both systems of Rec. BT.601 have one matrix, whose code point is 6 in QuickTime. */
wf_color_tags wf_color_tags_of(const char *space, wf_matrix matrix) {
    static const int matrices[] = {
        [WF_601_525] = 6, [WF_601_625] = 6, [WF_709] = 1, [WF_2020] = 9};
    size_t found = find_tags(space);
    matrix = wf_color_matrix_of(space, matrix);
    if (found == TAGGED) found = find_tags(wf_colors_of(matrix)->space);
    return (wf_color_tags){tagged[found].primaries, tagged[found].transfer, matrices[matrix]};
}
