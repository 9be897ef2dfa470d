/* The timecode that a file states, for the libav module. */
#include <libavutil/timecode.h>
#include <stdio.h>
#include <string.h>

#include "convert/media/libav/libav_reading.h"

static const char *tag_of(const AVDictionary *tags) {
    const AVDictionaryEntry *tag = av_dict_get(tags, "timecode", NULL, 0);
    return tag && *tag->value ? tag->value : NULL;
}

/* A track of QuickTime's timecode, which says how many labels a second has. */
static const AVStream *timecode_track(const AVFormatContext *format) {
    for (unsigned i = 0; i < format->nb_streams; i++) {
        const AVStream *s = format->streams[i];
        if (s->codecpar->codec_tag == MKTAG('t', 'm', 'c', 'd') && tag_of(s->metadata))
            return s;
    }
    return NULL;
}

static const char *any_tag(const AVFormatContext *format, int stream) {
    const char *found = tag_of(format->streams[stream]->metadata);
    if (!found) found = tag_of(format->metadata);
    for (unsigned i = 0; !found && i < format->nb_streams; i++)
        found = tag_of(format->streams[i]->metadata);
    return found;
}

/* MPEG's groups of pictures all have one, which is 0 where nobody set it. */
static bool read_group(const AVFrame *frame, char text[AV_TIMECODE_STR_SIZE]) {
    const AVFrameSideData *said = av_frame_get_side_data(frame, AV_FRAME_DATA_GOP_TIMECODE);
    if (!said || said->size < sizeof(int64_t)) return false;
    int64_t bits = *(const int64_t *)(const void *)said->data;
    av_timecode_make_mpeg_tc_string(text, (uint32_t)bits);
    return strspn(text, "0:;") < strlen(text);
}

/* SEI of H.264 and HEVC, and DV's packs, as SMPTE ST 12-1 has them in bits: how many there are,
 * and each, of which the first is the frame's. */
static bool read_coded(const wf_libav_reading *r, char text[AV_TIMECODE_STR_SIZE]) {
    const AVFrameSideData *said = av_frame_get_side_data(r->frame, AV_FRAME_DATA_S12M_TIMECODE);
    if (!said || said->size < 2 * sizeof(uint32_t)) return false;
    const uint32_t *words = (const uint32_t *)(const void *)said->data;
    if (!words[0]) return false;
    av_timecode_make_smpte_tc_string2(text, r->format->streams[r->stream]->avg_frame_rate,
                                      words[1], 0, 0);
    return true;
}

void wf_libav_timecode(wf_video *v) {
    const wf_libav_reading *r = v->state;
    const AVStream *track = timecode_track(r->format);
    char coded[AV_TIMECODE_STR_SIZE] = "";
    const char *found = track ? tag_of(track->metadata) : any_tag(r->format, r->stream);
    if (!found && (read_coded(r, coded) || read_group(r->frame, coded))) found = coded;
    snprintf(v->info.timecode, sizeof v->info.timecode, "%s", found ? found : "");
    AVRational rate = track ? track->avg_frame_rate : (AVRational){0, 0};
    if (rate.num > 0 && rate.den > 0) v->info.timecode_rate = wf_ratio(rate.num, rate.den);
}
