/* The parts that a scene is traced in: objects, taken apart at their outermost unions. */
#include "tracer/trace/parts.h"

#include <stdlib.h>

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

bool wf_parts_split(wf_tracer *t) {
    const wf_scene *s = t->scene;
    size_t steps = (size_t)s->step_count + 1;
    t->parts = malloc(steps * sizeof *t->parts);
    t->sibling = calloc((size_t)s->object_count + 1, sizeof *t->sibling);
    int *start = malloc(steps * sizeof *start), *stack = malloc(steps * sizeof *stack);
    bool good = t->parts && t->sibling && start && stack;
    for (int n = 0; good && n < s->object_count; n++) {
        if (s->objects[n].step_count) split_object(t, n, start, stack);
        if (s->objects[n].most_stack > t->most_stack) t->most_stack = s->objects[n].most_stack;
    }
    free(start);
    free(stack);
    return good;
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

void wf_parts_judge(wf_tracer *t) {
    bool moves = t->lights_move || wf_op_moves(t->scene, t->scene->camera.op);
    for (int n = 0; n < t->part_count; n++) {
        find_look(t, n);
        moves |= t->parts[n].moves;
    }
    t->all_still = !moves;
}

/* ---- Boxes ---- */

static wf_bounds solid_bounds(const wf_tracer *t, int solid, int within) {
    const wf_window_of_time *w = &t->window;
    int op = t->scene->solids[solid].op;
    bool own = op >= 0 && t->scene->ops[op].own_width;
    double width = (own ? t->scene->ops[op].width_fields : w->width_fields);
    width *= t->view.field_period_s;
    return wf_bounds_solid(t->scene, t->ops, solid, within, -w->anchor * width,
                           (1 - w->anchor) * width + w->late_s);
}

static wf_bounds combine(wf_step_kind kind, const wf_bounds *operand, int count) {
    wf_bounds b = operand[0];
    for (int k = 1; k < count && kind != WF_STEP_DIFFERENCE; k++)
        b = kind == WF_STEP_UNION ? wf_bounds_unite(b, operand[k])
                                  : wf_bounds_intersect(b, operand[k]);
    return b;
}

void wf_parts_bound(wf_tracer *t, int index, int within, wf_bounds *solids, wf_bounds *out) {
    const wf_part *part = &t->parts[index];
    int top = 0;
    for (int k = 0; k < part->step_count; k++) {
        const wf_step *step = &t->scene->steps[part->first_step + k];
        if (step->kind == WF_STEP_SOLID) {
            t->stack[top] = solid_bounds(t, step->count, within);
            if (solids) solids[step->count] = t->stack[top];
            top++;
            continue;
        }
        top -= step->count;
        t->stack[top] = combine(step->kind, &t->stack[top], step->count);
        top++;
    }
    *out = t->stack[0];
}
