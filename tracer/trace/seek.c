/* Rays one by one through the trees of parts. */
#include "tracer/trace/seek.h"

#include <math.h>
#include <string.h>

#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"
#include "tracer/trace/nearest.h"

typedef struct seeker {
    const wf_tracer *t;
    wf_trace_scratch *s;
    wf_seek_what what;
    wf_packet *ray; /* one, in as many places as loops run over */
    wf_hits *hit;
    _Alignas(64) double rounding[WF_PACKET];
    bool inside; /* the ray starts inside a union, which is to be looked at as a whole */
    bool failed;
    int last; /* the part that was met last; -1: none */
} seeker;

/* ---- Parts ---- */

/* Whether the point where the ray starts is in the solid that the runs are of. */
static bool starts_in(const wf_runs *r) {
    return (r->in[0][0] < 0 && r->out[0][0] > 0) || (r->in[1][0] < 0 && r->out[1][0] > 0);
}

static bool try_solid(seeker *q, int index, bool around) {
    wf_runs *runs = wf_nearest_runs(q->t, q->s, q->ray, index);
    if (!runs) return false;
    q->inside = around && starts_in(runs);
    q->t->packet->nearer(runs, q->rounding, index, 1, q->hit);
    return true;
}

/* Of a part of several solids the ray meets few: the program is made for it alone. */
static bool try_program(seeker *q, int part, bool around) {
    wf_culls *left = &q->s->alone;
    wf_shaft shaft = wf_shaft_of_rays(&q->ray->rays, q->hit->s[0]);
    if (!wf_find_part(q->t, q->s, q->ray, &shaft, part, left)) return false;
    return !left->part_count || wf_nearest_part(q->t, q->s, q->ray, left, q->rounding,
                                                around ? &q->inside : NULL, q->hit);
}

static bool meet(void *user, wf_walk *walk, int part, double near) {
    seeker *q = user;
    const wf_part *p = &q->t->parts[part];
    bool around = q->what == WF_SEEK_NEAREST && near <= 0 && q->t->sibling[p->object];
    bool good = p->step_count > 1
                    ? try_program(q, part, around)
                    : try_solid(q, q->t->scene->steps[p->first_step].count, around);
    q->failed = !good;
    walk->most = q->hit->s[0];
    if (q->hit->solid[0] >= 0) q->last = part;
    return good && !q->inside && (q->what == WF_SEEK_NEAREST || q->hit->solid[0] < 0);
}

/* ---- Rays ---- */

static void take_ray(seeker *q, const wf_packet *packet, const wf_hits *hits, int lane) {
    const double *const in[] = {packet->rays.ox, packet->rays.oy, packet->rays.oz,
                                packet->rays.dx, packet->rays.dy, packet->rays.dz,
                                packet->f,       hits->s};
    wf_packet *to = q->ray;
    double *const out[] = {to->rays.ox, to->rays.oy, to->rays.oz, to->rays.dx,
                           to->rays.dy, to->rays.dz, to->f,       q->hit->s};
    for (size_t n = 0; n < sizeof in / sizeof *in; n++)
        for (int i = 0; i < wf_places(1); i++) out[n][i] = in[n][lane];
    for (int i = 0; i < wf_places(1); i++) {
        q->hit->solid[i] = hits->solid[lane];
        q->hit->entering[i] = hits->entering[lane];
    }
    to->rays.count = 1;
    to->late_s = packet->late_s;
}

static void give_hit(const seeker *q, int lane, wf_hits *hits) {
    hits->s[lane] = q->hit->s[0];
    hits->solid[lane] = q->hit->solid[0];
    hits->entering[lane] = q->hit->entering[0];
}

/* Leaves the hit, or says that the ray starts inside a union. */
static bool seek_ray(seeker *q) {
    const wf_tracer *t = q->t;
    const wf_rays *r = &q->ray->rays;
    wf_walk walk = {.o = {r->ox[0], r->oy[0], r->oz[0]},
                    .d = {r->dx[0], r->dy[0], r->dz[0]},
                    .most = q->hit->s[0],
                    .meet = meet,
                    .user = q};
    q->inside = q->failed = false;
    wf_carry_begin(q->s);
    t->packet->rounding(r, WF_ROUNDING, q->rounding);
    if (q->what == WF_SEEK_ANY && q->last >= 0 && !meet(q, &walk, q->last, 0))
        return !q->failed;
    if (t->walk->go(&t->still_wide, &walk)) t->walk->go(&t->moving_wide, &walk);
    return !q->failed;
}

/* Rays that start inside unions, together as packets are looked at. */
static bool look_again(const seeker *q, const wf_packet *packet, const int *lane, int count,
                       wf_hits *hits) {
    wf_packet *some = &q->s->some;
    wf_hits *found = &q->s->some_hits;
    wf_packet_take(packet, lane, count, some);
    wf_hits_clear(found);
    wf_shaft shaft = wf_shaft_of_rays(&some->rays, HUGE_VAL);
    wf_carry_begin(q->s);
    if (!wf_find(q->t, q->s, some, &shaft, &q->s->around) ||
        !wf_nearest(q->t, q->s, some, &q->s->around, true, found))
        return false;
    for (int k = 0; k < count; k++) {
        hits->s[lane[k]] = found->s[k];
        hits->solid[lane[k]] = found->solid[k];
        hits->entering[lane[k]] = found->entering[k];
    }
    return true;
}

/* What has no box is tried by all. */
static bool try_endless(const seeker *q, const wf_packet *packet, wf_hits *hits) {
    if (!q->t->endless_count) return true;
    wf_shaft shaft = wf_shaft_of_rays(&packet->rays, HUGE_VAL);
    return wf_find_endless(q->t, q->s, packet, &shaft, &q->s->around) &&
           wf_nearest(q->t, q->s, packet, &q->s->around, false, hits);
}

bool wf_can_seek(const wf_tracer *t, wf_seek_what what) {
    return t->skip && (what == WF_SEEK_ANY || !t->endless_sibling);
}

bool wf_seek(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
             wf_seek_what what, wf_hits *hits) {
    seeker q = {.t = t, .s = s, .what = what, .ray = &s->ray, .hit = &s->hit, .last = -1};
    int again[WF_PACKET], agains = 0;
    wf_carry_begin(s);
    if (!try_endless(&q, packet, hits)) return false;
    for (int i = 0; i < packet->rays.count; i++) {
        if (what == WF_SEEK_ANY && hits->solid[i] >= 0) continue;
        take_ray(&q, packet, hits, i);
        if (!seek_ray(&q)) return false;
        if (q.inside)
            again[agains++] = i;
        else
            give_hit(&q, i, hits);
    }
    bool good = !agains || look_again(&q, packet, again, agains, hits);
    wf_carry_begin(s); /* what has been carried is of single rays */
    return good;
}
