/* Trees of boxes for single rays: halved until there are eight in each node. */
#include "tracer/trace/wide.h"

#include <math.h>
#include <stdlib.h>

#include "tracer/trace/tree.h"

typedef struct span {
    int first, count;
} span;

typedef struct builder {
    const wf_bounds *bounds;
    int *items;
    wf_walk_tree *tree;
} builder;

static int largest(const span *spans, int count) {
    int most = 0;
    for (int k = 1; k < count; k++)
        if (spans[k].count > spans[most].count) most = k;
    return most;
}

/* What the children of a node hold: items alone where they are few, else spans of items, of
 * which none is halved that is a node by itself. */
static int split(const builder *b, span whole, span *spans) {
    int count = 1;
    for (int k = 0; whole.count <= WF_WALK_WIDTH && k < whole.count; k++)
        spans[k] = (span){whole.first + k, 1};
    if (whole.count <= WF_WALK_WIDTH) return whole.count;
    spans[0] = whole;
    while (count < WF_WALK_WIDTH) {
        span *s = &spans[largest(spans, count)];
        if (s->count <= WF_WALK_WIDTH) break;
        wf_tree_halve(b->bounds, b->items + s->first, s->count);
        spans[count++] = (span){s->first + s->count / 2, s->count - s->count / 2};
        s->count /= 2;
    }
    return count;
}

static void put_box(wf_walk_node *node, int k, const wf_bounds *box) {
    for (int axis = 0; axis < 3; axis++) {
        node->low[axis][k] = box->low[axis];
        node->high[axis][k] = box->high[axis];
    }
}

/* Returns the box of what the node holds. */
static wf_bounds build(builder *b, int index, span whole) {
    span spans[WF_WALK_WIDTH];
    wf_bounds all = wf_bounds_none(), none = all;
    int count = split(b, whole, spans);
    for (int k = 0; k < WF_WALK_WIDTH; k++) {
        put_box(&b->tree->nodes[index], k, &none);
        b->tree->nodes[index].child[k] = 0;
    }
    for (int k = 0; k < count; k++) {
        int item = b->items[spans[k].first];
        int child = spans[k].count > 1 ? b->tree->node_count++ : ~item;
        wf_bounds box = child < 0 ? b->bounds[item] : build(b, child, spans[k]);
        put_box(&b->tree->nodes[index], k, &box);
        b->tree->nodes[index].child[k] = child;
        all = wf_bounds_unite(all, box);
    }
    return all;
}

static double size_of(const wf_bounds *b) {
    double size = 0;
    for (int k = 0; k < 3; k++) size = fmax(size, fmax(fabs(b->low[k]), fabs(b->high[k])));
    return size;
}

/* Nodes that are halved hold more than eight items, and halves of those at least four. */
bool wf_wide_new(const wf_bounds *bounds, int *items, int count, wf_walk_tree *out) {
    *out = (wf_walk_tree){0};
    if (!count) return true;
    size_t most = (size_t)count / 2 + 1;
    out->nodes = aligned_alloc(64, most * sizeof *out->nodes);
    if (!out->nodes) return false;
    out->node_count = 1;
    wf_bounds all = build(&(builder){bounds, items, out}, 0, (span){0, count});
    out->size = size_of(&all);
    return true;
}

void wf_wide_free(wf_walk_tree *tree) {
    free(tree->nodes);
    *tree = (wf_walk_tree){0};
}
