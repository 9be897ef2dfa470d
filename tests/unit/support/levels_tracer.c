/* Packets of rays, what they meet and what is seen there, and samplers, for test_isa.c. The
 * first level is the plain reference: it is compiled from the same C as the others. */
#include <math.h>
#include <string.h>

#include "tests/unit/support/levels.h"
#include "tracer/sample/sampler_inside.h"
#include "tracer/rays/light.h"
#include "tracer/rays/packet.h"
#include "tracer/rays/texture.h"
#include "tracer/rays/walk.h"

/* ---- Packets ---- */

static void fill(level_run *r, double *value) {
    for (int i = 0; i < WF_PACKET; i++) value[i] = level_number(r);
}

static void keep(level_run *r, const double *value) {
    level_keep_doubles(r, value, WF_PACKET);
}

static wf_vec drawn_vec(level_run *r) {
    return (wf_vec){level_uniform(r, -2, 2), level_uniform(r, -2, 2), level_uniform(r, -2, 2)};
}

static wf_vec drawn_axis(level_run *r) {
    wf_vec v = drawn_vec(r);
    double size = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return (wf_vec){v.x / size, v.y / size, v.z / size};
}

static void fill_points(level_run *r, wf_points *p) {
    fill(r, p->x), fill(r, p->y), fill(r, p->z);
}

static void keep_points(level_run *r, const wf_points *p) {
    keep(r, p->x), keep(r, p->y), keep(r, p->z);
}

static int drawn_count(const level_run *r) {
    return 1 + (int)(r->count % WF_PACKET);
}

static void fill_rays(level_run *r, wf_rays *rays) {
    rays->count = drawn_count(r);
    fill(r, rays->ox), fill(r, rays->oy), fill(r, rays->oz);
    fill(r, rays->dx), fill(r, rays->dy), fill(r, rays->dz);
}

static void keep_rays(level_run *r, const wf_rays *rays) {
    level_keep_integers(r, &(int64_t){rays->count}, 1);
    keep(r, rays->ox), keep(r, rays->oy), keep(r, rays->oz);
    keep(r, rays->dx), keep(r, rays->dy), keep(r, rays->dz);
}

/* Runs in order, some of them empty. */
static void fill_runs(level_run *r, wf_runs *runs) {
    for (int i = 0; i < WF_PACKET; i++) {
        double at = level_uniform(r, -3, 1);
        for (int k = 0; k < 2; k++) {
            bool some = level_draw(r) % 4 > 0;
            double length = level_uniform(r, 0.1, 2);
            runs->in[k][i] = some ? at : HUGE_VAL;
            runs->out[k][i] = some ? at + length : -HUGE_VAL;
            at += length + (level_draw(r) % 8 ? 0.5 : 0);
        }
        if (r->wild && level_draw(r) % 8 == 0) runs->in[0][i] = -HUGE_VAL;
    }
}

static void keep_runs(level_run *r, const wf_runs *runs) {
    for (int k = 0; k < 2; k++) keep(r, runs->in[k]), keep(r, runs->out[k]);
}

static void fill_hits(level_run *r, wf_hits *hits) {
    wf_hits_clear(hits);
    for (int i = 0; i < WF_PACKET; i++) {
        if (level_draw(r) % 2) continue;
        hits->s[i] = level_uniform(r, 0, 3);
        hits->solid[i] = level_draw(r) % 8;
        hits->entering[i] = level_draw(r) % 2;
    }
}

static void keep_hits(level_run *r, const wf_hits *hits) {
    keep(r, hits->s);
    level_keep_integers(r, hits->solid, WF_PACKET);
    level_keep_integers(r, hits->entering, WF_PACKET);
}

static const wf_packet_ops *packet(const level_run *r) {
    return wf_packet_ops_at(r->level);
}

static wf_affine drawn_affine(level_run *r) {
    wf_affine a = {.d = drawn_vec(r)};
    for (int k = 0; k < 9; k++) a.m[k / 3][k % 3] = level_number(r);
    return a;
}

