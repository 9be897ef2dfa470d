/* Walks of rays and shafts of rays through trees of boxes. */
#include "tracer/rays/walk.h"

#include <math.h>

#include "filters/base/isa_file.h"
#include "tracer/rays/lanes.h"

/* What waits to be looked at. */
typedef struct stop {
    double near;
    int32_t node;
} stop;

/* ---- Rays ---- */

/* By so much of the numbers' size boxes are wider for a ray: what rounding may do to it on its
 * way into a solid's space is far less, and so is how near to each other ends of runs are one.
 */
#define WIDER 0x1p-38

/* A ray made ready: along each axis, which plane of a box it meets first, and what is less from
 * that plane and the last. */
typedef struct way {
    lanes first[3], last[3], inverse[3];
    int first_plane[3], last_plane[3];
} way;

static inline way make_way(const wf_tree *tree, const wf_walk *w) {
    way r;
    double size = tree->size;
    for (int k = 0; k < 3; k++) size = fabs(w->o[k]) > size ? fabs(w->o[k]) : size;
    for (int k = 0; k < 3; k++) {
        double up = w->o[k] + size * WIDER, low = w->o[k] - size * WIDER;
        bool down = signbit(w->d[k]);
        r.first[k] = of(down ? low : up);
        r.last[k] = of(down ? up : low);
        r.inverse[k] = of(1 / w->d[k]);
        r.first_plane[k] = down ? 3 + k : k;
        r.last_plane[k] = down ? k : 3 + k;
    }
    return r;
}

/* The boxes that the ray meets, a bit each, and where. What is no number, of a ray along a
 * plane, counts as met. */
static inline unsigned meet_boxes(const wf_tree_node *node, const way *r, double most,
                                  lanes *near) {
    lanes from = of(0), to = of(most);
    for (int k = 0; k < 3; k++) {
        lanes a = *(const lanes *)node->plane[r->first_plane[k]];
        lanes b = *(const lanes *)node->plane[r->last_plane[k]];
        from = larger((a - r->first[k]) * r->inverse[k], from);
        to = smaller((b - r->last[k]) * r->inverse[k], to);
    }
    *near = from;
    return not_over(from, to) & node->used;
}

/* Puts what was met behind the stops there are, the nearest last. */
static inline int add_stops(const wf_tree_node *node, unsigned met, const double *near,
                            stop *stops, int count) {
    int first = count;
    for (; met; met &= met - 1) {
        int k = __builtin_ctz(met), at = count++;
        for (; at > first && stops[at - 1].near < near[k]; at--) stops[at] = stops[at - 1];
        stops[at] = (stop){near[k], node->child[k]};
    }
    return count;
}

/* Those items of stops from first on that are near enough, the last first. */
static inline bool meet_items(const stop *stops, int first, int count, wf_walk *w) {
    while (count > first) {
        const stop *s = &stops[--count];
        if (s->near <= w->most && !w->meet(w->user, w, ~s->node, s->near)) return false;
    }
    return true;
}

/* Children are all items, or all nodes. */
static bool go(const wf_tree *tree, wf_walk *w) {
    stop stops[WF_TREE_DEPTH * WF_TREE_WIDTH];
    int count = 0;
    if (!tree->node_count) return true;
    way r = make_way(tree, w);
    stops[count++] = (stop){0, 0};
    while (count > 0) {
        stop s = stops[--count];
        lanes near;
        if (s.near > w->most) continue;
        const wf_tree_node *node = &tree->nodes[s.node];
        unsigned met = meet_boxes(node, &r, w->most, &near);
        if (!met) continue;
        int more = add_stops(node, met, (const double *)&near, stops, count);
        if (node->child[0] >= 0)
            count = more;
        else if (!meet_items(stops, count, more, w))
            return false;
    }
    return true;
}

/* ---- Shafts ---- */

/* What rounding may do to the ends of a stretch. */
#define SLACK 0x1p-40

/* No ray of the shaft meets a box but between these. */
static inline unsigned reach_boxes(const wf_tree_node *node, const wf_shaft *f) {
    lanes from = of(0), to = of(f->most);
    for (int k = 0; k < 3; k++) {
        lanes low = *(const lanes *)node->plane[k], high = *(const lanes *)node->plane[3 + k];
        lanes a = (low - f->o.high[k]) * f->rise[k], b = (high - f->o.low[k]) * f->fall[k];
        if (signbit(f->d.high[k]))
            to = smaller(a, to);
        else
            from = larger(a, from);
        if (signbit(f->d.low[k]))
            from = larger(b, from);
        else
            to = smaller(b, to);
    }
    return not_over(from * (1 - SLACK), to * (1 + SLACK)) & node->used;
}

static int find(const wf_tree *tree, const wf_shaft *shaft, int most, int *found) {
    int32_t stops[WF_TREE_DEPTH * WF_TREE_WIDTH];
    int count = 0, n = 0;
    if (!tree->node_count) return 0;
    stops[count++] = 0;
    while (count > 0 && n <= most) {
        const wf_tree_node *node = &tree->nodes[stops[--count]];
        for (unsigned met = reach_boxes(node, shaft); met; met &= met - 1) {
            int32_t child = node->child[__builtin_ctz(met)];
            if (child < 0)
                found[n++] = tree->items[~child];
            else
                stops[count++] = child;
        }
    }
    return n;
}

const wf_walk_ops WF_ISA_TABLE(wf_walk_ops) = {go, find};
