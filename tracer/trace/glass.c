/* What is clear: which solids are, and how the media at both sides of a surface bend rays. */
#include "tracer/trace/glass.h"

#include <math.h>
#include <stdlib.h>

#include "tracer/scene/vec.h"
#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"
#include "tracer/trace/nearest.h"
#include "tracer/trace/seek.h"

#define PI 3.14159265358979323846

/* ---- Which parts are clear ---- */

static double determinant(const wf_affine *a) {
    const double(*m)[3] = a->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The volume of a canonical solid; at most, where only its box is known. */
static double canonical_volume(const wf_solid *s) {
    const double *p = s->shape;
    switch (s->kind) {
    case WF_SPHERE:
        return 4 * PI / 3;
    case WF_BOX:
        return 8;
    case WF_CYLINDER:
        return 2 * PI;
    case WF_CONE:
        return 2 * PI / 3 * (p[0] * p[0] + p[0] * p[1] + p[1] * p[1]);
    case WF_TORUS:
        return 2 * PI * PI * p[0] * p[0];
    case WF_POLYHEDRON:
        return p[6] > 0 ? (p[3] - p[0]) * (p[4] - p[1]) * (p[5] - p[2]) : HUGE_VAL;
    default:
        return HUGE_VAL;
    }
}

static double solid_volume(const wf_scene *scene, const wf_solid *s) {
    double volume = canonical_volume(s) * fabs(determinant(&s->place));
    for (int op = s->op; op >= 0; op = scene->ops[op].outer)
        if (scene->ops[op].kind == WF_OP_PLACE)
            volume *= fabs(determinant(&scene->ops[op].place));
    return volume;
}

static double combine(wf_step_kind kind, const double *operand, int count) {
    double volume = operand[0];
    for (int k = 1; k < count && kind != WF_STEP_DIFFERENCE; k++)
        volume = kind == WF_STEP_UNION ? volume + operand[k] : fmin(volume, operand[k]);
    return volume;
}

static wf_medium medium_of(const wf_tracer *t, const wf_part *part, double *stack) {
    const wf_scene *scene = t->scene;
    wf_medium medium = {.index = 1};
    int top = 0;
    for (int k = 0; k < part->step_count; k++) {
        const wf_step *step = &scene->steps[part->first_step + k];
        if (step->kind != WF_STEP_SOLID) {
            top -= step->count;
            stack[top] = combine(step->kind, &stack[top], step->count);
            top++;
            continue;
        }
        const wf_solid *solid = &scene->solids[step->count];
        const wf_material *m = &scene->materials[solid->material];
        stack[top++] = solid_volume(scene, solid);
        t->lets_light[part->object] |= m->refract > 0;
        if (m->refract > 0 && !medium.clear)
            medium = (wf_medium){.index = m->index, .clear = true};
        t->object_of[step->count] = part->object;
    }
    medium.volume = stack[0];
    return medium;
}

static bool any_clear(const wf_scene *scene) {
    for (int n = 0; n < scene->solid_count; n++)
        if (scene->materials[scene->solids[n].material].refract > 0) return true;
    return false;
}

bool wf_glass_judge(wf_tracer *t) {
    if (!any_clear(t->scene)) return true;
    double *stack = malloc(((size_t)t->most_stack + 1) * sizeof *stack);
    t->media = malloc(((size_t)t->part_count + 1) * sizeof *t->media);
    t->object_of = malloc(((size_t)t->scene->solid_count + 1) * sizeof *t->object_of);
    t->lets_light = calloc((size_t)t->scene->object_count + 1, sizeof *t->lets_light);
    bool good = stack && t->media && t->object_of && t->lets_light;
    for (int n = 0; good && n < t->part_count; n++)
        t->media[n] = medium_of(t, &t->parts[n], stack);
    free(stack);
    return good;
}

void wf_glass_free(wf_tracer *t) {
    free(t->media);
    free(t->object_of);
    free(t->lets_light);
}

/* ---- What a place is filled with ---- */

/* What holds each of some places. */
typedef struct filling {
    int clear[WF_PACKET];  /* the smallest clear part; -1: none */
    int opaque[WF_PACKET]; /* an opaque one; -1: none */
} filling;

static bool fills_more(const wf_tracer *t, int part, int than) {
    if (than < 0) return true;
    double a = t->media[part].volume, b = t->media[than].volume;
    return a < b || (a == b && part > than);
}

static void fill(const wf_tracer *t, int part, int lane, filling *out) {
    if (!t->media[part].clear)
        out->opaque[lane] = part > out->opaque[lane] ? part : out->opaque[lane];
    else if (fills_more(t, part, out->clear[lane]))
        out->clear[lane] = part;
}

/* Places are the origins of a packet's rays. */
static bool fill_packet(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                        const int *lane, const wf_culls *culls, filling *out) {
    uint8_t in[WF_PACKET];
    for (size_t n = 0; n < culls->part_count; n++) {
        if (!wf_holds(t, s, packet, culls, n, in)) return false;
        for (int k = 0; k < packet->rays.count; k++)
            if (in[k]) fill(t, culls->part[n].part, lane[k], out);
    }
    return true;
}

/* Where places lie so far apart that there is more than this between them, each is asked for by
 * itself. */
#define FEW_PARTS 24

typedef struct filler {
    const wf_tracer *t;
    const int *lane;
    filling *out;
} filler;

static void fill_one(void *user, int ray, int part) {
    const filler *f = user;
    fill(f->t, part, f->lane[ray], f->out);
}

static bool fill_each(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                      const wf_shaft *shaft, const int *lane, filling *out) {
    filler f = {t, lane, out};
    wf_culls *culls = &s->probe.culls;
    return wf_find_endless(t, s, packet, shaft, culls) &&
           fill_packet(t, s, packet, lane, culls, out) &&
           wf_seek_holders(t, s, packet, fill_one, &f);
}

static bool find_filling(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                         const int *lane, filling *out) {
    wf_culls *culls = &s->probe.culls;
    wf_shaft shaft = wf_shaft_of_rays(&packet->rays, 0);
    bool few;
    wf_carry_begin(s);
    if (!wf_find_few(t, s, packet, &shaft, FEW_PARTS, &few, culls)) return false;
    return few ? fill_packet(t, s, packet, lane, culls, out)
               : fill_each(t, s, packet, &shaft, lane, out);
}

/* ---- Both sides of surfaces ---- */

typedef struct bending {
    const wf_tracer *t;
    wf_trace_scratch *s;
    wf_trace_level *l;
    const double *off;
    int lane[WF_PACKET], count; /* those that have met something clear */
    filling before, behind;
} bending;

/* Fills in what lies `side` times off the surfaces, 1 before them and -1 behind. */
static bool look_beside(bending *b, double side, filling *out) {
    const wf_trace_level *l = b->l;
    wf_packet *probe = &b->s->probe.packet;
    wf_rays *r = &probe->rays;
    wf_packet_take(&l->packet, b->lane, b->count, probe);
    for (int k = 0; k < wf_places(b->count); k++) {
        int i = b->lane[k < b->count ? k : b->count - 1];
        double off = side * b->off[i];
        r->ox[k] = l->point.x[i] + off * l->normal.x[i];
        r->oy[k] = l->point.y[i] + off * l->normal.y[i];
        r->oz[k] = l->point.z[i] + off * l->normal.z[i];
    }
    for (int i = 0; i < WF_PACKET; i++) out->clear[i] = out->opaque[i] = -1;
    return find_filling(b->t, b->s, probe, b->lane, out);
}

/* The surface of an opaque part that a ray meets right where it has met something clear. */
static bool meet_opaque(bending *b, int i, int part, bool *changed) {
    wf_trace_scratch *s = b->s;
    wf_trace_level *l = b->l;
    wf_packet *one = &s->probe.packet;
    wf_culls *culls = &s->probe.culls;
    _Alignas(64) double rounding[WF_PACKET];
    wf_hits hits;
    wf_packet_take(&l->packet, &i, 1, one);
    wf_hits_clear(&hits);
    wf_shaft shaft = wf_shaft_of_rays(&one->rays, HUGE_VAL);
    wf_carry_begin(s);
    b->t->packet->rounding(&one->rays, WF_ROUNDING, rounding);
    if (!wf_find_part(b->t, s, one, &shaft, part, culls)) return false;
    if (!culls->part_count) return true;
    if (!wf_nearest_part(b->t, s, one, culls, rounding, NULL, &hits)) return false;
    if (hits.solid[0] < 0) return true;
    l->hits.solid[i] = hits.solid[0];
    l->hits.entering[i] = hits.entering[0];
    *changed = true;
    return true;
}

static double index_of(const wf_tracer *t, int part) {
    return part < 0 ? 1 : t->media[part].index;
}

bool wf_glass_bend(const wf_tracer *t, wf_trace_scratch *s, wf_trace_level *l,
                   const wf_surfaces *surfaces, const double *off, double *ratio,
                   bool *changed) {
    bending b = {.t = t, .s = s, .l = l, .off = off};
    *changed = false;
    for (int i = 0; t->media && i < l->packet.rays.count; i++)
        if (surfaces->material[i] && surfaces->material[i]->refract > 0) b.lane[b.count++] = i;
    if (!b.count) return true;
    if (!look_beside(&b, 1, &b.before) || !look_beside(&b, -1, &b.behind)) return false;
    for (int k = 0; k < b.count; k++) {
        int i = b.lane[k], opaque = b.behind.opaque[i];
        ratio[i] = index_of(t, b.before.clear[i]) / index_of(t, b.behind.clear[i]);
        if (opaque >= 0 && opaque != b.before.opaque[i] && !meet_opaque(&b, i, opaque, changed))
            return false;
    }
    return true;
}
