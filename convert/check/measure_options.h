#ifndef WF_CONVERT_CHECK_MEASURE_OPTIONS_H
#define WF_CONVERT_CHECK_MEASURE_OPTIONS_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "color/codes/display.h"
#include "convert/finish/crew.h"
#include "convert/weft.h"
#include "filters/raster/raster.h"

typedef enum wf_display_kind {
    WF_DISPLAY_BOB,   /* each field stretched over the frame, line by line linearly */
    WF_DISPLAY_CRT,   /* each field on its own lines; between them what is left of the other */
    WF_DISPLAY_BWDIF, /* a picture a field by FFmpeg's deinterlacer of the name, as the next */
    WF_DISPLAY_YADIF,
    WF_DISPLAY_W3FDIF,
} wf_display_kind;

/* "bob", "crt", "bwdif" .. Static storage. */
const char *wf_display_name(wf_display_kind kind);

/* What the heat map shows. */
typedef enum wf_heat_kind { WF_HEAT_FLICKER, WF_HEAT_VISIBLE, WF_HEAT_CRAWL } wf_heat_kind;

/* What is known to be on the picture; it makes sharpness measurable. */
typedef enum wf_chart {
    WF_CHART_NONE,
    WF_CHART_ZONEPLATE, /* examples/scenes/zoneplate.lua over the whole raster */
    WF_CHART_GRATING,   /* level, full contrast, sinusoidal in light */
} wf_chart;

typedef struct wf_measure_options {
    const wf_raster *raster;     /* NULL: as the file says */
    const wf_transfer *transfer; /* of the display it is made for; NULL: as the file says */
    const char *against;         /* the reference of `difference`; NULL: none */
    wf_display_kind display;
    wf_chart chart;
    double grating;      /* cycles a frame line */
    double view_heights; /* how far the eye is, in heights of the picture; 0: as usual */
    double peak_cd_m2;   /* the luminance of white; 0: as usual */
    bool want_heat;
    wf_heat_kind heat;
    int64_t first_frame, frame_count; /* which to measure; count 0: all from the first on */
    bool of_delivery;                 /* only what a delivery is held to: order and legality */
    size_t max_memory_bytes;
    wf_crew *crew; /* whose threads share the work; NULL: the caller's alone. Figures are the
                      same for any */
    weft_progress_fn *progress; /* called after every frame; NULL: nobody looks */
    void *progress_user;
    const char *stage; /* what progress is told of; NULL: "measure". Static storage */
    const volatile sig_atomic_t *canceled; /* looked at before every frame; NULL: nobody asks */
} wf_measure_options;

#endif
