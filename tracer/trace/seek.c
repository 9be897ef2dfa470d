/* Rays one by one through the trees of parts. */
#include "tracer/trace/seek.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"
#include "tracer/trace/nearest.h"

#define FEW_PARTS 40

typedef struct seeker {
    const wf_tracer *t;
    wf_trace_scratch *s;
    const wf_packet *packet;
    wf_hits *hits; /* of the packet */
    wf_seek_what what;
    const wf_grove *grove;
    const wf_rays *rays; /* of the packet, in the space of the grove */
    int ray;             /* of the packet, that is on its way */
    int taken;           /* that is the scratch's one ray; -1: none */
    bool failed;
    bool inside[WF_PACKET]; /* rays that start inside a union, which is to be seen as a whole */
    double far[WF_PACKET];  /* how far each is looked along */
    _Alignas(64) double rounding[WF_PACKET];
    wf_runs runs;
} seeker;

/* ---- Parts ---- */

/* Whether the point where the ray starts is in the solid that the runs are of. */
static bool starts_in(const wf_runs *r, int most_runs) {
    bool in = false;
    for (int k = 0; k < most_runs; k++) in |= r->in[k][0] < 0 && r->out[k][0] > 0;
    return in;
}

/* Makes the ray in hand the scratch's own, in as many places as loops run over. */
static void take_ray(seeker *q) {
    wf_trace_scratch *s = q->s;
    int lane = q->ray;
    if (q->taken == lane) return;
    wf_packet_take(q->packet, &lane, 1, &s->ray);
    wf_carry_begin(s);
    q->taken = lane;
}

/* The ray in the space of a leaf. NULL: no memory. */
static const wf_rays *rays_for(seeker *q, const wf_leaf *leaf, int *ray) {
    *ray = q->ray;
    if (leaf->op == q->grove->op) return q->rays;
    *ray = 0;
    q->s->spaces = &q->s->of_ray;
    take_ray(q);
    const wf_rays *rays = wf_carry_rays(q->t, q->s, &q->s->ray, leaf->op);
    q->s->spaces = &q->s->of_packet;
    return rays;
}

/* Without a look at the solid itself, which is far off in memory, unless it has a shape. */
static bool try_solid(seeker *q, const wf_leaf *leaf, bool around) {
    const wf_tracer *t = q->t;
    int ray, most_runs = wf_solid_type_of(leaf->kind)->most_runs;
    const wf_rays *rays = rays_for(q, leaf, &ray);
    wf_rays local;
    if (!rays) return false;
    t->packet->place_one(&leaf->inverse, rays, ray, &local);
    t->intersect[leaf->kind](&t->scene->solids[leaf->solid], t->scene->planes, &local,
                             &q->runs);
    q->inside[q->ray] |= around && starts_in(&q->runs, most_runs);
    t->packet->nearer_one(&q->runs, most_runs, q->rounding[q->ray], leaf->solid, q->ray,
                          q->hits);
    return true;
}

/* Programs are looked at for all rays together that may meet them. */
static bool wait_for(seeker *q, const wf_leaf *leaf, double near) {
    wf_trace_scratch *s = q->s;
    if (s->waiting_count == s->waiting_capacity) {
        size_t capacity = 2 * s->waiting_capacity + WF_PACKET;
        wf_waiting *grown = realloc(s->waiting, capacity * sizeof *grown);
        if (!grown) return false;
        s->waiting = grown;
        s->waiting_capacity = capacity;
    }
    s->waiting[s->waiting_count++] = (wf_waiting){leaf, near, q->ray};
    return true;
}

static bool is_around(const seeker *q, const wf_leaf *leaf, double near) {
    return q->what == WF_SEEK_NEAREST && near <= 0 && leaf->sibling;
}

static bool try_leaf(seeker *q, const wf_leaf *leaf, double near) {
    bool good = leaf->solid < 0 ? wait_for(q, leaf, near)
                                : try_solid(q, leaf, is_around(q, leaf, near));
    q->failed = !good;
    return good && !q->inside[q->ray] &&
           (q->what == WF_SEEK_NEAREST || q->hits->solid[q->ray] < 0);
}

/* ---- Ways ---- */

typedef struct way {
    seeker *q;
    const wf_leaf *last; /* what was met last */
} way;

static bool meet(void *user, wf_walk *walk, int place, double near) {
    way *w = user;
    seeker *q = w->q;
    const wf_leaf *leaf = &q->grove->leaves[place];
    bool on = try_leaf(q, leaf, near);
    walk->most = q->hits->s[q->ray];
    if (leaf->solid >= 0 && q->hits->solid[q->ray] >= 0) w->last = leaf;
    return on;
}

/* What stopped the ray before is likely to stop this one. */
static void go_one(way *w) {
    seeker *q = w->q;
    const wf_rays *r = q->rays;
    int i = q->ray;
    wf_walk walk = {.o = {r->ox[i], r->oy[i], r->oz[i]},
                    .d = {r->dx[i], r->dy[i], r->dz[i]},
                    .most = q->hits->s[i],
                    .meet = meet,
                    .user = w};
    if (q->what == WF_SEEK_ANY && w->last && !try_leaf(q, w->last, 0)) return;
    q->t->walk->go(&q->grove->tree, &walk);
}

static bool go_through(seeker *q, const wf_grove *grove) {
    way w = {.q = q};
    q->grove = grove;
    if (!grove->tree.item_count) return true;
    q->rays = wf_carry_rays(q->t, q->s, q->packet, grove->op);
    if (!q->rays) return false;
    for (q->ray = 0; q->ray < q->packet->rays.count && !q->failed; q->ray++) {
        bool found = q->what == WF_SEEK_ANY && q->hits->solid[q->ray] >= 0;
        if (!found && !q->inside[q->ray]) go_one(&w);
    }
    return !q->failed;
}

