/* Trees of boxes, halved about the middle along the axis on which the boxes lie widest apart.
 */
#include "tracer/trace/tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEAF  4
#define DEPTH 64 /* a tree halved at each node is never deeper */

typedef struct builder {
    const wf_bounds *bounds;
    wf_tree *tree;
} builder;

static double middle(const wf_bounds *bounds, int item, int axis) {
    const wf_bounds *box = &bounds[item];
    return box->low[axis] / 2 + box->high[axis] / 2;
}

/* The axis along which the middles of the boxes lie widest apart. */
static int widest(const wf_bounds *bounds, const int *items, int count) {
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            double m = middle(bounds, items[i], k);
            low[k] = m < low[k] ? m : low[k];
            high[k] = m > high[k] ? m : high[k];
        }
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    return axis;
}

static void swap(int *a, int *b) {
    int t = *a;
    *a = *b;
    *b = t;
}

/* Quickselect about the middle one. */
void wf_tree_halve(const wf_bounds *bounds, int *items, int count) {
    int axis = widest(bounds, items, count);
    int low = 0, high = count - 1, half = count / 2;
    while (low < high) {
        double pivot = middle(bounds, items[(low + high) / 2], axis);
        int i = low, j = high;
        while (i <= j) {
            while (middle(bounds, items[i], axis) < pivot) i++;
            while (middle(bounds, items[j], axis) > pivot) j--;
            if (i <= j) swap(&items[i++], &items[j--]);
        }
        if (half <= j)
            high = j;
        else if (half >= i)
            low = i;
        else
            return;
    }
}

wf_bounds wf_tree_around(const wf_bounds *bounds, const int *items, int count) {
    wf_bounds all = wf_bounds_none();
    for (int i = 0; i < count; i++) all = wf_bounds_unite(all, bounds[items[i]]);
    return all;
}

static void build(builder *b, int node, int first, int count) {
    wf_tree *tree = b->tree;
    int *items = tree->items + first;
    tree->nodes[node] = (wf_tree_node){wf_tree_around(b->bounds, items, count), first, count};
    if (count <= LEAF) return;
    wf_tree_halve(b->bounds, items, count);
    int child = tree->node_count;
    tree->node_count += 2;
    tree->nodes[node].first = child;
    tree->nodes[node].count = 0;
    build(b, child, first, count / 2);
    build(b, child + 1, first + count / 2, count - count / 2);
}

bool wf_tree_new(const wf_bounds *bounds, const int *items, int count, wf_tree *out) {
    *out = (wf_tree){.node_count = 1, .item_count = count};
    out->nodes = malloc((2 * (size_t)count + 1) * sizeof *out->nodes);
    out->items = malloc(((size_t)count + 1) * sizeof *out->items);
    if (!out->nodes || !out->items) {
        wf_tree_free(out);
        return false;
    }
    memcpy(out->items, items, (size_t)count * sizeof *items);
    build(&(builder){bounds, out}, 0, 0, count);
    return true;
}

void wf_tree_free(wf_tree *tree) {
    free(tree->nodes);
    free(tree->items);
    *tree = (wf_tree){0};
}

static int meet_leaf(const wf_tree *tree, const wf_tree_node *node, const wf_bounds *bounds,
                     const wf_shaft *shaft, int *found) {
    wf_stretch stretch;
    int n = 0;
    for (int i = 0; i < node->count; i++) {
        int item = tree->items[node->first + i];
        if (wf_shaft_meets(shaft, &bounds[item], &stretch)) found[n++] = item;
    }
    return n;
}

int wf_tree_meet(const wf_tree *tree, const wf_bounds *bounds, const wf_shaft *shaft, int most,
                 int *found) {
    int waiting[DEPTH], top = 0, n = 0;
    wf_stretch stretch;
    if (!tree->item_count) return 0;
    waiting[top++] = 0;
    while (top > 0 && n <= most) {
        const wf_tree_node *node = &tree->nodes[waiting[--top]];
        if (!wf_shaft_meets(shaft, &node->bounds, &stretch)) continue;
        if (node->count) {
            n += meet_leaf(tree, node, bounds, shaft, found + n);
            continue;
        }
        waiting[top++] = node->first + 1;
        waiting[top++] = node->first;
    }
    return n;
}
