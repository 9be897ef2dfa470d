/* A window of decoded pictures, which moves forward over a video. */
#include "convert/video/window.h"

#include <inttypes.h>
#include <stdlib.h>

typedef struct slot {
    int64_t number; /* -1: it is free; AHEAD: its picture is not taken yet */
    uint8_t *code;  /* of all planes */
    bool missing;
} slot;

/* What decoding one picture more has given. */
typedef struct outcome {
    weft_status status;
    weft_error error;
    bool more, missing;
    int64_t ticks, lasts;
    size_t at; /* its slot */
} outcome;

enum { AHEAD = -2, MOST_AHEAD = 8 };

struct wf_video_window {
    wf_video *video;
    int64_t ticks, lasts;      /* of the picture taken last */
    outcome ahead[MOST_AHEAD]; /* pictures that are not taken yet */
    int planned, read, taken;  /* of ahead */
    slot *slot;
    size_t slots, most_slots;
    size_t bytes[4]; /* of each plane */
    int64_t next, end;
};

size_t wf_video_window_picture_bytes(const wf_video_window *w) {
    return w->bytes[0] + w->bytes[1] + w->bytes[2] + w->bytes[3];
}

weft_status wf_video_window_new(wf_video *video, bool want_alpha, size_t most_bytes,
                                wf_video_window **out, weft_error *err) {
    wf_video_window *w = *out = calloc(1, sizeof *w);
    if (!w) {
        wf_video_close(video);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for the video");
    }
    w->video = video;
    w->end = -1;
    w->ticks = INT64_MIN;
    const wf_video_info *info = wf_video_info_of(video);
    for (int p = 0; p < 4; p++) {
        bool there = p < 3 ? p < info->planes : info->alpha && want_alpha;
        if (!there) continue;
        int width, lines;
        wf_video_plane_size(video, p, &width, &lines);
        w->bytes[p] = (size_t)width * (size_t)lines * wf_video_code_bytes(info);
    }
    w->most_slots = most_bytes / wf_video_window_picture_bytes(w);
    return WEFT_OK;
}

void wf_video_window_free(wf_video_window *w) {
    if (!w) return;
    for (size_t i = 0; i < w->slots; i++) free(w->slot[i].code);
    free(w->slot);
    wf_video_close(w->video);
    free(w);
}

int64_t wf_video_window_next(const wf_video_window *w) {
    return w->next;
}

int64_t wf_video_window_end(const wf_video_window *w) {
    return w->end;
}

int64_t wf_video_window_ticks(const wf_video_window *w) {
    return w->ticks;
}

int64_t wf_video_window_lasts(const wf_video_window *w) {
    return w->lasts;
}

void wf_video_window_forget(wf_video_window *w, int64_t number) {
    for (size_t i = 0; i < w->slots; i++)
        if (w->slot[i].number < number && w->slot[i].number != AHEAD) w->slot[i].number = -1;
}

static weft_status add_slot(wf_video_window *w, slot **out, weft_error *err) {
    slot *grown = NULL;
    if (w->slots >= w->most_slots)
        return wf_fail(err, WEFT_NO_MEMORY,
                       "a field needs more than %zu pictures of the video at once, which is "
                       "what --max-memory allows; allow more, or take a shorter "
                       "--temporal-width",
                       w->slots);
    grown = realloc(w->slot, (w->slots + 1) * sizeof *grown);
    if (!grown) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a picture of the video");
    w->slot = grown;
    grown[w->slots] = (slot){-1, malloc(wf_video_window_picture_bytes(w)), false};
    if (!grown[w->slots].code)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for a picture of the video");
    *out = &grown[w->slots++];
    return WEFT_OK;
}

static weft_status free_slot(wf_video_window *w, slot **out, weft_error *err) {
    for (size_t i = 0; i < w->slots; i++)
        if (w->slot[i].number == -1) {
            *out = &w->slot[i];
            return WEFT_OK;
        }
    return add_slot(w, out, err);
}

static void planes_of(const wf_video_window *w, uint8_t *code, void *plane[4]) {
    for (int p = 0; p < 4; p++) {
        plane[p] = code;
        code += w->bytes[p];
    }
}

