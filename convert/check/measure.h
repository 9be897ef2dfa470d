#ifndef WF_CONVERT_CHECK_MEASURE_H
#define WF_CONVERT_CHECK_MEASURE_H

#include "convert/read/video.h"

/* What interlace, its coding and its delivery do to a picture, in figures. Luminances are those
 * of the raster's display, white being 1. */

typedef enum wf_display_kind {
    WF_DISPLAY_BOB, /* each field stretched over the frame, line by line linearly */
    WF_DISPLAY_CRT, /* each field on its own lines; between them what is left of the other */
} wf_display_kind;

/* What is known to be on the picture; it makes sharpness measurable. */
typedef enum wf_chart {
    WF_CHART_NONE,
    WF_CHART_ZONEPLATE, /* examples/scenes/zoneplate.lua over the whole raster */
    WF_CHART_GRATING,   /* level, full contrast, sinusoidal in light */
} wf_chart;

typedef struct wf_measure_options {
    const wf_raster *raster; /* NULL: as the file says */
    const char *against;     /* the reference of `difference`; NULL: none */
    wf_display_kind display;
    wf_chart chart;
    double grating; /* cycles a frame line */
    bool want_heat;
    bool of_delivery; /* only what a delivery is held to: order and legality */
    size_t max_memory_bytes;
    weft_progress_fn *progress; /* called after every frame; NULL: nobody looks */
    void *progress_user;
} wf_measure_options;

/* One plane of one kind of lines, against the reference. */
typedef struct wf_plane_difference {
    double rmse, psnr, ssim;
} wf_plane_difference;

/* NaN: not measured, because the video has nothing that it could be measured of. */
typedef struct wf_figures {
    int64_t frames;
    wf_video_info info;
    double flicker_rms, flicker_p999; /* of half the difference of a frame's two fields */
    double flicker_share;             /* of the picture, where it is above 2 % */
    double sharpness;                 /* vertical response of the chart's, 1 at rest */
    /* sqrt(U^2 + V^2) that luma alone gains from cheap composite coding and a notch decoder,
     * and the luma that color alone gains, in units of Y'. */
    double cross_color_rms, cross_color_p999, cross_luma_rms, cross_luma_p999;
    const char *order_verdict;      /* NULL: a single frame has no order */
    double order_ratio;             /* total variation in time, bottom first over top first */
    double range_share, r103_share; /* of the picture outside them */
    double reserved_share; /* of the picture, with codes that are kept for synchronization */
    /* Against the reference; samples as shares of the largest code, so that PSNR has the peak
     * that is customary. */
    double rmse, psnr, ssim;
    wf_plane_difference plane[3][3]; /* [plane][whole frame, top field, bottom field] */
    const char *plane_name[3];       /* "y", "cb", "cr"; NULL: there is no reference */
    float *heat; /* [lines][width_px] RMS flicker; free(); NULL unless wanted */
} wf_figures;

/* Reads the video to its end and fills figures. WEFT_USAGE where what is asked does not fit
 * the file; WEFT_FAILED where the file is damaged, of odd height or of mixed sizes. */
weft_status wf_measure(const char *path, const wf_measure_options *options, wf_figures *figures,
                       weft_error *err);

/* One figure by its JSON name. */
typedef struct wf_figure_kind {
    const char *group, *key; /* "flicker", "rms"; key NULL: the group is the figure */
    const char *help;
    size_t offset;    /* of the double in wf_figures */
    bool more_better; /* a limit on it is the least that is allowed */
} wf_figure_kind;

/* The table, by index; NULL past the end. */
const wf_figure_kind *wf_figure_at(size_t index);
double wf_figure_value(const wf_figures *figures, const wf_figure_kind *kind);

#endif
