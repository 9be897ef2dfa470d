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
    int ray;             /* of the packet, that sets out next */
    int taken;           /* that is the scratch's one ray; -1: none */
    const wf_leaf *last; /* what stopped a ray last */
    wf_holder_fn *found; /* of WF_SEEK_HOLDERS */
    void *user;
    bool failed;
    bool inside[WF_PACKET]; /* rays that start inside a union, which is to be seen as a whole */
    double far[WF_PACKET];  /* how far each is looked along */
    _Alignas(64) double rounding[WF_PACKET];
    wf_runs runs;
} seeker;

/* ---- Parts ---- */

/* Whether the point where the ray starts is in the solid that the runs are of. */
static bool starts_in(const wf_runs *r, int most_runs, int place) {
    bool in = false;
    for (int k = 0; k < most_runs; k++) in |= r->in[k][place] < 0 && r->out[k][place] > 0;
    return in;
}

/* Makes a ray the scratch's own, in as many places as loops run over. */
static void take_ray(seeker *q, int ray) {
    wf_trace_scratch *s = q->s;
    if (q->taken == ray) return;
    wf_packet_take(q->packet, &ray, 1, &s->ray);
    wf_carry_begin(s);
    q->taken = ray;
}

/* The ray in the space of a leaf, and which it is there. NULL: no memory. */
static const wf_rays *rays_for(seeker *q, const wf_leaf *leaf, int *ray) {
    if (leaf->op == q->grove->op) return q->rays;
    q->s->spaces = &q->s->of_ray;
    take_ray(q, *ray);
    *ray = 0;
    const wf_rays *rays = wf_carry_rays(q->t, q->s, &q->s->ray, leaf->op);
    q->s->spaces = &q->s->of_packet;
    return rays;
}

static bool is_around(const seeker *q, const wf_leaf *leaf, double near) {
    return q->what == WF_SEEK_NEAREST && near <= 0 && leaf->sibling;
}

/* What the runs say of rays and solids of one kind. */
static void take_runs(seeker *q, const wf_met *m, int count) {
    const wf_leaf *leaves = q->grove->leaves;
    int most_runs = wf_solid_type_of(leaves[~m->item[0]].kind)->most_runs;
    int solid[WF_PACKET];
    for (int k = 0; k < count; k++) {
        const wf_leaf *leaf = &leaves[~m->item[k]];
        solid[k] = leaf->solid;
        if (q->what == WF_SEEK_HOLDERS && starts_in(&q->runs, most_runs, k))
            q->found(q->user, m->ray[k], leaf->part);
        if (is_around(q, leaf, m->near[k]))
            q->inside[m->ray[k]] |= starts_in(&q->runs, most_runs, k);
    }
    if (q->what == WF_SEEK_HOLDERS) return;
    q->t->packet->nearer_each(&q->runs, most_runs, q->rounding, solid, m->ray, count, q->hits);
    for (int k = 0; q->what == WF_SEEK_ANY && k < count; k++)
        if (q->hits->solid[m->ray[k]] >= 0) q->last = &leaves[~m->item[k]];
}

/* One ray and one solid. */
static bool try_solid(seeker *q, const wf_met *m) {
    const wf_tracer *t = q->t;
    const wf_leaf *leaf = &q->grove->leaves[~m->item[0]];
    const wf_affine *map = &leaf->inverse;
    int ray = m->ray[0];
    const wf_rays *rays = rays_for(q, leaf, &ray);
    wf_rays local;
    if (!rays) return false;
    t->packet->place_each(&map, rays, &ray, 1, &local);
    t->intersect[leaf->kind](&t->scene->solids[leaf->solid], t->scene->planes, &local,
                             &q->runs);
    take_runs(q, m, 1);
    return true;
}

/* Rays that each meet a solid of one kind, all of which are alike: without a look at the solids
 * themselves, which are far off in memory. */
static void try_alike(seeker *q, const wf_met *m, int kind) {
    const wf_affine *map[WF_PACKET];
    wf_rays local;
    for (int k = 0; k < m->count; k++) map[k] = &q->grove->leaves[~m->item[k]].inverse;
    q->t->packet->place_each(map, q->rays, m->ray, m->count, &local);
    q->t->intersect[kind](NULL, NULL, &local, &q->runs);
    take_runs(q, m, m->count);
}

/* Programs are looked at for all rays together that may meet them. */
static bool wait_for(seeker *q, const wf_met *m) {
    wf_trace_scratch *s = q->s;
    if (s->waiting_count == s->waiting_capacity) {
        size_t capacity = 2 * s->waiting_capacity + WF_PACKET;
        wf_waiting *grown = realloc(s->waiting, capacity * sizeof *grown);
        if (!grown) return false;
        s->waiting = grown;
        s->waiting_capacity = capacity;
    }
    const wf_leaf *leaf = &q->grove->leaves[~m->item[0]];
    s->waiting[s->waiting_count++] = (wf_waiting){leaf, m->near[0], m->ray[0]};
    return true;
}

static void add_met(const wf_met *from, int k, wf_met *to) {
    to->near[to->count] = from->near[k];
    to->item[to->count] = from->item[k];
    to->ray[to->count++] = from->ray[k];
}

/* Asks memory for a leaf before it is looked at. */
static void ask_for(const wf_leaf *leaf) {
    __builtin_prefetch(leaf);
    __builtin_prefetch((const char *)leaf + 64);
}

