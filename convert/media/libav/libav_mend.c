/* Pictures that cannot be decoded as missing ones, for the libav module: the ones after them
 * keep their places. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/media/libav/libav_reading.h"

/* A decoder that fails so often without another packet does not come to its end. */
#define MOST_FAILURES 1000
/* Pictures that may be lost at one place. */
#define MOST_LOST INT64_C(10000000)
/* How many times as many as are there a file may say it has: what is cut off is some of it, and
 * lengths are damaged too. */
#define MOST_TIMES 20

void wf_libav_mend_again(wf_libav_reading *r) {
    av_frame_free(&r->held);
    r->place = -1;
    r->lost = 0;
    r->first_bad = r->last_bad = -1;
    r->last_ticks = AV_NOPTS_VALUE;
}

/* ---- Frames ---- */

/* Something is lost that was coded so many packets into the stream. */
static void lose(wf_video *v, int64_t packet, const weft_error *why) {
    wf_libav_reading *r = v->state;
    wf_video_note_trouble(v, why);
    if (r->first_bad < 0 || packet < r->first_bad) r->first_bad = packet;
    if (packet > r->last_bad) r->last_bad = packet;
    r->lost++;
}

/* The packet that the frame in hand was coded in. */
static int64_t packet_of(const wf_libav_reading *r) {
    int64_t packet = r->frame->reordered_opaque;
    return packet < 0 || packet > r->packets ? r->packets : packet;
}

/* Whether the frame in hand may look at what was lost: it was coded after that, and neither is
 * a keyframe nor comes after one. */
static bool is_tainted(wf_libav_reading *r) {
    int64_t packet = packet_of(r);
    if (r->first_bad < 0 || packet < r->first_bad) return false;
    if (!r->frame->key_frame || packet == r->first_bad) return true;
    r->first_bad = r->last_bad > packet ? packet + 1 : -1;
    return false;
}

/* Pictures that come before the one that the decoder complained of may look at it. */
static void hear(wf_video *v) {
    weft_error why;
    int64_t packet = wf_libav_complained(v->state);
    if (packet < 1) return;
    wf_fail(&why, WEFT_FAILED, "%s: its decoder complained about frame %" PRId64 " (%.3f s)",
            v->path, packet - 1, wf_libav_time_s(v));
    lose(v, packet, &why);
}

/* Whether the frame in hand can be shown. */
static bool is_whole(wf_video *v, weft_error *why) {
    wf_libav_reading *r = v->state;
    if (wf_libav_is_damaged(r->frame)) {
        wf_fail(why, WEFT_FAILED, "%s: frame %" PRId64 " (%.3f s) is damaged", v->path,
                v->frame.index < 0 ? 0 : v->frame.index, wf_libav_time_s(v));
        lose(v, packet_of(r), why);
        return false;
    }
    bool tainted = is_tainted(r);
    bool fits = !r->pixels || !wf_libav_check_frame(v, wf_libav_time_s(v), why);
    r->lost += tainted || !fits;
    if (!fits) wf_video_note_trouble(v, why);
    return !tainted && fits;
}

/* Decodes until a frame that can be shown is in hand, or to the end. */
static weft_status find_frame(wf_video *v, weft_error *err) {
    wf_libav_reading *r = v->state;
    for (int failures = 0; failures < MOST_FAILURES;) {
        int64_t packets = r->packets;
        weft_error why = {""};
        weft_status status = wf_libav_decode(v, &why);
        if (status == WEFT_NO_MEMORY) return wf_fail(err, status, "%s", why.text);
        hear(v);
        if (!status && (!r->have || r->place >= 0 || is_whole(v, &why))) return WEFT_OK;
        if (status) lose(v, r->packets, &why);
        if (r->have) av_frame_unref(r->frame);
        r->have = false;
        failures = r->packets > packets ? 0 : failures + 1;
    }
    return WEFT_OK;
}