static void place(level_run *r) {
    wf_affine a = drawn_affine(r);
    wf_rays from, to;
    fill_rays(r, &from), fill_rays(r, &to);
    packet(r)->place(&a, &from, &to);
    keep_rays(r, &to);
}

static void place_each(level_run *r) {
    wf_affine a[8];
    const wf_affine *map[8];
    wf_rays from, to;
    int ray[8], count = 1 + (int)(level_draw(r) % 8);
    fill_rays(r, &from), fill_rays(r, &to);
    for (int k = 0; k < 8; k++) {
        a[k] = drawn_affine(r), map[k] = &a[k];
        ray[k] = (int)(level_draw(r) % (unsigned)from.count);
    }
    packet(r)->place_each(map, &from, ray, count, &to);
    keep_rays(r, &to);
}

static void place_normals_each(level_run *r) {
    wf_affine a[WF_PACKET];
    const wf_affine *map[WF_PACKET];
    wf_points normals;
    int count = drawn_count(r);
    fill_points(r, &normals);
    for (int k = 0; k < count; k++) a[k] = drawn_affine(r), map[k] = &a[k];
    packet(r)->place_normals_each(map, count, &normals);
    keep_points(r, &normals);
}

static void drift_in(level_run *r) {
    const wf_op op = {.kind = WF_OP_VELOCITY, .velocity = drawn_vec(r)};
    const wf_ready_op ready = {.op = &op, .offset = drawn_vec(r)};
    double dt_s[WF_PACKET];
    wf_rays from, to;
    fill(r, dt_s), fill_rays(r, &from), fill_rays(r, &to);
    packet(r)->drift_in(&ready, dt_s, &from, &to);
    keep_rays(r, &to);
}

static void spin_in(level_run *r) {
    const wf_op op = {.kind = WF_OP_SPIN, .axis = drawn_axis(r), .center = drawn_vec(r)};
    const wf_ready_op ready = {.op = &op};
    wf_sincos spin;
    wf_rays from, to;
    fill(r, spin.cos), fill(r, spin.sin), fill_rays(r, &from), fill_rays(r, &to);
    packet(r)->spin_in(&ready, &spin, &from, &to);
    keep_rays(r, &to);
}

static void find_sincos(level_run *r) {
    const wf_ready_op ready = {.phase = level_uniform(r, 0, 1),
                               .turns_a_second = level_uniform(r, -1000, 1000)};
    double dt_s[WF_PACKET];
    wf_sincos spin;
    fill(r, dt_s), fill(r, spin.cos), fill(r, spin.sin);
    packet(r)->find_sincos(&ready, dt_s, drawn_count(r), &spin);
    keep(r, spin.cos), keep(r, spin.sin);
}

static void spin_out(level_run *r) {
    const wf_op op = {.kind = WF_OP_SPIN, .axis = drawn_axis(r)};
    const wf_ready_op ready = {.op = &op};
    wf_sincos spin;
    wf_points d;
    fill(r, spin.cos), fill(r, spin.sin), fill_points(r, &d);
    packet(r)->spin_out(&ready, &spin, drawn_count(r), &d);
    keep_points(r, &d);
}

static void place_normals(level_run *r) {
    wf_affine a = drawn_affine(r);
    wf_points n;
    fill_points(r, &n);
    packet(r)->place_normals(&a, drawn_count(r), &n);
    keep_points(r, &n);
}

static void reach(level_run *r) {
    wf_rays rays;
    wf_points p;
    double s[WF_PACKET];
    fill_rays(r, &rays), fill(r, s), fill_points(r, &p);
    for (int i = 0; i < WF_PACKET; i += 5) s[i] = HUGE_VAL;
    packet(r)->reach(&rays, s, &p);
    keep_points(r, &p);
}

