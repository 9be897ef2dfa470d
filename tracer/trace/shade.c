/* Light at the surfaces that rays meet: colors, lights and shadows, mirrors and glass. */
#include "tracer/trace/shade.h"

#include <math.h>
#include <string.h>

#include "tracer/scene/vec.h"
#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"
#include "tracer/trace/glass.h"
#include "tracer/trace/nearest.h"
#include "tracer/trace/paint.h"
#include "tracer/trace/seek.h"
#include "tracer/trace/shadow.h"

/* Secondary rays start this far off the surface, by the size of the numbers they start from:
 * what rounding leaves on the wrong side is far nearer. */
#define OFF_SURFACE 0x1p-34

typedef struct shading {
    const wf_tracer *t;
    wf_trace_scratch *s;
    int level;
    wf_trace_level *l;
    int count;
    wf_surfaces *surface;
    bool shines; /* something here has a highlight */
    _Alignas(64) double off[WF_PACKET];
    double ratio[WF_PACKET]; /* of indices of refraction, where something clear is met */
} shading;

static wf_vec at(const wf_points *p, int i) {
    return (wf_vec){p->x[i], p->y[i], p->z[i]};
}

static void put(wf_points *p, int i, wf_vec v) {
    p->x[i] = v.x, p->y[i] = v.y, p->z[i] = v.z;
}

/* ---- Surfaces ---- */

static bool paint(shading *h) {
    if (!wf_paint(h->t, h->s, h->l, h->surface, &h->shines)) return false;
    h->t->packet->reach(&h->l->packet.rays, h->l->hits.s, &h->l->point);
    h->t->light->face(&h->l->packet.rays, &h->l->normal);
    h->t->light->off_surface(&h->l->packet.rays, h->l->hits.s, OFF_SURFACE, h->off);
    return true;
}

bool wf_surfaces_of(const wf_tracer *t, wf_trace_scratch *s, wf_trace_level *l,
                    wf_surfaces *surfaces, double *off) {
    shading h = {.t = t, .s = s, .l = l, .count = l->packet.rays.count, .surface = surfaces};
    if (!paint(&h)) return false;
    memcpy(off, h.off, sizeof h.off);
    return true;
}

/* Paints again where something opaque begins at the surface of something clear. */
static bool bend(shading *h) {
    bool changed;
    if (!wf_glass_bend(h->t, h->s, h->l, h->surface, h->off, h->ratio, &changed)) return false;
    if (h->t->media) wf_carry_begin(h->s);
    return !changed || paint(h);
}

/* ---- Secondary packets ---- */

/* Has a packet's rays, as many as lanes, begin `side` times off the surfaces that those lanes
 * have met, each at its time; side NULL: 1. */
static void begin_rays(const shading *h, const int *lane, int lanes, const double *side,
                       wf_packet *packet) {
    const wf_points *p = &h->l->point, *n = &h->l->normal;
    wf_rays *r = &packet->rays;
    r->count = lanes;
    packet->late_s = h->l->packet.late_s;
    for (int k = 0; k < lanes; k++) {
        int i = lane[k];
        double off = side ? side[k] * h->off[i] : h->off[i];
        r->ox[k] = p->x[i] + off * n->x[i];
        r->oy[k] = p->y[i] + off * n->y[i];
        r->oz[k] = p->z[i] + off * n->z[i];
        packet->f[k] = h->l->packet.f[i];
    }
}

static void aim_rays(const wf_points *ways, const int *lane, wf_rays *r) {
    for (int k = 0; k < r->count; k++) {
        int i = lane ? lane[k] : k;
        r->dx[k] = ways->x[i], r->dy[k] = ways->y[i], r->dz[k] = ways->z[i];
    }
}

