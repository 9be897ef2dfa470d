/* Light that comes straight through clear solids, and takes their color. */
#include <math.h>
#include <string.h>

#include "tracer/scene/vec.h"
#include "tracer/trace/carry.h"
#include "tracer/trace/find.h"
#include "tracer/trace/glass.h"
#include "tracer/trace/nearest.h"
#include "tracer/trace/seek.h"
#include "tracer/trace/shade.h"
#include "tracer/trace/shadow.h"

/* How many clear objects a ray may be within at once, and still know which. */
#define MOST_WITHIN 16

/* What is behind more surfaces than these is dark. */
#define MOST_SURFACES 256

/* Light that is less than this share of what it was is none. */
#define DARK 1e-6

/* Rays on their way to a light. Lanes are those of the packet that was asked about. */
typedef struct passage {
    const wf_tracer *t;
    wf_trace_scratch *s;
    wf_trace_level *l; /* rays that are still on their way */
    int lane[WF_PACKET];
    double left[WF_PACKET];             /* s that is left of each */
    int within[WF_PACKET][MOST_WITHIN]; /* objects that they entered and did not leave */
    int depth[WF_PACKET];
    double (*tint)[WF_PACKET];
    uint8_t *dark;
    wf_surfaces surface;
    _Alignas(64) double off[WF_PACKET];
} passage;

static bool meet(const passage *p) {
    wf_trace_level *l = p->l;
    int count = l->packet.rays.count;
    double most = 0;
    bool few;
    wf_hits_clear(&l->hits);
    for (int k = 0; k < WF_PACKET; k++) l->hits.s[k] = p->left[k < count ? k : count - 1];
    for (int k = 0; k < count; k++) most = fmax(most, p->left[k]);
    wf_shaft shaft = wf_shaft_of_rays(&l->packet.rays, most);
    p->s->counts.rays += count;
    wf_carry_begin(p->s);
    int parts = wf_seek_above(p->t, WF_SEEK_NEAREST);
    if (!wf_find_few(p->t, p->s, &l->packet, &shaft, parts, &few, &l->culls)) return false;
    return few ? wf_nearest(p->t, p->s, &l->packet, &l->culls, true, &l->hits)
               : wf_seek(p->t, p->s, &l->packet, WF_SEEK_NEAREST, &l->hits);
}

/* Whether a ray goes through an object that it has not been in before. */
static bool passes(passage *p, int k, int object, bool entering) {
    int i = p->lane[k], *within = p->within[i], n = 0;
    if (entering) {
        if (p->depth[i] < MOST_WITHIN) within[p->depth[i]++] = object;
        return true;
    }
    while (n < p->depth[i] && within[n] != object) n++;
    if (n == p->depth[i]) return true;
    within[n] = within[--p->depth[i]];
    return false;
}

/* Takes a ray through the surface that it has met; false: no light comes that way. */
static bool pass(passage *p, int k) {
    const wf_material *m = p->surface.material[k];
    int i = p->lane[k], object = p->t->object_of[p->l->hits.solid[k]];
    double most = 0;
    if (!(m->refract > 0)) return false;
    bool once = passes(p, k, object, p->l->hits.entering[k]);
    for (int c = 0; c < 3; c++) {
        if (once) p->tint[c][i] *= (double)m->refract * p->surface.color[c][k];
        most = fmax(most, p->tint[c][i]);
    }
    return most > DARK;
}

/* Has a ray begin behind the surface. */
static void go_on(passage *p, int k) {
    wf_trace_level *l = p->l;
    wf_rays *r = &l->packet.rays;
    double off = p->off[k];
    r->ox[k] = l->point.x[k] - off * l->normal.x[k];
    r->oy[k] = l->point.y[k] - off * l->normal.y[k];
    r->oz[k] = l->point.z[k] - off * l->normal.z[k];
    p->left[k] -= l->hits.s[k];
}

/* Leaves the rays that are on their way still. */
static void keep(passage *p, const int *kept, int count) {
    wf_packet on;
    for (int n = 0; n < count; n++) {
        p->lane[n] = p->lane[kept[n]];
        p->left[n] = p->left[kept[n]];
    }
    if (count) wf_packet_take(&p->l->packet, kept, count, &on);
    if (count) p->l->packet = on;
    p->l->packet.rays.count = count;
}

/* To the next surface of each ray. */
static bool step(passage *p) {
    int kept[WF_PACKET], count = 0;
    if (!meet(p) || !wf_surfaces_of(p->t, p->s, p->l, &p->surface, p->off)) return false;
    for (int k = 0; k < p->l->packet.rays.count; k++) {
        if (p->l->hits.solid[k] < 0)
            p->dark[p->lane[k]] = WF_SHADOW_NONE;
        else if (pass(p, k)) {
            go_on(p, k);
            kept[count++] = k;
        }
    }
    keep(p, kept, count);
    return true;
}

bool wf_glass_light(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                    const int *lanes, int count, double far, uint8_t *dark,
                    double tint[3][WF_PACKET]) {
    passage p = {.t = t, .s = s, .l = &s->passage, .tint = tint, .dark = dark};
    if (!count) return true;
    wf_packet_take(packet, lanes, count, &p.l->packet);
    for (int k = 0; k < count; k++) {
        p.lane[k] = lanes[k];
        p.left[k] = far;
    }
    for (int n = 0; n < MOST_SURFACES && p.l->packet.rays.count > 0; n++)
        if (!step(&p)) return false;
    return true;
}
