#ifndef WF_CONVERT_MEDIA_VIDEO_KIND_H
#define WF_CONVERT_MEDIA_VIDEO_KIND_H

#include <stdio.h>

#include "color/codes/display.h"
#include "convert/base/fail.h"
#include "convert/job/choices.h"
#include "convert/job/output.h"

/* Finished video as it is read, and what each kind of file has to do for it. */

typedef struct wf_video_options {
    const wf_raster *raster;     /* what it is, as the user says; NULL: as the file says */
    const wf_transfer *transfer; /* of the display it is made for; NULL: as the file says */
    size_t max_memory_bytes;     /* of one picture */
    bool want_times;             /* of all pictures: info.times is filled where there are any */
    bool codes_only;             /* wf_video_next is not called */
    bool progressive_only;       /* a later frame that says that it is interlaced is an error */
    bool want_alpha;             /* as a fourth plane of codes, where there is some */
    bool mends; /* pictures that cannot be decoded are given as missing, instead of an error */
} wf_video_options;

/* Where chroma lies among the luma samples that share it: with the first of a line and, where
 * it is of two lines, between these; amid all of them; with the first of all. */
typedef enum wf_siting { WF_SITING_LEFT, WF_SITING_CENTER, WF_SITING_TOP_LEFT } wf_siting;

/* What a stream is tagged with: code points of Rec. ITU-T H.273, 2 where it does not say. */
typedef struct wf_video_tags {
    int primaries, transfer, matrix;
    bool range_said;
    wf_siting siting; /* where it says nothing, that of its kind of stream */
    bool pictures;    /* a file of animated pictures: they are sRGB where it says nothing */
} wf_video_tags;

typedef struct wf_video_info {
    char format[96]; /* for people: "Y4M 422p10" */
    int width_px, lines;
    int interval_lines; /* of the vertical interval, coded above these and not read (D-10) */
    wf_layout layout;   /* WF_LINEAR: EXR; WF_RGB: other pictures */
    int bits;           /* of a code; 32: floats; 16 for pictures of unknown depth */
    bool full_range;
    bool alpha;           /* there is some: read as codes of full range, if it is wanted */
    bool alpha_lost;      /* there is some that this decoder does not show */
    wf_alpha alpha_said;  /* how the file says that color lies beside it; WF_ALPHA_UNSET: not */
    int videos;           /* streams of video, of which the first is read; 0: not counted */
    int planes;           /* 3, or 1: a lone Y, beside which Cb and Cr are 0 */
    wf_transfer transfer; /* of the display it is made for */
    int across, down;     /* luma samples to a chroma sample: 1 1, 2 1, 2 2, 4 1 */
    wf_raster raster;     /* named by size, rate and label; with the user's or a made up name
                             where none fits */
    bool scan_known;      /* the file or the user says how it is scanned: raster.scan is not a
                             guess */
    int64_t frames;       /* -1: not known before the end */
    bool separate;        /* each field is a file of its own */
    wf_video_tags tags;
    wf_rational rate, aspect;  /* as the file says; {0, 0}: it does not */
    bool interlaced;           /* as the file says */
    char timecode[16];         /* of the first picture, as the file says; "": it does not */
    wf_rational timecode_rate; /* labels a second; {0, 0}: it does not say */
    /* Where want_times asked for them and the file has them: when each picture is shown, in
     * ticks from any zero, ascending, [frames]. Owned by the video. */
    int64_t *times;
    int64_t back; /* the picture, as coded, before which timestamps run backwards; 0: none */
    int64_t last_ticks; /* how long the last of them is shown; 0: that is not said */
    wf_rational tick_s;
} wf_video_info;

/* Planes R G B or Y Cb Cr, width_px[p] x lines[p], top line first, both fields woven. Signals:
 * R'G'B' and Y' from 0 to 1, Cb and Cr from -1/2 to 1/2, linear light as it is. */
typedef struct wf_video_frame {
    float *plane[3];
    int width_px[4], lines[4]; /* of alpha too */
    int64_t index;             /* from 0 */
    bool timed;                /* it says when it is shown: */
    int64_t ticks;             /* from any zero, of info.tick_s */
    int64_t lasts;             /* ticks; 0: it does not say */
    bool missing;              /* it could not be decoded, and these are its neighbor's codes */
} wf_video_frame;

/* What was not as it should be, of the pictures that were given so far. */
typedef struct wf_video_troubles {
    weft_error missing; /* where pictures are missing: with the first of them, why; else "" */
    bool cut;           /* it ended before what it says is its end, which nothing fills up */
    int64_t complaints; /* of the decoder, which has shown pictures all the same; the first: */
    int64_t complained_at; /* about this picture */
} wf_video_troubles;

typedef struct wf_video wf_video;

/* How many planes of codes are taken, alpha being the plane 3; a lone Y is one of three. */
int wf_video_planes(const wf_video_options *options, const wf_video_info *info);

/* How many bytes a code is kept in: 1 where it has 8 bits or fewer, else 2. */
size_t wf_video_code_bytes(const wf_video_info *info);

/* What a file says of how its frames are scanned and how fast they follow each other. */
typedef struct wf_video_label {
    bool scan_known, interlaced, top_first;
    wf_rational rate, aspect; /* {0, 0}: not said */
    const char *raster;       /* weft:raster; NULL or "": not said */
    bool matrix_known;        /* else it is the raster's */
    wf_matrix matrix;
    wf_transfer transfer;
} wf_video_label;

typedef struct wf_video_kind {
    /* Fills info but for its raster, and label, which may borrow from the state. */
    weft_status (*open)(wf_video *video, wf_video_label *label, weft_error *err);
    /* Fills the frame's planes; *more is false, and nothing read, after the last. */
    weft_status (*next)(wf_video *video, bool *more, weft_error *err);
    /* Goes to `picture`, or to one before it: frame.index becomes that of the one before the
     * next. NULL: it reads on from where it is. */
    weft_status (*seek)(wf_video *video, int64_t picture, weft_error *err);
    void (*close)(wf_video *video); /* after open, whatever it returned */
} wf_video_kind;

struct wf_video {
    const wf_video_kind *kind;
    char *path;
    FILE *pipe; /* what cannot be opened twice, its first byte unread; NULL: a file */
    wf_video_options options;
    wf_video_info info;
    wf_video_frame frame;
    /* Codes are wanted instead of signals: where each plane of them goes, [lines][width_px] of
     * wf_video_code_bytes each; NULL: nowhere, the frame is passed over. */
    bool take_codes;
    void *code[4];
    wf_video_troubles troubles;
    void *state; /* the kind's */
};

/* Takes the codes of a line of a plane: as signals into the frame, or where codes are wanted,
 * there. */
void wf_video_take_codes(wf_video *video, int plane, int line, const uint16_t *code);

/* The same of a line of bytes, where codes are wanted and have one. */
void wf_video_take_bytes(wf_video *video, int plane, int line, const uint8_t *code);

/* Whether a frame of info's size is allowed: measuring takes about twelve floats a pixel. */
weft_status wf_video_check_memory(const wf_video *video, weft_error *err);

/* Notes why a picture is missing, if it is the first. */
void wf_video_note_trouble(wf_video *video, const weft_error *why);

weft_status wf_video_no_memory(const wf_video *video, weft_error *err);

#endif
