/* Alpha as a picture of its own, the key, beside the picture that it is for, the fill. */
#include "convert/finish/key.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "convert/write/sink.h"

static bool has_key(const wf_setup *s) {
    return s->key.kind;
}

static bool is_linear(const wf_setup *s) {
    return s->key.kind->layout == WF_LINEAR;
}

/* ---- Samples ---- */

size_t wf_key_sample_bytes(const wf_setup *s) {
    if (!has_key(s)) return 0;
    return is_linear(s) ? sizeof(float) : sizeof(uint16_t);
}

void wf_key_put(const wf_setup *s, const float *k, size_t count, void *to) {
    const wf_output_options *o = &s->key_options;
    uint16_t *code = to;
    if (is_linear(s)) {
        memcpy(to, k, count * sizeof *k);
        return;
    }
    float one = (float)(1 << (o->bits - 8));
    float black = o->full_range ? 0 : 16 * one;
    float range = o->full_range ? (float)((1 << o->bits) - 1) : 219 * one;
    for (size_t i = 0; i < count; i++) {
        float share = k[i] > 0 ? k[i] < 1 ? k[i] : 1 : 0; /* NaN becomes 0 */
        code[i] = (uint16_t)lrintf(black + range * share);
    }
}

static weft_status make_neutral(const wf_setup *s, wf_outputs *o, weft_error *err) {
    if (s->key.kind->layout != WF_YCBCR) return WEFT_OK;
    size_t width = (size_t)s->key_options.raster->width_px;
    o->neutral = malloc(width * sizeof *o->neutral);
    if (!o->neutral) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a line of the key");
    for (size_t i = 0; i < width; i++)
        o->neutral[i] = (uint16_t)(1 << (s->key_options.bits - 1));
    return WEFT_OK;
}

/* All of its channels are one plane, or its chroma one line. */
static wf_frame frame_of(const wf_setup *s, const wf_outputs *o, const void *key,
                         int64_t index) {
    size_t width = (size_t)s->key_options.raster->width_px;
    wf_frame frame = {.plane = {key, key, key}, .stride = {width, width, width}};
    frame.index = index;
    if (s->key.kind->layout != WF_YCBCR) return frame;
    frame.plane[1] = frame.plane[2] = o->neutral;
    frame.stride[1] = frame.stride[2] = 0;
    return frame;
}

/* ---- Both outputs ---- */

weft_status wf_outputs_open(const wf_setup *s, wf_outputs *o, weft_error *err) {
    weft_status status = wf_output_open(s->output, &s->output_options, &o->fill, err);
    if (status || !has_key(s)) return status;
    wf_output_options key = s->key_options;
    key.timecode = s->output_options.timecode; /* which the input may have told since */
    status = make_neutral(s, o, err);
    return status ? status : wf_output_open(s->key, &key, &o->key, err);
}

weft_status wf_outputs_write(const wf_setup *s, wf_outputs *o, const wf_frame *fill,
                             const void *key, weft_error *err) {
    weft_status status = s->output.ops->write(o->fill, fill, err);
    if (status || !key) return status;
    const wf_frame frame = frame_of(s, o, key, fill->index);
    return s->key.ops->write(o->key, &frame, err);
}

/* Takes back a key that stands at its name. */
static void remove_key(const wf_setup *s) {
    const char *name = wf_output_file(s->key.kind, s->key_options.output);
    if (name && !s->key.kind->sequence) unlink(name);
}

weft_status wf_outputs_commit(const wf_setup *s, wf_outputs *o, weft_error *err) {
    weft_status status = WEFT_OK;
    wf_sink *fill = o->fill, *key = o->key;
    o->key = NULL;
    if (key) status = s->key.ops->commit(key, err);
    if (status) return status;
    o->fill = NULL;
    status = s->output.ops->commit(fill, err);
    if (status && key) remove_key(s);
    return status;
}

void wf_outputs_close(const wf_setup *s, wf_outputs *o) {
    if (o->key) s->key.ops->abandon(o->key);
    if (o->fill) s->output.ops->abandon(o->fill);
    free(o->neutral);
    *o = (wf_outputs){0};
}
