/* The table of luma weights, from which the Y'CbCr matrices follow. */
#include "color/line/luma.h"

static const struct {
    double kr, kb;
} weights[] = {
    [WF_LUMA_601] = {0.299, 0.114},
    [WF_LUMA_709] = {0.2126, 0.0722},
    [WF_LUMA_2020] = {0.2627, 0.0593},
};

wf_ycbcr wf_ycbcr_of(wf_luma luma) {
    double kr = weights[luma].kr, kb = weights[luma].kb;
    return (wf_ycbcr){.kr = (float)kr,
                      .kb = (float)kb,
                      .cb_scale = (float)(0.5 / (1 - kb)),
                      .cr_scale = (float)(0.5 / (1 - kr))};
}