static void nearer(level_run *r) {
    wf_runs runs;
    wf_hits hits;
    double rounding[WF_PACKET];
    fill_runs(r, &runs), fill_hits(r, &hits);
    for (int i = 0; i < WF_PACKET; i++) {
        rounding[i] = level_uniform(r, 0, 0.01);
        if (i % 3 == 0 && hits.s[i] < HUGE_VAL) runs.in[0][i] = hits.s[i];
    }
    int most_runs = 1 + (int)(level_draw(r) % 2);
    packet(r)->nearer(&runs, most_runs, rounding, level_draw(r) % 8, drawn_count(r), &hits);
    keep_hits(r, &hits);
}

static void nearer_each(level_run *r) {
    wf_runs runs;
    wf_hits hits;
    double rounding[WF_PACKET];
    int ray[WF_PACKET], solid[WF_PACKET], count = drawn_count(r);
    int most_runs = 1 + (int)(level_draw(r) % 2);
    fill_runs(r, &runs), fill_hits(r, &hits);
    for (int i = 0; i < WF_PACKET; i++) {
        rounding[i] = level_uniform(r, 0, 0.01);
        ray[i] = (int)(level_draw(r) % WF_PACKET), solid[i] = (int)(level_draw(r) % 8);
        if (i % 3 == 0 && hits.s[ray[i]] < HUGE_VAL) runs.in[0][i] = hits.s[ray[i]];
    }
    packet(r)->nearer_each(&runs, most_runs, rounding, solid, ray, count, &hits);
    keep_hits(r, &hits);
}

static void unit(level_run *r) {
    wf_points d;
    fill_points(r, &d);
    for (int i = 0; i < WF_PACKET; i += 17) d.x[i] = d.y[i] = d.z[i] = 0;
    packet(r)->unit(drawn_count(r), &d);
    keep_points(r, &d);
}

static void rounding(level_run *r) {
    wf_rays rays;
    double out[WF_PACKET];
    fill_rays(r, &rays), fill(r, out);
    packet(r)->rounding(&rays, WF_ROUNDING, out);
    keep(r, out);
}

static void farthest(level_run *r) {
    _Alignas(64) double s[WF_PACKET];
    double most;
    fill(r, s);
    most = packet(r)->farthest(s, drawn_count(r));
    level_keep_doubles(r, &most, 1);
}

static void no_second_run(level_run *r) {
    wf_runs runs;
    fill_runs(r, &runs);
    packet(r)->no_second_run(&runs, drawn_count(r));
    keep_runs(r, &runs);
}

static void box_of_rays(level_run *r) {
    wf_rays rays;
    wf_bounds o, d;
    fill_rays(r, &rays);
    packet(r)->box(&rays, &o, &d);
    level_keep_doubles(r, o.low, 3), level_keep_doubles(r, o.high, 3);
    level_keep_doubles(r, d.low, 3), level_keep_doubles(r, d.high, 3);
}

static const level_row packets[] = {
    {"packet.place", place, false, 0},
    {"packet.place_each", place_each, false, 0},
    {"packet.place_normals_each", place_normals_each, false, 0},
    {"packet.drift_in", drift_in, false, 0},
    {"packet.spin_in", spin_in, false, 0},
    {"packet.find_sincos", find_sincos, false, 0},
    {"packet.spin_out", spin_out, false, 0},
    {"packet.place_normals", place_normals, false, 0},
    {"packet.reach", reach, false, 0},
    {"packet.nearer", nearer, false, 0},
    {"packet.nearer_each", nearer_each, false, 0},
    {"packet.unit", unit, false, 0},
    {"packet.rounding", rounding, false, 0},
    {"packet.farthest", farthest, false, 0},
    {"packet.no_second_run", no_second_run, false, 0},
    {"packet.box", box_of_rays, false, 0},
};

/* ---- Solids ---- */

static const wf_plane planes[] = {
    {{1, 0, 0}, 1}, {{-1, 0, 0}, 1}, {{0, 1, 0}, 1},       {{0, -1, 0}, 1},
    {{0, 0, 1}, 1}, {{0, 0, -1}, 1}, {{0.6, 0.8, 0}, 0.9},
};

