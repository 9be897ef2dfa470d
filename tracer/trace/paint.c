/* What surfaces look like where rays meet them: normals, colors and materials. */
#include "tracer/trace/paint.h"

#include <string.h>

#include "tracer/trace/carry.h"
#include "tracer/trace/nearest.h"

typedef struct painter {
    const wf_tracer *t;
    wf_trace_scratch *s;
    wf_trace_level *l;
    wf_surfaces *surface;
    int count; /* of the level's rays */
} painter;

/* Rays that meet one solid, where, and what it looks like there. */
typedef struct painting {
    const wf_packet *packet;
    const double *at; /* s of each ray */
    wf_points normal;
    _Alignas(64) double rgb[3][WF_PACKET];
} painting;

/* ---- One solid ---- */

static void find_normals(const painter *p, const wf_solid *solid, const wf_rays *rays,
                         painting *a) {
    const wf_tracer *t = p->t;
    int count = rays->count;
    wf_rays local;
    wf_points at;
    t->packet->place(&solid->inverse, rays, &local);
    t->packet->reach(&local, a->at, &at);
    t->normals[solid->kind](solid, t->scene->planes, &at, count, &a->normal);
    t->packet->place_normals(&solid->inverse, count, &a->normal);
    wf_carry_normals(t, p->s, solid->op, count, &a->normal);
}

static void find_colors(const painter *p, const wf_solid *solid, const wf_material *m,
                        const wf_rays *rays, painting *a) {
    int places = wf_places(rays->count);
    wf_rays written;
    wf_points at;
    if (m->texture.kind == WF_TEXTURE_NONE) {
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < places; i++) a->rgb[c][i] = (double)m->color[c];
        return;
    }
    if (solid->written >= 0) {
        p->t->packet->place(&p->t->ops[solid->written].inverse, rays, &written);
        rays = &written;
    }
    p->t->packet->reach(rays, a->at, &at);
    p->t->textures[m->texture.kind](p->t->scene, &m->texture, &at, rays->count,
                                    (double *const[3]){a->rgb[0], a->rgb[1], a->rgb[2]});
}

static bool find_looks(const painter *p, int64_t index, painting *a) {
    const wf_solid *solid = &p->t->scene->solids[index];
    const wf_rays *rays = wf_carry_rays(p->t, p->s, a->packet, solid->op);
    if (!rays) return false;
    find_normals(p, solid, rays, a);
    find_colors(p, solid, &p->t->scene->materials[solid->material], rays, a);
    return true;
}

/* ---- Among the others ---- */

static void put_material(const painter *p, int64_t solid, const int *lane, int count) {
    const wf_tracer *t = p->t;
    const wf_material *m = &t->scene->materials[t->scene->solids[solid].material];
    wf_surfaces *f = p->surface;
    for (int k = 0; k < count; k++) {
        int i = lane[k];
        f->material[i] = m;
        f->lit[i] = m->unlit ? 0 : 1;
        f->ambient[i] = (double)m->ambient;
        f->diffuse[i] = (double)m->diffuse;
        f->specular[i] = (double)m->specular;
        f->shininess[i] = (double)m->shininess;
    }
}

/* Looks of all rays are found, of which those are taken that meet the solid. */
static bool paint_many(const painter *p, int64_t solid) {
    painting a = {.packet = &p->l->packet, .at = p->l->hits.s};
    const double *const from[] = {a.normal.x, a.normal.y, a.normal.z,
                                  a.rgb[0],   a.rgb[1],   a.rgb[2]};
    double *const to[] = {p->l->normal.x,       p->l->normal.y,       p->l->normal.z,
                          p->surface->color[0], p->surface->color[1], p->surface->color[2]};
    if (!find_looks(p, solid, &a)) return false;
    for (size_t n = 0; n < sizeof to / sizeof *to; n++)
        p->t->light->choose(p->l->hits.solid, solid, from[n], p->count, to[n]);
    return true;
}

/* Few rays meet the solid: they are taken out of the packet, and put back. */
static bool paint_few(const painter *p, int64_t solid, const int *lane, int count) {
    double at[WF_PACKET];
    painting a = {.packet = &p->s->some, .at = at};
    const double *const from[] = {a.normal.x, a.normal.y, a.normal.z,
                                  a.rgb[0],   a.rgb[1],   a.rgb[2]};
    double *const to[] = {p->l->normal.x,       p->l->normal.y,       p->l->normal.z,
                          p->surface->color[0], p->surface->color[1], p->surface->color[2]};
    wf_packet_take(&p->l->packet, lane, count, &p->s->some);
    for (int k = 0; k < wf_places(count); k++)
        at[k] = p->l->hits.s[lane[k < count ? k : count - 1]];
    wf_carry_begin(p->s);
    if (!find_looks(p, solid, &a)) return false;
    for (size_t n = 0; n < sizeof to / sizeof *to; n++)
        for (int k = 0; k < count; k++) to[n][lane[k]] = from[n][k];
    return true;
}

/* ---- Solids that are alike ---- */

/* Rays that meet solids of one kind, which are alike but for their maps, in one space. */
typedef struct alike {
    wf_solid_kind kind;
    int op, count, lane[WF_PACKET];
    const wf_solid *solid[WF_PACKET];
} alike;

