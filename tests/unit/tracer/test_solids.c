/* Rays against canonical solids: runs against the inequality that defines the solid, at points
 * all along the ray, in long double; normals against its slope; every instruction set alike. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "tracer/rays/solid.h"

static const wf_plane faces[] = {{{1, 0, 0}, 1},      {{-1, 0, 0}, 1}, {{0, 1, 0}, 1},
                                 {{0, -1, 0}, 1},     {{0, 0, 1}, 1},  {{0, 0, -1}, 1},
                                 {{0.6, 0.8, 0}, 0.9}};

static const wf_solid solids[] = {
    {.kind = WF_SPHERE},
    {.kind = WF_BOX},
    {.kind = WF_CYLINDER},
    {.kind = WF_CONE, .shape = {1, 0}},
    {.kind = WF_CONE, .shape = {0.25, 1}},
    {.kind = WF_CONE, .shape = {1, 1}},
    {.kind = WF_CONE, .shape = {1, 1 - 1e-9}},
    {.kind = WF_TORUS, .shape = {0.25}},
    {.kind = WF_TORUS, .shape = {0.999999}},
    {.kind = WF_TORUS, .shape = {1.5}},
    {.kind = WF_TORUS, .shape = {0.01}},
    {.kind = WF_HALFSPACE},
    {.kind = WF_QUADRIC, .shape = {1, 2, 3, 0, 0, 0, 0, 0, 0, -1}},     /* ellipsoid */
    {.kind = WF_QUADRIC, .shape = {1, -1, 1, 0, 0, 0, 0, 0, 0, -0.25}}, /* hyperboloid */
    {.kind = WF_QUADRIC, .shape = {1, -1, 1, 0, 0, 0, 0, 0, 0, 0.25}},  /* of two sheets */
    {.kind = WF_QUADRIC, .shape = {1, 0, 1, 0, 0, 0, 0, -1, 0, 0}},     /* paraboloid */
    {.kind = WF_QUADRIC, .shape = {0, 0, 0, 0, 0, 0, 1, 2, 3, -0.5}},   /* plane */
    {.kind = WF_QUADRIC, .shape = {1, 0.5, 0.7, 0.3, 0.2, 0.1, -0.2, 0.4, 0.3, -0.6}},
    {.kind = WF_POLYHEDRON, .first_plane = 0, .plane_count = 7},
};
#define SOLIDS (sizeof solids / sizeof *solids)