static wf_solid drawn_solid(level_run *r, wf_solid_kind kind) {
    wf_solid s = {.kind = kind, .plane_count = 7};
    for (int k = 0; k < 10 && kind == WF_QUADRIC; k++)
        s.shape[k] = level_draw(r) % 4 ? level_uniform(r, -1, 1) : 0;
    if (kind == WF_CONE) s.shape[level_draw(r) % 2] = 1;
    if (kind == WF_CONE) s.shape[level_draw(r) % 2] += level_uniform(r, 0, 0.9);
    if (kind == WF_TORUS) s.shape[0] = level_uniform(r, 0.001, 1.5);
    return s;
}

/* Rays that aim at the solid, some along an axis, some that all but touch it. */
static void aim(level_run *r, wf_rays *rays) {
    double far = exp2(level_uniform(r, 0, 20));
    fill_rays(r, rays);
    for (int i = 0; i < WF_PACKET; i++) {
        double *const o[3] = {&rays->ox[i], &rays->oy[i], &rays->oz[i]};
        double *const d[3] = {&rays->dx[i], &rays->dy[i], &rays->dz[i]};
        if (r->wild && i % 4 == 0) continue;
        for (int k = 0; k < 3; k++) {
            double target = level_draw(r) % 8 ? level_uniform(r, -1.3, 1.3) : 1;
            *o[k] = level_uniform(r, -far, far);
            *d[k] = level_draw(r) % 8 ? target - *o[k] : 0;
        }
        if (*d[0] == 0 && *d[1] == 0 && *d[2] == 0) *d[2] = 1;
    }
}

static void intersect(level_run *r, wf_solid_kind kind) {
    wf_solid s = drawn_solid(r, kind);
    wf_rays rays;
    wf_runs runs;
    aim(r, &rays), fill_runs(r, &runs);
    wf_solid_ops_at(r->level)->intersect[kind](&s, planes, &rays, &runs);
    keep_runs(r, &runs);
}

static void normals(level_run *r, wf_solid_kind kind) {
    wf_solid s = drawn_solid(r, kind);
    wf_points p, n;
    fill_points(r, &p), fill_points(r, &n); /* no face is nearest to NaN: n stays */
    for (int i = 0; i < WF_PACKET; i += 3) p.x[i] = 1, p.y[i] = i % 2 ? 1 : p.y[i];
    wf_solid_ops_at(r->level)->normals[kind](&s, planes, &p, drawn_count(r), &n);
    keep_points(r, &n);
}

#define SOLID(name, kind)                                                                      \
    static void name##_runs(level_run *r) {                                                    \
        intersect(r, kind);                                                                    \
    }                                                                                          \
    static void name##_normals(level_run *r) {                                                 \
        normals(r, kind);                                                                      \
    }
SOLID(sphere, WF_SPHERE)
SOLID(box, WF_BOX)
SOLID(cylinder, WF_CYLINDER)
SOLID(cone, WF_CONE)
SOLID(torus, WF_TORUS)
SOLID(halfspace, WF_HALFSPACE)
SOLID(quadric, WF_QUADRIC)
SOLID(polyhedron, WF_POLYHEDRON)

#define SOLID_ROWS(name)                                                                       \
    {"solid.intersect " #name, name##_runs, false, 0}, {                                       \
        "solid.normals " #name, name##_normals, false, 0                                       \
    }
static const level_row solids[] = {
    SOLID_ROWS(sphere), SOLID_ROWS(box),       SOLID_ROWS(cylinder), SOLID_ROWS(cone),
    SOLID_ROWS(torus),  SOLID_ROWS(halfspace), SOLID_ROWS(quadric),  SOLID_ROWS(polyhedron),
};

/* ---- CSG ---- */

enum { MOST_SOLIDS = 6 };

