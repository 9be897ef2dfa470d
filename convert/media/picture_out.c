/* What files say of the pictures that are written into them, whatever their format. */
#include "convert/media/picture_out.h"

#include <stdio.h>
#include <string.h>

#include "convert/job/timecode.h"

static const char *order_name(const wf_picture_out *p) {
    if (p->field == 1) return p->top_lines ? "top field 1" : "bottom field 1";
    if (p->field == 2) return p->top_lines ? "top field 2" : "bottom field 2";
    return !p->interlaced ? "progressive" : p->top_first ? "top first" : "bottom first";
}

const char *wf_picture_words(const wf_picture_out *p, char text[WF_PICTURE_WORDS_SIZE]) {
    const char *order = order_name(p);
    int room = WF_PICTURE_WORDS_SIZE - 1 - (int)strlen(", ") - (int)strlen(order);
    snprintf(text, WF_PICTURE_WORDS_SIZE, "%.*s, %s", room, p->raster, order);
    return text;
}

bool wf_picture_time(const wf_picture_out *p, uint32_t *word) {
    wf_timecode label;
    if (!wf_parse_timecode(p->timecode, &label)) return false;
    if (p->field) label.frames = 2 * label.frames + p->field - 1;
    *word = wf_timecode_bcd(&label, p->frame_rate);
    return true;
}
