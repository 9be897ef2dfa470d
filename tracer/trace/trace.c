/* Tracing: scratch, rectangles that are prepared for, and samples in packets. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/trace/camera.h"
#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"
#include "tracer/trace/seek.h"
#include "tracer/trace/shade.h"

/* ---- Scratch ---- */

static bool make_scratch(const wf_tracer *t, wf_trace_scratch *s) {
    size_t stack = (size_t)t->most_stack + 2;
    s->levels = t->scene->depth_limit + 1;
    s->found = malloc(((size_t)t->part_count + 1) * sizeof *s->found);
    s->stack = malloc(stack * sizeof *s->stack);
    s->in = aligned_alloc(64, stack * sizeof *s->in);
    s->spaces = &s->of_packet;
    size_t ops = (size_t)t->scene->op_count + 1;
    s->of_packet.carried_of = calloc(ops, sizeof *s->of_packet.carried_of);
    s->of_ray.carried_of = calloc(ops, sizeof *s->of_ray.carried_of);
    size_t bytes = ((size_t)s->levels * sizeof *s->level + 63) / 64 * 64;
    s->level = aligned_alloc(64, bytes);
    if (s->level) memset(s->level, 0, bytes);
    return s->found && s->stack && s->in && s->of_packet.carried_of && s->of_ray.carried_of &&
           s->level;
}

wf_trace_scratch *wf_trace_scratch_new(const wf_tracer *t) {
    size_t bytes = (sizeof(wf_trace_scratch) + 63) / 64 * 64;
    wf_trace_scratch *s = aligned_alloc(64, bytes);
    if (!s) return NULL;
    memset(s, 0, bytes);
    if (make_scratch(t, s)) return s;
    wf_trace_scratch_free(s);
    return NULL;
}

static void free_spaces(wf_spaces *s) {
    for (int n = 0; n < s->carried_capacity; n++) free(s->carried[n]);
    free(s->carried);
    free(s->carried_of);
}

void wf_trace_scratch_free(wf_trace_scratch *s) {
    if (!s) return;
    for (int n = 0; s->level && n < s->levels; n++) wf_culls_free(&s->level[n].culls);
    free_spaces(&s->of_packet);
    free_spaces(&s->of_ray);
    wf_culls_free(&s->tile);
    free(s->found);
    free(s->stack);
    free(s->in);
    free(s->level);
    free(s->runs);
    wf_culls_free(&s->joined);
    wf_culls_free(&s->passage.culls);
    wf_culls_free(&s->probe.culls);
    wf_culls_free(&s->alone);
    wf_culls_free(&s->around);
    wf_culls_free(&s->shadow);
    free(s->joined_in);
    free(s->waiting);
    free(s);
}

wf_trace_counts wf_trace_counted(const wf_trace_scratch *s) {
    return s->counts;
}

/* ---- Tracing ---- */

/* Of tiles that may see more parts than these no list is made: each packet looks for its own.
 */
#define TILE_PARTS 256
_Static_assert(WF_TRACE_PACKET == WF_PACKET, "what is told of packets is what they are");

bool wf_trace_prepare(const wf_tracer *t, wf_trace_scratch *s, const double x[2],
                      const double y[2], bool *empty) {
    wf_shaft shaft = wf_camera_shaft(t, x, y);
    int most = TILE_PARTS > wf_seek_above(t, WF_SEEK_NEAREST) ? TILE_PARTS : t->part_count;
    if (!wf_find_few(t, s, NULL, &shaft, most, &s->tile_few, &s->tile)) return false;
    *empty = s->tile_few && s->tile.part_count == 0;
    s->counts.tiles++;
    s->counts.tiles_skipped += *empty;
    return true;
}

bool wf_trace_nothing(const wf_tracer *t, wf_trace_scratch *s, const double x[2],
                      const double y[2]) {
    wf_shaft shaft = wf_camera_shaft(t, x, y);
    bool few;
    return wf_find_few(t, s, NULL, &shaft, TILE_PARTS, &few, &s->tile) && few &&
           s->tile.part_count == 0;
}

void wf_trace_skip(wf_trace_scratch *s) {
    s->counts.tiles++;
    s->counts.tiles_skipped++;
}

static void fill_packet(const wf_tracer *t, const wf_trace_samples *samples, size_t first,
                        wf_packet *packet) {
    _Alignas(64) double x[WF_PACKET], y[WF_PACKET];
    size_t left = samples->count - first;
    packet->rays.count = left < WF_PACKET ? (int)left : WF_PACKET;
    packet->late_s = samples->late_s;
    for (int i = 0; i < WF_PACKET; i++) {
        size_t at = first + (size_t)(i < packet->rays.count ? i : packet->rays.count - 1);
        x[i] = samples->x[at];
        y[i] = samples->y[at];
        packet->f[i] = samples->f[at];
    }
    wf_camera_rays(t, x, y, packet);
}

/* From the tile's list, what this packet can meet. */
static bool look_from_tile(const wf_tracer *t, wf_trace_scratch *s) {
    wf_trace_level *l = &s->level[0];
    if (!s->tile_few) return wf_look_about(t, s, 0);
    wf_carry_begin(s);
    if (!t->skip) return wf_look_along(t, s, 0, &s->tile);
    wf_shaft shaft = wf_shaft_of_rays(&l->packet.rays, HUGE_VAL);
    return wf_find_again(t, s, &l->packet, &shaft, &s->tile, &l->culls) &&
           wf_look_along(t, s, 0, &l->culls);
}

static void take_light(const wf_trace_level *l, const wf_trace_samples *samples, size_t first) {
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < l->packet.rays.count; i++)
            samples->rgb[c][first + (size_t)i] = (float)l->rgb[c][i];
    for (int i = 0; samples->alpha && i < l->packet.rays.count; i++)
        samples->alpha[first + (size_t)i] = (float)l->alpha[i];
}

bool wf_trace(const wf_tracer *t, wf_trace_scratch *s, const wf_trace_samples *samples) {
    s->counts.samples += (int64_t)samples->count;
    for (size_t first = 0; first < samples->count; first += WF_PACKET) {
        fill_packet(t, samples, first, &s->level[0].packet);
        s->level[0].open = true;
        if (!look_from_tile(t, s)) return false;
        take_light(&s->level[0], samples, first);
    }
    return true;
}