typedef struct drawn_csg {
    wf_step steps[2 * MOST_SOLIDS];
    wf_runs runs[MOST_SOLIDS];
    int solid[MOST_SOLIDS];
    wf_csg csg;
} drawn_csg;

/* Solids, each joined to those before it. */
static void draw_csg(level_run *r, drawn_csg *c) {
    int solids_used = 1 + (int)(level_draw(r) % MOST_SOLIDS), steps = 0;
    for (int k = 0; k < solids_used; k++) {
        fill_runs(r, &c->runs[k]);
        c->solid[k] = k + 3;
        c->steps[steps++] = (wf_step){WF_STEP_SOLID, k};
        wf_step_kind kind = (wf_step_kind)(WF_STEP_UNION + level_draw(r) % 3);
        if (k) c->steps[steps++] = (wf_step){kind, 2};
    }
    c->csg = (wf_csg){c->steps, steps, c->runs, c->solid, solids_used, drawn_count(r)};
}

static void csg_nearest(level_run *r) {
    drawn_csg c;
    wf_csg_entry stack[4];
    double apart[WF_PACKET];
    wf_hits hits;
    draw_csg(r, &c), fill_hits(r, &hits);
    for (int i = 0; i < WF_PACKET; i++) apart[i] = level_uniform(r, 0, 1e-3);
    wf_csg_ops_at(r->level)->nearest(&c.csg, apart, stack, &hits);
    keep_hits(r, &hits);
}

static void csg_inside(level_run *r) {
    drawn_csg c;
    wf_csg_entry stack[4];
    double s[WF_PACKET];
    uint8_t in[WF_PACKET] = {0};
    draw_csg(r, &c), fill(r, s);
    wf_csg_ops_at(r->level)->inside(&c.csg, s, stack, in);
    level_keep_bytes(r, in, WF_PACKET);
}

static const level_row csgs[] = {
    {"csg.nearest", csg_nearest, false, 0},
    {"csg.inside", csg_inside, false, 0},
};

/* ---- Walks ---- */

/* A root over four nodes, each of which it has twice. */
static void fill_tree(level_run *r, wf_tree_node *nodes) {
    for (int n = 0; n < 5; n++) {
        nodes[n].used = level_draw(r) & 255;
        for (int k = 0; k < WF_TREE_WIDTH; k++) {
            nodes[n].child[k] = n ? ~(8 * n + k - 8) : 1 + k % 4;
            for (int axis = 0; axis < 3; axis++) {
                nodes[n].plane[axis][k] = level_uniform(r, -2, 2);
                nodes[n].plane[3 + axis][k] = nodes[n].plane[axis][k] + level_uniform(r, 0, 3);
            }
        }
    }
}

/* Rays from about the tree, from planes of its boxes and along them. */
static void fill_walkers(level_run *r, const wf_tree_node *root, wf_rays *rays) {
    double *const o[3] = {rays->ox, rays->oy, rays->oz};
    double *const d[3] = {rays->dx, rays->dy, rays->dz};
    rays->count = drawn_count(r);
    for (int i = 0; i < WF_PACKET; i++)
        for (int axis = 0; axis < 3; axis++) {
            o[axis][i] = level_draw(r) % 4 ? level_uniform(r, -3, 3) : root->plane[axis][0];
            d[axis][i] = level_draw(r) % 4 ? level_uniform(r, -1, 1) : 0;
            if (r->wild) d[axis][i] = level_number(r);
        }
}

static void keep_met(level_run *r, const wf_met *met, double *most) {
    for (int k = 0; k < met->count; k++) {
        level_keep_integers(r, (int64_t[]){met->item[k], met->ray[k]}, 2);
        level_keep_doubles(r, &met->near[k], 1);
        if (met->item[k] % 5 == 0) most[met->ray[k]] = met->near[k] + 1;
    }
}

