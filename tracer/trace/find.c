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

static int find_parts(const finding *f, int *found) {
    const wf_tracer *t = f->t;
    int count = t->endless_count;
    for (int n = 0; !t->skip && n < t->part_count; n++) found[n] = n;
    if (!t->skip) return t->part_count;
    memcpy(found, t->endless, (size_t)count * sizeof *found);
    count += wf_tree_meet(&t->still_tree, t->part_bounds, f->shaft, found + count);
    return count + wf_tree_meet(&t->moving_tree, t->part_bounds, f->shaft, found + count);
}

bool wf_find(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
             const wf_shaft *shaft, wf_culls *out) {
    finding f = {t, s, packet, shaft};
    const wf_cull_scene scene = cull_scene(&f);
    int count = find_parts(&f, s->found);
    wf_culls_clear(out);
    for (int n = 0; n < count; n++)
        if (!wf_cull_part(&scene, s->found[n], s->stack, out)) return false;
    wf_culls_sort(out);
    return !s->failed;
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
