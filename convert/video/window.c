/* A window of decoded pictures, which moves forward over a video. */
#include "convert/video/window.h"

#include <inttypes.h>
#include <stdlib.h>

typedef struct slot {
    int64_t number; /* -1: it is free */
    uint16_t *code; /* of all planes */
} slot;

struct wf_video_window {
    wf_video *video;
    slot *slot;
    size_t slots, most_slots;
    size_t samples[3]; /* of each plane */
    int64_t next, end;
};

static size_t picture_samples(const wf_video_window *w) {
    return w->samples[0] + w->samples[1] + w->samples[2];
}

size_t wf_video_window_picture_bytes(const wf_video_window *w) {
    return picture_samples(w) * sizeof(uint16_t);
}

weft_status wf_video_window_new(wf_video *video, size_t most_bytes, wf_video_window **out,
                                weft_error *err) {
    wf_video_window *w = *out = calloc(1, sizeof *w);
    if (!w) {
        wf_video_close(video);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for the video");
    }
    w->video = video;
    w->end = -1;
    for (int p = 0; p < wf_video_info_of(video)->planes; p++) {
        int width, lines;
        wf_video_plane_size(video, p, &width, &lines);
        w->samples[p] = (size_t)width * (size_t)lines;
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
    return wf_video_ticks(w->video);
}

int64_t wf_video_window_lasts(const wf_video_window *w) {
    return wf_video_lasts(w->video);
}

void wf_video_window_forget(wf_video_window *w, int64_t number) {
    for (size_t i = 0; i < w->slots; i++)
        if (w->slot[i].number < number) w->slot[i].number = -1;
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
    grown[w->slots] = (slot){-1, malloc(wf_video_window_picture_bytes(w))};
    if (!grown[w->slots].code)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for a picture of the video");
    *out = &grown[w->slots++];
    return WEFT_OK;
}

static weft_status free_slot(wf_video_window *w, slot **out, weft_error *err) {
    for (size_t i = 0; i < w->slots; i++)
        if (w->slot[i].number < 0) {
            *out = &w->slot[i];
            return WEFT_OK;
        }
    return add_slot(w, out, err);
}

static void planes_of(const wf_video_window *w, uint16_t *code, uint16_t *plane[3]) {
    for (int p = 0; p < 3; p++) {
        plane[p] = code;
        code += w->samples[p];
    }
}

weft_status wf_video_window_advance(wf_video_window *w, bool keep, weft_error *err) {
    slot *to = NULL;
    uint16_t *plane[3];
    bool more = false;
    weft_status status = keep ? free_slot(w, &to, err) : WEFT_OK;
    if (status) return status;
    if (keep) planes_of(w, to->code, plane);
    status = wf_video_next_codes(w->video, keep ? plane : NULL, &more, err);
    if (status) return status;
    if (!more) {
        w->end = w->next;
        return WEFT_OK;
    }
    if (keep) to->number = w->next;
    w->next++;
    return WEFT_OK;
}

weft_status wf_video_window_jump(wf_video_window *w, int64_t number, weft_error *err) {
    return wf_video_seek(w->video, number, &w->next, err);
}

bool wf_video_window_find(const wf_video_window *w, int64_t number, const uint16_t *plane[3]) {
    for (size_t i = 0; i < w->slots; i++) {
        if (w->slot[i].number != number) continue;
        uint16_t *found[3];
        planes_of(w, w->slot[i].code, found);
        for (int p = 0; p < 3; p++) plane[p] = found[p];
        return true;
    }
    return false;
}
