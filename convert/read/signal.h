#ifndef WF_CONVERT_READ_SIGNAL_H
#define WF_CONVERT_READ_SIGNAL_H

#include "convert/read/video.h"

/* A frame as a display and as a composite coder have it, whatever it was read from. Planes are
 * [lines][width_px], both fields woven. */
typedef struct wf_signal {
    int width_px, lines;
    float *light; /* luminance on the raster's display, white being 1; of linear light the
                     luminance by Rec. BT.709's weights as it is */
    /* 4:4:4 Y'CbCr by the raster's matrix. Subsampled chroma is brought back along the line by
     * the half-band of Rec. BT.601; linear light is encoded first, as the raster says and
     * through 4:2:2, without rounding to fewer than 16 bits. */
    float *ycbcr[3];
    /* The planes as they are coded: those of the frame, or what linear light was encoded to. */
    wf_video_frame coded;
    int across, down; /* of coded */
    bool fields;      /* its chroma lines, where they are fewer, are those of two fields */
    bool is_ycbcr;    /* coded holds Y' Cb Cr; false: R' G' B' */
} wf_signal;

/* The line of coded's chroma that goes with luma line y. */
int wf_signal_chroma_line(const wf_signal *signal, int y);

typedef struct wf_signals wf_signals; /* what makes them; one thread at a time */

/* Makes signals of video as info describes it. The linear light of EXR is scene-linear Rec.
 * 709. */
weft_status wf_signals_new(const wf_video_info *info, wf_signals **out, weft_error *err);
void wf_signals_free(wf_signals *signals); /* NULL is fine */

/* Allocates the planes of a signal, for wf_signals_take to fill. */
weft_status wf_signal_new(const wf_signals *signals, wf_signal **out, weft_error *err);
void wf_signal_free(wf_signal *signal); /* NULL is fine */

/* Fills signal from a frame. coded points into the frame, or into signals, until the next. */
void wf_signals_take(wf_signals *signals, const wf_video_frame *frame, wf_signal *signal);

#endif
