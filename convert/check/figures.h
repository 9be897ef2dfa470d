#ifndef WF_CONVERT_CHECK_FIGURES_H
#define WF_CONVERT_CHECK_FIGURES_H

#include <stdbool.h>
#include <stddef.h>

#include "convert/read/video.h"

/* What interlace, its coding and its delivery do to a picture, in figures;
 * convert/check/README.md defines them. Luminances are those of the raster's display, white
 * being 1. */

/* One plane against the reference: all its lines, or those of one field. */
typedef struct wf_plane_difference {
    double rmse, psnr, ssim;
} wf_plane_difference;

/* NaN: not measured, because the video has nothing that it could be measured of. */
typedef struct wf_figures {
    int64_t frames;
    wf_video_info info;
    double flicker_rms, flicker_p999; /* of half the difference of a frame's two fields */
    double flicker_share;             /* of the picture, where it is above 2 % */
    /* What is seen of it, in just noticeable differences; the share where it is above 1. */
    double visible_jnd_p999, visible_share;
    /* Amplitude of what comes and goes at edges that drift by half a line a field, and the same
     * as it is seen. */
    double crawl_rms, crawl_p999, crawl_jnd_p999, crawl_share;
    double sharpness; /* vertical response to the chart, 1 where nothing is lost */
    /* sqrt(U^2 + V^2) that luma alone gains from cheap composite coding and a notch decoder,
     * and the luma that color alone gains, in units of Y'. */
    double cross_color_rms, cross_color_p999, cross_luma_rms, cross_luma_p999;
    const char *order_verdict; /* NULL: a single frame has no order */
    double order_ratio;        /* total variation in time, bottom first over top first */
    double order_agreement; /* share of the picture's regions that see the order; NaN: none */
    double range_share, r103_share; /* of the picture outside narrow range, outside EBU R 103 */
    double reserved_share;          /* of the picture that has codes kept for synchronization */
    /* Against the reference; samples as shares of the largest code, so that PSNR has the peak
     * that is customary. */
    double rmse, psnr, ssim;
    wf_plane_difference plane[3][3]; /* [plane][whole frame, top field, bottom field] */
    const char *plane_name[3];       /* "y", "cb", "cr"; NULL: there is no reference */
    float *heat; /* [lines][width_px] RMS flicker, of the kind asked for; free(); NULL unless
                    wanted */
} wf_figures;

/* One figure by its JSON name. */
typedef struct wf_figure_kind {
    const char *group, *key; /* "flicker.visible", "share"; key NULL: the group is the figure */
    const char *help;
    size_t offset;    /* of the double in wf_figures */
    bool more_better; /* a limit on it is the least that is allowed */
} wf_figure_kind;

/* The table, by index; NULL past the end. */
const wf_figure_kind *wf_figure_at(size_t index);
double wf_figure_value(const wf_figures *figures, const wf_figure_kind *kind);

#endif
