/* Whether a tile is still: no moving part can be seen in it, nor come between a light and what
 * can. Where the latter is, the boxes of parts say, as far as the tile's own rays go. */
#include <math.h>
#include <string.h>

#include "tracer/trace/camera.h"

/* ---- Where receivers are ---- */

/* The box of what a still frustum's rays reach within a stretch, that of its four corner rays.
 */
static wf_bounds reached(const wf_rays *corner, const double from[4], const double to[4]) {
    wf_bounds b = wf_bounds_none();
    for (int i = 0; i < 4; i++)
        for (int end = 0; end < 2; end++) {
            double s = end ? to[i] : from[i];
            b = wf_bounds_unite(
                b, wf_bounds_of_point((wf_vec){corner->ox[i] + s * corner->dx[i],
                                               corner->oy[i] + s * corner->dy[i],
                                               corner->oz[i] + s * corner->dz[i]}));
        }
    return b;
}

/* Where corner rays meet the plane of a half-space that stands still; false: not all do, and
 * the rays between them may go on for ever. */
static bool meet_plane(const wf_tracer *t, const wf_solid *solid, const wf_rays *corner,
                       double at[4]) {
    wf_affine in = solid->inverse;
    for (int op = solid->op; op >= 0; op = t->scene->ops[op].outer) {
        if (t->scene->ops[op].kind != WF_OP_PLACE) return false;
        in = wf_compose(&in, &t->ops[op].inverse);
    }
    for (int i = 0; i < 4; i++) {
        wf_vec o = wf_apply(&in, (wf_vec){corner->ox[i], corner->oy[i], corner->oz[i]});
        wf_vec d = wf_turn(&in, (wf_vec){corner->dx[i], corner->dy[i], corner->dz[i]});
        at[i] = -o.y / d.y;
        if (!(at[i] > 0 && at[i] < HUGE_VAL)) return false;
    }
    return true;
}

/* The surface of a part as far as the shaft sees it; false: nobody knows how far that is. */
static bool find_receiver(const wf_tracer *t, int part, const wf_rays *corner,
                          const wf_shaft *shaft, wf_bounds *box) {
    const wf_part *p = &t->parts[part];
    const wf_step *step = &t->scene->steps[p->first_step];
    wf_stretch s;
    double from[4], to[4];
    if (p->step_count == 1 && t->scene->solids[step->count].kind == WF_HALFSPACE &&
        meet_plane(t, &t->scene->solids[step->count], corner, from)) {
        *box = reached(corner, from, from);
        return true;
    }
    *box = wf_bounds_none();
    if (!wf_shaft_meets(shaft, &t->part_bounds[part], &s)) return true;
    if (!wf_bounds_finite(&t->part_bounds[part])) return false;
    for (int i = 0; i < 4; i++) from[i] = s.from, to[i] = s.to;
    *box = s.to < HUGE_VAL
               ? wf_bounds_intersect(t->part_bounds[part], reached(corner, from, to))
               : t->part_bounds[part];
    return true;
}

/* ---- Light ---- */

static wf_bounds ways_between(const wf_bounds *box, wf_vec light) {
    return (wf_bounds){{light.x - box->high[0], light.y - box->high[1], light.z - box->high[2]},
                       {light.x - box->low[0], light.y - box->low[1], light.z - box->low[2]}};
}

/* Whether something that moves may come between a light and a box. */
static bool crossed(const wf_tracer *t, wf_trace_scratch *s, const wf_light *light,
                    const wf_bounds *box) {
    wf_vec point = light->point, shines = light->direction;
    double most = 1;
    for (int op = light->op; op >= 0; op = t->scene->ops[op].outer) {
        wf_affine place = wf_op_at(&t->ops[op], 0);
        point = wf_apply(&place, point);
        shines = wf_turn(&place, shines);
    }
    wf_bounds d = ways_between(box, point);
    if (light->kind == WF_LIGHT_DIRECTION) {
        d = wf_bounds_of_point((wf_vec){-shines.x, -shines.y, -shines.z});
        most = HUGE_VAL;
    }
    wf_shaft shaft = wf_shaft_new(*box, d, most);
    return t->walk->find(&t->moving_tree, &shaft, 0, s->found) > 0;
}