static outcome decode(wf_video_window *w, const slot *to) {
    outcome o = {.ticks = INT64_MIN};
    void *plane[4];
    if (to) planes_of(w, to->code, plane);
    o.status = wf_video_next_codes(w->video, to ? plane : NULL, &o.more, &o.error);
    if (o.status || !o.more) return o;
    o.ticks = wf_video_ticks(w->video);
    o.lasts = wf_video_lasts(w->video);
    o.missing = wf_video_is_missing(w->video);
    return o;
}

/* Takes what was decoded to a slot, which may be NULL, and keeps it or not. */
static weft_status take(wf_video_window *w, const outcome *o, slot *to, bool keep,
                        weft_error *err) {
    if (to) to->number = !o->status && o->more && keep ? w->next : -1;
    if (to) to->missing = o->missing;
    if (o->status) return wf_fail(err, o->status, "%s", o->error.text);
    if (!o->more) {
        w->end = w->next;
        return WEFT_OK;
    }
    w->ticks = o->ticks;
    w->lasts = o->lasts;
    w->next++;
    return WEFT_OK;
}

/* ---- Reading ahead ---- */

void wf_video_window_plan_ahead(wf_video_window *w, int count) {
    slot *to;
    if (w->taken < w->read || w->end >= 0) return;
    w->planned = w->read = w->taken = 0;
    /* What a field needs at once comes first. */
    size_t most = w->most_slots / 2;
    while (w->planned < count && w->planned < MOST_AHEAD && (size_t)w->planned < most &&
           !free_slot(w, &to, NULL)) {
        to->number = AHEAD;
        w->ahead[w->planned++].at = (size_t)(to - w->slot);
    }
}

void wf_video_window_read_ahead(wf_video_window *w) {
    bool more = true;
    for (; more && w->read < w->planned; w->read++) {
        size_t at = w->ahead[w->read].at;
        w->ahead[w->read] = decode(w, &w->slot[at]);
        w->ahead[w->read].at = at;
        more = !w->ahead[w->read].status && w->ahead[w->read].more;
    }
}

/* Slots for which there was no picture, or whose picture nobody waits for, are free again. */
static void drop_ahead(wf_video_window *w) {
    for (; w->taken < w->planned; w->taken++) w->slot[w->ahead[w->taken].at].number = -1;
    w->planned = w->read = w->taken = 0;
}

weft_status wf_video_window_advance(wf_video_window *w, bool keep, weft_error *err) {
    slot *to = NULL;
    if (w->taken < w->read) {
        const outcome *o = &w->ahead[w->taken++];
        return take(w, o, &w->slot[o->at], keep, err);
    }
    drop_ahead(w);
    weft_status status = keep ? free_slot(w, &to, err) : WEFT_OK;
    if (status) return status;
    outcome o = decode(w, to);
    return take(w, &o, to, keep, err);
}

weft_status wf_video_window_jump(wf_video_window *w, int64_t number, weft_error *err) {
    drop_ahead(w);
    return wf_video_seek(w->video, number, &w->next, err);
}

weft_status wf_video_window_check_whole(const wf_video_window *w, weft_error *err) {
    return wf_video_check_whole(w->video, err);
}

static const slot *slot_of(const wf_video_window *w, int64_t number) {
    for (size_t i = 0; i < w->slots; i++)
        if (w->slot[i].number == number) return &w->slot[i];
    return NULL;
}

bool wf_video_window_find(const wf_video_window *w, int64_t number, const void *plane[4]) {
    const slot *found = slot_of(w, number);
    void *planes[4];
    if (!found) return false;
    planes_of(w, found->code, planes);
    for (int p = 0; p < 4; p++) plane[p] = planes[p];
    return true;
}

bool wf_video_window_lacks(const wf_video_window *w, int64_t number) {
    const slot *found = slot_of(w, number);
    return found && found->missing;
}

const wf_video_troubles *wf_video_window_troubles(const wf_video_window *w) {
    return wf_video_troubles_of(w->video);
}
