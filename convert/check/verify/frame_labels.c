/* Reads the labels in the headers of DPX and EXR sequences. */
#include "convert/check/verify/frame_labels.h"

#include <stdio.h>
#include <string.h>

#include "convert/base/infile.h"
#include "convert/base/names.h"
#include "convert/job/timecode.h"
#include "convert/read/sequence.h"
#include "convert/read/source.h"

typedef struct frame_label {
    wf_timecode label;
    bool there;
    int interlace; /* of DPX; -1: not said */
} frame_label;

/* ---- DPX ---- */

#define TELEVISION_AT 1920 /* the header: U32 time code, U32 user bits, U8 interlace, .. */
#define UNDEFINED     UINT32_MAX

static int of_bcd(unsigned byte) {
    return (int)(byte >> 4) * 10 + (int)(byte & 15);
}

/* The label in a word of ST 12-1; false where there is none. */
static bool read_word(uint32_t word, wf_rational rate, wf_timecode *out) {
    int together = wf_timecode_together(rate);
    if (word == UNDEFINED) return false;
    *out = (wf_timecode){.hours = of_bcd(word >> 24 & 0x3f),
                         .minutes = of_bcd(word >> 16 & 0x7f),
                         .seconds = of_bcd(word >> 8 & 0x7f),
                         .frames = of_bcd(word & 0x3f) * together,
                         .drop_frame = word >> 6 & 1};
    if (together == 2) out->frames += (int)(word >> 15 & 1);
    return true;
}

static weft_status read_dpx(const char *path, wf_rational rate, frame_label *out,
                            weft_error *err) {
    uint8_t head[TELEVISION_AT + 9] = {0};
    const uint8_t *tv = head + TELEVISION_AT;
    size_t got;
    weft_status status = wf_infile_head(path, head, sizeof head, &got, err);
    if (status || got < sizeof head) return status;
    bool little = head[0] == 'X';
    uint32_t word = 0;
    for (int i = 0; i < 4; i++) word = word << 8 | tv[little ? 3 - i : i];
    out->interlace = tv[8] <= 1 ? tv[8] : -1;
    out->there = read_word(word, rate, &out->label);
    return WEFT_OK;
}

/* ---- EXR ---- */

static weft_status read_exr(const wf_subframe_ref *ref, wf_rational rate, frame_label *out,
                            weft_error *err) {
    const wf_source_options options = {.max_memory_bytes = (size_t)1 << 30};
    wf_subframe *subframe;
    weft_status status = wf_subframe_open(ref->path, ref->part, &options, &subframe, err);
    if (status) return status;
    const wf_image_info *info = wf_subframe_info(subframe);
    out->there = wf_parse_timecode(info->timecode, &out->label);
    if (out->there && wf_timecode_together(rate) == 2)
        out->label.frames = 2 * out->label.frames + info->timecode_mark;
    wf_subframe_close(subframe);
    return WEFT_OK;
}

/* ---- The sequence ---- */

static weft_status read_label(const wf_subframe_ref *ref, wf_rational rate, frame_label *out,
                              weft_error *err) {
    *out = (frame_label){.interlace = -1};
    if (wf_name_ends_in(ref->path, ".dpx")) return read_dpx(ref->path, rate, out, err);
    return wf_name_ends_in(ref->path, ".exr") ? read_exr(ref, rate, out, err) : WEFT_OK;
}

static bool same_label(const wf_timecode *a, const wf_timecode *b) {
    return a->hours == b->hours && a->minutes == b->minutes && a->seconds == b->seconds &&
           a->frames == b->frames && a->drop_frame == b->drop_frame;
}

/* Takes the label of file i, counted from the first that has one, and whether it follows from
 * it. */
static void add_label(wf_frame_labels *l, const wf_timecode *label, wf_rational rate,
                      int64_t i) {
    char why[160];
    if (!l->labeled++) l->first = *label;
    bool counts = wf_timecode_check(&l->first, rate, why, sizeof why);
    wf_timecode should = counts ? wf_timecode_add(&l->first, i, rate) : *label;
    if (same_label(label, &should) || l->wrong++) return;
    l->wrong_at = i;
    l->is = *label;
    l->should = should;
}

weft_status wf_frame_labels_read(const char *path, wf_rational rate, int fields,
                                 wf_frame_labels *out, weft_error *err) {
    char *name = (char *)(uintptr_t)path;
    wf_sequence sequence = {0};
    *out = (wf_frame_labels){.interlace = -1};
    weft_status status = wf_sequence_expand(&name, 1, NULL, &sequence, err);
    int64_t first = -1, apart = sequence.stepped ? sequence.number_step.num : 1;
    for (size_t i = 0; !status && i < sequence.count; i++) {
        frame_label found;
        if (!sequence.refs[i].path) continue;
        status = read_label(&sequence.refs[i], rate, &found, err);
        if (found.there && first < 0) first = (int64_t)i;
        if (found.there)
            add_label(out, &found.label, rate, ((int64_t)i - first) / fields * apart);
        if (!out->files++) out->interlace = found.interlace;
        if (found.interlace != out->interlace) out->interlace = -1;
    }
    wf_sequence_free(&sequence);
    return status;
}
