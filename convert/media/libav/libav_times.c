/* When the pictures of a stream are shown, from its packets. */
#include "convert/media/libav/libav_times.h"

#include <libavformat/avformat.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct listing {
    int64_t *time;
    size_t count, capacity;
    int64_t packets;          /* with those that are not shown */
    int64_t last, last_ticks; /* the latest time, and how long its packet lasts */
    bool all;                 /* every packet so far had a time */
    int64_t decoded;          /* packets that have the time of decoding alone */
    int64_t last_dts, back;   /* info.back, from the times that packets are decoded at */
} listing;

static int by_time(const void *left, const void *right) {
    const int64_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

static void note_order(listing *l, int64_t dts) {
    if (dts == AV_NOPTS_VALUE) return;
    if (l->count && !l->back && dts < l->last_dts) l->back = (int64_t)l->count;
    l->last_dts = dts;
}

static bool add(listing *l, int64_t time, int64_t ticks) {
    if (l->count == l->capacity) {
        size_t capacity = l->capacity ? 2 * l->capacity : 1024;
        int64_t *grown = realloc(l->time, capacity * sizeof *grown);
        if (!grown) return false;
        l->time = grown;
        l->capacity = capacity;
    }
    if (!l->count || time > l->last) {
        l->last = time;
        l->last_ticks = ticks > 0 ? ticks : 0;
    }
    l->time[l->count++] = time;
    l->all &= time != AV_NOPTS_VALUE;
    return true;
}

/* Packets that edit lists leave out are decoded and not shown. */
static bool list_packets(AVFormatContext *format, int stream, listing *l) {
    AVPacket *packet = av_packet_alloc();
    bool fits = packet != NULL;
    for (unsigned i = 0; i < format->nb_streams; i++)
        if ((int)i != stream) format->streams[i]->discard = AVDISCARD_ALL;
    while (fits && av_read_frame(format, packet) >= 0) {
        l->packets += packet->stream_index == stream;
        if (packet->stream_index == stream && !(packet->flags & AV_PKT_FLAG_DISCARD)) {
            note_order(l, packet->dts);
            bool shown = packet->pts != AV_NOPTS_VALUE;
            l->decoded += !shown;
            fits = add(l, shown ? packet->pts : packet->dts, packet->duration);
        }
        av_packet_unref(packet);
    }
    av_packet_free(&packet);
    return fits;
}

static bool can_be_read_twice(const char *path) {
    struct stat about;
    return !stat(path, &about) && S_ISREG(about.st_mode);
}

static bool open_again(const wf_video *v, int stream, AVFormatContext **format) {
    char *url = malloc(strlen(v->path) + sizeof "file:");
    if (!url) return false;
    strcat(strcpy(url, "file:"), v->path);
    bool opened = avformat_open_input(format, url, NULL, NULL) >= 0;
    free(url);
    /* Streams of some containers are found only by reading into them. */
    return opened && avformat_find_stream_info(*format, NULL) >= 0 &&
           stream < (int)(*format)->nb_streams;
}

/* AVI has times of decoding only. Pictures are shown as far apart as these are, however they
 * change places. */
static bool is_complete(const listing *l, const AVFormatContext *format) {
    bool avi = format && !strcmp(format->iformat->name, "avi");
    return l->count && l->all && (!l->decoded || (avi && l->decoded == (int64_t)l->count));
}

weft_status wf_libav_times(wf_video *v, int stream, int64_t *packets, bool *decoded,
                           weft_error *err) {
    AVFormatContext *format = NULL;
    listing l = {.all = true, .last_dts = AV_NOPTS_VALUE};
    bool fits = true;
    if (can_be_read_twice(v->path) && open_again(v, stream, &format)) {
        AVRational tick = format->streams[stream]->time_base;
        v->info.tick_s = wf_ratio(tick.num, tick.den);
        fits = list_packets(format, stream, &l);
    }
    bool complete = fits && is_complete(&l, format);
    *decoded = complete && l.decoded;
    avformat_close_input(&format);
    if (complete) {
        qsort(l.time, l.count, sizeof *l.time, by_time);
        v->info.times = l.time;
        v->info.last_ticks = l.last_ticks;
        v->info.back = l.back;
        l.time = NULL;
    }
    *packets = l.packets;
    if (fits && l.count) v->info.frames = (int64_t)l.count;
    free(l.time);
    return fits ? WEFT_OK : wf_video_no_memory(v, err);
}
