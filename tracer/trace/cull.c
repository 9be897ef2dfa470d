/* What is left of the parts of a scene where rays can reach only some of their solids. */
#include "tracer/trace/cull.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Lists ---- */

void wf_culls_free(wf_culls *c) {
    free(c->part);
    free(c->step);
    free(c->solid);
    *c = (wf_culls){0};
}

void wf_culls_clear(wf_culls *c) {
    c->part_count = c->step_count = c->solid_count = 0;
}

/* Makes an array hold `need` items; pointer: to the pointer to them. */
static bool reserve(void *pointer, size_t *have, size_t need, size_t each) {
    if (need <= *have) return true;
    void *old, *grown;
    memcpy(&old, pointer, sizeof old);
    size_t want = 2 * need;
    grown = realloc(old, want * each);
    if (!grown) return false;
    memcpy(pointer, &grown, sizeof grown);
    *have = want;
    return true;
}

static bool reserve_part(wf_culls *c, size_t steps, size_t solids) {
    return reserve(&c->part, &c->part_capacity, c->part_count + 1, sizeof *c->part) &&
           reserve(&c->step, &c->step_capacity, c->step_count + steps, sizeof *c->step) &&
           reserve(&c->solid, &c->solid_capacity, c->solid_count + solids, sizeof *c->solid);
}

/* ---- Programs ---- */

/* A program to be culled: solids NULL means that steps count the scene's own. */
typedef struct program {
    const wf_step *steps;
    int step_count;
    const int *solids;
} program;

typedef struct culling {
    const wf_cull_scene *scene;
    wf_culls *out;
    size_t first_solid; /* of the part in out */
    wf_cull_operand *stack;
    int top;
} culling;

static bool is_empty(const culling *c, int operand) {
    size_t end = operand + 1 < c->top ? c->stack[operand + 1].step : c->out->step_count;
    return c->stack[operand].step == end;
}

static void push_solid(culling *c, int solid) {
    wf_culls *out = c->out;
    wf_cull_operand *operand = &c->stack[c->top++];
    *operand = (wf_cull_operand){out->step_count, out->solid_count, {0, HUGE_VAL}};
    if (c->scene->shaft && !c->scene->meets(c->scene->user, solid, &operand->stretch)) return;
    out->step[out->step_count++] =
        (wf_step){WF_STEP_SOLID, (int)(out->solid_count - c->first_solid)};
    out->solid[out->solid_count++] = solid;
}

/* Where rays may be in a union or an intersection of two. */
static wf_stretch joined(wf_step_kind kind, wf_stretch a, wf_stretch b) {
    bool wider = kind == WF_STEP_UNION;
    return (wf_stretch){(a.from < b.from) == wider ? a.from : b.from,
                        (a.to > b.to) == wider ? a.to : b.to};
}

/* Operands that are left, and where rays may be in the whole; 0: it is gone. */
static int operands_left(const culling *c, const wf_step *step, int first, wf_stretch *where) {
    int left = 0;
    for (int k = first; k < c->top; k++) {
        bool needed = step->kind == WF_STEP_INTERSECTION ||
                      (step->kind == WF_STEP_DIFFERENCE && k == first);
        if (is_empty(c, k)) {
            if (needed) return 0;
            continue;
        }
        if (!left++)
            *where = c->stack[k].stretch;
        else if (step->kind != WF_STEP_DIFFERENCE)
            *where = joined(step->kind, *where, c->stack[k].stretch);
    }
    return where->from <= where->to ? left : 0;
}

/* What is left of an operation: nothing, one operand, or itself over fewer. */
static void push_operation(culling *c, const wf_step *step) {
    int first = c->top - step->count;
    wf_stretch where = {0, HUGE_VAL};
    int left = operands_left(c, step, first, &where);
    c->top = first + 1;
    c->stack[first].stretch = where;
    if (!left) {
        c->out->step_count = c->stack[first].step;
        c->out->solid_count = c->stack[first].solid;
    } else if (left > 1) {
        c->out->step[c->out->step_count++] = (wf_step){step->kind, left};
    }
}

