#ifndef WF_CONVERT_VIDEO_H
#define WF_CONVERT_VIDEO_H

#include "color/display.h"
#include "convert/fail.h"
#include "convert/sink.h"

/* Finished video read back, frame by frame and as signals, for what measures or decodes it:
 * Y4M, raw v210 and uyvy, pictures and sequences of them and, through the libav module where it
 * is there, whatever else. One thread at a time. */

typedef struct wf_video_options {
    const wf_raster *raster; /* what it is, as the user says; NULL: as the file says */
    size_t max_memory_bytes; /* of one picture */
} wf_video_options;

typedef struct wf_video_info {
    char format[96]; /* for people: "Y4M 422p10" */
    int width_px, lines;
    int interval_lines; /* of the vertical interval, coded above these and not read (D-10) */
    wf_layout layout;   /* WF_LINEAR: EXR; WF_RGB: other pictures */
    int bits;           /* of a code; 32: floats; 16 for pictures of unknown depth */
    bool full_range;
    int planes;           /* 3, or 1: a lone Y, beside which Cb and Cr are 0 */
    wf_transfer transfer; /* of the display it is made for */
    int across, down;     /* luma samples to a chroma sample: 1 1, 2 1, 2 2, 4 1 */
    wf_raster raster;     /* named by size, rate and label; with the user's or a made up name
                             where none fits */
    bool scan_known;      /* the file or the user says how it is scanned: raster.scan is not a
                             guess */
    int64_t frames;       /* -1: not known before the end */
} wf_video_info;

/* Planes R G B or Y Cb Cr, width_px[p] x lines[p], top line first, both fields woven. Signals:
 * R'G'B' and Y' from 0 to 1, Cb and Cr from -1/2 to 1/2, linear light as it is. */
typedef struct wf_video_frame {
    float *plane[3];
    int width_px[3], lines[3];
    int64_t index; /* from 0 */
} wf_video_frame;

typedef struct wf_video wf_video;

/* Opens a file, a pattern or a directory of pictures, or "-" for Y4M on standard input, and
 * reads what it says of itself. */
weft_status wf_video_open(const char *path, const wf_video_options *options, wf_video **out,
                          weft_error *err);
const wf_video_info *wf_video_info_of(const wf_video *video);

/* The next frame, owned by the video and valid until the next call; NULL after the last. A file
 * that ends within a frame, or a picture of another size, is an error that says which. */
weft_status wf_video_next(wf_video *video, const wf_video_frame **frame, weft_error *err);
void wf_video_close(wf_video *video); /* NULL is fine */

#endif
