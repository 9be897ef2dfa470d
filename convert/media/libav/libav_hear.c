/* Hears what decoders complain of and go on, for the libav module. */
#include "convert/media/libav/libav_reading.h"

/* Called by any thread. Codecs of what is no video that is read have no opaque. */
static void hear(void *whom, int level, const char *format, va_list values) {
    (void)format, (void)values;
    if (!whom || level > AV_LOG_ERROR || *(const AVClass **)whom != avcodec_get_class()) return;
    const AVCodecContext *codec = whom;
    wf_libav_reading *r = codec->opaque;
    long long none = 0;
    if (!r) return;
    atomic_fetch_add(&r->complaints, 1);
    atomic_compare_exchange_strong(&r->complained, &none, codec->reordered_opaque);
}

void wf_libav_listen(void) {
    av_log_set_callback(hear);
}

void wf_libav_note_complaints(wf_video *v) {
    wf_libav_reading *r = v->state;
    int64_t now = atomic_load(&r->complaints), more = now - r->noted;
    r->noted = now;
    if (!more) return;
    if (!v->troubles.complaints) v->troubles.complained_at = v->frame.index;
    v->troubles.complaints += more;
}

int64_t wf_libav_complained(wf_libav_reading *r) {
    return atomic_exchange(&r->complained, 0);
}

void wf_libav_pass_complaints(wf_libav_reading *r) {
    atomic_store(&r->complained, 0);
    r->noted = atomic_load(&r->complaints);
}
