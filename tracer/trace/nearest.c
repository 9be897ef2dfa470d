/* The nearest surface along each ray of a packet. */
#include "tracer/trace/nearest.h"

#include <math.h>
#include <stdlib.h>

#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"

/* ---- Hits ---- */

typedef struct search {
    const wf_tracer *t;
    wf_trace_scratch *s;
    const wf_packet *packet;
    const wf_culls *culls;
    wf_hits *hits;
    const double *rounding;
} search;

static int most_runs(const search *q, int solid) {
    return wf_solid_type_of(q->t->scene->solids[solid].kind)->most_runs;
}

/* As many as the solid has at most. */
static bool make_runs(const search *q, int solid, wf_runs *runs) {
    const wf_solid *form = &q->t->scene->solids[solid];
    const wf_rays *rays = wf_carry_rays(q->t, q->s, q->packet, form->op);
    wf_rays local;
    if (!rays) return false;
    q->t->packet->place(&form->inverse, rays, &local);
    q->t->intersect[form->kind](form, q->t->scene->planes, &local, runs);
    return true;
}

/* Makes the scratch's runs as many as are needed; what was in them is lost. */
static bool reserve_runs(wf_trace_scratch *s, size_t need) {
    if (need <= s->runs_capacity) return true;
    free(s->runs);
    s->runs_capacity = 0;
    s->runs = aligned_alloc(64, 2 * need * sizeof *s->runs);
    if (s->runs) s->runs_capacity = 2 * need;
    return s->runs;
}

static bool make_part_runs(const search *q, const wf_culls *culls, const wf_culled *part) {
    if (!reserve_runs(q->s, (size_t)part->solid_count)) return false;
    for (int k = 0; k < part->solid_count; k++) {
        int solid = culls->solid[part->solid + (size_t)k];
        if (!make_runs(q, solid, &q->s->runs[k])) return false;
        if (most_runs(q, solid) < 2)
            q->t->packet->no_second_run(&q->s->runs[k], q->packet->rays.count);
    }
    return true;
}

static wf_csg program_of(const search *q, const wf_culls *culls, const wf_culled *part) {
    return (wf_csg){culls->step + part->step,   part->step_count,  q->s->runs,
                    culls->solid + part->solid, part->solid_count, q->packet->rays.count};
}

static bool try_solid(search *q, int solid) {
    if (!reserve_runs(q->s, 1) || !make_runs(q, solid, q->s->runs)) return false;
    q->t->packet->nearer(q->s->runs, most_runs(q, solid), q->rounding, solid,
                         q->packet->rays.count, q->hits);
    return true;
}

static bool try_part(search *q, const wf_culled *part) {
    if (part->solid_count == 1) return try_solid(q, q->culls->solid[part->solid]);
    if (!make_part_runs(q, q->culls, part)) return false;
    wf_csg csg = program_of(q, q->culls, part);
    q->t->csg->nearest(&csg, q->rounding, q->s->in, q->hits);
    return true;
}

/* ---- Rays that start inside a union ---- */

static bool holds(const search *q, const wf_culled *part, uint8_t *in) {
    const double start[WF_PACKET] = {0};
    if (!make_part_runs(q, q->culls, part)) return false;
    wf_csg csg = program_of(q, q->culls, part);
    q->t->csg->inside(&csg, start, q->s->in, in);
    return true;
}

bool wf_holds(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
              const wf_culls *culls, size_t part, uint8_t *in) {
    const search q = {.t = t, .s = s, .packet = packet, .culls = culls};
    return holds(&q, &culls->part[part], in);
}

static bool starts_inside(search *q, const wf_culled *part, bool *inside) {
    uint8_t in[WF_PACKET];
    if (!holds(q, part, in)) return false;
    for (int i = 0; i < q->packet->rays.count; i++) *inside |= in[i];
    return true;
}

/* A stack for programs of any number of operands; what was in it is lost. */
static wf_csg_entry *joined_stack(wf_trace_scratch *s, size_t need) {
    if (need <= s->joined_in_capacity) return s->joined_in;
    free(s->joined_in);
    s->joined_in_capacity = 0;
    s->joined_in = aligned_alloc(64, 2 * need * sizeof *s->joined_in);
    if (s->joined_in) s->joined_in_capacity = 2 * need;
    return s->joined_in;
}

/* All parts of one object as the union that they are. */
static bool try_union(search *q, int object) {
    wf_culls *joined = &q->s->joined;
    if (!wf_culls_join(q->culls, q->t->parts, object, joined)) return false;
    const wf_culled *all = &joined->part[0];
    wf_csg_entry *stack = joined_stack(q->s, (size_t)all->step_count + 1);
    if (!stack || !make_part_runs(q, joined, all)) return false;
    wf_csg csg = program_of(q, joined, all);
    q->t->csg->nearest(&csg, q->rounding, stack, q->hits);
    return true;
}

/* The object, of several parts, that a ray starts inside of; -1: none. Rays start inside of one
 * at most that matters: where two objects overlap each has its own surfaces. */
static bool find_around(search *q, int after, int *object) {
    int found = -1;
    for (size_t n = 0; n < q->culls->part_count; n++) {
        const wf_culled *part = &q->culls->part[n];
        int of = q->t->parts[part->part].object;
        bool inside = false;
        if (part->near > 0 || of <= after || !q->t->sibling[of] || (found >= 0 && of >= found))
            continue;
        if (!starts_inside(q, part, &inside)) return false;
        if (inside) found = of;
    }
    *object = found;
    return true;
}

