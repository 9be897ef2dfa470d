/* Tracers: what is known of a scene, and of a window of time, before rays are traced. */
#include <stdlib.h>

#include "tracer/trace/glass.h"
#include "tracer/trace/parts.h"
#include "tracer/trace/tree.h"

/* ---- Life ---- */

static bool any_own_width(const wf_scene *s) {
    for (int n = 0; n < s->op_count; n++)
        if (s->ops[n].own_width) return true;
    return false;
}

static bool make_arrays(wf_tracer *t) {
    const wf_scene *s = t->scene;
    size_t parts = (size_t)t->part_count + 1, stack = (size_t)t->most_stack + 1;
    t->ops = calloc((size_t)s->op_count + 1, sizeof *t->ops);
    t->solid_bounds = malloc(((size_t)s->solid_count + 1) * sizeof *t->solid_bounds);
    t->part_bounds = malloc(parts * sizeof *t->part_bounds);
    t->stack = malloc(stack * sizeof *t->stack);
    t->lit = calloc(parts, sizeof *t->lit);
    t->clear = calloc(parts, sizeof *t->clear);
    t->moving = malloc(parts * sizeof *t->moving);
    t->movers = malloc(parts * sizeof *t->movers);
    t->endless = malloc(parts * sizeof *t->endless);
    return t->ops && t->solid_bounds && t->part_bounds && t->stack && t->lit && t->clear &&
           t->moving && t->movers && t->endless;
}

wf_tracer *wf_tracer_new(const wf_scene *scene, const wf_view *view) {
    wf_tracer *t = calloc(1, sizeof *t);
    if (!t) return NULL;
    t->scene = scene;
    t->view = *view;
    t->packet = wf_packet_ops_best();
    t->csg = wf_csg_ops_best();
    t->light = wf_light_ops_best();
    t->walk = wf_walk_ops_best();
    t->intersect = wf_solid_ops_best()->intersect;
    t->normals = wf_solid_ops_best()->normals;
    t->textures = wf_texture_ops_best()->color;
    t->own_widths = any_own_width(scene);
    for (int n = 0; n < scene->light_count; n++)
        t->lights_move |= wf_op_moves(scene, scene->lights[n].op);
    if (wf_parts_split(t) && make_arrays(t) && wf_glass_judge(t)) {
        wf_parts_judge(t);
        return t;
    }
    wf_tracer_free(t);
    return NULL;
}

void wf_tracer_free(wf_tracer *t) {
    if (!t) return;
    wf_tree_free(&t->moving_tree);
    wf_groves_free(t->groves);
    free(t->parts);
    free(t->sibling);
    wf_glass_free(t);
    free(t->lit);
    free(t->clear);
    free(t->ops);
    free(t->solid_bounds);
    free(t->part_bounds);
    free(t->stack);
    free(t->moving);
    free(t->movers);
    free(t->endless);
    free(t);
}

bool wf_tracer_own_widths(const wf_tracer *t) {
    return t->own_widths;
}

/* ---- Looking at a window of time ---- */

/* Parts that are nowhere in the window are in no list: an intersection of moving solids comes
 * and goes. */
static void sort_part(wf_tracer *t, int n) {
    wf_parts_bound(t, n, -1, t->solid_bounds, &t->part_bounds[n]);
    if (wf_bounds_empty(&t->part_bounds[n])) return;
    bool finite = wf_bounds_finite(&t->part_bounds[n]);
    t->endless_sibling |= !finite && t->sibling[t->parts[n].object];
    if (!finite)
        t->endless[t->endless_count++] = n;
    else if (t->parts[n].moves)
        t->moving[t->moving_count++] = n;
}

/* What stands still, once and for all. */
static void sort_still_parts(wf_tracer *t) {
    for (int n = 0; n < t->part_count; n++) {
        if (t->parts[n].moves)
            t->movers[t->mover_count++] = n;
        else
            sort_part(t, n);
    }
    t->endless_still = t->endless_count;
}

bool wf_tracer_look(wf_tracer *t, const wf_window_of_time *window, bool skip) {
    t->window = *window;
    t->skip = skip;
    for (int n = 0; n < t->scene->op_count; n++)
        t->ops[n] = wf_op_ready(t->scene, n, window->base_s);
    if (!t->looked) sort_still_parts(t);
    t->looked = true;
    t->moving_count = 0;
    t->endless_count = t->endless_still;
    for (int n = 0; n < t->mover_count; n++) sort_part(t, t->movers[n]);
    wf_tree_free(&t->moving_tree);
    return wf_tree_new(t->part_bounds, t->moving, t->moving_count, &t->moving_tree) &&
           wf_groves_look(t);
}
