#ifndef WF_CONVERT_JOB_DELIVERY_H
#define WF_CONVERT_JOB_DELIVERY_H

#include "convert/job/output.h"

/* Deliveries: a codec in a container. A row says what the output takes, as other outputs do,
 * and what libavformat and libavcodec are told; the table needs neither library. */

/* Which rasters a codec takes, and what it makes of their lines. */
typedef struct wf_delivery_form {
    int width_px, lines; /* 0: any */
    unsigned rates;      /* WF_RATE_ bits; 0: any */
    unsigned scans;      /* WF_SCAN_ bits */
    int bits;            /* 0: any that the delivery takes */
    int64_t bit_rate;    /* a second; 0: the codec's own. DNxHD: which of its tables */
    int skip_lines;      /* dropped above the picture: an odd number changes the order */
    int kept_lines;      /* of what is left; 0: all */
    int above_lines;     /* of the vertical interval, black, coded above the picture */
    int64_t stated_rate; /* where the container is told another than the encoder; 0: the same */
    bool folds_chroma;   /* to 4:2:0 (color/codes/chroma_420.h); false: as it comes */
    const char *options; /* the encoder's, beside those of the delivery; NULL: none */
} wf_delivery_form;

enum { WF_SCAN_TOP = 1, WF_SCAN_BOTTOM = 2, WF_SCAN_WHOLE = 4 };
enum {
    WF_RATE_23_976 = 1,
    WF_RATE_24 = 2,
    WF_RATE_25 = 4,
    WF_RATE_29_97 = 8,
    WF_RATE_30 = 16,
    WF_RATE_50 = 32,
    WF_RATE_59_94 = 64,
    WF_RATE_60 = 128
};

typedef struct wf_delivery {
    wf_output_kind kind;         /* its name is the codec's, its ending the container's */
    const char *muxer;           /* libavformat's */
    const char *encoder;         /* libavcodec's; NULL: weft writes uncompressed codes itself */
    const char *encoder_options; /* "key=value:.."; NULL: none */
    const wf_delivery_form *forms; /* the first that fits is taken */
    size_t form_count;
    int pictures_a_group;      /* of pictures, at 25 frames a second; 0: every one is whole */
    unsigned sound_bytes;      /* 1u << bytes for each size of a sample that it takes */
    const char *sound_encoder; /* libavcodec's, in tracks of two channels, which loses
                                  something; NULL: samples are written as they are */
    bool one_audio_stream;     /* of all channels, 4 or 8 of them */
    bool constant;             /* bit rate */
    int threads;               /* where another number makes other bytes; 0: any */
    bool full_range;           /* is told to the reader, and so can be had */
    unsigned alpha_bits;       /* 1u << bits for each depth that has alpha; 0: none */
} wf_delivery;

/* By index, the default of each container first; NULL past the end. */
const wf_delivery *wf_delivery_at(size_t index);

/* The delivery of output's ending: of codec, or the container's default (NULL). NULL where the
 * ending is no container's, without an error, or where the codec does not go into it, with one
 * that says which do. */
const wf_delivery *wf_delivery_for(const char *output, const char *codec, bool *container,
                                   weft_error *err);

/* The form that takes the raster and the bits; NULL with an error that says which rasters it
 * takes. */
const wf_delivery_form *wf_delivery_form_for(const wf_delivery *delivery,
                                             const wf_output_options *options, weft_error *err);

/* Whether it takes so much sound, of so many bits; an error that says what it takes. */
weft_status wf_delivery_check_sound(const wf_delivery *delivery,
                                    const wf_output_options *options, weft_error *err);

/* How many tracks a sound of so many channels is given where nobody says: one each, and in
 * groups of four where the delivery has those. */
int wf_delivery_sound_tracks(const wf_delivery *delivery, int channels);

/* The raster as it is in the file: lines cut off and added, line map and order that follow. */
wf_raster wf_delivery_raster(const wf_delivery_form *form, const wf_raster *raster);

/* What QuickTime calls a codec that has a code of its own for every raster; {0}: libavformat
 * gives the code. */
typedef struct wf_delivery_mark {
    char tag[5];      /* of the sample description */
    const char *name; /* the same in words */
} wf_delivery_mark;
wf_delivery_mark wf_delivery_quicktime(const wf_delivery *delivery, const wf_raster *raster);

/* Words for --codec's help: "v210, prores, ..". */
void wf_delivery_codecs(char *text, size_t size);

#endif
