/* Walks of rays and shafts of rays through trees of boxes. */
#include "tracer/rays/walk.h"

#include <math.h>
#include <string.h>

#include "filters/base/isa_file.h"
#include "tracer/rays/lanes.h"

/* ---- Rays ---- */

/* By so much of the numbers' size boxes are wider for a ray: what rounding may do to it on its
 * way into a solid's space is far less, and so is how near to each other ends of runs are one.
 */
#define WIDER 0x1p-38

/* A ray along a plane is on its way across it for longer than anything takes. */
#define SLOWEST 0x1p1000

static void begin_along(double size, const double *o, const double *d, int count,
                        double *less_low, double *less_high, double *inverse) {
    for (int i = 0, n = wf_places(count); i < n; i++) {
        double far = fabs(o[i]) > size ? fabs(o[i]) : size, one = fabs(1 / d[i]);
        less_low[i] = o[i] + far * WIDER;
        less_high[i] = o[i] - far * WIDER;
        inverse[i] = copysign(one < SLOWEST ? one : SLOWEST, d[i]);
    }
}

static void begin(const wf_tree *tree, const wf_rays *r, wf_walk *w) {
    const double *const o[3] = {r->ox, r->oy, r->oz}, *const d[3] = {r->dx, r->dy, r->dz};
    for (int k = 0; k < 3; k++)
        begin_along(tree->size, o[k], d[k], r->count, w->less_low[k], w->less_high[k],
                    w->inverse[k]);
    for (int i = 0, n = wf_places(r->count); i < n; i++)
        w->down[i] =
            (uint8_t)((d[0][i] < 0 ? 1 : 0) | (d[1][i] < 0 ? 2 : 0) | (d[2][i] < 0 ? 4 : 0));
}

/* Where the ray meets each of the boxes, and leaves them. */
static inline void meet_boxes(const wf_tree_node *node, const wf_walk *w, int ray, double most,
                              lanes *near, lanes *far) {
    lanes from = of(0), to = of(most);
    for (int k = 0; k < 3; k++) {
        lanes low = *(const lanes *)node->plane[k], high = *(const lanes *)node->plane[3 + k];
        lanes inverse = of(w->inverse[k][ray]);
        lanes a = (low - of(w->less_low[k][ray])) * inverse;
        lanes b = (high - of(w->less_high[k][ray])) * inverse;
        from = larger(smaller(a, b), from);
        to = smaller(larger(a, b), to);
    }
    *near = from;
    *far = to;
}

/* Puts those children that are met, the nearest last, and returns how many they are; up to
 * WF_TREE_WIDTH places behind are written to. */
#if defined(__AVX512F__) && defined(__AVX512VL__)
static inline int put_met(const wf_tree_node *node, unsigned down, lanes near, lanes far,
                          double *to_near, int32_t *to_child) {
    const __m512i place = _mm512_setr_epi64(7, 6, 5, 4, 3, 2, 1, 0);
    __m512i order = _mm512_xor_si512(place, _mm512_set1_epi64(down));
    far = (lanes)_mm512_mask_mov_pd(_mm512_set1_pd(-1), (__mmask8)node->used, (__m512d)far);
    __m512d a = _mm512_permutexvar_pd(order, (__m512d)near);
    __m512d b = _mm512_permutexvar_pd(order, (__m512d)far);
    __mmask8 met = _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ);
    __m256i child = _mm256_permutexvar_epi32(_mm512_cvtepi64_epi32(order),
                                             _mm256_load_si256((const __m256i *)node->child));
    _mm512_storeu_pd(to_near, _mm512_maskz_compress_pd(met, a));
    _mm256_storeu_si256((__m256i *)to_child, _mm256_maskz_compress_epi32(met, child));
    return __builtin_popcount(met);
}
#else
static inline int put_met(const wf_tree_node *node, unsigned down, lanes near, lanes far,
                          double *to_near, int32_t *to_child) {
    unsigned met = not_over(near, far) & node->used;
    int count = 0;
    for (unsigned k = WF_TREE_WIDTH; met && k-- > 0;) {
        unsigned place = k ^ down;
        if (!(met >> place & 1)) continue;
        to_near[count] = near[place];
        to_child[count++] = node->child[place];
    }
    return count;
}
#endif

/* Trees of so many nodes are larger than a core's own cache. */
#define MANY_NODES 2048

/* Asks memory for the node that a way comes to next, while others take their steps. */
static inline void ask_for(const wf_tree *tree, const int32_t *stop, int stops) {
    int next = stop[stops > 0 ? stops - 1 : 0];
    const char *node = (const char *)&tree->nodes[next > 0 ? next : 0];
    for (size_t n = 0; n < sizeof *tree->nodes; n += 64) __builtin_prefetch(node + n);
}

/* Without a branch between nodes of nodes and nodes of items: there is no telling which comes
 * next. */
static inline int step_one(const wf_tree *tree, const wf_walk *walk, double most, wf_ways *w,
                           int k, int items, wf_met *met) {
    double *stop_near = w->near[w->row[k]];
    int32_t *stop = w->node[w->row[k]];
    int ray = w->ray[k], top = w->stops[k] - 1;
    while (top >= 0 && stop_near[top] > most) top--;
    w->stops[k] = 0;
    if (top < 0) return items;
    const wf_tree_node *node = &tree->nodes[stop[top]];
    bool last = node->child[0] < 0;
    lanes near, far;
    meet_boxes(node, walk, ray, most, &near, &far);
    int found = put_met(node, walk->down[ray], near, far, stop_near + top, stop + top);
    memcpy(met->near + items, stop_near + top, sizeof near);
    memcpy(met->item + items, stop + top, sizeof node->child);
    for (int i = 0; i < WF_TREE_WIDTH; i++) met->ray[items + i] = ray;
    w->stops[k] = top + (found & -!last);
    if (tree->node_count > MANY_NODES) ask_for(tree, stop, w->stops[k]);
    return items + (found & -last);
}

static void step(const wf_tree *tree, const wf_walk *walk, const double *most, wf_ways *ways,
                 wf_met *met) {
    int items = met->count;
    for (int k = 0; k < ways->count; k++)
        items = step_one(tree, walk, most[ways->ray[k]], ways, k, items, met);
    met->count = items;
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

const wf_walk_ops WF_ISA_TABLE(wf_walk_ops) = {begin, step, find};
