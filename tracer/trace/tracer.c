#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/trace/inside.h"

/* ---- Parts ---- */

/* Where the program of the operand that ends with step k begins, for each k. */
static void find_starts(const wf_step *steps, int count, int *start, int *stack) {
    int top = 0;
    for (int k = 0; k < count; k++) {
        if (steps[k].kind == WF_STEP_SOLID) {
            stack[top++] = start[k] = k;
            continue;
        }
        top -= steps[k].count;
        start[k] = stack[top++];
    }
}

/* Takes unions apart from the outside in: the nearest surface of a union is the nearest of its
 * operands', as long as rays do not start inside it. */
static int split(const wf_step *steps, int last, const int *start, int object, wf_part *parts,
                 int *waiting) {
    int top = 0, count = 0;
    waiting[top++] = last;
    while (top > 0) {
        int end = waiting[--top];
        if (steps[end].kind != WF_STEP_UNION) {
            parts[count++] = (wf_part){object, start[end], end - start[end] + 1, false};
            continue;
        }
        for (int n = 0, operand = end - 1; n < steps[end].count; n++) {
            waiting[top++] = operand;
            operand = start[operand] - 1;
        }
    }
    return count;
}

static bool part_moves(const wf_scene *scene, const wf_part *part) {
    for (int k = 0; k < part->step_count; k++) {
        const wf_step *step = &scene->steps[part->first_step + k];
        if (step->kind == WF_STEP_SOLID && wf_op_moves(scene, scene->solids[step->count].op))
            return true;
    }
    return false;
}

/* Positions of steps within the scene's array instead of an object's. */
static void split_object(wf_tracer *t, int index, int *start, int *stack) {
    const wf_object *object = &t->scene->objects[index];
    const wf_step *steps = t->scene->steps + object->first_step;
    wf_part *parts = t->parts + t->part_count;
    find_starts(steps, object->step_count, start, stack);
    int count = split(steps, object->step_count - 1, start, index, parts, stack);
    for (int n = 0; n < count; n++) {
        parts[n].first_step += object->first_step;
        parts[n].moves = part_moves(t->scene, &parts[n]);
    }
    t->sibling[index] = count > 1;
    t->part_count += count;
}

static bool make_parts(wf_tracer *t) {
    const wf_scene *s = t->scene;
    size_t steps = (size_t)s->step_count + 1;
    t->parts = malloc(steps * sizeof *t->parts);
    t->sibling = calloc((size_t)s->object_count + 1, sizeof *t->sibling);
    int *start = malloc(steps * sizeof *start), *stack = malloc(steps * sizeof *stack);
    bool room = t->parts && t->sibling && start && stack;
    for (int n = 0; room && n < s->object_count; n++) {
        if (s->objects[n].step_count) split_object(t, n, start, stack);
        if (s->objects[n].most_stack > t->most_stack) t->most_stack = s->objects[n].most_stack;
    }
    free(start);
    free(stack);
    return room;
}

static void find_look(wf_tracer *t, int index) {
    const wf_part *part = &t->parts[index];
    for (int k = 0; k < part->step_count; k++) {
        const wf_step *step = &t->scene->steps[part->first_step + k];
        if (step->kind != WF_STEP_SOLID) continue;
        const wf_material *m = &t->scene->materials[t->scene->solids[step->count].material];
        t->lit[index] |= !m->unlit;
        t->clear[index] |= m->reflect > 0 || m->refract > 0;
    }
}

static void find_looks(wf_tracer *t) {
    bool moves = t->lights_move || wf_op_moves(t->scene, t->scene->camera.op);
    for (int n = 0; n < t->part_count; n++) {
        find_look(t, n);
        moves |= t->parts[n].moves;
    }
    t->all_still = !moves;
}

/* ---- Life ---- */

static bool any_op(const wf_scene *s, bool own_width) {
    for (int n = 0; own_width && n < s->op_count; n++)
        if (s->ops[n].own_width) return true;
    return false;
}

static bool make_room(wf_tracer *t) {
    const wf_scene *s = t->scene;
    size_t parts = (size_t)t->part_count + 1, stack = (size_t)t->most_stack + 1;
    t->ops = calloc((size_t)s->op_count + 1, sizeof *t->ops);
    t->solid_bounds = malloc(((size_t)s->solid_count + 1) * sizeof *t->solid_bounds);
    t->part_bounds = malloc(parts * sizeof *t->part_bounds);
    t->stack = malloc(stack * sizeof *t->stack);
    t->lit = calloc(parts, sizeof *t->lit);
    t->clear = calloc(parts, sizeof *t->clear);
    t->still = malloc(parts * sizeof *t->still);
    t->moving = malloc(parts * sizeof *t->moving);
    t->movers = malloc(parts * sizeof *t->movers);
    t->endless = malloc(parts * sizeof *t->endless);
    return t->ops && t->solid_bounds && t->part_bounds && t->stack && t->lit && t->clear &&
           t->still && t->moving && t->movers && t->endless;
}

