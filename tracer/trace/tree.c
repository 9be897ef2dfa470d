/* Trees of boxes. */
#include "tracer/trace/tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/trace/bounds.h"

/* ---- Parts of items ---- */

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

/* Puts those `half` items first whose middles are smallest, along the axis on which the middles
 * lie widest apart: quickselect about the middle one. */
static void part_items(const wf_bounds *bounds, int *items, int count, int half) {
    int axis = widest(bounds, items, count);
    int low = 0, high = count - 1;
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

/* ---- Nodes ---- */

/* Items in a row. */
typedef struct span {
    int first, count;
} span;

typedef struct builder {
    const wf_bounds *bounds;
    wf_tree *tree;
} builder;

/* Nodes are full but for the root: one level more is a step more for every ray. */
static int children_of(int count) {
    int64_t full = 1;
    while (full * WF_TREE_WIDTH < count) full *= WF_TREE_WIDTH;
    return (int)((count + full - 1) / full);
}

/* Cuts a span into so many about equal ones, each by what it holds of the two halves of all. */
static void split(const builder *b, span whole, int parts, span *spans) {
    if (parts == 1 || whole.count == parts) {
        for (int k = 0; k < parts; k++)
            spans[k] = (span){whole.first + k, parts == 1 ? whole.count : 1};
        return;
    }
    int left = parts / 2, half = (int)((int64_t)whole.count * left / parts);
    part_items(b->bounds, b->tree->items + whole.first, whole.count, half);
    split(b, (span){whole.first, half}, left, spans);
    split(b, (span){whole.first + half, whole.count - half}, parts - left, spans + left);
}

static void put_child(wf_tree_node *node, int k, const wf_bounds *box, int child) {
    for (int axis = 0; axis < 3; axis++) {
        node->plane[axis][k] = box->low[axis];
        node->plane[3 + axis][k] = box->high[axis];
    }
    node->child[k] = child;
    node->used |= 1u << k;
}

/* How far a box lies from the middle of all, in the direction of a place of a node. */
static double fits(const wf_bounds *box, const wf_bounds *all, int place) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double off = box->low[k] / 2 - all->low[k] / 2 + (box->high[k] / 2 - all->high[k] / 2);
        sum += place >> k & 1 ? off : -off;
    }
    return sum;
}

/* Gives each box a place of the node: again and again the box and the place that fit best. */
static void find_places(const wf_bounds *boxes, const wf_bounds *all, int count, int *place) {
    double fit[WF_TREE_WIDTH][WF_TREE_WIDTH];
    unsigned given = 0, taken = 0;
    for (int k = 0; k < count; k++)
        for (int p = 0; p < WF_TREE_WIDTH; p++) fit[k][p] = fits(&boxes[k], all, p);
    for (int n = 0; n < count; n++) {
        int box = -1, at = -1;
        for (int k = 0; k < count; k++)
            for (int p = 0; p < WF_TREE_WIDTH; p++) {
                bool free = !(given >> k & 1) && !(taken >> p & 1);
                if (free && (box < 0 || fit[k][p] > fit[box][at])) box = k, at = p;
            }
        given |= 1u << box, taken |= 1u << at;
        place[box] = at;
    }
}

/* Returns the box of what the node holds. */
static wf_bounds build(builder *b, int index, span whole) {
    wf_tree *tree = b->tree;
    span spans[WF_TREE_WIDTH];
    wf_bounds all = wf_bounds_none();
    int count = children_of(whole.count);
    split(b, whole, count, spans);
    wf_bounds boxes[WF_TREE_WIDTH];
    int child[WF_TREE_WIDTH] = {0}, place[WF_TREE_WIDTH];
    for (int k = 0; k < count; k++) {
        bool one = spans[k].count == 1;
        child[k] = one ? ~spans[k].first : tree->node_count++;
        boxes[k] = one ? b->bounds[tree->items[spans[k].first]] : build(b, child[k], spans[k]);
        all = wf_bounds_unite(all, boxes[k]);
    }
    find_places(boxes, &all, count, place);
    wf_tree_node *node = &tree->nodes[index];
    *node = (wf_tree_node){.used = 0};
    for (int k = 0; k < WF_TREE_WIDTH; k++) node->child[k] = child[0];
    for (int k = 0; k < count; k++) put_child(node, place[k], &boxes[k], child[k]);
    return all;
}

static double size_of(const wf_bounds *b) {
    double size = 0;
    for (int k = 0; k < 3; k++) size = fmax(size, fmax(fabs(b->low[k]), fabs(b->high[k])));
    return size;
}

/* A node below the root has two children or more, those of the last level four items. */
static size_t most_nodes(int count) {
    return (size_t)count / 2 + 1;
}

bool wf_tree_new(const wf_bounds *bounds, const int *items, int count, wf_tree *out) {
    *out = (wf_tree){.node_count = 1, .item_count = count};
    if (!count) out->node_count = 0;
    out->nodes = aligned_alloc(64, most_nodes(count) * sizeof *out->nodes);
    out->items = malloc(((size_t)count + 1) * sizeof *out->items);
    if (!out->nodes || !out->items) {
        wf_tree_free(out);
        return false;
    }
    if (!count) return true;
    memcpy(out->items, items, (size_t)count * sizeof *items);
    wf_bounds all = build(&(builder){bounds, out}, 0, (span){0, count});
    out->size = size_of(&all);
    return true;
}

void wf_tree_free(wf_tree *tree) {
    free(tree->nodes);
    free(tree->items);
    *tree = (wf_tree){0};
}