weft_status wf_libav_mend_first(wf_video *v, weft_error *err) {
    wf_libav_reading *r = v->state;
    wf_libav_mend_again(r);
    weft_status status = find_frame(v, err);
    if (!status && !r->have && *v->troubles.missing.text)
        return wf_fail(err, WEFT_FAILED, "%s", v->troubles.missing.text);
    return status;
}

/* ---- Places ---- */

/* Pictures between the last one, or the beginning of the stream, and the frame in hand: by
 * their times and the rate. */
static int64_t skipped(const wf_video *v, int64_t ticks) {
    const wf_libav_reading *r = v->state;
    bool first = !v->frame.index;
    int64_t since = first ? r->format->streams[r->stream]->start_time : r->last_ticks;
    if (!r->lost) return 0;
    if (ticks == AV_NOPTS_VALUE || since == AV_NOPTS_VALUE || !wf_ratio_given(v->info.rate))
        return r->lost;
    double since_s = ((double)ticks - (double)since) * wf_ratio_value(v->info.tick_s);
    double past = round(since_s * wf_ratio_value(v->info.rate)) - !first;
    return past > 0 && past < (double)MOST_LOST ? (int64_t)past : 0;
}

/* Without a sign, as the times of damaged files may be farther apart than one holds. */
static uint64_t ticks_off(const wf_video_info *info, int64_t n, int64_t ticks) {
    uint64_t off = (uint64_t)info->times[n] - (uint64_t)ticks;
    return info->times[n] < ticks ? -off : off;
}

/* A picture that is there is none after the last that the file has. */
static int64_t within(const wf_video *v, int64_t place) {
    int64_t last = v->info.frames < 0 ? place : v->info.frames - 1;
    if (place > last) place = last;
    return place < v->frame.index ? v->frame.index : place;
}

/* The number of the frame in hand: that of the nearest time that is listed, which may be
 * rounded; else by what was lost. */
static int64_t place_of(const wf_video *v) {
    const wf_libav_reading *r = v->state;
    const wf_video_info *info = &v->info;
    int64_t ticks = r->frame->best_effort_timestamp, n = v->frame.index;
    if (!info->times || r->by_decoding) return within(v, n + skipped(v, ticks));
    if (ticks == AV_NOPTS_VALUE) return n;
    while (n + 1 < info->frames && ticks_off(info, n + 1, ticks) < ticks_off(info, n, ticks))
        n++;
    return n < info->frames && ticks_off(info, n, ticks) <= 1 ? n : v->frame.index;
}

/* ---- What should be there ---- */

/* Pictures that change places with the last are absent between those that are there. */
#define MOST_DELAYED 16

/* Ticks from one picture to the next, by the mean rate of the stream, if that is the rate of
 * those that are there, all of them but at the end; else 0. */
static double even_step(const wf_video *v) {
    const wf_libav_reading *r = v->state;
    const wf_video_info *info = &v->info;
    double rate = av_q2d(r->format->streams[r->stream]->avg_frame_rate);
    double step = rate > 0 ? 1 / (rate * wf_ratio_value(info->tick_s)) : 0;
    for (int64_t n = 0; step > 0 && n < info->frames; n++) {
        double since = (double)(info->times[n] - info->times[0]);
        int64_t place = llround(since / step);
        bool in_place = n < info->frames - MOST_DELAYED ? place == n : place >= n;
        if (!in_place || fabs(since - step * (double)place) > 1) step = 0;
    }
    return step;
}

/* Those of a stream that states how long it is. */
static int64_t absent_of_length(const wf_video *v, double length_s) {
    const wf_video_info *info = &v->info;
    double tick_s = wf_ratio_value(info->tick_s), step = even_step(v);
    int64_t first = info->times[0], last = info->times[info->frames - 1], there = info->frames;
    if (step <= 0) step = (double)(last - first) / (double)(there - 1);
    double ends = length_s / tick_s, pictures = (ends - (double)first) / step;
    if (ends < (double)last + 1.5 * step) return 0;
    return pictures > 0 && pictures < (double)MOST_LOST ? llround(pictures) - there : 0;
}

