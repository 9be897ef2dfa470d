/* The table of figures, from which JSON, limits and what is printed take their names. */
#include "convert/check/figures.h"

#include <string.h>

#define FIGURE(member) offsetof(wf_figures, member)

static const wf_figure_kind figures_table[] = {
    {"flicker", "rms", "interline flicker: RMS", FIGURE(flicker_rms), false},
    {"flicker", "p999", "its 99.9th percentile", FIGURE(flicker_p999), false},
    {"flicker", "share", "share of the picture over 2 %", FIGURE(flicker_share), false},
    {"flicker.visible", "jnd_p999",
     "what is seen of it, in just noticeable differences (JND): the 99.9th percentile",
     FIGURE(visible_jnd_p999), false},
    {"flicker.visible", "share", "share of the picture over 1 JND", FIGURE(visible_share),
     false},
    {"crawl", "rms", "what comes and goes at edges that drift half a line a field: RMS",
     FIGURE(crawl_rms), false},
    {"crawl", "p999", "its 99.9th percentile", FIGURE(crawl_p999), false},
    {"crawl", "jnd_p999", "the same as it is seen, in JND", FIGURE(crawl_jnd_p999), false},
    {"crawl", "share", "share of the picture over 1 JND", FIGURE(crawl_share), false},
    {"sharpness", NULL, "vertical response of the chart's", FIGURE(sharpness), true},
    {"cross_color", "rms", "color that composite coding makes of luma: RMS",
     FIGURE(cross_color_rms), false},
    {"cross_color", "p999", "its 99.9th percentile", FIGURE(cross_color_p999), false},
    {"cross_luma", "rms", "luma that it makes of color: RMS", FIGURE(cross_luma_rms), false},
    {"cross_luma", "p999", "its 99.9th percentile", FIGURE(cross_luma_p999), false},
    {"order", "ratio", "total variation in time, bottom first over top first",
     FIGURE(order_ratio), false},
    {"order", "agreement", "share of the picture's regions that agree on the order",
     FIGURE(order_agreement), true},
    {"legal", "range_share", "share of the picture outside narrow range", FIGURE(range_share),
     false},
    {"legal", "r103_share", "share of the picture outside EBU R103", FIGURE(r103_share), false},
    {"difference", "rmse", "RMS difference, of the largest code", FIGURE(rmse), false},
    {"difference", "psnr", "peak signal over it, dB", FIGURE(psnr), true},
    {"difference", "ssim", "structural similarity", FIGURE(ssim), true},
};

const wf_figure_kind *wf_figure_at(size_t index) {
    return index < sizeof figures_table / sizeof *figures_table ? &figures_table[index] : NULL;
}

double wf_figure_value(const wf_figures *figures, const wf_figure_kind *kind) {
    double value;
    memcpy(&value, (const char *)figures + kind->offset, sizeof value);
    return value;
}