static bool light_still(const wf_tracer *t, wf_trace_scratch *s, const wf_bounds *box) {
    if (t->lights_move) return false;
    for (int n = 0; n < t->scene->light_count; n++) {
        const wf_light *light = &t->scene->lights[n];
        if (light->shadows && crossed(t, s, light, box)) return false;
    }
    return true;
}

/* ---- Tiles ---- */

static bool part_still(const wf_tracer *t, int part, const wf_rays *corner,
                       const wf_shaft *shaft, wf_bounds *lit) {
    wf_bounds box;
    if (t->clear[part]) return false;
    if (!t->lit[part]) return true;
    if (!find_receiver(t, part, corner, shaft, &box)) return false;
    *lit = wf_bounds_unite(*lit, box);
    return true;
}

bool wf_tracer_still(const wf_tracer *t) {
    return t->all_still;
}

static bool endless_moves(const wf_tracer *t) {
    for (int n = 0; n < t->endless_count; n++)
        if (t->parts[t->endless[n]].moves) return true;
    return false;
}

static void find_corners(const wf_tracer *t, const double x[2], const double y[2],
                         wf_rays *rays) {
    wf_packet corner;
    double xs[WF_PACKET], ys[WF_PACKET];
    corner.rays.count = 4;
    corner.late_s = 0;
    for (int i = 0; i < WF_PACKET; i++) {
        xs[i] = x[i & 1], ys[i] = y[i >> 1 & 1];
        corner.f[i] = 0;
    }
    wf_camera_rays(t, xs, ys, &corner);
    *rays = corner.rays;
}

/* Looks at all parts in a rectangle that stand still. */
static bool look_at_parts(const wf_tracer *t, wf_trace_scratch *s, const wf_rays *corner,
                          const wf_shaft *shaft, wf_bounds *lit) {
    for (int n = 0; n < t->endless_count; n++)
        if (!part_still(t, t->endless[n], corner, shaft, lit)) return false;
    int count = t->walk->find(wf_groves_still(t->groves), shaft, t->part_count, s->found);
    for (int n = 0; n < count; n++)
        if (!part_still(t, s->found[n], corner, shaft, lit)) return false;
    return true;
}

static void find_sight(const wf_tracer *t, wf_trace_scratch *s, const double x[2],
                       const double y[2], const wf_shaft *shaft, wf_trace_sight *sight) {
    wf_bounds lit = wf_bounds_none();
    wf_rays corner;
    find_corners(t, x, y, &corner);
    sight->plain = look_at_parts(t, s, &corner, shaft, &lit);
    memcpy(sight->low, lit.low, sizeof lit.low);
    memcpy(sight->high, lit.high, sizeof lit.high);
    sight->known = true;
}

bool wf_trace_still(const wf_tracer *t, wf_trace_scratch *s, const double x[2],
                    const double y[2], wf_trace_sight *sight) {
    if (t->all_still) return true;
    if (wf_op_moves(t->scene, t->scene->camera.op) || endless_moves(t)) return false;
    wf_shaft shaft = wf_camera_shaft(t, x, y);
    if (t->walk->find(&t->moving_tree, &shaft, 0, s->found) > 0) return false;
    if (!sight->known) find_sight(t, s, x, y, &shaft, sight);
    if (!sight->plain) return false;
    wf_bounds lit;
    memcpy(lit.low, sight->low, sizeof lit.low);
    memcpy(lit.high, sight->high, sizeof lit.high);
    return wf_bounds_empty(&lit) || light_still(t, s, &lit);
}