static void walk_tree(level_run *r) {
    wf_tree_node nodes[5];
    const wf_tree tree = {nodes, NULL, 5, 32, 5};
    const wf_walk_ops *ops = wf_walk_ops_at(r->level);
    static wf_ways ways;
    wf_rays rays;
    wf_walk walk;
    wf_met met;
    double most[WF_PACKET];
    fill_tree(r, nodes);
    fill_walkers(r, nodes, &rays);
    for (int i = 0; i < WF_PACKET; i++) most[i] = level_draw(r) % 2 ? HUGE_VAL : 3;
    ops->begin(&tree, &rays, &walk);
    int count = rays.count < WF_WAYS ? rays.count : WF_WAYS;
    wf_ways_clear(&ways);
    for (int k = 0; k < count; k++) wf_ways_add(&tree, k, &ways);
    if (count > 3) wf_ways_remove(1, &ways);
    for (int n = 0; n < 10; n++) {
        met.count = 0;
        ops->step(&tree, &walk, most, &ways, &met);
        keep_met(r, &met, most);
        for (int k = 0; k < ways.count; k++)
            level_keep_integers(r, &(int64_t){ways.stops[k]}, 1);
    }
}

static void find_in_tree(level_run *r) {
    wf_tree_node nodes[5];
    int items[32], found[64];
    const wf_tree tree = {nodes, items, 5, 32, 5};
    wf_shaft shaft = {.most = level_draw(r) % 2 ? HUGE_VAL : 3};
    fill_tree(r, nodes);
    for (int k = 0; k < 32; k++) items[k] = 100 + k;
    for (int axis = 0; axis < 3; axis++) {
        shaft.o.low[axis] = level_uniform(r, -3, 3),
        shaft.d.low[axis] = level_uniform(r, -1, 1);
        shaft.o.high[axis] = shaft.o.low[axis] + level_uniform(r, 0, 0.5);
        shaft.d.high[axis] = shaft.d.low[axis] + level_uniform(r, 0, 0.5);
        shaft.rise[axis] = 1 / shaft.d.high[axis], shaft.fall[axis] = 1 / shaft.d.low[axis];
    }
    if (r->wild) shaft.o.high[0] = level_number(r);
    int count = wf_walk_ops_at(r->level)->find(&tree, &shaft, (int)(level_draw(r) % 40), found);
    for (int k = 0; k < count; k++) level_keep_integers(r, &(int64_t){found[k]}, 1);
}

/* What a walk begins with. */
static void begin_walk(level_run *r) {
    const wf_tree tree = {NULL, NULL, 1, 1, level_uniform(r, 0, 5)};
    wf_rays rays;
    wf_walk walk;
    fill_rays(r, &rays);
    for (int i = 0; i < WF_PACKET; i++)
        if (level_draw(r) % 3 == 0) rays.dz[i] = level_draw(r) % 2 ? 0. : -0.;
    wf_walk_ops_at(r->level)->begin(&tree, &rays, &walk);
    for (int k = 0; k < 3; k++) {
        level_keep_doubles(r, walk.less_low[k], (size_t)rays.count);
        level_keep_doubles(r, walk.less_high[k], (size_t)rays.count);
        level_keep_doubles(r, walk.inverse[k], (size_t)rays.count);
    }
    level_keep_bytes(r, walk.down, (size_t)rays.count);
}

static const level_row walks[] = {{"walk.begin", begin_walk, false, 0},
                                  {"walk.step", walk_tree, false, 0},
                                  {"walk.find", find_in_tree, false, 0}};

/* ---- Light ---- */

static const wf_light_ops *light(const level_run *r) {
    return wf_light_ops_at(r->level);
}

static void face(level_run *r) {
    wf_rays rays;
    wf_points n;
    fill_rays(r, &rays), fill_points(r, &n);
    light(r)->face(&rays, &n);
    keep_points(r, &n);
}

static void choose(level_run *r) {
    int64_t hit[WF_PACKET];
    double from[WF_PACKET], to[WF_PACKET];
    fill(r, from), fill(r, to);
    for (int i = 0; i < WF_PACKET; i++) hit[i] = (int64_t)(level_draw(r) % 4) - 1;
    light(r)->choose(hit, level_draw(r) % 3, from, drawn_count(r), to);
    keep(r, to);
}

