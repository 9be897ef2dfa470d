#ifndef WF_CONVERT_VIDEO_KINDS_H
#define WF_CONVERT_VIDEO_KINDS_H

#include "color/encoder.h"
#include "convert/video.h"

/* Inside the reading of video: what each kind of file has to do. */

/* What a file says of how its frames are scanned and how fast they follow each other. */
typedef struct wf_video_label {
    bool scan_known, interlaced, top_first;
    wf_rational rate, aspect; /* {0, 0}: not said */
    const char *raster;       /* weft:raster; NULL or "": not said */
    bool matrix_known;        /* else it is the raster\'s */
    wf_matrix matrix;
    wf_transfer transfer;
} wf_video_label;

typedef struct wf_video_kind {
    /* Fills info but for its raster, and label, which may borrow from the state. */
    weft_status (*open)(wf_video *video, wf_video_label *label, weft_error *err);
    /* Fills the frame's planes; *more is false, and nothing read, after the last. */
    weft_status (*next)(wf_video *video, bool *more, weft_error *err);
    void (*close)(wf_video *video); /* after open, whatever it returned */
} wf_video_kind;

struct wf_video {
    const wf_video_kind *kind;
    char *path;
    wf_video_options options;
    wf_video_info info;
    wf_video_frame frame;
    void *state; /* the kind's */
};

extern const wf_video_kind wf_video_y4m, wf_video_raw, wf_video_pictures, wf_video_libav;

/* Codes of a line of a plane to signals, into the frame. */
void wf_video_take_codes(wf_video *video, int plane, int line, const uint16_t *code);

weft_status wf_video_no_memory(const wf_video *video, weft_error *err);

#endif