static uint32_t draw(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static double uniform(uint32_t *state, double low, double high) {
    return low + (high - low) * draw(state) / 16777216.0;
}

/* Rays that aim near the solid from inside, near and far, some along an axis. */
static void aim(wf_rays *r, uint32_t *seed, double distance) {
    r->count = WF_PACKET;
    for (int i = 0; i < WF_PACKET; i++) {
        double target[3], from[3];
        for (int k = 0; k < 3; k++) {
            target[k] = uniform(seed, -1.3, 1.3);
            from[k] = i % 4 == 0 ? uniform(seed, -1, 1) : uniform(seed, -1, 1) * distance;
        }
        if (i % 8 == 1) from[0] = target[0], from[1] = target[1];
        if (i % 8 == 2) from[2] = target[2];
        r->ox[i] = from[0], r->oy[i] = from[1], r->oz[i] = from[2];
        r->dx[i] = target[0] - from[0], r->dy[i] = target[1] - from[1],
        r->dz[i] = target[2] - from[2];
    }
}

/* Below zero inside, in long double, with a slope of about 1 near the surface. */
static long double signed_value(const wf_solid *s, const long double p[3]) {
    long double x = p[0], y = p[1], z = p[2], across = sqrtl(x * x + z * z), worst = -1e9L;
    const double *q = s->shape;
    switch (s->kind) {
    case WF_SPHERE:
        return sqrtl(x * x + y * y + z * z) - 1;
    case WF_BOX:
        return fmaxl(fabsl(x), fmaxl(fabsl(y), fabsl(z))) - 1;
    case WF_CYLINDER:
        return fmaxl(across, fabsl(y)) - 1;
    case WF_CONE:
        return fmaxl(across - ((q[1] + q[0]) / 2 + (q[1] - q[0]) / 2 * y), fabsl(y) - 1);
    case WF_TORUS:
        return sqrtl((across - 1) * (across - 1) + y * y) - q[0];
    case WF_HALFSPACE:
        return y;
    case WF_QUADRIC:
        return q[0] * x * x + q[1] * y * y + q[2] * z * z + q[3] * x * y + q[4] * y * z +
               q[5] * z * x + q[6] * x + q[7] * y + q[8] * z + q[9];
    default:
        for (int k = 0; k < s->plane_count; k++) {
            const wf_plane *f = &faces[s->first_plane + k];
            worst = fmaxl(worst, f->n[0] * x + f->n[1] * y + f->n[2] * z - f->d);
        }
        return worst;
    }
}

static void point_at(const wf_rays *r, int i, long double s, long double p[3]) {
    p[0] = r->ox[i] + s * r->dx[i], p[1] = r->oy[i] + s * r->dy[i],
    p[2] = r->oz[i] + s * r->dz[i];
}

static bool in_runs(const wf_runs *runs, int i, double s) {
    return (s > runs->in[0][i] && s < runs->out[0][i]) ||
           (s > runs->in[1][i] && s < runs->out[1][i]);
}

static void find_runs(const wf_solid *s, const wf_rays *r, wf_runs *runs,
                      wf_intersect_fn *const *by) {
    for (int i = 0; i < WF_PACKET; i++) runs->in[1][i] = HUGE_VAL, runs->out[1][i] = -HUGE_VAL;
    by[s->kind](s, faces, r, runs);
}

/* Points off the surface by more than rounding allows are in a run just when they are inside.
 */
static void check_ray(size_t which, const wf_rays *r, const wf_runs *runs, int i,
                      double slack) {
    const wf_solid *s = &solids[which];
    for (int k = -50; k <= 150; k++) {
        double at =
            1 + (k - 50) * 0.02 /
                    sqrt(r->dx[i] * r->dx[i] + r->dy[i] * r->dy[i] + r->dz[i] * r->dz[i]);
        long double p[3];
        point_at(r, i, at, p);
        long double value = signed_value(s, p);
        if (fabsl(value) > (long double)slack && (value < 0) != in_runs(runs, i, at))
            fail_msg("solid %zu (%s), ray %d at %g: value %Lg, runs %g..%g %g..%g", which,
                     wf_solid_type_of(s->kind)->name, i, at, value, runs->in[0][i],
                     runs->out[0][i], runs->in[1][i], runs->out[1][i]);
    }
}

/* Ends of runs lie on the surface. */
static void check_ends(size_t which, const wf_rays *r, const wf_runs *runs, int i,
                       double slack) {
    const wf_solid *s = &solids[which];
    for (int k = 0; k < 4; k++) {
        double at = k % 2 ? runs->out[k / 2][i] : runs->in[k / 2][i];
        long double p[3];
        if (isnan(at)) fail_msg("solid %zu, ray %d: an end is NaN", which, i);
        if (isinf(at)) continue;
        point_at(r, i, at, p);
        if (fabsl(p[0]) > 100 || fabsl(p[1]) > 100 || fabsl(p[2]) > 100) continue;
        long double value = signed_value(s, p);
        if (!(fabsl(value) <= (long double)slack))
            fail_msg("solid %zu (%s), ray %d: an end at %g lies %Lg off the surface", which,
                     wf_solid_type_of(s->kind)->name, i, at, value);
    }
}

static void runs_are_the_solid(void **state) {
    (void)state;
    static const double distances[] = {3, 100, 1e6};
    for (size_t w = 0; w < SOLIDS; w++)
        for (int d = 0; d < 3; d++) {
            uint32_t seed = (uint32_t)(100 * w) + (uint32_t)d;
            /* Rounding of the ray itself, at the distance it comes from; a torus's quartic
             * squares distances of the order of its tube. */
            double slack = 2e-13 * (1 + distances[d] / 100);
            if (solids[w].kind == WF_TORUS) slack = slack * 20 / solids[w].shape[0];
            for (int round = 0; round < 40; round++) {
                wf_rays r;
                wf_runs runs;
                aim(&r, &seed, distances[d]);
                find_runs(&solids[w], &r, &runs, wf_solid_ops_best()->intersect);
                for (int i = 0; i < WF_PACKET; i++) {
                    check_ends(w, &r, &runs, i, 20 * slack);
                    check_ray(w, &r, &runs, i, 1e5 * slack);
                }
            }
        }
}

static void every_level_has_the_same_bits(void **state) {
    (void)state;
    for (size_t w = 0; w < SOLIDS; w++)
        for (uint32_t seed = 1; seed < 20; seed++) {
            wf_rays r;
            wf_runs first, other;
            uint32_t state_of = seed;
            aim(&r, &state_of, 10);
            find_runs(&solids[w], &r, &first, wf_solid_ops_at(0)->intersect);
            for (size_t level = 1; wf_solid_ops_at(level); level++) {
                find_runs(&solids[w], &r, &other, wf_solid_ops_at(level)->intersect);
                assert_memory_equal(&first, &other, sizeof first);
            }
        }
}

/* Directions of any length: the parameter scales by a power of two, bit for bit. */
static void directions_of_any_length(void **state) {
    (void)state;
    for (size_t w = 0; w < SOLIDS; w++)
        for (int k = -40; k <= 40; k += 16) {
            wf_rays r, scaled;
            wf_runs runs, other;
            uint32_t seed = 9;
            aim(&r, &seed, 5);
            scaled = r;
            for (int i = 0; i < WF_PACKET; i++) {
                scaled.dx[i] = ldexp(r.dx[i], k);
                scaled.dy[i] = ldexp(r.dy[i], k);
                scaled.dz[i] = ldexp(r.dz[i], k);
            }
            find_runs(&solids[w], &r, &runs, wf_solid_ops_best()->intersect);
            find_runs(&solids[w], &scaled, &other, wf_solid_ops_best()->intersect);
            for (int i = 0; i < WF_PACKET; i++) {
                assert_true(other.in[0][i] == ldexp(runs.in[0][i], -k));
                assert_true(other.out[0][i] == ldexp(runs.out[0][i], -k));
            }
        }
}

/* Bounds hold what is inside by the inequality. */
static void points(void **state) {
    (void)state;
    uint32_t seed = 4;
    for (size_t w = 0; w < SOLIDS; w++)
        for (int n = 0; n < 3000; n++) {
            const wf_solid *s = &solids[w];
            const wf_solid_type *type = wf_solid_type_of(s->kind);
            wf_vec p = {uniform(&seed, -2.5, 2.5), uniform(&seed, -1.6, 1.6),
                        uniform(&seed, -2.5, 2.5)};
            long double at[3] = {p.x, p.y, p.z}, value = signed_value(s, at);
            wf_bounds b = type->bounds(s, faces);
            bool inside = value < -1e-12L;
            const double c[3] = {p.x, p.y, p.z};
            for (int k = 0; k < 3; k++)
                assert_true(!inside || (c[k] >= b.low[k] && c[k] <= b.high[k]));
        }
}

static wf_vec normal_at(const wf_solid *s, wf_vec p) {
    wf_points at, n;
    for (int i = 0; i < WF_PACKET; i++) at.x[i] = p.x, at.y[i] = p.y, at.z[i] = p.z;
    wf_solid_ops_best()->normals[s->kind](s, faces, &at, WF_PACKET, &n);
    for (size_t level = 0; wf_solid_ops_at(level); level++) {
        wf_points other;
        wf_solid_ops_at(level)->normals[s->kind](s, faces, &at, WF_PACKET, &other);
        assert_memory_equal(&other, &n, sizeof n);
    }
    return (wf_vec){n.x[9], n.y[9], n.z[9]};
}

static void normals(void **state) {
    (void)state;
    for (size_t w = 0; w < SOLIDS; w++) {
        uint32_t seed = 77;
        const wf_solid *s = &solids[w];
        wf_rays r;
        wf_runs runs;
        aim(&r, &seed, 4);
        find_runs(s, &r, &runs, wf_solid_ops_best()->intersect);
        for (int i = 0; i < WF_PACKET; i++) {
            long double p[3], up[3], length = 0, along = 0;
            if (isinf(runs.in[0][i])) continue;
            point_at(&r, i, runs.in[0][i], p);
            wf_vec n = normal_at(s, (wf_vec){(double)p[0], (double)p[1], (double)p[2]});
            const double normal[3] = {n.x, n.y, n.z};
            double size = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
            assert_true(size > 0 && isfinite(size));
            for (int k = 0; k < 3; k++) {
                long double a[3] = {p[0], p[1], p[2]}, b[3] = {p[0], p[1], p[2]};
                a[k] -= 1e-7L, b[k] += 1e-7L;
                up[k] = signed_value(s, b) - signed_value(s, a);
                length += up[k] * up[k];
                along += up[k] * normal[k] / size;
            }
            /* An edge has no slope to speak of. */
            if (along < 0.999999L * sqrtl(length) && along < 0.6L * sqrtl(length))
                fail_msg("solid %zu, ray %d: the normal is %Lg along the slope", w, i,
                         along / sqrtl(length));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_are_the_solid),
        cmocka_unit_test(every_level_has_the_same_bits),
        cmocka_unit_test(directions_of_any_length),
        cmocka_unit_test(points),
        cmocka_unit_test(normals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