static void off_surface(level_run *r) {
    wf_rays rays;
    double s[WF_PACKET], off[WF_PACKET];
    fill_rays(r, &rays), fill(r, s), fill(r, off);
    light(r)->off_surface(&rays, s, 0x1p-40, off);
    keep(r, off);
}

static void turn(level_run *r) {
    wf_points d, n;
    double ratio[WF_PACKET], side[WF_PACKET];
    bool through = level_draw(r) % 2;
    fill_points(r, &d), fill_points(r, &n), fill(r, ratio), fill(r, side);
    light(r)->turn(&d, &n, through ? ratio : NULL, drawn_count(r), side);
    keep_points(r, &d);
    keep(r, side);
}

static void ways(level_run *r) {
    wf_points p, to, way;
    fill_points(r, &p), fill_points(r, &to), fill_points(r, &way);
    light(r)->ways(&p, &to, drawn_count(r), &way);
    keep_points(r, &way);
}

static void against(level_run *r) {
    wf_points d, way;
    fill_points(r, &d), fill_points(r, &way);
    light(r)->against(&d, drawn_count(r), &way);
    keep_points(r, &way);
}

static void faces_light(level_run *r) {
    wf_points n, way;
    double lit[WF_PACKET], share[WF_PACKET];
    fill_points(r, &n), fill_points(r, &way), fill(r, share);
    for (int i = 0; i < WF_PACKET; i++) lit[i] = level_draw(r) % 2;
    light(r)->faces_light(lit, &n, &way, drawn_count(r), share);
    keep(r, share);
}

static void fill_surfaces(level_run *r, wf_surfaces *f) {
    memset(f->material, 0, sizeof f->material);
    fill(r, f->ambient), fill(r, f->diffuse), fill(r, f->specular);
    for (int c = 0; c < 3; c++)
        fill(r, f->color[c]), fill(r, f->light[c]), fill(r, f->shine[c]);
    for (int i = 0; i < WF_PACKET; i++) {
        f->lit[i] = level_draw(r) % 2;
        f->shininess[i] = level_uniform(r, 0, 200);
    }
}

static void add_light(level_run *r) {
    const float color[3] = {1, 0.5f, 0.25f};
    wf_rays rays;
    wf_points n, way;
    double share[WF_PACKET];
    wf_surfaces f;
    fill_rays(r, &rays), fill_points(r, &n), fill_points(r, &way), fill_surfaces(r, &f);
    for (int i = 0; i < WF_PACKET; i++) share[i] = fmax(level_uniform(r, -1, 1), 0);
    light(r)->add(&rays, &n, &way, share, color, level_draw(r) % 2, &f);
    for (int c = 0; c < 3; c++) keep(r, f.light[c]), keep(r, f.shine[c]);
}

static void sum_light(level_run *r) {
    const float background[3] = {0.1f, 0.2f, 0.3f};
    double rgb[3][WF_PACKET], seen[WF_PACKET];
    wf_surfaces f;
    fill_surfaces(r, &f), fill(r, seen);
    for (int c = 0; c < 3; c++) fill(r, rgb[c]);
    for (int i = 0; i < WF_PACKET; i += 3) seen[i] = HUGE_VAL;
    light(r)->sum(&f, seen, background, drawn_count(r), rgb);
    for (int c = 0; c < 3; c++) keep(r, rgb[c]);
}

static const level_row lights[] = {
    {"light.face", face, false, 0},
    {"light.choose", choose, false, 0},
    {"light.off_surface", off_surface, false, 0},
    {"light.turn", turn, false, 0},
    {"light.ways", ways, false, 0},
    {"light.against", against, false, 0},
    {"light.faces_light", faces_light, false, 0},
    {"light.add", add_light, false, 0},
    {"light.sum", sum_light, false, 0},
};

/* ---- Textures ---- */