/* What was met of parts and solids that are like no other: one by one. Leaves the rest. */
static bool try_others(seeker *q, wf_met *met) {
    wf_met one;
    int count = met->count;
    met->count = 0;
    for (int k = 0; k < count; k++) {
        int item = ~met->item[k];
        ask_for(&q->grove->leaves[item]);
        one.count = 0;
        add_met(met, k, q->grove->kinds[item] < WF_SOLID_KINDS ? met : &one);
        if (!one.count) continue;
        if (!(q->grove->leaves[item].solid < 0 ? wait_for(q, &one) : try_solid(q, &one)))
            return false;
    }
    return true;
}

/* Takes those out of what was met that are of the kind of the first, which it returns. */
static int take_kind(const seeker *q, wf_met *met, wf_met *some) {
    const uint8_t *kinds = q->grove->kinds;
    int count = met->count, kind = kinds[~met->item[0]];
    met->count = some->count = 0;
    for (int k = 0; k < count; k++) {
        bool takes = kinds[~met->item[k]] == kind && some->count < WF_PACKET;
        add_met(met, k, takes ? some : met);
    }
    return kind;
}

/* Tries what ways have come to: those of one kind together. */
static bool try_met(seeker *q) {
    wf_met *met = &q->s->met, some;
    if (!try_others(q, met)) return false;
    while (met->count > 0) {
        int kind = take_kind(q, met, &some);
        try_alike(q, &some, kind);
    }
    return true;
}

/* ---- Ways ---- */

static bool has_found(const seeker *q, int ray) {
    return q->inside[ray] || (q->what == WF_SEEK_ANY && q->hits->solid[ray] >= 0);
}

/* What stopped another ray before is likely to stop this one. */
static void guess(const seeker *q, int ray) {
    wf_met *m = &q->s->met;
    if (q->what != WF_SEEK_ANY || !q->last) return;
    m->near[m->count] = 0;
    m->item[m->count] = ~(int)(q->last - q->grove->leaves);
    m->ray[m->count++] = ray;
}

/* Has rays that are to go set out for as long as there is space. */
static void set_out(seeker *q) {
    wf_ways *w = &q->s->ways;
    for (; q->ray < q->packet->rays.count && w->count < WF_WAYS; q->ray++) {
        if (has_found(q, q->ray)) continue;
        guess(q, q->ray);
        wf_ways_add(&q->grove->tree, q->ray, w);
    }
}

static void end_ways(seeker *q) {
    wf_ways *w = &q->s->ways;
    for (int k = w->count; k-- > 0;)
        if (!w->stops[k] || has_found(q, w->ray[k])) wf_ways_remove(k, w);
}

/* Many rays are on their way at once, so that what they come to is looked at together. */
static bool go_through(seeker *q, const wf_grove *grove) {
    wf_trace_scratch *s = q->s;
    q->grove = grove;
    q->last = NULL;
    q->ray = 0;
    s->met.count = 0;
    wf_ways_clear(&s->ways);
    if (!grove->tree.item_count) return true;
    q->rays = wf_carry_rays(q->t, s, q->packet, grove->op);
    if (!q->rays) return false;
    q->t->walk->begin(&grove->tree, q->rays, &s->walk);
    for (set_out(q); s->ways.count > 0; set_out(q)) {
        q->t->walk->step(&grove->tree, &s->walk, q->hits->s, &s->ways, &s->met);
        if (!try_met(q)) return false;
        end_ways(q);
    }
    return true;
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

/* Tells of those of the rays that start in the part. */
static bool try_holder(const seeker *q, const wf_leaf *leaf, const int *lane) {
    wf_trace_scratch *s = q->s;
    uint8_t in[WF_PACKET];
    wf_shaft shaft = wf_shaft_of_rays(&s->some.rays, 0);
    wf_carry_begin(s);
    if (!wf_find_part(q->t, s, &s->some, &shaft, leaf->part, &s->alone)) return false;
    if (!s->alone.part_count) return true;
    if (!wf_holds(q->t, s, &s->some, &s->alone, 0, in)) return false;
    for (int k = 0; k < s->some.rays.count; k++)
        if (in[k]) q->found(q->user, lane[k], leaf->part);
    return true;
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
    bool holders = q->what == WF_SEEK_HOLDERS;
    bool good = holders ? try_holder(q, w->leaf, lane)
                        : try_program(q, w->leaf, around ? &inside : NULL);
    q->s->spaces = &q->s->of_packet;
    if (holders) return good;
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

static bool go_through_all(seeker *q) {
    q->s->waiting_count = 0;
    q->t->packet->rounding(&q->packet->rays, WF_ROUNDING, q->rounding);
    for (int n = 0; n < q->t->groves->count; n++)
        if (!go_through(q, &q->t->groves->grove[n])) return false;
    return try_programs(q);
}

bool wf_seek(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
             wf_seek_what what, wf_hits *hits) {
    seeker q = {.t = t, .s = s, .packet = packet, .hits = hits, .what = what, .taken = -1};
    memcpy(q.far, hits->s, sizeof q.far);
    return try_endless(&q) && go_through_all(&q) && look_again(&q);
}

bool wf_seek_holders(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                     wf_holder_fn *found, void *user) {
    wf_hits hits;
    seeker q = {.t = t,
                .s = s,
                .packet = packet,
                .hits = &hits,
                .what = WF_SEEK_HOLDERS,
                .taken = -1,
                .found = found,
                .user = user};
    wf_hits_clear(&hits);
    memset(hits.s, 0, sizeof hits.s);
    return go_through_all(&q);
}
