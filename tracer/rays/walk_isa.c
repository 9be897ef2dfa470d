/* Walks of rays and shafts of rays through trees of boxes. */
#include "tracer/rays/walk.h"

#include <math.h>

#include "filters/base/isa_file.h"
#include "tracer/rays/lanes.h"

/* ---- Rays ---- */

/* By so much of the numbers' size boxes are wider for a ray: what rounding may do to it on its
 * way into a solid's space is far less, and so is how near to each other ends of runs are one.
 */
#define WIDER 0x1p-38

static void begin(const wf_tree *tree, const double o[3], const double d[3], double most,
                  wf_walk *w) {
    double size = tree->size;
    for (int k = 0; k < 3; k++) size = fabs(o[k]) > size ? fabs(o[k]) : size;
    for (int k = 0; k < 3; k++) {
        double up = o[k] + size * WIDER, low = o[k] - size * WIDER;
        bool down = signbit(d[k]);
        w->first[k] = down ? low : up;
        w->last[k] = down ? up : low;
        w->inverse[k] = 1 / d[k];
        w->first_plane[k] = down ? 3 + k : k;
        w->last_plane[k] = down ? k : 3 + k;
    }
    w->most = most;
    w->count = tree->node_count > 0;
    w->stop[0] = (wf_stop){0, 0};
}

/* The boxes that the ray meets, a bit each, and where. What is no number, of a ray along a
 * plane, counts as met. */
static inline unsigned meet_boxes(const wf_tree_node *node, const wf_walk *w, lanes *near) {
    lanes from = of(0), to = of(w->most);
    for (int k = 0; k < 3; k++) {
        lanes a = *(const lanes *)node->plane[w->first_plane[k]];
        lanes b = *(const lanes *)node->plane[w->last_plane[k]];
        from = larger((a - w->first[k]) * w->inverse[k], from);
        to = smaller((b - w->last[k]) * w->inverse[k], to);
    }
    *near = from;
    return not_over(from, to) & node->used;
}

/* Puts what was met behind the stops there are, the nearest last. */
static inline void add_stops(const wf_tree_node *node, unsigned met, const double *near,
                             wf_walk *w) {
    int first = w->count, count = first;
    for (; met; met &= met - 1) {
        int k = __builtin_ctz(met), at = count++;
        for (; at > first && w->stop[at - 1].near < near[k]; at--)
            w->stop[at] = w->stop[at - 1];
        w->stop[at] = (wf_stop){near[k], node->child[k]};
    }
    w->count = count;
}

/* The last of the stops that is near enough. False: none is. */
static inline bool pop(wf_walk *w, wf_stop *stop) {
    int count = w->count;
    while (count > 0) {
        *stop = w->stop[--count];
        if (stop->near > w->most) continue;
        w->count = count;
        return true;
    }
    w->count = 0;
    return false;
}

/* Where one box alone is met, it is gone into at once. */
static bool next(const wf_tree *tree, wf_walk *w, wf_stop *item) {
    wf_stop s;
    if (!pop(w, &s)) return false;
    while (s.what >= 0) {
        const wf_tree_node *node = &tree->nodes[s.what];
        _Alignas(64) double near[WF_TREE_WIDTH];
        unsigned met = meet_boxes(node, w, (lanes *)near);
        if (met && !(met & (met - 1))) {
            int k = __builtin_ctz(met);
            s = (wf_stop){near[k], node->child[k]};
            continue;
        }
        add_stops(node, met, near, w);
        if (!pop(w, &s)) return false;
    }
    *item = s;
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

const wf_walk_ops WF_ISA_TABLE(wf_walk_ops) = {begin, next, find};
