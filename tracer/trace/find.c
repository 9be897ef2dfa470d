/* Which parts of a scene rays may meet: by trees of boxes, and then solid by solid. */
#include "tracer/trace/find.h"

#include <string.h>

#include "tracer/trace/carry.h"

typedef struct finding {
    const wf_tracer *t;
    wf_trace_scratch *s;
    const wf_packet *packet;
    const wf_shaft *shaft;
} finding;

static bool meets_bounds(void *user, int solid, wf_stretch *stretch) {
    const finding *f = user;
    return wf_shaft_meets(f->shaft, &f->t->solid_bounds[solid], stretch);
}

/* In the solid's own space its box is tight, and a half-space has one there only. */
static bool meets_form(void *user, int index, wf_stretch *stretch) {
    const finding *f = user;
    const wf_solid *solid = &f->t->scene->solids[index];
    const wf_shaft *outer = wf_carry_shaft(f->t, f->s, f->packet, f->shaft, solid->op);
    if (!outer) {
        f->s->failed = true;
        return false;
    }
    wf_shaft own = wf_shaft_place(&solid->inverse, outer);
    wf_bounds box = wf_solid_type_of(solid->kind)->bounds(solid, f->t->scene->planes);
    return wf_shaft_meets(&own, &box, stretch);
}

static wf_cull_scene cull_scene(finding *f) {
    return (wf_cull_scene){f->t->scene->steps,
                           f->t->parts,
                           f->t->part_bounds,
                           f->t->skip ? f->shaft : NULL,
                           f->packet ? meets_form : meets_bounds,
                           f};
}

/* Finds no more than soon after `most`. */
static int find_parts(const finding *f, int most, int *found) {
    const wf_tracer *t = f->t;
    int count = t->endless_count;
    for (int n = 0; !t->skip && n < t->part_count; n++) found[n] = n;
    if (!t->skip) return t->part_count;
    memcpy(found, t->endless, (size_t)count * sizeof *found);
    count += t->walk->find(wf_groves_still(t->groves), f->shaft, most, found + count);
    return count + t->walk->find(&t->moving_tree, f->shaft, most, found + count);
}

static bool cull_parts(finding *f, const int *parts, int count, wf_culls *out) {
    const wf_cull_scene scene = cull_scene(f);
    wf_culls_clear(out);
    for (int n = 0; n < count; n++)
        if (!wf_cull_part(&scene, parts[n], f->s->stack, out)) return false;
    wf_culls_sort(out);
    return !f->s->failed;
}

bool wf_find_few(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                 const wf_shaft *shaft, int most, bool *few, wf_culls *out) {
    finding f = {t, s, packet, shaft};
    int count = find_parts(&f, most, s->found);
    *few = count <= most || !t->skip;
    return !*few || cull_parts(&f, s->found, count, out);
}

bool wf_find(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
             const wf_shaft *shaft, wf_culls *out) {
    bool few;
    return wf_find_few(t, s, packet, shaft, t->part_count, &few, out);
}

bool wf_find_endless(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                     const wf_shaft *shaft, wf_culls *out) {
    finding f = {t, s, packet, shaft};
    return cull_parts(&f, t->endless, t->endless_count, out);
}

bool wf_find_part(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                  const wf_shaft *shaft, int part, wf_culls *out) {
    finding f = {t, s, packet, shaft};
    return cull_parts(&f, &part, 1, out);
}

bool wf_find_again(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                   const wf_shaft *shaft, const wf_culls *from, wf_culls *out) {
    finding f = {t, s, packet, shaft};
    const wf_cull_scene scene = cull_scene(&f);
    wf_culls_clear(out);
    if (!wf_cull_again(&scene, from, s->stack, out)) return false;
    wf_culls_sort(out);
    return !s->failed;
}
