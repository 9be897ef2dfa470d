/* Outputs of uncompressed 4:2:2 in MXF: v210 or uyvy, by the depth. */
#include <stdlib.h>

#include "convert/base/outfile.h"
#include "convert/job/delivery.h"
#include "convert/write/mxf.h"
#include "convert/write/packing.h"
#include "convert/write/sink_kinds.h"
#include "convert/write/size.h"

struct wf_sink {
    wf_output_options options;
    wf_outfile *file;
    wf_mxf *mxf;
    uint8_t *bytes;
};

static void release(wf_sink *s) {
    if (s->mxf) wf_mxf_free(s->mxf);
    free(s->bytes);
    free(s);
}

static void abandon(wf_sink *s) {
    if (s->file) wf_outfile_abandon(s->file);
    release(s);
}

static weft_status check(const wf_output_options *o, weft_error *err) {
    bool container;
    return wf_delivery_check_sound(wf_delivery_for(o->output, o->codec, &container, NULL), o,
                                   err);
}

static size_t frame_bytes(const wf_output_options *o) {
    return o->bits == 8 ? wf_uyvy_bytes(o) : wf_v210_bytes(o);
}

/* Counts frames and sound. Keys, headers and the index come to less than a hundredth of
 * that. */
static wf_sink_size size(const wf_output_options *o, int64_t frames) {
    return (wf_sink_size){frames * (int64_t)frame_bytes(o) + wf_sound_bytes(o, frames),
                          WF_SIZE_ABOUT};
}

/* The timecode of this run's first frame. */
static wf_timecode start_of(const wf_output_options *o) {
    wf_timecode label = {0};
    if (o->timecode) wf_parse_timecode(o->timecode, &label);
    return wf_timecode_add(&label, o->first_frame, o->raster->frame_rate);
}

static wf_date date_of(const wf_output_options *o) {
    wf_date date = {0};
    if (o->date) wf_parse_date(o->date, &date);
    return date;
}

static weft_status start(wf_sink *s, weft_error *err) {
    const wf_output_options *o = &s->options;
    if (o->frame_count < 0)
        return wf_fail(err, WEFT_USAGE,
                       "%s: its header says how many frames there are, which a pipe does not "
                       "tell; give --frames, such as 0-99, or write another container",
                       o->output);
    const wf_mxf_options options = {
        .raster = o->raster,
        .bits = o->bits,
        .frame_bytes = frame_bytes(o),
        .full_range = o->full_range,
        .color_space = o->color_space,
        .frame_count = o->frame_count,
        .start = start_of(o),
        .date = date_of(o),
        .first_frame = o->first_frame,
        .sound = o->sound,
    };
    /* A job that resumes gets here only if what stands at the name is no whole output, which
     * it may replace. */
    weft_status status = wf_outfile_open(o->output, o->overwrite || o->resume, &s->file, err);
    return status ? status : wf_mxf_open(&options, s->file, &s->mxf, err);
}

static weft_status open_sink(const wf_output_options *options, wf_sink **out, weft_error *err) {
    wf_sink *s = calloc(1, sizeof *s);
    if (s) s->bytes = malloc(frame_bytes(options));
    if (!s || !s->bytes) {
        free(s);
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for a frame", options->output);
    }
    s->options = *options;
    weft_status status = start(s, err);
    if (status)
        abandon(s);
    else
        *out = s;
    return status;
}

static weft_status write_sink(wf_sink *s, const wf_frame *frame, weft_error *err) {
    if (s->options.bits == 8)
        wf_uyvy_pack(&s->options, frame, s->bytes);
    else
        wf_v210_pack(&s->options, frame, s->bytes);
    return wf_mxf_write(s->mxf, s->bytes, err);
}

static weft_status commit(wf_sink *s, weft_error *err) {
    weft_status status = wf_mxf_finish(s->mxf, err);
    if (status) {
        abandon(s);
        return status;
    }
    status = wf_outfile_commit(s->file, err);
    s->file = NULL;
    release(s);
    return status;
}

const wf_sink_ops wf_mxf_sink_ops = {
    .check = check,
    .size = size,
    .open = open_sink,
    .write = write_sink,
    .commit = commit,
    .abandon = abandon,
};
