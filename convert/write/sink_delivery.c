/* Outputs in containers. What is asked for is compared with the table of deliveries here;
 * the libav module writes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/module.h"
#include "convert/job/delivery.h"
#include "convert/media/libav/libav.h"
#include "convert/write/packing.h"
#include "convert/write/sink_kinds.h"
#include "convert/write/size.h"

struct wf_sink {
    const wf_libav_writer *writer;
    void *state;
};

static const wf_delivery *delivery_of(const wf_output_options *o) {
    bool container;
    return wf_delivery_for(o->output, o->codec, &container, NULL);
}

/* What needs libav, and what would not. */
static void name_need(const wf_output_options *o, char what[600]) {
    snprintf(what, 600, "%.500s: a container, unlike .y4m, .v210 and sequences,",
             o->output);
}

static weft_status check(const wf_output_options *o, weft_error *err) {
    const wf_delivery *d = delivery_of(o);
    if (o->full_range && !d->full_range)
        return wf_fail(err, WEFT_USAGE,
                       "%.500s: readers take %s for narrow range; leave out --range full",
                       o->output, d->kind.name);
    if (o->alpha && !(d->alpha_bits & 1u << o->bits))
        return wf_fail(err, WEFT_USAGE,
                       "%.500s: the encoder of %s has alpha of 8, 10 and 16 bits, not %d",
                       o->output, d->kind.name, o->bits);
    if (!wf_delivery_form_for(d, o, err)) return WEFT_USAGE;
    weft_status status = wf_delivery_check_sound(d, o, err);
    char what[600];
    name_need(o, what);
    return status ? status : wf_module_check("libav", what, err);
}

static void tell(const wf_output_options *o, char *text, size_t size) {
    const wf_delivery *d = delivery_of(o);
    const wf_delivery_form *form = wf_delivery_form_for(d, o, NULL);
    *text = '\0';
    if (form && form->folds_chroma)
        snprintf(text, size,
                 "%.200s: chroma is 4:2:0, which every player takes; --bits 10 is 4:2:2",
                 o->output);
    if (!form || !form->kept_lines) return;
    wf_raster kept = wf_delivery_raster(form, o->raster);
    snprintf(text, size,
             "%.200s: %s takes %d lines: of %s, %d above and %d below are dropped, and what is "
             "left is %s",
             o->output, d->kind.name, form->kept_lines, o->raster->name, form->skip_lines,
             o->raster->lines - form->kept_lines - form->skip_lines, wf_raster_order(&kept));
}

/* ---- Sizes ---- */

/* Bytes of the picture where frames are uncompressed or of constant size; 0: they are not. A
 * DNxHD table is named by its Mb/s at 25 frames a second, or at 50 where there are 720
 * lines. */
static int64_t picture_bytes(const wf_output_options *o, const wf_delivery *d,
                             const wf_delivery_form *form, int64_t frames) {
    if (!strcmp(d->encoder, "v210")) return frames * (int64_t)wf_v210_bytes(o);
    if (d->constant) return wf_bytes_at_rate(o, frames, form->bit_rate / 8);
    if (!strcmp(d->encoder, "dnxhd") && form->bit_rate)
        return frames * (form->bit_rate / 8 / (form->lines == 720 ? 50 : 25));
    return 0;
}

static wf_sink_size size(const wf_output_options *o, int64_t frames) {
    const wf_delivery *d = delivery_of(o);
    const wf_delivery_form *form = wf_delivery_form_for(d, o, NULL);
    int64_t pictures = form ? picture_bytes(o, d, form, frames) : 0;
    if (!pictures) return (wf_sink_size){0};
    return (wf_sink_size){pictures + wf_sound_bytes(o, frames), WF_SIZE_ABOUT};
}

/* ---- Opening and writing ---- */

static weft_status open_sink(const wf_output_options *o, wf_sink **out, weft_error *err) {
    void *symbol;
    char what[600];
    wf_libav_writer_fn *writer;
    weft_status status = check(o, err);
    name_need(o, what);
    if (!status) status = wf_module_symbol("libav", "wf_libav_writer_of", what, &symbol, err);
    if (status) return status;
    memcpy(&writer, &symbol, sizeof writer);
    wf_sink *s = calloc(1, sizeof *s);
    if (!s) return wf_fail(err, WEFT_NO_MEMORY, "%.500s: out of memory", o->output);
    s->writer = writer();
    status = s->writer->open(o, delivery_of(o), &s->state, err);
    if (status)
        free(s);
    else
        *out = s;
    return status;
}

static weft_status write_sink(wf_sink *s, const wf_frame *frame, weft_error *err) {
    return s->writer->write(s->state, frame, err);
}

static weft_status commit(wf_sink *s, weft_error *err) {
    weft_status status = s->writer->commit(s->state, err);
    free(s);
    return status;
}

static void abandon(wf_sink *s) {
    s->writer->abandon(s->state);
    free(s);
}

const wf_sink_ops wf_delivery_ops = {
    .check = check,
    .tell = tell,
    .size = size,
    .open = open_sink,
    .write = write_sink,
    .commit = commit,
    .abandon = abandon,
};