/* ---- Programs ---- */

static int by_leaf(const void *a, const void *b) {
    const wf_waiting *p = a, *q = b;
    if (p->leaf != q->leaf) return (p->leaf > q->leaf) - (p->leaf < q->leaf);
    return p->ray - q->ray;
}

/* Those of the rays for which the part may still matter. *around: one may start inside it. */
static int still_waiting(const seeker *q, const wf_waiting *w, size_t count, int *lane,
                         bool *around) {
    int n = 0;
    *around = false;
    for (size_t k = 0; k < count; k++) {
        int i = w[k].ray;
        bool found = q->what == WF_SEEK_ANY && q->hits->solid[i] >= 0;
        if (found || q->inside[i] || w[k].near > q->hits->s[i]) continue;
        *around |= is_around(q, w[k].leaf, w[k].near);
        lane[n++] = i;
    }
    return n;
}

/* The part for those rays alone, and what they meet of it. */
static bool try_program(const seeker *q, const wf_leaf *leaf, bool *inside) {
    wf_trace_scratch *s = q->s;
    wf_packet *some = &s->some;
    _Alignas(64) double rounding[WF_PACKET];
    wf_shaft shaft = wf_shaft_of_rays(&some->rays, HUGE_VAL);
    wf_carry_begin(s);
    q->t->packet->rounding(&some->rays, WF_ROUNDING, rounding);
    return wf_find_part(q->t, s, some, &shaft, leaf->part, &s->alone) &&
           (!s->alone.part_count ||
            wf_nearest_part(q->t, s, some, &s->alone, rounding, inside, &s->some_hits));
}

/* Where one of them starts inside the part, all are looked at again. */
static bool try_waiting(seeker *q, const wf_waiting *w, size_t count) {
    wf_hits *hits = &q->s->some_hits;
    int lane[WF_PACKET];
    bool around, inside = false;
    int n = still_waiting(q, w, count, lane, &around);
    if (!n) return true;
    wf_packet_take(q->packet, lane, n, &q->s->some);
    for (int k = 0; k < wf_places(n); k++)
        wf_hits_copy(q->hits, lane[k < n ? k : n - 1], hits, k);
    q->s->spaces = &q->s->of_ray;
    bool good = try_program(q, w->leaf, around ? &inside : NULL);
    q->s->spaces = &q->s->of_packet;
    for (int k = 0; k < n; k++) {
        wf_hits_copy(hits, k, q->hits, lane[k]);
        q->inside[lane[k]] |= inside;
    }
    return good;
}

static bool try_programs(seeker *q) {
    wf_trace_scratch *s = q->s;
    size_t end;
    if (s->waiting_count) qsort(s->waiting, s->waiting_count, sizeof *s->waiting, by_leaf);
    for (size_t first = 0; first < s->waiting_count; first = end) {
        const wf_waiting *w = &s->waiting[first];
        for (end = first + 1; end < s->waiting_count && s->waiting[end].leaf == w->leaf;) end++;
        if (!try_waiting(q, w, end - first)) return false;
    }
    return true;
}

/* ---- Packets ---- */

/* Rays that start inside unions, together as packets are looked at. */
static bool look_again(const seeker *q) {
    wf_packet *some = &q->s->some;
    wf_hits *found = &q->s->some_hits;
    int lane[WF_PACKET], count = 0;
    for (int i = 0; i < q->packet->rays.count; i++)
        if (q->inside[i]) lane[count++] = i;
    if (!count) return true;
    wf_packet_take(q->packet, lane, count, some);
    wf_hits_clear(found);
    for (int k = 0; k < wf_places(count); k++)
        found->s[k] = q->far[lane[k < count ? k : count - 1]];
    wf_shaft shaft = wf_shaft_of_rays(&some->rays, HUGE_VAL);
    wf_carry_begin(q->s);
    bool good = wf_find(q->t, q->s, some, &shaft, &q->s->around) &&
                wf_nearest(q->t, q->s, some, &q->s->around, true, found);
    for (int k = 0; k < count; k++) wf_hits_copy(found, k, q->hits, lane[k]);
    wf_carry_begin(q->s); /* what has been carried is of some */
    return good;
}

/* What has no box is tried by all. */
static bool try_endless(const seeker *q) {
    if (!q->t->endless_count) return true;
    wf_shaft shaft = wf_shaft_of_rays(&q->packet->rays, HUGE_VAL);
    return wf_find_endless(q->t, q->s, q->packet, &shaft, &q->s->around) &&
           wf_nearest(q->t, q->s, q->packet, &q->s->around, false, q->hits);
}

/* A ray that starts in a union whose parts have no box would not be known to. */
int wf_seek_above(const wf_tracer *t, wf_seek_what what) {
    bool can = t->skip && (what == WF_SEEK_ANY || !t->endless_sibling);
    return can ? FEW_PARTS : t->part_count;
}

bool wf_seek(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
             wf_seek_what what, wf_hits *hits) {
    seeker q = {.t = t, .s = s, .packet = packet, .hits = hits, .what = what, .taken = -1};
    memcpy(q.far, hits->s, sizeof q.far);
    if (!try_endless(&q)) return false;
    t->packet->rounding(&packet->rays, WF_ROUNDING, q.rounding);
    s->waiting_count = 0;
    for (int n = 0; n < t->groves->count; n++)
        if (!go_through(&q, &t->groves->grove[n])) return false;
    return try_programs(&q) && look_again(&q);
}
