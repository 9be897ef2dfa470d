#ifndef WF_CONVERT_MEDIA_METADATA_H
#define WF_CONVERT_MEDIA_METADATA_H

#include "convert/base/fail.h"
#include "convert/job/colors.h"
#include "filters/raster/raster.h"

/* What is in a file, counted packet by packet. */
typedef struct wf_contents {
    int64_t packets, bytes;          /* of the picture */
    int64_t least_bytes, most_bytes; /* of a packet */
    int64_t fields;      /* that the packets are shown for: two of a frame, repeated ones too */
    int64_t lone_fields; /* packets of a single field */
    int64_t hidden;      /* packets that an edit list leaves out */
    int64_t repeated;    /* packets that are shown for more than two */
    bool types_known;
    int64_t whole, between, longest_group; /* I and B pictures; from one I to the next */
    int sounds;                            /* streams */
    double sound_least_s, sound_most_s;
    double sound_block_s; /* how exact that is: blocks of coded sound at its ends */
} wf_contents;

/* What a delivered file says of itself, in its container and its streams; nothing here is
 * looked up in pixels. */
typedef struct wf_metadata {
    char container[16]; /* libavformat's name: "mov", "mxf", "matroska" */
    bool of_mpeg4;      /* "mov" with the brand of MP4 and its kin, not of QuickTime */
    char codec[24], profile[48], pixels[24];
    int64_t bit_rate;     /* a second, as the stream says; 0: not said */
    int level;            /* of the codec, as libavcodec numbers it */
    char sound_codec[24]; /* of the first stream of sound */
    int width_px, lines;  /* as coded */
    wf_rational rate, pixel_aspect;
    bool scan_known, interlaced, top_first;
    bool coded_fields, coded_top_first; /* the first frame is coded as fields, in this order */
    bool tagged;                        /* the next three are said */
    wf_color_tags tags;
    int64_t frames;    /* -1: not said */
    double start_s;    /* when its first picture is shown; 0: at the beginning, or not said */
    double video_s;    /* how long the video is; 0: not said */
    char timecode[32]; /* of the first frame, as it is written; "": none */
    int timecode_base; /* labels a second, of QuickTime's and MXF's; 0: not said */
    bool timecode_drop;
    int sound_streams, sound_channels, sound_rate, sound_bits;
    double sound_s; /* the shortest of them; 0: not said */
    wf_contents there;

    bool has_fiel, has_pasp, has_colr, has_clap; /* QuickTime's atoms */
    int fiel[2];
    int64_t clean[2];  /* width and lines of clap, in 65536ths */
    int graphics_mode; /* of the picture, as vmhd has it */

    bool has_line_map; /* MXF */
    int line_map[2];
    int frame_layout;   /* -1: none */
    int dominance;      /* the field that is first in time; -1: none */
    int siting;         /* of chroma; -1: none */
    wf_rational aspect; /* of the picture; {0, 0}: none */
    char pattern[8];    /* "OP1a"; "": no header */
} wf_metadata;

/* wf_libav_metadata, an entry point of the libav module. */
typedef weft_status wf_libav_metadata_fn(const char *path, wf_metadata *metadata,
                                         weft_error *err);

#endif
