#include "convert/colors.h"

const wf_colors *wf_colors_of(wf_matrix matrix) {
    static const wf_colors rows[] = {
        [WF_601_525] = {"rec601-525", WF_LUMA_601, WF_PRIMARIES_SMPTE_C},
        [WF_601_625] = {"rec601-625", WF_LUMA_601, WF_PRIMARIES_EBU},
        [WF_709] = {"rec709", WF_LUMA_709, WF_PRIMARIES_709},
        [WF_2020] = {"rec2020", WF_LUMA_2020, WF_PRIMARIES_2020},
    };
    return &rows[matrix];
}
