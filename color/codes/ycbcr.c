/* Lines of R'G'B' to Y'CbCr and back. */
#include "color/codes/ycbcr.h"

#include "color/line/line.h"

void wf_ycbcr_of_rgb(wf_luma luma, float *r_to_y, float *g_to_cb, float *b_to_cr,
                     size_t count) {
    wf_ycbcr weights = wf_ycbcr_of(luma);
    wf_line_ops_best()->ycbcr(&weights, r_to_y, g_to_cb, b_to_cr, count);
}

void wf_rgb_of_ycbcr(wf_luma luma, float *y_to_r, float *cb_to_g, float *cr_to_b,
                     size_t count) {
    wf_ycbcr w = wf_ycbcr_of(luma);
    float kg = 1 - w.kr - w.kb;
    for (size_t i = 0; i < count; i++) {
        float y = y_to_r[i], r = y + cr_to_b[i] / w.cr_scale, b = y + cb_to_g[i] / w.cb_scale;
        y_to_r[i] = r;
        cb_to_g[i] = (y - w.kr * r - w.kb * b) / kg;
        cr_to_b[i] = b;
    }
}
