/* Which trees parts are in, and the trees. */
#include "tracer/trace/grove.h"

#include <stdlib.h>

#include "tracer/trace/parts.h"
#include "tracer/trace/tree.h"

/* Groves that are not worth a walk of their own are in that of the rest. */
#define FEWEST_PARTS 8
#define MOST_GROVES  32

/* The first two: what stands still, and the rest. */
enum { STILL, REST, OF_OPS };

/* ---- Which is in which ---- */

/* The outermost operator that moves a solid; -1: none. */
static int mover_of(const wf_scene *s, int solid) {
    int mover = -1;
    for (int op = s->solids[solid].op; op >= 0; op = s->ops[op].outer)
        if (s->ops[op].kind != WF_OP_PLACE) mover = op;
    return mover;
}

/* The operator that moves all of a part; -1: there is none. */
static int mover_of_part(const wf_tracer *t, const wf_part *part) {
    int mover = -1;
    for (int k = 0; k < part->step_count; k++) {
        const wf_step *step = &t->scene->steps[part->first_step + k];
        if (step->kind != WF_STEP_SOLID) continue;
        int of = mover_of(t->scene, step->count);
        if (of < 0 || (k && of != mover)) return -1;
        mover = of;
    }
    return mover;
}

/* Whether something in a part moves within its mover's space. */
static bool moves_within(const wf_tracer *t, const wf_part *part, int mover) {
    for (int k = 0; k < part->step_count; k++) {
        const wf_step *step = &t->scene->steps[part->first_step + k];
        if (step->kind != WF_STEP_SOLID) continue;
        for (int op = t->scene->solids[step->count].op; op != mover;
             op = t->scene->ops[op].outer)
            if (t->scene->ops[op].kind != WF_OP_PLACE) return true;
    }
    return false;
}

/* Those operators that move most parts get a grove each: of_op [op], how many parts each moves,
 * becomes which grove that is. */
static void choose_groves(wf_groves *g, int *of_op, int ops) {
    for (int n = 0; n < ops; n++) {
        bool own = of_op[n] >= FEWEST_PARTS && g->count < OF_OPS + MOST_GROVES;
        if (own) g->grove[g->count] = (wf_grove){.op = n};
        of_op[n] = own ? g->count++ : REST;
    }
}

static void sort_parts(const wf_tracer *t, wf_groves *g, int *of_op) {
    int *mover = g->of_part;
    for (int n = 0; n < t->part_count; n++) {
        mover[n] = t->parts[n].moves ? mover_of_part(t, &t->parts[n]) : -1;
        if (mover[n] >= 0) of_op[mover[n]]++;
    }
    choose_groves(g, of_op, t->scene->op_count);
    for (int n = 0; n < t->part_count; n++) {
        int op = mover[n], in = op >= 0 ? of_op[op] : t->parts[n].moves ? REST : STILL;
        if (in >= OF_OPS) g->grove[in].moves |= moves_within(t, &t->parts[n], op);
        g->of_part[n] = in;
    }
    g->grove[REST].moves = true;
}

static wf_groves *new_groves(const wf_tracer *t) {
    wf_groves *g = calloc(1, sizeof *g);
    if (!g) return NULL;
    g->count = OF_OPS;
    g->grove = calloc(OF_OPS + MOST_GROVES, sizeof *g->grove);
    g->of_part = malloc(((size_t)t->part_count + 1) * sizeof *g->of_part);
    int *of_op = calloc((size_t)t->scene->op_count + 1, sizeof *of_op);
    if (g->grove && g->of_part && of_op) {
        g->grove[STILL].op = g->grove[REST].op = -1;
        sort_parts(t, g, of_op);
        free(of_op);
        return g;
    }
    free(of_op);
    wf_groves_free(g);
    return NULL;
}

/* ---- Trees ---- */

static wf_leaf leaf_of(const wf_tracer *t, int index) {
    const wf_part *part = &t->parts[index];
    wf_leaf leaf = {.part = index, .solid = -1, .sibling = t->sibling[part->object]};
    if (part->step_count > 1) return leaf;
    leaf.solid = t->scene->steps[part->first_step].count;
    const wf_solid *solid = &t->scene->solids[leaf.solid];
    leaf.inverse = solid->inverse;
    leaf.op = solid->op;
    leaf.kind = solid->kind;
    return leaf;
}

static uint8_t kind_of(const wf_grove *g, const wf_leaf *leaf) {
    bool alike = leaf->solid >= 0 && leaf->op == g->op && wf_solid_type_of(leaf->kind)->alike;
    return alike ? (uint8_t)leaf->kind : WF_SOLID_KINDS;
}

static void free_grove(wf_grove *g) {
    wf_tree_free(&g->tree);
    free(g->leaves);
    free(g->kinds);
    g->leaves = NULL;
    g->kinds = NULL;
}

/* Notes the box of a part in its grove; false: it has none there. Those that are endless are so
 * in the world, too. */
static bool bound(wf_tracer *t, int part, int op, wf_bounds *bounds) {
    if (op < 0)
        *bounds = t->part_bounds[part];
    else
        wf_parts_bound(t, part, op, NULL, bounds);
    return !wf_bounds_empty(bounds) && wf_bounds_finite(bounds);
}

/* The parts of a grove, of all or of those that move. */
static int find_parts(wf_tracer *t, int index, wf_bounds *bounds, int *parts) {
    int count = 0, op = t->groves->grove[index].op;
    for (int n = 0; n < (index == STILL ? t->part_count : t->mover_count); n++) {
        int part = index == STILL ? n : t->movers[n];
        if (t->groves->of_part[part] == index && bound(t, part, op, &bounds[part]))
            parts[count++] = part;
    }
    return count;
}

static bool make_grove(wf_tracer *t, int index, wf_bounds *bounds, int *parts) {
    wf_grove *g = &t->groves->grove[index];
    int count = find_parts(t, index, bounds, parts);
    free_grove(g);
    if (!wf_tree_new(bounds, parts, count, &g->tree)) return false;
    g->leaves = aligned_alloc(64, ((size_t)count + 1) * sizeof *g->leaves);
    g->kinds = malloc((size_t)count + 1);
    if (!g->leaves || !g->kinds) return false;
    for (int n = 0; n < count; n++) {
        g->leaves[n] = leaf_of(t, g->tree.items[n]);
        g->kinds[n] = kind_of(g, &g->leaves[n]);
    }
    return true;
}

bool wf_groves_look(wf_tracer *t) {
    bool first = !t->groves;
    if (!first && !t->mover_count) return true;
    if (first && !(t->groves = new_groves(t))) return false;
    size_t parts = (size_t)t->part_count + 1;
    wf_bounds *bounds = malloc(parts * sizeof *bounds);
    int *list = malloc(parts * sizeof *list);
    bool good = bounds && list;
    for (int n = 0; good && n < t->groves->count; n++)
        if (first || t->groves->grove[n].moves) good = make_grove(t, n, bounds, list);
    free(bounds);
    free(list);
    return good;
}

const wf_tree *wf_groves_still(const wf_groves *g) {
    return &g->grove[STILL].tree;
}

void wf_groves_free(wf_groves *g) {
    if (!g) return;
    for (int n = 0; g->grove && n < g->count; n++) free_grove(&g->grove[n]);
    free(g->grove);
    free(g->of_part);
    free(g);
}
