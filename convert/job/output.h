#ifndef WF_CONVERT_JOB_OUTPUT_H
#define WF_CONVERT_JOB_OUTPUT_H

#include "color/space/space.h"
#include "convert/base/fail.h"
#include "filters/raster/raster.h"

/* Outputs as a job asks for them: what kinds there are, and what one is told of a run. How they
 * are written is convert/write. */

/* Samples of a frame: linear light as floats, R'G'B' codes or Y'CbCr codes. */
typedef enum wf_layout { WF_LINEAR, WF_RGB, WF_YCBCR } wf_layout;

/* One kind of output. */
typedef struct wf_output_kind {
    const char *name;    /* of a delivery the codec's, as --codec has it */
    const char *endings; /* "y4m -", blank separated; sequences: "exr" */
    const char *help;    /* one line for people */
    wf_layout layout;    /* the layout it takes by default */
    unsigned bits_mask;  /* 1u << bits for each depth it takes */
    int default_bits;
    bool full_range; /* default range */
    bool sequence;   /* one file a frame, named by a pattern */
    bool joins;      /* chunks of it can be joined by cat, or are files of their own */
    bool fixed_422;  /* 4:2:2 is the only sampling it takes */
    bool fixed_444;  /* 4:4:4 is */
    bool container;  /* holds sound beside the picture */
    unsigned
        fills; /* 1u << wf_fill for each way that color may lie beside alpha; 0: no alpha */
} wf_output_kind;

/* Sound beside the picture, as a sink takes it: frame after frame from its first on, so many
 * samples of each as wf_sound_samples says. */
typedef struct wf_sound_feed {
    int tracks; /* 0: there is no sound */
    int bits;   /* of a sample as it is written */
    /* Fills to[count][tracks] with the next samples at WF_SOUND_RATE: 32 bits of which the
     * lower 32 - bits are 0. NULL: it is silent. */
    weft_status (*read)(void *self, int32_t *to, int64_t count, weft_error *err);
    void *self; /* borrowed */
} wf_sound_feed;

/* What an output is given for the whole run. Strings are borrowed. */
typedef struct wf_output_options {
    const char *output; /* as the user wrote it */
    const wf_raster *raster;
    wf_layout layout;
    int bits; /* of the codes; 32 for WF_LINEAR */
    bool full_range;
    bool subsampled;                    /* 4:2:2; false: 4:4:4 */
    bool alpha;                         /* frames have a plane of it */
    bool straight;                      /* and color is not multiplied by it */
    int64_t first_frame;                /* of this chunk of the run */
    int64_t frame_count;                /* -1: not known before the end */
    bool separate_fields;               /* sequences: a file a field */
    bool stream_header;                 /* false: a later chunk, to be joined by cat */
    bool chunked;                       /* one of several chunks, of which each has files */
    const char *timecode;               /* of frame 0; validated */
    const char *date;                   /* containers: validated; NULL: unknown */
    const char *color_space;            /* what the codes are in, for metadata; "" if unknown */
    const wf_chromaticities *primaries; /* of light; NULL: what color_space tells of them */
    wf_rational subframe_rate;          /* "frames" are subframes; {0, 0}: they are frames */
    const char *codec;   /* containers: what is coded; NULL: the container's default */
    wf_sound_feed sound; /* containers */
    int threads;         /* that an encoder may use; 0: all */
    bool overwrite, resume;
} wf_output_options;

/* Files a frame of a sequence: frame n is files n * this and on, in order of time. */
static inline int wf_output_files(const wf_output_options *options) {
    return options->separate_fields ? 2 : 1;
}

#endif
