/* What writing a picture and writing its sound have in common: failing, and handing packets on.
 */
#include "convert/media/libav/libav_writing.h"

weft_status wf_writing_failed(const wf_writing *w, const char *doing, int code,
                              weft_error *err) {
    char why[AV_ERROR_MAX_STRING_SIZE] = "";
    if (*w->failure.text) return wf_fail(err, WEFT_FAILED, "%s", w->failure.text);
    av_strerror(code, why, sizeof why);
    return wf_fail(err, code == AVERROR(ENOMEM) ? WEFT_NO_MEMORY : WEFT_FAILED,
                   "%.500s: %s: %s", w->options.output, doing, why);
}

int wf_writing_mux(wf_writing *w, const AVCodecContext *codec, int stream) {
    AVPacket *p = w->packet;
    if (codec == w->codec) p->duration = 1;
    p->stream_index = stream;
    av_packet_rescale_ts(p, codec->time_base, w->format->streams[stream]->time_base);
    return av_interleaved_write_frame(w->format, p);
}