/* Colors of lanes that are even. */
static void put_colors(const painter *p, const alike *like) {
    for (int k = 0; k < like->count; k++) {
        const wf_material *m = &p->t->scene->materials[like->solid[k]->material];
        for (int c = 0; c < 3; c++) p->surface->color[c][like->lane[k]] = (double)m->color[c];
    }
}

/* Each ray with a solid of its own. */
static bool paint_alike(const painter *p, const alike *like) {
    const wf_tracer *t = p->t;
    const wf_affine *map[WF_PACKET];
    int ray[WF_PACKET], count = like->count;
    double at[WF_PACKET];
    wf_rays local;
    wf_points point, normal;
    wf_packet_take(&p->l->packet, like->lane, count, &p->s->some);
    wf_carry_begin(p->s);
    const wf_rays *rays = wf_carry_rays(t, p->s, &p->s->some, like->op);
    if (!rays) return false;
    for (int k = 0; k < wf_places(count); k++) {
        int of = k < count ? k : count - 1;
        at[k] = p->l->hits.s[like->lane[of]];
        map[k] = &like->solid[of]->inverse;
        ray[k] = of;
    }
    t->packet->place_each(map, rays, ray, count, &local);
    t->packet->reach(&local, at, &point);
    t->normals[like->kind](NULL, NULL, &point, count, &normal);
    t->packet->place_normals_each(map, count, &normal);
    wf_carry_normals(t, p->s, like->op, count, &normal);
    for (int k = 0; k < count; k++) {
        p->l->normal.x[like->lane[k]] = normal.x[k];
        p->l->normal.y[like->lane[k]] = normal.y[k];
        p->l->normal.z[like->lane[k]] = normal.z[k];
    }
    put_colors(p, like);
    return true;
}

/* ---- All ---- */

/* The rays that meet one solid, in a row of those of all. */
typedef struct group {
    int64_t solid;
    int first, count;
    bool done;
} group;

/* Puts the packet's lanes in order of what they meet; returns how many solids there are. */
static int find_groups(const painter *p, group *groups, int *lane) {
    const int64_t *solid = p->l->hits.solid;
    int of[WF_PACKET], count = 0, last = 0, end = 0;
    for (int i = 0; i < p->count; i++) {
        of[i] = -1;
        if (solid[i] < 0) continue;
        if (!count || groups[last].solid != solid[i])
            for (last = 0; last < count && groups[last].solid != solid[i];) last++;
        if (last == count) groups[count++] = (group){.solid = solid[i]};
        groups[last].count++;
        of[i] = last;
    }
    for (int k = 0; k < count; k++) {
        groups[k].first = end;
        end += groups[k].count;
        groups[k].count = 0;
    }
    for (int i = 0; i < p->count; i++)
        if (of[i] >= 0) lane[groups[of[i]].first + groups[of[i]].count++] = i;
    return count;
}

/* Whether taking rays out of the packet costs less than looking at all. */
static bool is_few(const painter *p, const group *g) {
    return 4 * g->count < p->count;
}

static const wf_solid *solid_of(const painter *p, const group *g) {
    return &p->t->scene->solids[g->solid];
}

/* Whether a group's looks may be found together with those of others. */
static bool is_plain(const painter *p, const group *g) {
    const wf_solid *solid = solid_of(p, g);
    return !g->done && is_few(p, g) && wf_solid_type_of(solid->kind)->alike &&
           p->t->scene->materials[solid->material].texture.kind == WF_TEXTURE_NONE;
}

/* All that may be found together with the first of these groups. */
static bool paint_together(const painter *p, group *groups, int count, const int *lane) {
    alike like = {.kind = solid_of(p, groups)->kind, .op = solid_of(p, groups)->op};
    for (int n = 0; n < count; n++) {
        const wf_solid *solid = solid_of(p, &groups[n]);
        if (!is_plain(p, &groups[n]) || solid->kind != like.kind || solid->op != like.op)
            continue;
        for (int k = 0; k < groups[n].count; k++) {
            like.solid[like.count] = solid;
            like.lane[like.count++] = lane[groups[n].first + k];
        }
        groups[n].done = true;
    }
    return paint_alike(p, &like);
}

static bool paint_group(const painter *p, group *groups, int count, const int *lane) {
    if (groups->done) return true;
    if (is_plain(p, groups)) return paint_together(p, groups, count, lane);
    return paint_few(p, groups->solid, lane + groups->first, groups->count);
}

bool wf_paint(const wf_tracer *t, wf_trace_scratch *s, wf_trace_level *l, wf_surfaces *surface,
              bool *shines) {
    painter p = {t, s, l, surface, l->packet.rays.count};
    group groups[WF_PACKET];
    int lane[WF_PACKET], count = find_groups(&p, groups, lane);
    memset(surface, 0, sizeof *surface);
    *shines = false;
    for (int k = 0; k < count; k++) {
        groups[k].done = !is_few(&p, &groups[k]);
        if (groups[k].done && !paint_many(&p, groups[k].solid)) return false;
    }
    for (int k = 0; k < count; k++) {
        const group *g = &groups[k];
        if (!paint_group(&p, &groups[k], count - k, lane)) return false;
        put_material(&p, g->solid, lane + g->first, g->count);
        *shines |= surface->specular[lane[g->first]] > 0;
    }
    return true;
}
