/* Operators at instants: closed forms, inverses, and angles at frame 10^7. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#include "tracer/scene/motion.h"

#define PI 3.14159265358979323846

static void expect(wf_vec a, double x, double y, double z, double tolerance) {
    if (fabs(a.x - x) > tolerance || fabs(a.y - y) > tolerance || fabs(a.z - z) > tolerance)
        fail_msg("%.17g %.17g %.17g, should be %.17g %.17g %.17g", a.x, a.y, a.z, x, y, z);
}

static wf_op spin(double rpm, wf_vec axis, wf_vec center) {
    return (wf_op){.kind = WF_OP_SPIN,
                   .outer = -1,
                   .axis = axis,
                   .center = center,
                   .turns_a_second_num = rpm,
                   .turns_a_second_den = 60};
}

/* A quarter turn about y takes z to x. */
static void quarter_turns(void **state) {
    (void)state;
    wf_op ops[] = {spin(15, (wf_vec){0, 1, 0}, (wf_vec){0, 0, 0}),
                   spin(15, (wf_vec){0, 0, 1}, (wf_vec){2, 0, 0})};
    wf_scene scene = {.ops = ops, .op_count = 2};
    wf_ready_op about_y = wf_op_ready(&scene, 0, (wf_rational){0, 1});
    wf_ready_op about_z = wf_op_ready(&scene, 1, (wf_rational){1, 1});
    wf_affine a = wf_op_at(&about_y, 1), b = wf_op_at(&about_z, 0);
    expect(wf_apply(&a, (wf_vec){0, 0, 1}), 1, 0, 0, 1e-15);
    expect(wf_apply(&b, (wf_vec){3, 0, 0}), 2, 1, 0, 1e-15);
}

/* 10 rpm at frame n of 60000/1001 is n 1001 / 360000 turns: its fraction in whole numbers. */
static void angles_far_from_zero(void **state) {
    (void)state;
    wf_op op = spin(10, (wf_vec){0, 0, 1}, (wf_vec){0, 0, 0});
    wf_scene scene = {.ops = &op, .op_count = 1};
    const int64_t frames[] = {0, 1, 359, 10000000, 10000001, 123456789};
    for (int i = 0; i < 6; i++) {
        int64_t n = frames[i];
        wf_ready_op ready = wf_op_ready(&scene, 0, wf_ratio(1001 * n, 60000));
        wf_affine a = wf_op_at(&ready, 0);
        double angle = 2 * PI * (double)(n * 1001 % 360000) / 360000;
        wf_vec p = wf_apply(&a, (wf_vec){1, 0, 0});
        expect(p, cos(angle), sin(angle), 0, 2e-15);
        double off = remainder(atan2(p.y, p.x) - angle, 2 * PI);
        assert_true(fabs(off) <= 1e-9);
    }
}

static void velocity_and_keys(void **state) {
    (void)state;
    const double half = sqrt(0.5);
    wf_key keys[] = {{1, {0, 0, 0}, {1, 0, 0, 0}}, {3, {4, 0, 2}, {half, 0, half, 0}}};
    wf_op ops[] = {{.kind = WF_OP_VELOCITY, .outer = -1, .velocity = {1, -2, 3}},
                   {.kind = WF_OP_KEYS, .outer = -1, .first_key = 0, .key_count = 2}};
    wf_scene scene = {.ops = ops, .op_count = 2, .keys = keys, .key_count = 2};
    wf_ready_op v = wf_op_ready(&scene, 0, (wf_rational){5, 2}),
                k = wf_op_ready(&scene, 1, (wf_rational){2, 1});
    wf_affine a = wf_op_at(&v, 0.5), before = wf_op_at(&k, -5), mid = wf_op_at(&k, 0),
              after = wf_op_at(&k, 9);
    expect(wf_apply(&a, (wf_vec){1, 1, 1}), 4, -5, 10, 0);
    expect(wf_apply(&before, (wf_vec){0, 0, 1}), 0, 0, 1, 0);
    expect(wf_apply(&mid, (wf_vec){0, 0, 1}), 2 + half, 0, 1 + half,
           1e-15); /* turned by 45 degrees */
    expect(wf_apply(&after, (wf_vec){0, 0, 1}), 5, 0, 2, 1e-15);
}

static void inverses(void **state) {
    (void)state;
    const double half = sqrt(0.5);
    wf_key keys[] = {{0, {0, 1, 0}, {1, 0, 0, 0}}, {1, {4, 0, 2}, {half, half, 0, 0}}};
    wf_op ops[] = {spin(33, (wf_vec){0.6, 0, 0.8}, (wf_vec){1, 2, 3}),
                   {.kind = WF_OP_VELOCITY, .outer = -1, .velocity = {1, -2, 3}},
                   {.kind = WF_OP_KEYS, .outer = -1, .key_count = 2},
                   {.kind = WF_OP_PLACE,
                    .outer = -1,
                    .place = {.m = {{2, 0.5, 0}, {0, 3, 1}, {-1, 0, 0.25}}, .d = {7, 8, 9}}}};
    wf_scene scene = {.ops = ops, .op_count = 4, .keys = keys, .key_count = 2};
    for (int i = 0; i < 4; i++)
        for (double dt = -1; dt <= 1; dt += 0.125) {
            wf_ready_op ready = wf_op_ready(&scene, i, (wf_rational){1, 3});
            wf_affine out = wf_op_at(&ready, dt), in = wf_op_inverse_at(&ready, dt),
                      both = wf_compose(&in, &out);
            wf_vec p = {0.3, -0.7, 1.9};
            expect(wf_apply(&both, p), p.x, p.y, p.z, 2e-14);
            wf_vec there = wf_apply(&out, p);
            expect(wf_apply(&in, there), p.x, p.y, p.z, 2e-14);
        }
}

/* Normals stay square to the surface under any map. */
static void normals_turn_with_the_surface(void **state) {
    (void)state;
    wf_affine a = {.m = {{2, 0.5, 0}, {0, 3, 1}, {-1, 0, 0.25}}, .d = {7, 8, 9}}, inverse;
    assert_true(wf_invert(&a, &inverse));
    wf_vec n = {inverse.m[2][0], inverse.m[2][1], inverse.m[2][2]};
    wf_vec u = wf_turn(&a, (wf_vec){1, 0, 0}), v = wf_turn(&a, (wf_vec){0, 1, 0});
    assert_true(fabs(n.x * u.x + n.y * u.y + n.z * u.z) < 1e-15);
    assert_true(fabs(n.x * v.x + n.y * v.y + n.z * v.z) < 1e-15);
    wf_affine flat = {.m = {{1, 2, 3}, {2, 4, 6}, {0, 0, 1}}};
    assert_false(wf_invert(&flat, &inverse));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quarter_turns),
        cmocka_unit_test(angles_far_from_zero),
        cmocka_unit_test(velocity_and_keys),
        cmocka_unit_test(inverses),
        cmocka_unit_test(normals_turn_with_the_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