/* How many pictures are absent at the end, which Matroska and an index tell. */
static int64_t absent(const wf_video *v) {
    const wf_libav_reading *r = v->state;
    const wf_video_info *info = &v->info;
    int64_t packets = wf_libav_stated_packets(r), more = packets ? packets - r->listed : 0;
    bool matroska = !strncmp(r->format->iformat->name, "matroska", 8);
    if (matroska && info->times && info->frames > 1)
        more = absent_of_length(v, wf_libav_stated_length_s(r));
    return more < 0 || more > MOST_TIMES * (info->frames + 10) ? 0 : more;
}

/* Those that are absent are shown as fast as the ones before them. */
static weft_status extend_times(wf_video *v, int64_t frames, weft_error *err) {
    wf_video_info *info = &v->info;
    int64_t there = info->frames;
    if (!info->times) return WEFT_OK;
    double step = even_step(v), mean = (double)info->last_ticks;
    int64_t *grown = realloc(info->times, (size_t)frames * sizeof *grown);
    if (!grown) return wf_video_no_memory(v, err);
    info->times = grown;
    if (there > 1) mean = (double)(grown[there - 1] - grown[0]) / (double)(there - 1);
    for (int64_t n = step > 0 ? 0 : there; n < frames; n++)
        grown[n] = grown[0] + llround((step > 0 ? step : mean) * (double)n);
    return WEFT_OK;
}

weft_status wf_libav_mend_count(wf_video *v, weft_error *err) {
    int64_t more = v->pipe || v->info.frames < 0 ? 0 : absent(v);
    weft_error why;
    if (!more) return WEFT_OK;
    wf_fail(&why, WEFT_FAILED,
            "%s: it was cut off: %" PRId64 " pictures are there, and it says that it has "
            "%" PRId64,
            v->path, v->info.frames, v->info.frames + more);
    wf_video_note_trouble(v, &why);
    weft_status status = extend_times(v, v->info.frames + more, err);
    if (!status) v->info.frames += more;
    return status;
}

/* ---- Giving ---- */

/* A missing picture is shown when it is listed, else one of the stated rate after the last. */
static void give_missing(wf_video *v) {
    const wf_video_info *info = &v->info;
    bool listed = info->times && v->frame.index < info->frames;
    wf_libav_give_time(v, listed ? info->times[v->frame.index] : AV_NOPTS_VALUE, 0);
    v->frame.missing = true;
}

static weft_status give_frame(wf_video *v, weft_error *err) {
    wf_libav_reading *r = v->state;
    if (!r->held) r->held = av_frame_alloc();
    if (!r->held) return wf_video_no_memory(v, err);
    av_frame_unref(r->held);
    av_frame_move_ref(r->held, r->frame);
    r->have = false;
    r->place = -1;
    r->lost = 0;
    wf_libav_give_time(v, r->held->best_effort_timestamp, r->held->pkt_duration);
    v->frame.missing = false;
    return WEFT_OK;
}

/* A file is as long as it says, by pictures that are missing; of a pipe it is noted that what
 * was there last is lost, or that it ends early. */
static void note_end(wf_video *v) {
    const wf_libav_reading *r = v->state;
    weft_error why;
    bool early = v->pipe && wf_libav_check_end(v, &why);
    if (early) wf_video_note_trouble(v, &why);
    v->troubles.cut = early || (v->info.frames < 0 && r->lost);
}

weft_status wf_libav_mend_next(wf_video *v, const AVFrame **frame, weft_error *err) {
    wf_libav_reading *r = v->state;
    *frame = NULL;
    weft_status status = find_frame(v, err);
    if (status) return status;
    if (r->have && r->place < 0) r->place = place_of(v);
    int64_t there = r->have ? r->place : v->info.frames;
    if (v->frame.index < there) {
        give_missing(v);
        *frame = r->held ? r->held : r->have ? r->frame : NULL;
        return WEFT_OK;
    }
    if (!r->have) {
        note_end(v);
        return WEFT_OK;
    }
    status = give_frame(v, err);
    *frame = r->held;
    return status;
}