bool wf_nearest_part(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                     const wf_culls *culls, const double *rounding, bool *inside,
                     wf_hits *hits) {
    search q = {t, s, packet, culls, hits, rounding};
    return (!inside || starts_inside(&q, &culls->part[0], inside)) &&
           try_part(&q, &culls->part[0]);
}

/* ---- Together ---- */

static bool is_around(const int *around, int count, int object) {
    for (int k = 0; k < count; k++)
        if (around[k] == object) return true;
    return false;
}

#define MOST_AROUND 8

static bool nearest_of(search *q, bool whole) {
    const wf_tracer *t = q->t;
    int around[MOST_AROUND], count = 0, object = -1;
    _Alignas(64) double rounding[WF_PACKET];
    t->packet->rounding(&q->packet->rays, WF_ROUNDING, rounding);
    q->rounding = rounding;
    while (whole && count < MOST_AROUND) {
        if (!find_around(q, object, &object)) return false;
        if (object < 0) break;
        if (!try_union(q, object)) return false;
        around[count++] = object;
    }
    for (size_t n = 0; n < q->culls->part_count; n++) {
        const wf_culled *part = &q->culls->part[n];
        if (part->near > t->packet->farthest(q->hits->s, q->packet->rays.count)) break;
        if (count && is_around(around, count, t->parts[part->part].object)) continue;
        if (!try_part(q, part)) return false;
    }
    return true;
}

/* ---- Packets that meet too much ---- */

/* Each end of each solid is tried against all of them: beyond this many, two packets of half as
 * many rays, each of which meets fewer, are cheaper than one. */
#define MANY_SOLIDS 192

void wf_packet_take(const wf_packet *from, const int *lane, int count, wf_packet *to) {
    const double *const in[] = {from->rays.ox, from->rays.oy, from->rays.oz, from->rays.dx,
                                from->rays.dy, from->rays.dz, from->f};
    double *const out[] = {to->rays.ox, to->rays.oy, to->rays.oz, to->rays.dx,
                           to->rays.dy, to->rays.dz, to->f};
    to->rays.count = count;
    to->late_s = from->late_s;
    for (size_t n = 0; n < sizeof in / sizeof *in; n++)
        for (int i = 0, places = wf_places(count); i < places; i++)
            out[n][i] = in[n][lane[i < count ? i : count - 1]];
}

/* Copies `count` lanes of a packet and its hits from first on; the rest are copies of the last.
 */
static void take_lanes(const wf_packet *from, const wf_hits *hits, int first, int count,
                       wf_packet *to, wf_hits *to_hits) {
    int lane[WF_PACKET] = {0}, places = wf_places(count);
    for (int i = 0; i < places; i++) lane[i] = first + (i < count ? i : count - 1);
    wf_packet_take(from, lane, count, to);
    for (int i = 0; i < places; i++) {
        to_hits->s[i] = hits->s[lane[i]];
        to_hits->solid[i] = hits->solid[lane[i]];
        to_hits->entering[i] = hits->entering[lane[i]];
    }
}

/* How many solids the largest part has: parts of one solid each are many and cheap. */
static int most_solids(const wf_culls *culls) {
    int most = 0;
    for (size_t n = 0; n < culls->part_count; n++)
        if (culls->part[n].solid_count > most) most = culls->part[n].solid_count;
    return most;
}

/* Finds hits of `count` lanes from first on. *helps: they meet fewer solids than the whole
 * packet does; where they do not, nothing is done. */
static bool nearest_of_half(const search *q, bool whole, int first, int count, bool *helps) {
    wf_packet half;
    wf_hits hits;
    wf_culls culls = {0};
    take_lanes(q->packet, q->hits, first, count, &half, &hits);
    wf_shaft shaft = wf_shaft_of_rays(&half.rays, HUGE_VAL);
    wf_carry_begin(q->s);
    bool good = wf_find_again(q->t, q->s, &half, &shaft, q->culls, &culls);
    if (!*helps) *helps = 4 * most_solids(&culls) < 3 * most_solids(q->culls);
    if (good && *helps) good = wf_nearest(q->t, q->s, &half, &culls, whole, &hits);
    for (int i = 0; *helps && i < count; i++) {
        q->hits->s[first + i] = hits.s[i];
        q->hits->solid[first + i] = hits.solid[i];
        q->hits->entering[first + i] = hits.entering[i];
    }
    wf_culls_free(&culls);
    return good;
}

bool wf_nearest(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                const wf_culls *culls, bool whole, wf_hits *hits) {
    search q = {.t = t, .s = s, .packet = packet, .culls = culls, .hits = hits};
    int count = packet->rays.count, half = count / 2;
    bool helps = false;
    if (!t->skip || count < 2 || most_solids(culls) <= MANY_SOLIDS)
        return nearest_of(&q, whole);
    bool good = nearest_of_half(&q, whole, 0, half, &helps);
    if (good && helps) good = nearest_of_half(&q, whole, half, count - half, &helps);
    wf_carry_begin(s); /* what has been carried is of the halves */
    return helps || !good ? good : nearest_of(&q, whole);
}