/* Fills the places behind the packet's rays with copies of the last. */
static void pad(wf_packet *packet) {
    wf_rays *r = &packet->rays;
    double *const array[] = {r->ox, r->oy, r->oz, r->dx, r->dy, r->dz, packet->f};
    for (size_t n = 0; n < sizeof array / sizeof *array; n++)
        for (int i = r->count; i < WF_PACKET; i++) array[n][i] = array[n][r->count - 1];
}

/* Lanes of which share is more than 0. */
static int find_lanes(const double *share, int count, int *lane) {
    int lanes = 0;
    for (int i = 0; i < count; i++) {
        lane[lanes] = i;
        lanes += share[i] > 0;
    }
    return lanes;
}

/* ---- Lights ---- */

/* A light as each lane sees it, whose time is its own. */
static void find_light(const shading *h, const wf_light *light, wf_points *place,
                       wf_points *shines) {
    double dt_s[WF_PACKET];
    int places = wf_places(h->count);
    for (int i = 0; i < places; i++) {
        put(place, i, light->point);
        put(shines, i, light->direction);
    }
    for (int op = light->op; op >= 0; op = h->t->scene->ops[op].outer) {
        wf_carry_times(h->t, &h->l->packet, &h->t->scene->ops[op], dt_s);
        for (int i = 0; i < places; i++) {
            wf_affine map = wf_op_at(&h->t->ops[op], dt_s[i]);
            put(place, i, wf_apply(&map, at(place, i)));
            put(shines, i, wf_turn(&map, at(shines, i)));
        }
    }
}

/* What reaches a point at `way` from the light without shadows: cone and fall-off. */
static double reach_of(const wf_light *light, wf_vec way, wf_vec shines) {
    double distance = sqrt(wf_vec_dot(way, way)), share = 1;
    if (light->kind == WF_LIGHT_SPOT) {
        double cosine = -wf_vec_dot(wf_vec_unit(way), wf_vec_unit(shines)),
               wide = light->cos_outer;
        double f = (cosine - wide) / fmax(light->cos_inner - wide, 1e-9);
        f = fmin(fmax(f, 0), 1);
        share = f * f * (3 - 2 * f);
    }
    return light->fall_off > 0 ? share * pow(distance, -light->fall_off) : share;
}

/* The way to the light, and how much of it would come without shadows. */
static void find_ways(const shading *h, const wf_light *light, wf_points *ways, double *share) {
    wf_points place, shines;
    find_light(h, light, &place, &shines);
    if (light->kind == WF_LIGHT_DIRECTION)
        h->t->light->against(&shines, h->count, ways);
    else
        h->t->light->ways(&h->l->point, &place, h->count, ways);
    h->t->light->faces_light(h->surface->lit, &h->l->normal, ways, h->count, share);
    if (light->kind != WF_LIGHT_SPOT && !(light->fall_off > 0)) return;
    for (int i = 0; i < h->count; i++)
        if (share[i] > 0 && light->kind != WF_LIGHT_DIRECTION)
            share[i] *= reach_of(light, at(ways, i), at(&shines, i));
}

/* Light that comes to each lane, of the share that would come without shadows: where it came
 * through something clear, tint has a share of it for each color. */
typedef struct shadows {
    bool tinted;
    _Alignas(64) double tint[3][WF_PACKET];
} shadows;

/* Lets light through what is clear; dark: of the shadow's rays, which stand for these lanes. */
static bool let_through(const shading *h, double far, const int *lane, uint8_t *dark,
                        shadows *out) {
    const wf_packet *packet = &h->l->shadow;
    int blocked[WF_PACKET], count = 0;
    double tint[3][WF_PACKET];
    for (int k = 0; k < packet->rays.count; k++)
        if (dark[k] == WF_SHADOW_CLEAR) blocked[count++] = k;
    if (!count) return true;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < WF_PACKET; i++) out->tint[c][i] = tint[c][i] = 1;
    if (!wf_glass_light(h->t, h->s, packet, blocked, count, far, dark, tint)) return false;
    for (int n = 0; n < count; n++) {
        int k = blocked[n];
        out->tinted |= dark[k] == WF_SHADOW_NONE;
        for (int c = 0; c < 3; c++) out->tint[c][lane[k]] = tint[c][k];
    }
    return true;
}

