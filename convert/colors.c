#include "convert/colors.h"

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

/* Where a space ends in -camera its transfer is that of the same name; the code points do not
 * tell a BT.1886 display's inverse from the camera's curve. Rec. BT.601's two matrices are one,
 * which QuickTime calls 6. */
wf_color_tags wf_color_tags_of(const char *space, wf_matrix matrix) {
    static const struct {
        const char *space;
        int primaries, transfer;
    } rows[] = {
        {"rec601-525", 6, 1}, {"rec601-625", 5, 1},  {"rec709", 1, 1},
        {"rec2020", 9, 14},   {"rec2100-pq", 9, 16}, {"rec2100-hlg", 9, 18},
    };
    static const int matrices[] = {
        [WF_601_525] = 6, [WF_601_625] = 6, [WF_709] = 1, [WF_2020] = 9};
    const char *own = wf_colors_of(matrix)->space,
               *dash = space ? strstr(space, "-camera") : NULL;
    size_t length = dash ? (size_t)(dash - space) : space ? strlen(space) : 0;
    size_t found = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!strcmp(rows[i].space, own)) found = i;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strlen(rows[i].space) == length && !strncmp(rows[i].space, space, length))
            found = i;
    return (wf_color_tags){rows[found].primaries, rows[found].transfer, matrices[matrix]};
}