static bool cull(culling *c, int part, const program *p) {
    wf_culls *out = c->out;
    size_t most = (size_t)p->step_count;
    if (!reserve_part(out, most, most)) return false;
    size_t first_step = out->step_count;
    c->first_solid = out->solid_count;
    c->top = 0;
    for (int k = 0; k < p->step_count; k++) {
        const wf_step *step = &p->steps[k];
        if (step->kind == WF_STEP_SOLID)
            push_solid(c, p->solids ? p->solids[step->count] : step->count);
        else
            push_operation(c, step);
    }
    if (out->step_count > first_step)
        out->part[out->part_count++] = (wf_culled){part,
                                                   c->stack[0].stretch.from,
                                                   first_step,
                                                   c->first_solid,
                                                   (int)(out->step_count - first_step),
                                                   (int)(out->solid_count - c->first_solid)};
    return true;
}

static bool part_met(const wf_cull_scene *scene, int part) {
    wf_stretch stretch;
    return !scene->shaft || wf_shaft_meets(scene->shaft, &scene->part_bounds[part], &stretch);
}

bool wf_cull_part(const wf_cull_scene *scene, int part, wf_cull_operand *stack, wf_culls *out) {
    const wf_part *p = &scene->parts[part];
    program whole = {scene->steps + p->first_step, p->step_count, NULL};
    culling c = {scene, out, 0, stack, 0};
    return !part_met(scene, part) || cull(&c, part, &whole);
}

bool wf_cull_again(const wf_cull_scene *scene, const wf_culls *from, wf_cull_operand *stack,
                   wf_culls *out) {
    culling c = {scene, out, 0, stack, 0};
    for (size_t n = 0; n < from->part_count; n++) {
        const wf_culled *p = &from->part[n];
        program left = {from->step + p->step, p->step_count, from->solid + p->solid};
        if (part_met(scene, p->part) && !cull(&c, p->part, &left)) return false;
    }
    return true;
}

/* ---- Order ---- */

static int by_near(const void *a, const void *b) {
    const wf_culled *p = a, *q = b;
    if (p->near != q->near) return p->near < q->near ? -1 : 1;
    return (p->part > q->part) - (p->part < q->part);
}

void wf_culls_sort(wf_culls *c) {
    if (c->part_count < 2) return;
    if (c->part_count > 16) {
        qsort(c->part, c->part_count, sizeof *c->part, by_near);
        return;
    }
    for (size_t n = 1; n < c->part_count; n++) {
        wf_culled moved = c->part[n];
        size_t at = n;
        for (; at > 0 && by_near(&c->part[at - 1], &moved) > 0; at--)
            c->part[at] = c->part[at - 1];
        c->part[at] = moved;
    }
}

/* ---- Joining ---- */

/* Adds a part's program and solids, which then count behind those there are. */
static bool append(const wf_culls *from, const wf_culled *part, wf_culls *out) {
    size_t steps = (size_t)part->step_count, solids = (size_t)part->solid_count;
    if (!reserve_part(out, steps + 1, solids)) return false;
    for (size_t k = 0; k < steps; k++) {
        wf_step step = from->step[part->step + k];
        if (step.kind == WF_STEP_SOLID) step.count += (int)out->solid_count;
        out->step[out->step_count++] = step;
    }
    memcpy(out->solid + out->solid_count, from->solid + part->solid,
           solids * sizeof *out->solid);
    out->solid_count += solids;
    return true;
}

bool wf_culls_join(const wf_culls *from, const wf_part *parts, int object, wf_culls *out) {
    int operands = 0;
    wf_culls_clear(out);
    for (size_t n = 0; n < from->part_count; n++) {
        if (parts[from->part[n].part].object != object) continue;
        if (!append(from, &from->part[n], out)) return false;
        operands++;
    }
    if (!operands) return false;
    if (operands > 1) out->step[out->step_count++] = (wf_step){WF_STEP_UNION, operands};
    out->part[out->part_count++] =
        (wf_culled){.step_count = (int)out->step_count, .solid_count = (int)out->solid_count};
    return true;
}