/* Takes light away from the lanes that something stands before. */
static bool cast_shadows(const shading *h, const wf_light *light, const wf_points *ways,
                         double *share, shadows *out) {
    wf_trace_level *l = h->l;
    uint8_t dark[WF_PACKET];
    int lane[WF_PACKET], lanes = find_lanes(share, h->count, lane);
    double far = light->kind == WF_LIGHT_DIRECTION ? HUGE_VAL : 1 - OFF_SURFACE;
    if (!lanes) return true;
    begin_rays(h, lane, lanes, NULL, &l->shadow);
    aim_rays(ways, lane, &l->shadow.rays);
    pad(&l->shadow);
    h->s->counts.rays += lanes;
    if (!wf_shadow(h->t, h->s, &l->shadow, far, dark) || !let_through(h, far, lane, dark, out))
        return false;
    for (int k = 0; k < lanes; k++)
        if (dark[k] != WF_SHADOW_NONE) share[lane[k]] = 0;
    return true;
}

static void add_light(const shading *h, const wf_points *ways, const double *share,
                      const float color[3]) {
    h->t->light->add(&h->l->packet.rays, &h->l->normal, ways, share, color, h->shines,
                     h->surface);
}

/* One color after the other. */
static void add_tinted(const shading *h, const wf_points *ways, const double *share,
                       const float color[3], const shadows *cast) {
    for (int c = 0; c < 3; c++) {
        float only[3] = {0, 0, 0};
        _Alignas(64) double part[WF_PACKET];
        only[c] = color[c];
        for (int i = 0; i < wf_places(h->count); i++) part[i] = share[i] * cast->tint[c][i];
        add_light(h, ways, part, only);
    }
}

static bool add_lights(const shading *h) {
    wf_surfaces *f = h->surface;
    for (int c = 0; c < 3; c++) memcpy(f->light[c], f->ambient, sizeof f->ambient);
    for (int n = 0; n < h->t->scene->light_count; n++) {
        const wf_light *light = &h->t->scene->lights[n];
        wf_points ways;
        _Alignas(64) double share[WF_PACKET];
        shadows cast;
        cast.tinted = false;
        find_ways(h, light, &ways, share);
        if (light->shadows && !cast_shadows(h, light, &ways, share, &cast)) return false;
        if (cast.tinted)
            add_tinted(h, &ways, share, light->color, &cast);
        else
            add_light(h, &ways, share, light->color);
    }
    return true;
}

/* ---- Mirrors and glass ---- */

/* Of a holdout nothing is seen but that it hides. */
static void find_shares(const shading *h, bool through, double *share) {
    for (int i = 0; i < h->count; i++) {
        const wf_material *m = h->surface->material[i];
        bool none = !m || (m->holdout && h->l->open);
        share[i] = none ? 0 : through ? (double)m->refract : (double)m->reflect;
    }
}

/* How much of what is behind comes through, of all colors together. */
static double clearness(const shading *h, int i) {
    double sum = 0;
    for (int c = 0; c < 3; c++) sum += (double)h->surface->color[c][i];
    return sum / 3;
}

/* What comes by way of a mirror is added; what comes through takes the place of as much of the
 * surface's own light. */
static void mix(const shading *h, const double *shares, const int *lane, int lanes,
                bool through) {
    const wf_trace_level *next = &h->s->level[h->level + 1];
    for (int k = 0; k < lanes; k++) {
        int i = lane[k];
        double share = shares[i];
        if (through) h->l->alpha[i] = 1 - share * clearness(h, i) * (1 - next->alpha[k]);
        for (int c = 0; c < 3; c++) {
            double own = h->l->rgb[c][i], tint = h->surface->color[c][i];
            h->l->rgb[c][i] = through ? own * (1 - share) + share * tint * next->rgb[c][k]
                                      : own + share * next->rgb[c][k];
        }
    }
}