wf_tracer *wf_tracer_new(const wf_scene *scene, const wf_view *view) {
    wf_tracer *t = calloc(1, sizeof *t);
    if (!t) return NULL;
    t->scene = scene;
    t->view = *view;
    t->packet = wf_packet_ops_best();
    t->csg = wf_csg_ops_best();
    t->light = wf_light_ops_best();
    t->intersect = wf_solid_ops_best()->intersect;
    t->normals = wf_solid_ops_best()->normals;
    t->textures = wf_texture_ops_best()->color;
    t->own_widths = any_op(scene, true);
    for (int n = 0; n < scene->light_count; n++)
        t->lights_move |= wf_op_moves(scene, scene->lights[n].op);
    if (make_parts(t) && make_room(t)) {
        find_looks(t);
        return t;
    }
    wf_tracer_free(t);
    return NULL;
}

void wf_tracer_free(wf_tracer *t) {
    if (!t) return;
    wf_tree_free(&t->still_tree);
    wf_tree_free(&t->moving_tree);
    free(t->parts);
    free(t->sibling);
    free(t->lit);
    free(t->clear);
    free(t->ops);
    free(t->solid_bounds);
    free(t->part_bounds);
    free(t->stack);
    free(t->still);
    free(t->moving);
    free(t->movers);
    free(t->endless);
    free(t);
}

bool wf_tracer_own_widths(const wf_tracer *t) {
    return t->own_widths;
}

/* ---- Looking at a window of time ---- */

static wf_bounds solid_bounds(const wf_tracer *t, int solid) {
    const wf_window_of_time *w = &t->window;
    int op = t->scene->solids[solid].op;
    bool own = op >= 0 && t->scene->ops[op].own_width;
    double width = (own ? t->scene->ops[op].width_fields : w->width_fields);
    width *= t->view.field_period_s;
    return wf_bounds_solid(t->scene, t->ops, solid, -w->anchor * width,
                           (1 - w->anchor) * width + w->late_s);
}

static wf_bounds combine(wf_step_kind kind, const wf_bounds *operand, int count) {
    wf_bounds b = operand[0];
    for (int k = 1; k < count && kind != WF_STEP_DIFFERENCE; k++)
        b = kind == WF_STEP_UNION ? wf_bounds_unite(b, operand[k])
                                  : wf_bounds_intersect(b, operand[k]);
    return b;
}

static void bound_part(wf_tracer *t, int index) {
    const wf_part *part = &t->parts[index];
    int top = 0;
    for (int k = 0; k < part->step_count; k++) {
        const wf_step *step = &t->scene->steps[part->first_step + k];
        if (step->kind == WF_STEP_SOLID) {
            t->solid_bounds[step->count] = solid_bounds(t, step->count);
            t->stack[top++] = t->solid_bounds[step->count];
            continue;
        }
        top -= step->count;
        t->stack[top] = combine(step->kind, &t->stack[top], step->count);
        top++;
    }
    t->part_bounds[index] = t->stack[0];
}

/* Parts that are nowhere in the window are in no list: an intersection of moving solids comes
 * and goes. */
static void sort_part(wf_tracer *t, int n) {
    bound_part(t, n);
    if (wf_bounds_empty(&t->part_bounds[n])) return;
    if (!wf_bounds_finite(&t->part_bounds[n]))
        t->endless[t->endless_count++] = n;
    else if (t->parts[n].moves)
        t->moving[t->moving_count++] = n;
    else
        t->still[t->still_count++] = n;
}

/* What stands still, once and for all. */
static bool sort_still_parts(wf_tracer *t) {
    for (int n = 0; n < t->part_count; n++) {
        if (t->parts[n].moves)
            t->movers[t->mover_count++] = n;
        else
            sort_part(t, n);
    }
    t->endless_still = t->endless_count;
    return wf_tree_new(t->part_bounds, t->still, t->still_count, &t->still_tree);
}

bool wf_tracer_look(wf_tracer *t, const wf_window_of_time *window, bool skip) {
    t->window = *window;
    t->skip = skip;
    for (int n = 0; n < t->scene->op_count; n++)
        t->ops[n] = wf_op_ready(t->scene, n, window->base_s);
    if (!t->looked && !sort_still_parts(t)) return false;
    t->looked = true;
    t->moving_count = 0;
    t->endless_count = t->endless_still;
    for (int n = 0; n < t->mover_count; n++) sort_part(t, t->movers[n]);
    wf_tree_free(&t->moving_tree);
    return wf_tree_new(t->part_bounds, t->moving, t->moving_count, &t->moving_tree);
}

/* ---- Scratch ---- */

