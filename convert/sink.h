#ifndef WF_CONVERT_SINK_H
#define WF_CONVERT_SINK_H

#include "convert/fail.h"
#include "filters/raster.h"

typedef enum wf_layout { WF_LINEAR, WF_RGB, WF_YCBCR } wf_layout;

/* What a sink is given for the whole run. Strings are borrowed. */
typedef struct wf_sink_options {
    const char *output; /* as the user wrote it */
    const wf_raster *raster;
    wf_layout layout;
    int bits; /* of the codes; 32 for WF_LINEAR */
    bool full_range;
    bool subsampled;     /* 4:2:2; false: 4:4:4 */
    int64_t first_frame; /* of this chunk of the run */
    int64_t frame_count;
    bool separate_fields;      /* sequences: a file a field */
    bool stream_header;        /* false: a later chunk, to be joined by cat */
    const char *timecode;      /* of frame 0; validated */
    const char *color_space;   /* what the codes are in, for metadata; "" if unknown */
    wf_rational subframe_rate; /* "frames" are subframes; {0, 0}: they are frames */
    const char *codec;         /* containers: what is coded; NULL: the container's default */
    int silent_tracks;         /* containers: of sound */
    int threads;               /* that an encoder may use; 0: all */
    bool overwrite, resume;
} wf_sink_options;

/* One finished frame, both fields woven, top line first. Planes are R G B or Y Cb Cr, each line
 * stride[p] samples after the last. Codes are uint16_t, WF_LINEAR is float. */
typedef struct wf_frame {
    const void *plane[3];
    size_t stride[3];
    int64_t index; /* from 0 in the whole run, chunk or not */
} wf_frame;

typedef struct wf_sink wf_sink;

/* How many bytes a run will write, as far as that can be told before. */
typedef enum wf_size_known {
    WF_SIZE_UNKNOWN,
    WF_SIZE_EXACT,
    WF_SIZE_ABOUT, /* within some percent */
    WF_SIZE_MOST   /* before compression */
} wf_size_known;

typedef struct wf_sink_size {
    int64_t bytes;
    wf_size_known known;
} wf_sink_size;

/* One kind of output: a row of the registry. A sink is driven by one thread at a time. */
typedef struct wf_sink_kind {
    const char *name;
    const char *endings; /* "y4m -", blank separated; sequences: "exr" */
    const char *help;    /* one line for people */
    wf_layout layout;    /* the layout it takes by default */
    unsigned bits_mask;  /* 1u << bits for each depth it takes */
    int default_bits;
    bool full_range; /* default range */
    bool sequence;   /* one file a frame, named by a pattern */
    bool joins;      /* chunks of it can be joined by cat, or are files of their own */
    bool fixed_422;  /* 4:2:2 is the only sampling it takes */
    /* Whether it takes all of that, before anything is read; NULL: it does. */
    weft_status (*check)(const wf_sink_options *options, weft_error *err);
    /* What it will change without being asked to, for people; "": nothing. NULL: nothing. */
    void (*tell)(const wf_sink_options *options, char *text, size_t size);
    /* Bytes of `frames` frames; NULL: not known. */
    wf_sink_size (*size)(const wf_sink_options *options, int64_t frames);
    weft_status (*open)(const wf_sink_options *options, wf_sink **out, weft_error *err);
    weft_status (*write)(wf_sink *sink, const wf_frame *frame, weft_error *err);
    weft_status (*commit)(wf_sink *sink,
                          weft_error *err); /* sync, rename; frees sink in any case */
    void (*abandon)(wf_sink *sink);         /* removes what is unfinished, frees */
} wf_sink_kind;

/* The registry, by index; NULL past the end. */
const wf_sink_kind *wf_sink_at(size_t index);

/* The kind that an output's name asks for and, in a container, the codec (NULL: its default);
 * NULL with an error that lists what there is. */
const wf_sink_kind *wf_sink_for(const char *output, const char *codec, weft_error *err);

/* What the kind says of that, {0} where it does not. */
wf_sink_size wf_sink_size_of(const wf_sink_kind *kind, const wf_sink_options *options,
                             int64_t frames);

/* Files a frame of a sequence: frame n is files n * this and on, in order of time. */
int wf_sink_files(const wf_sink_options *options);

/* Whether file `frame` is already there, whole (sequences), or the whole output is (index < 0).
 */
bool wf_sink_present(const wf_sink_kind *kind, const char *output, int64_t frame);

#endif
