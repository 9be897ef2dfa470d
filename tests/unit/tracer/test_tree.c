/* Walks through trees of boxes against a look at every box. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tracer/trace/bounds.h"
#include "tracer/trace/tree.h"

#define MOST 3000

static double draw(uint32_t *seed, double low, double high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (*seed >> 8) * 0x1p-24;
}

/* Boxes of sizes over three decades, some of them flat, some in one place. */
static void make_boxes(wf_bounds *boxes, int count, double size, uint32_t *seed) {
    for (int n = 0; n < count; n++)
        for (int k = 0; k < 3; k++) {
            double at = n % 7 ? draw(seed, -1, 1) : 0.25;
            double half = n % 5 ? pow(10, draw(seed, -4, -1)) : 0;
            boxes[n].low[k] = size * (at - half);
            boxes[n].high[k] = size * (at + half);
        }
}

typedef struct test_ray {
    double o[3], d[3], most;
} test_ray;

/* Where a ray is in a box, by long doubles; false: nowhere from s = 0 on. */
static bool in_box(const test_ray *ray, const wf_bounds *box, long double *from) {
    long double first = 0, last = HUGE_VALL;
    for (int k = 0; k < 3; k++) {
        long double o = ray->o[k], d = ray->d[k];
        long double a = (box->low[k] - o) / d, b = (box->high[k] - o) / d;
        if (d == 0 && (o < box->low[k] || o > box->high[k])) return false;
        if (d == 0) continue;
        first = fmaxl(first, fminl(a, b));
        last = fminl(last, fmaxl(a, b));
    }
    *from = first;
    return first <= last;
}

typedef struct visits {
    int times[MOST];
    double near[MOST];
} visits;

static void go(const wf_tree *tree, const test_ray *r, visits *v) {
    const wf_walk_ops *ops = wf_walk_ops_best();
    static wf_ways ways;
    wf_rays rays = {.count = 1};
    wf_walk walk;
    wf_met met;
    for (int i = 0; i < 8; i++) {
        rays.ox[i] = r->o[0], rays.oy[i] = r->o[1], rays.oz[i] = r->o[2];
        rays.dx[i] = r->d[0], rays.dy[i] = r->d[1], rays.dz[i] = r->d[2];
    }
    ops->begin(tree, &rays, &walk);
    wf_ways_clear(&ways);
    for (wf_ways_add(tree, 0, &ways); ways.stops[0];) {
        met.count = 0;
        ops->step(tree, &walk, &r->most, &ways, &met);
        for (int k = 0; k < met.count; k++) {
            int item = tree->items[~met.item[k]];
            v->times[item]++;
            v->near[item] = met.near[k];
        }
    }
}

/* From inside and outside, along axes and across, through corners of boxes. */
static test_ray make_ray(const wf_bounds *boxes, int count, double size, uint32_t *seed) {
    test_ray ray = {.most = HUGE_VAL};
    const wf_bounds *aim = &boxes[(int)draw(seed, 0, count)];
    for (int k = 0; k < 3; k++) {
        ray.o[k] = size * draw(seed, -3, 3);
        ray.d[k] = draw(seed, 0, 1) < 0.3 ? 0 : aim->high[k] - ray.o[k];
        if (ray.d[k] == 0) ray.o[k] = draw(seed, 0, 1) < 0.5 ? aim->low[k] : ray.o[k];
    }
    if (ray.d[0] == 0 && ray.d[1] == 0 && ray.d[2] == 0) ray.d[2] = 1;
    return ray;
}

static int check_ray(const test_ray *ray, const wf_bounds *boxes, int count, const visits *v) {
    int idle = 0;
    for (int n = 0; n < count; n++) {
        long double from;
        bool met = in_box(ray, &boxes[n], &from);
        if (v->times[n] > 1) fail_msg("box %d is met %d times", n, v->times[n]);
        if (met && !v->times[n]) fail_msg("box %d of %d is missed", n, count);
        if (met && v->near[n] > (double)from) fail_msg("box %d is met before it begins", n);
        idle += v->times[n] && !met;
    }
    return idle;
}