static bool make_scratch(const wf_tracer *t, wf_trace_scratch *s) {
    size_t stack = (size_t)t->most_stack + 2;
    s->levels = t->scene->depth_limit + 1;
    s->found = malloc(((size_t)t->part_count + 1) * sizeof *s->found);
    s->stack = malloc(stack * sizeof *s->stack);
    s->in = aligned_alloc(64, stack * sizeof *s->in);
    s->carried_of = calloc((size_t)t->scene->op_count + 1, sizeof *s->carried_of);
    size_t bytes = ((size_t)s->levels * sizeof *s->level + 63) / 64 * 64;
    s->level = aligned_alloc(64, bytes);
    if (s->level) memset(s->level, 0, bytes);
    return s->found && s->stack && s->in && s->carried_of && s->level;
}

wf_trace_scratch *wf_trace_scratch_new(const wf_tracer *t) {
    wf_trace_scratch *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    if (make_scratch(t, s)) return s;
    wf_trace_scratch_free(s);
    return NULL;
}

void wf_trace_scratch_free(wf_trace_scratch *s) {
    if (!s) return;
    for (int n = 0; s->level && n < s->levels; n++) wf_culls_free(&s->level[n].culls);
    for (int n = 0; n < s->carried_count || (n < s->carried_room && s->carried[n]); n++)
        free(s->carried[n]);
    wf_culls_free(&s->tile);
    free(s->carried);
    free(s->carried_of);
    free(s->found);
    free(s->stack);
    free(s->in);
    free(s->level);
    free(s->runs);
    free(s);
}

wf_trace_counts wf_trace_counted(const wf_trace_scratch *s) {
    return s->counts;
}

/* ---- Tracing ---- */

bool wf_trace_prepare(const wf_tracer *t, wf_trace_scratch *s, const double x[2],
                      const double y[2], bool *empty) {
    wf_shaft shaft = wf_camera_shaft(t, x, y);
    if (!wf_find(t, s, NULL, &shaft, &s->tile)) return false;
    *empty = s->tile.part_count == 0;
    s->counts.tiles++;
    s->counts.tiles_skipped += *empty;
    return true;
}

bool wf_trace_nothing(const wf_tracer *t, wf_trace_scratch *s, const double x[2],
                      const double y[2]) {
    wf_shaft shaft = wf_camera_shaft(t, x, y);
    return wf_find(t, s, NULL, &shaft, &s->tile) && s->tile.part_count == 0;
}

void wf_trace_skip(wf_trace_scratch *s) {
    s->counts.tiles++;
    s->counts.tiles_skipped++;
}

static void fill_packet(const wf_tracer *t, const wf_trace_samples *samples, size_t first,
                        wf_packet *packet) {
    _Alignas(64) double x[WF_PACKET], y[WF_PACKET];
    size_t left = samples->count - first;
    packet->rays.count = left < WF_PACKET ? (int)left : WF_PACKET;
    packet->late_s = samples->late_s;
    for (int i = 0; i < WF_PACKET; i++) {
        size_t at = first + (size_t)(i < packet->rays.count ? i : packet->rays.count - 1);
        x[i] = samples->x[at];
        y[i] = samples->y[at];
        packet->f[i] = samples->f[at];
    }
    wf_camera_rays(t, x, y, packet);
}

bool wf_look_along(const wf_tracer *t, wf_trace_scratch *s, int level, const wf_culls *culls) {
    wf_trace_level *l = &s->level[level];
    wf_hits_clear(&l->hits);
    s->counts.rays += l->packet.rays.count;
    return wf_nearest(t, s, &l->packet, culls, true, &l->hits) && wf_shade(t, s, level);
}

/* From the tile's list, what this packet can meet. */
static bool look_from_tile(const wf_tracer *t, wf_trace_scratch *s) {
    wf_trace_level *l = &s->level[0];
    wf_carry_begin(s);
    if (!t->skip) return wf_look_along(t, s, 0, &s->tile);
    wf_shaft shaft = wf_shaft_of_rays(&l->packet.rays, HUGE_VAL);
    return wf_find_again(t, s, &l->packet, &shaft, &s->tile, &l->culls) &&
           wf_look_along(t, s, 0, &l->culls);
}

static void take_light(const wf_trace_level *l, const wf_trace_samples *samples, size_t first) {
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < l->packet.rays.count; i++)
            samples->rgb[c][first + (size_t)i] = (float)l->rgb[c][i];
}

bool wf_trace(const wf_tracer *t, wf_trace_scratch *s, const wf_trace_samples *samples) {
    s->counts.samples += (int64_t)samples->count;
    for (size_t first = 0; first < samples->count; first += WF_PACKET) {
        fill_packet(t, samples, first, &s->level[0].packet);
        if (!look_from_tile(t, s)) return false;
        take_light(&s->level[0], samples, first);
    }
    return true;
}
