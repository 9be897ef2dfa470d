/* Goes to a picture of a file, for the libav module: to a keyframe before it, and decodes on.
 */
#include "convert/media/libav/libav_reading.h"

/* How long before the picture a keyframe is looked for, try by try: where decoding from the
 * nearest one does not give the picture, such as after one that later pictures look beyond. */
static const double before_s[] = {0, 1, 5, 25};

/* Whether timestamps tell the picture from its neighbors. */
static bool is_told(const wf_video_info *info, int64_t picture) {
    return info->times && picture > 0 && picture < info->frames &&
           info->times[picture - 1] < info->times[picture] &&
           (picture + 1 == info->frames || info->times[picture] < info->times[picture + 1]);
}

static void forget_frame(wf_libav_reading *r) {
    av_frame_unref(r->frame);
    r->have = false;
    wf_libav_mend_again(r);
}

/* Decodes on until the frame that is shown then is in hand. Pictures before the keyframe, which
 * are coded after it, may be damaged since they look at what was not decoded. */
static bool decode_to(wf_video *v, int64_t ticks) {
    wf_libav_reading *r = v->state;
    while (!wf_libav_decode(v, NULL) && r->have) {
        int64_t at = r->frame->best_effort_timestamp;
        bool sound = at != AV_NOPTS_VALUE && r->key_ticks <= ticks &&
                     (at < r->key_ticks || !wf_libav_is_damaged(r->frame));
        if (!sound || at > ticks) return false;
        if (at == ticks) return true;
        forget_frame(r);
    }
    return false;
}

static bool try_from(wf_video *v, int64_t from, int64_t ticks) {
    wf_libav_reading *r = v->state;
    forget_frame(r);
    r->drained = false;
    r->until_key = true;
    if (av_seek_frame(r->format, r->stream, from, AVSEEK_FLAG_BACKWARD) < 0) return false;
    avcodec_flush_buffers(r->codec);
    return decode_to(v, ticks);
}

/* What has been tried may have left anything behind in libav. */
static weft_status begin_again(wf_video *v, weft_error *err) {
    wf_libav_reading *r = v->state;
    wf_libav_close_stream(v);
    wf_libav_mend_again(r);
    r->have = r->drained = r->until_key = false;
    r->packets = 0;
    r->end_s = 0;
    v->frame.index = -1;
    wf_libav_pass_complaints(r);
    return wf_libav_open_stream(v, err);
}

weft_status wf_libav_seek(wf_video *v, int64_t picture, weft_error *err) {
    wf_libav_reading *r = v->state;
    const wf_video_info *info = &v->info;
    if (v->pipe || r->by_decoding || !is_told(info, picture)) return WEFT_OK;
    int64_t ticks = info->times[picture];
    for (size_t i = 0; i < sizeof before_s / sizeof *before_s; i++) {
        int64_t from = ticks - (int64_t)(before_s[i] / wf_ratio_value(info->tick_s));
        if (from < info->times[0]) break;
        if (!try_from(v, from, ticks)) continue;
        r->packets = r->listed;
        v->frame.index = picture - 1;
        wf_libav_pass_complaints(r);
        return WEFT_OK;
    }
    return begin_again(v, err);
}