/* Points are finite: those that rays reach. */
static void texture(level_run *r, wf_texture_kind kind) {
    static float pixels[3 * 5 * 4];
    wf_image picture = {5, 4, pixels};
    wf_scene scene = {.images = &picture, .image_count = 1};
    wf_points p;
    double rgb[3][WF_PACKET];
    wf_texture t = {
        .kind = kind, .color = {{1, 0.5f, 0}, {0, 0.25f, 1}}, .center = drawn_vec(r)};
    t.axis = drawn_axis(r), t.across = drawn_axis(r), t.down = drawn_axis(r);
    t.size = level_uniform(r, 0.01, 1), t.width = level_uniform(r, 0.1, 2);
    t.height = level_uniform(r, 0.1, 2), t.repeat = level_draw(r) % 2;
    for (int i = 0; i < 60; i++) pixels[i] = (float)level_uniform(r, 0, 2);
    fill_points(r, &p);
    for (int i = 0; i < WF_PACKET; i++) {
        if (!isfinite(p.x[i]) || i % 3 == 0) p.x[i] = t.size * (double)(i - 60);
        if (!isfinite(p.y[i])) p.y[i] = 0;
        if (!isfinite(p.z[i])) p.z[i] = -0.0;
    }
    int count = 1 + (int)(r->count % WF_PACKET);
    wf_texture_ops_at(r->level)->color[kind](&scene, &t, &p, count,
                                             (double *const[]){rgb[0], rgb[1], rgb[2]});
    for (int c = 0; c < 3; c++) level_keep_doubles(r, rgb[c], (size_t)count);
}

#define TEXTURE(name, kind)                                                                    \
    static void name(level_run *r) {                                                           \
        texture(r, kind);                                                                      \
    }
TEXTURE(checker, WF_TEXTURE_CHECKER)
TEXTURE(stripe, WF_TEXTURE_STRIPE)
TEXTURE(zoneplate, WF_TEXTURE_ZONEPLATE)
TEXTURE(image, WF_TEXTURE_IMAGE)

/* WF_TEXTURE_NONE has no function but a place in the table: stripes are looked at twice. */
static const level_row textures[] = {
    {"texture.checker", checker, false, 0}, {"texture.stripe", stripe, false, 0},
    {"texture.stripe", stripe, false, 0},   {"texture.zoneplate", zoneplate, false, 0},
    {"texture.image", image, false, 0},
};

/* ---- Samplers ---- */

static void scramble(level_run *r) {
    uint32_t *reversed = level_buffer(r, r->count * sizeof *reversed);
    float *out = level_floats(r, r->count);
    for (size_t i = 0; i < r->count; i++) reversed[i] = level_draw(r);
    wf_sampler_ops_at(r->level)->scramble(reversed, (int)r->count, level_draw(r), out);
    level_keep_floats(r, out, r->count);
}

static void random_numbers(level_run *r) {
    float *out = level_floats(r, r->count);
    wf_sampler_ops_at(r->level)->random((int)r->count, level_draw(r), out);
    level_keep_floats(r, out, r->count);
}

static const level_row samplers[] = {
    {"sampler.scramble", scramble, false, 0},
    {"sampler.random", random_numbers, false, 0},
};

const level_table level_tracer[] = {
    LEVEL_TABLE("tracer/rays/packet_isa.c", wf_packet_ops, packets),
    LEVEL_TABLE("tracer/rays/solid_isa.c", wf_solid_ops, solids),
    LEVEL_TABLE("tracer/rays/csg_isa.c", wf_csg_ops, csgs),
    LEVEL_TABLE("tracer/rays/walk_isa.c", wf_walk_ops, walks),
    LEVEL_TABLE("tracer/rays/light_isa.c", wf_light_ops, lights),
    LEVEL_TABLE("tracer/rays/texture_isa.c", wf_texture_ops, textures),
    LEVEL_TABLE("tracer/sample/sampler_isa.c", wf_sampler_ops, samplers),
    {.file = NULL},
};
