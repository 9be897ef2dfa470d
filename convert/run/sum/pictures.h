#ifndef WF_CONVERT_RUN_SUM_PICTURES_H
#define WF_CONVERT_RUN_SUM_PICTURES_H

#include "convert/read/source.h"
#include "convert/run/sum/flow.h"
#include "filters/resample/resampler.h"

/* Fields summed from pictures: a unit of time is one picture, read band by band. */

/* How a source's pictures lie, and who may read them. Borrowed from the source. */
typedef struct wf_picture_desc {
    const wf_resampler *resampler;
    const wf_source_options *options;
    int open_together; /* pictures that may be open at once */
    int64_t end_field; /* of all that the pictures give, whatever the chunk */
    bool unforeseen;   /* which pictures later fields see is not known yet: none is carried */
    size_t carried_bytes; /* most of sums that are carried from group to group where windows
                             overlap; beyond it pictures are read again */
} wf_picture_desc;

/* How a source's pictures are read. */
typedef struct wf_picture_reading {
    wf_picture_desc (*describe)(const wf_run *run); /* once, after start */
    /* Has units at hand that open is asked for next, by the run's one thread; fields before
     * units->group_end are those in hand. NULL: nothing has to be done. */
    weft_status (*prepare)(const wf_run *run, const wf_units *units, weft_error *err);
    /* Opens a picture, which the caller closes; any thread. NULL with WEFT_OK: it is missing,
     * and black. */
    weft_status (*open)(const wf_run *run, int64_t unit, wf_subframe **out, weft_error *err);
    /* Whether two units show one picture, which is then opened once. */
    bool (*same)(const wf_run *run, int64_t a, int64_t b);
} wf_picture_reading;

extern const wf_summing wf_summing_pictures;

/* ---- Between the files of pictures ---- */

/* run->sums. */
typedef struct wf_pictures {
    const wf_resampler *resampler;
    wf_reader **reader;   /* [threads] */
    wf_scratch **scratch; /* [threads] */
    bool merge; /* equal pictures of one window are added once, with their weights' sum */
    wf_field **flight; /* fields in flight, the first first; there is space for a group and
                          those carried */
    wf_field **active; /* those of them that the units in hand are added to */
    wf_field **spare;  /* fields done with, whose memory later ones take over */
    int flight_count, spare_count;
    int64_t opened;
} wf_pictures;

/* (pictures_bands.c) wf_summing's add. */
weft_status wf_pictures_add(wf_run *run, const wf_units *units, weft_error *err);

/* (pictures_bands.c) Takes line `line` of a complete field through color into its frame. */
void wf_pictures_finish_line(wf_run *run, wf_worker *worker, const wf_field *field, int line);

#endif