/* Has the rays of the level below begin where these lanes go on. */
static void set_out(const shading *h, const int *lane, int lanes, bool through,
                    wf_packet *packet) {
    const wf_rays *r = &h->l->packet.rays;
    const wf_points *n = &h->l->normal;
    wf_points way, normal;
    _Alignas(64) double ratio[WF_PACKET], side[WF_PACKET];
    for (int k = 0; k < wf_places(lanes); k++) {
        int i = lane[k < lanes ? k : lanes - 1];
        way.x[k] = r->dx[i], way.y[k] = r->dy[i], way.z[k] = r->dz[i];
        normal.x[k] = n->x[i], normal.y[k] = n->y[i], normal.z[k] = n->z[i];
        ratio[k] = h->ratio[i];
    }
    h->t->light->turn(&way, &normal, through ? ratio : NULL, lanes, side);
    begin_rays(h, lane, lanes, side, packet);
    aim_rays(&way, NULL, &packet->rays);
    pad(packet);
}

static bool look_on(const shading *h, bool through) {
    wf_trace_level *next = &h->s->level[h->level + 1];
    double share[WF_PACKET];
    int lane[WF_PACKET];
    find_shares(h, through, share);
    int lanes = find_lanes(share, h->count, lane);
    if (!lanes) return true;
    next->open = through && h->l->open;
    set_out(h, lane, lanes, through, &next->packet);
    if (!wf_look_about(h->t, h->s, h->level + 1)) return false;
    mix(h, share, lane, lanes, through);
    return true;
}

/* Surfaces are opaque, holdouts are not there and what is behind everything has an alpha of its
 * own, where alpha counts. Light is multiplied by it. */
static void find_alpha(const shading *h) {
    wf_trace_level *l = h->l;
    for (int i = 0; i < wf_places(h->count); i++) {
        const wf_material *m = h->surface->material[i];
        double clear = m ? m->holdout : (double)h->t->scene->background_clear;
        l->alpha[i] = l->open ? 1 - clear : 1;
        if (!(l->alpha[i] < 1)) continue;
        for (int c = 0; c < 3; c++) l->rgb[c][i] *= l->alpha[i];
    }
}

static bool shade(const wf_tracer *t, wf_trace_scratch *s, int level) {
    wf_surfaces surface;
    wf_trace_level *l = &s->level[level];
    shading h = {.t = t,
                 .s = s,
                 .level = level,
                 .l = l,
                 .count = l->packet.rays.count,
                 .surface = &surface};
    if (!paint(&h) || !bend(&h) || !add_lights(&h)) return false;
    t->light->sum(&surface, l->hits.s, t->scene->background, h.count, l->rgb);
    find_alpha(&h);
    if (level + 1 >= s->levels) return true;
    return look_on(&h, true) && look_on(&h, false);
}

bool wf_look_along(const wf_tracer *t, wf_trace_scratch *s, int level, const wf_culls *culls) {
    wf_trace_level *l = &s->level[level];
    wf_hits_clear(&l->hits);
    s->counts.rays += l->packet.rays.count;
    bool good = culls ? wf_nearest(t, s, &l->packet, culls, true, &l->hits)
                      : wf_seek(t, s, &l->packet, WF_SEEK_NEAREST, &l->hits);
    return good && shade(t, s, level);
}

bool wf_look_about(const wf_tracer *t, wf_trace_scratch *s, int level) {
    wf_trace_level *l = &s->level[level];
    wf_shaft shaft = wf_shaft_of_rays(&l->packet.rays, HUGE_VAL);
    bool few;
    wf_carry_begin(s);
    return wf_find_few(t, s, &l->packet, &shaft, wf_seek_above(t, WF_SEEK_NEAREST), &few,
                       &l->culls) &&
           wf_look_along(t, s, level, few ? &l->culls : NULL);
}
