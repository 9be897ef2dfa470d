/* An open picture: what it says of itself, what it was taken for, and its end. */
#include "convert/read/subframe.h"

#include <stdio.h>
#include <stdlib.h>

const wf_image_info *wf_subframe_info(const wf_subframe *subframe) {
    return &subframe->info;
}

const char *wf_subframe_part_name(const wf_subframe *subframe) {
    return subframe->part_name;
}

const wf_pick *wf_subframe_pick(const wf_subframe *subframe) {
    return &subframe->pick;
}

const wf_file_colors *wf_subframe_colors(const wf_subframe *subframe) {
    return &subframe->colors;
}

weft_status wf_subframe_settle_colors(wf_subframe *s, const wf_source_options *o,
                                      weft_error *err) {
    s->colors = wf_file_colors_of(&s->info.colors);
    if (!o->to_light) return WEFT_OK;
    if (o->decode) {
        s->decode = *o->decode;
        return WEFT_OK;
    }
    if (*s->colors.trouble)
        return wf_fail(err, WEFT_USAGE, "%s: %s", s->path, s->colors.trouble);
    if (!wf_decoding_changes(&s->colors.decoding)) return WEFT_OK;
    s->owns_decode = wf_decoding_transform(&s->colors.decoding, &s->decode);
    return s->owns_decode ? WEFT_OK
                          : wf_fail(err, WEFT_NO_MEMORY, "%s: no memory to decode it", s->path);
}

void wf_subframe_settle_alpha(wf_subframe *s, const wf_source_options *o) {
    if (s->info.colors.no_alpha) s->pick.count = 3;
    bool given = o->alpha != WF_ALPHA_UNSET, has = s->pick.count == 4;
    if (given) s->info.alpha = o->alpha;
    if (!has) s->info.alpha = WF_ALPHA_UNSET;
    s->alpha_reason = !has || (!given && s->info.alpha_by_file) ? WF_REASON_FILE
                      : given                                   ? WF_REASON_OPTION
                                                                : WF_REASON_DEFAULT;
    bool counts = has && s->info.alpha != WF_ALPHA_IGNORED;
    s->multiplies = counts && s->info.alpha == WF_ALPHA_STRAIGHT;
    s->divides = counts && !s->multiplies && s->decode.apply;
    s->info.has_alpha = counts && o->want_alpha;
    if (!s->multiplies && !s->divides && !s->info.has_alpha) s->pick.count = 3;
}

void wf_subframe_take(const wf_subframe *s, wf_taken_list *list) {
    static const char *const alphas[] = {"none", "straight", "premultiplied", "ignore"};
    const wf_pick *pick = &s->pick;
    char number[16];
    snprintf(number, sizeof number, "%d", s->part);
    wf_take(list, "part", *s->part_name ? s->part_name : number,
            wf_reason_name(pick->part_reason));
    wf_take(list, "layer", pick->layer, wf_reason_name(pick->layer_reason));
    wf_take(list, "channels", wf_picture_kind_name(pick->kind),
            wf_reason_name(pick->layer_reason));
    wf_file_colors_take(&s->colors, list);
    wf_take(list, "alpha", alphas[s->info.alpha], wf_reason_name(s->alpha_reason));
}

weft_status wf_subframe_made(const wf_row_maker *maker, void *picture, int width_px, int lines,
                             wf_subframe **out, weft_error *err) {
    wf_subframe *s = *out = calloc(1, sizeof *s);
    if (!s) {
        maker->close(picture);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for a picture");
    }
    wf_box box = {0, 0, width_px, lines};
    s->info = (wf_image_info){
        .display = box, .data = box, .pixel_aspect = 1, .band_lines = 32, .whole = true};
    s->maker = maker;
    s->picture = picture;
    s->layout.channels = maker->channels;
    s->info.has_alpha = maker->channels == 4;
    return WEFT_OK;
}

void wf_subframe_close(wf_subframe *s) {
    if (!s) return;
    if (s->maker) s->maker->close(s->picture);
    for (int i = 0; i < s->layers; i++) wf_subframe_close(s->layer[i].picture);
    free(s->layer);
    wf_exr_stream_end(&s->stream);
    if (s->owns_decode) s->decode.free(s->decode.self);
    free(s->whole);
    free(s->path);
    free(s);
}