static void rays_meet_what_they_meet(void **state) {
    static const int counts[] = {1, 2, 7, 8, 9, 64, 65, 512, 513, 3000};
    static wf_bounds boxes[MOST];
    static int items[MOST];
    (void)state;
    uint32_t seed = 5;
    int idle = 0, rays = 0;
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        double size = pow(10, draw(&seed, -12, 12));
        make_boxes(boxes, counts[c], size, &seed);
        for (int n = 0; n < counts[c]; n++) items[n] = n;
        wf_tree tree;
        assert_true(wf_tree_new(boxes, items, counts[c], &tree));
        for (int k = 0; k < 200; k++, rays++) {
            visits v = {{0}, {0}};
            test_ray one = make_ray(boxes, counts[c], size, &seed);
            go(&tree, &one, &v);
            idle += check_ray(&one, boxes, counts[c], &v);
        }
        wf_tree_free(&tree);
    }
    printf("boxes met for nothing: %d by %d rays\n", idle, rays);
    assert_true(idle < rays); /* corners are aimed at */
}

static void nothing_is_beyond_most(void **state) {
    wf_bounds boxes[64];
    int items[64];
    wf_tree tree;
    (void)state;
    for (int n = 0; n < 64; n++) {
        boxes[n] = (wf_bounds){{n, -1, -1}, {n + 0.5, 1, 1}};
        items[n] = n;
    }
    assert_true(wf_tree_new(boxes, items, 64, &tree));
    for (int most = 1; most < 64; most++) {
        visits v = {{0}, {0}};
        test_ray one = {.o = {0.75, 0, 0}, .d = {1, 0, 0}, .most = most};
        go(&tree, &one, &v);
        for (int n = 0; n < 64; n++) assert_int_equal(v.times[n], n > 0 && n <= most);
    }
    wf_tree_free(&tree);
}

/* What a ray meets is found for every shaft that holds it. */
static void shafts_find_what_rays_meet(void **state) {
    static wf_bounds boxes[MOST];
    static int items[MOST], found[MOST];
    (void)state;
    uint32_t seed = 9;
    wf_tree tree;
    make_boxes(boxes, MOST, 1, &seed);
    for (int n = 0; n < MOST; n++) items[n] = n;
    assert_true(wf_tree_new(boxes, items, MOST, &tree));
    int64_t all = 0;
    for (int k = 0; k < 300; k++) {
        test_ray ray = make_ray(boxes, MOST, 1, &seed);
        wf_bounds o = {{0}, {0}}, d = o;
        bool seen[MOST] = {false};
        long double from;
        for (int axis = 0; axis < 3; axis++) {
            o.low[axis] = ray.o[axis] - draw(&seed, 0, 0.1);
            o.high[axis] = ray.o[axis] + draw(&seed, 0, 0.1);
            d.low[axis] = ray.d[axis] - draw(&seed, 0, 0.1);
            d.high[axis] = ray.d[axis] + draw(&seed, 0, 0.1);
        }
        wf_shaft shaft = wf_shaft_new(o, d, HUGE_VAL);
        int count = wf_walk_ops_best()->find(&tree, &shaft, MOST, found);
        for (int n = 0; n < count; n++) {
            assert_false(seen[found[n]]);
            seen[found[n]] = true;
        }
        for (int n = 0; n < MOST; n++)
            if (in_box(&ray, &boxes[n], &from) && !seen[n]) fail_msg("box %d is missed", n);
        all += count;
    }
    assert_true(all < 300 * MOST / 2);
    wf_tree_free(&tree);
}

/* A search that is content with few ends soon after them. */
static void few_are_enough(void **state) {
    static wf_bounds boxes[MOST];
    static int items[MOST], found[MOST];
    (void)state;
    uint32_t seed = 2;
    wf_tree tree;
    make_boxes(boxes, MOST, 1, &seed);
    for (int n = 0; n < MOST; n++) items[n] = n;
    assert_true(wf_tree_new(boxes, items, MOST, &tree));
    wf_shaft all = wf_shaft_new((wf_bounds){{-2, -2, -2}, {2, 2, 2}},
                                (wf_bounds){{-1, -1, -1}, {1, 1, 1}}, HUGE_VAL);
    assert_int_equal(wf_walk_ops_best()->find(&tree, &all, MOST, found), MOST);
    int count = wf_walk_ops_best()->find(&tree, &all, 40, found);
    assert_true(count > 40 && count <= 48);
    wf_tree_free(&tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_what_they_meet),
        cmocka_unit_test(nothing_is_beyond_most),
        cmocka_unit_test(shafts_find_what_rays_meet),
        cmocka_unit_test(few_are_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
