/* Walks of single rays through trees of boxes. */
#include "tracer/rays/walk.h"

#include <math.h>

#include "filters/base/isa_file.h"

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

/* By so much of the numbers' size boxes are wider: what rounding may do to a ray on its way
 * into a solid's space is far less, and so is how near to each other ends of runs are one. */
#define SLACK 0x1p-38

/* A ray made ready: along each axis, what is less from a box's first and last plane. */
typedef struct way {
    double first[3], last[3], inverse[3];
    bool down[3];
} way;

static way make_way(const wf_walk_tree *tree, const wf_walk *w) {
    way r;
    double size = tree->size;
    for (int k = 0; k < 3; k++) size = fabs(w->o[k]) > size ? fabs(w->o[k]) : size;
    for (int k = 0; k < 3; k++) {
        double up = w->o[k] + size * SLACK, low = w->o[k] - size * SLACK;
        r.down[k] = signbit(w->d[k]);
        r.first[k] = r.down[k] ? low : up;
        r.last[k] = r.down[k] ? up : low;
        r.inverse[k] = 1 / w->d[k];
    }
    return r;
}

/* Eight boxes side by side, whatever the instruction set makes of them. */
typedef double lanes __attribute__((vector_size(64), may_alias));
typedef int64_t lane_mask __attribute__((vector_size(64), may_alias));

/* Vectors are passed between functions of this file only, which are inlined. */
#pragma GCC diagnostic ignored "-Wpsabi"

static inline lanes choose(lane_mask mask, lanes a, lanes b) {
    return (lanes)(((lane_mask)a & mask) | ((lane_mask)b & ~mask));
}

/* A bit for each lane that the mask has. */
static inline unsigned bits_of(lane_mask mask) {
#if defined(__AVX512F__)
    return _mm512_movepi64_mask((__m512i)mask);
#else
    unsigned bits = 0;
    for (unsigned k = 0; k < WF_WALK_WIDTH; k++) bits |= (unsigned)mask[k] & 1u << k;
    return bits;
#endif
}

/* The boxes that the ray meets, a bit each, and where. What is no number, of a ray along a
 * plane, counts as met. */
static inline unsigned meet_boxes(const wf_walk_node *node, const way *r, double most,
                                  lanes *near) {
    lanes from = {0}, to = most - (lanes){0};
    for (int k = 0; k < 3; k++) {
        const lanes *low = (const lanes *)node->low[k], *high = (const lanes *)node->high[k];
        lanes a = ((r->down[k] ? *high : *low) - r->first[k]) * r->inverse[k];
        lanes b = ((r->down[k] ? *low : *high) - r->last[k]) * r->inverse[k];
        from = choose(a > from, a, from);
        to = choose(b < to, b, to);
    }
    *near = from;
    return bits_of(from <= to);
}

typedef struct stop {
    double near;
    int32_t node;
} stop;

/* Puts what was met behind the stops there are, the nearest last. */
static inline int add_stops(const wf_walk_node *node, unsigned met, lanes near, stop *stops,
                            int count) {
    int first = count;
    for (; met; met &= met - 1) {
        int k = __builtin_ctz(met), at = count++;
        for (; at > first && stops[at - 1].near < near[k]; at--) stops[at] = stops[at - 1];
        stops[at] = (stop){near[k], node->child[k]};
    }
    return count;
}

static bool go(const wf_walk_tree *tree, wf_walk *w) {
    stop stops[WF_WALK_DEPTH * WF_WALK_WIDTH];
    int count = 0;
    if (!tree->node_count) return true;
    way r = make_way(tree, w);
    stops[count++] = (stop){0, 0};
    while (count > 0) {
        stop s = stops[--count];
        lanes near;
        if (s.near > w->most) continue;
        if (s.node < 0) {
            if (!w->meet(w->user, w, ~s.node, s.near)) return false;
            continue;
        }
        const wf_walk_node *node = &tree->nodes[s.node];
        unsigned met = meet_boxes(node, &r, w->most, &near);
        count = add_stops(node, met, near, stops, count);
    }
    return true;
}

const wf_walk_ops WF_ISA_TABLE(wf_walk_ops) = {go};
