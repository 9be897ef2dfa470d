/* What is hard on the tracer's numbers: tangents, thin gaps, extreme shapes, large and small
 * scenes, places and times far away. Prints how far each holds. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "filters/base/quad.h"
#include "tests/unit/support/scene_fields.h"
#include "tests/unit/support/sizes.h"
#include "tracer/rays/solid.h"

#define WIDTH  64
#define LINES  48
#define RASTER "64x48@30i,tff,par=1:1"
#define ORTHO  "camera{eye={0, 0, 100}, look_at={0, 0, 0}, ortho_height=raster.lines}\n"
#define WHITE  ":material{unlit=true, color=1}"

typedef wf_quad quad;

static uint32_t draw(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static double uniform(uint32_t *state, double low, double high) {
    return low + (high - low) * draw(state) / 16777216.0;
}

static scene_job job_of(const char *text, int count) {
    return (scene_job){.text = text,
                       .raster = RASTER,
                       .aperture = "line",
                       .width = {1, 2},
                       .sampler = WF_SAMPLER_SOBOL,
                       .count = count};
}

static double mean_of(const scene_job *job) {
    float *frame = scene_frame(job, 0);
    double sum = 0;
    for (int k = 0; k < 3 * WIDTH * LINES; k++) sum += (double)frame[k];
    free(frame);
    return sum / (3 * WIDTH * LINES);
}

/* ---- Tangents ---- */

/* A round solid's side, x^2 + z^2 + round y^2 = (a + b y)^2. */
typedef struct side {
    wf_solid solid;
    double round, a, b;
} side;

/* A ray through a point off the side by a share of its size, at right angles to the normal. */
static void pass(const side *s, wf_rays *r, int i, double off, uint32_t *seed) {
    double turn = uniform(seed, 0, 6.3), c = cos(turn), z = sin(turn);
    double y = uniform(seed, -0.9, 0.9),
           across = sqrt(pow(s->a + s->b * y, 2) - s->round * y * y);
    double slope = uniform(seed, -2, 2), back = uniform(seed, 0, 4);
    double n[3] = {across * c, s->round * y - (s->a + s->b * y) * s->b, across * z};
    double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) n[k] /= size;
    double d[3] = {-z, 0, c};
    double e[3] = {n[1] * d[2] - n[2] * d[1], n[2] * d[0] - n[0] * d[2],
                   n[0] * d[1] - n[1] * d[0]};
    for (int k = 0; k < 3; k++) d[k] += slope * e[k];
    r->ox[i] = across * c + off * n[0] - back * d[0];
    r->oy[i] = y + off * n[1] - back * d[1];
    r->oz[i] = across * z + off * n[2] - back * d[2];
    r->dx[i] = d[0], r->dy[i] = d[1], r->dz[i] = d[2];
}

/* How far inside the ray gets: the discriminant, of lengths squared; in 113 bits. */
static quad depth_of(const side *s, const wf_rays *r, int i) {
    quad o[3] = {r->ox[i], r->oy[i], r->oz[i]}, d[3] = {r->dx[i], r->dy[i], r->dz[i]};
    quad at = s->a + s->b * o[1], to = s->b * d[1];
    quad q2 = d[0] * d[0] + d[2] * d[2] + s->round * d[1] * d[1] - to * to;
    quad q1 = o[0] * d[0] + o[2] * d[2] + s->round * o[1] * d[1] - at * to;
    quad q0 = o[0] * o[0] + o[2] * o[2] + s->round * o[1] * o[1] - at * at;
    return q1 * q1 / q2 - q0;
}

/* Hits and misses are those of the rays as they are. */
static void tangents(void **state) {
    static const side sides[] = {
        {{.kind = WF_SPHERE}, 1, 1, 0},
        {{.kind = WF_CYLINDER}, 0, 1, 0},
        {{.kind = WF_CONE, .shape = {1, 0.25}}, 0, 0.625, -0.375},
    };
    (void)state;
    for (int k = 0; k < 3; k++) {
        const side *s = &sides[k];
        int wrong = 0, rays = 0;
        double worst = 0, nearest = 1;
        uint32_t seed = 5;
        for (int round = 0; round < 4000; round += test_step(10)) {
            wf_rays r = {.count = WF_PACKET};
            wf_runs runs;
            for (int i = 0; i < WF_PACKET; i++)
                pass(s, &r, i, ldexp(uniform(&seed, -1, 1), -(int)uniform(&seed, 20, 54)),
                     &seed);
            wf_solid_ops_best()->intersect[s->solid.kind](&s->solid, NULL, &r, &runs);
            for (int i = 0; i < WF_PACKET; i++, rays++) {
                quad depth = depth_of(s, &r, i);
                nearest = fmin(nearest, fabs((double)depth));
                if ((depth > 0) == (runs.in[0][i] < runs.out[0][i])) continue;
                wrong++;
                worst = fmax(worst, fabs((double)depth));
            }
        }
        print_message("%s: of %d tangent rays, the nearest %.2g off, %d are on the wrong side, "
                      "by %.2g at most\n",
                      wf_solid_type_of(s->solid.kind)->name, rays, nearest, wrong, worst);
        assert_true(wrong == 0);
    }
}

/* ---- Gaps ---- */

/* What two boxes a few roundings apart have in common is nothing, for any ray. */
static void gaps(void **state) {
    (void)state;
    for (int ulps = 1; ulps <= 64; ulps *= 4)
        for (int places = 0; places < 3; places++) {
            double at = (double[]){1, 3.7, 1234.5}[places], next = at;
            char text[1024];
            for (int n = 0; n < ulps; n++) next = nextafter(next, HUGE_VAL);
            snprintf(text, sizeof text,
                     "camera{eye={%.17g, 0, 100}, look_at={%.17g, 0, 0}, ortho_height=4}\n"
                     "local a = box{min={%.17g, -1, -1}, max={%.17g, 1, 1}}\n"
                     "local b = box{min={%.17g, -1, -1}, max={%.17g, 1, 1}}\n"
                     "add((a * b)" WHITE ")\n",
                     at, at, at - 1, at, next, at + 1);
            scene_job job = job_of(text, 64);
            assert_true(mean_of(&job) == 0);
        }
    print_message("gaps of 1 to 64 ulp: nothing is seen in %d samples each\n",
                  64 * WIDTH * LINES);
}

/* ---- Shapes ---- */

/* Stretched a million times, solids cover bands and wedges of known area. */
static void needles_and_plates(void **state) {
    static const struct {
        const char *text;
        double area; /* of the picture */
    } shapes[] = {
        {"sphere{radius=1}:scale{1e6, 12, 1}", 24.0 / LINES},
        {"sphere{radius=1}:scale{20, 10, 1e-6}", M_PI * 20 * 10 / (WIDTH * LINES)},
        {"ellipsoid{radii={20, 10, 2e-5}}", M_PI * 20 * 10 / (WIDTH * LINES)},
        {"ellipsoid{radii={1e7, 10, 10}}", 20.0 / LINES},
        {"cone{from={-32, 0, 0}, to={6399968, 0, 0}, radii={12, 0}}", 24.0 / LINES},
        {"cone{from={0, -20, 0}, to={0, 20, 0}, radii={1e-5, 0}}", 0},
        {"cylinder{from={0, -1e6, 0}, to={0, 1e6, 0}, radius=16}", 0.5},
        {"torus{axis={0, 0, 1}, major=15, minor=1.5e-5}",
         2 * M_PI * 15 * 3e-5 / (WIDTH * LINES)},
        {"torus{axis={0, 0, 1}, major=10.00001, minor=10}", M_PI * 20 * 20 / (WIDTH * LINES)},
    };
    (void)state;
    for (size_t n = 0; n < sizeof shapes / sizeof *shapes; n++) {
        char text[512];
        snprintf(text, sizeof text, ORTHO "add(%s" WHITE ")\n", shapes[n].text);
        scene_job job = job_of(text, 1024);
        double mean = mean_of(&job), off = fabs(mean - shapes[n].area);
        print_message("%-56s covers %.6f, off by %.1g\n", shapes[n].text, mean, off);
        assert_true(off <= 2e-5);
    }
}

/* (|(x, z)| - 1)^2 + y^2 - r^2 of a torus, and its slope there, which is 2 r on the surface. */
static quad torus_at(const wf_rays *r, int i, double s, double minor) {
    quad at = s, x = r->ox[i] + at * r->dx[i], y = r->oy[i] + at * r->dy[i];
    quad z = r->oz[i] + at * r->dz[i], m = minor, sum = x * x + y * y + z * z + 1 - m * m;
    /* The quartic over 4 of its near factor: no root to be taken in 113 bits. */
    return (sum * sum - 4 * (x * x + z * z)) / 4;
}

/* Ends of runs lie on tori from nearly closed to a million times thinner than wide. */
static void tori(void **state) {
    static const double minors[] = {1 / (1 + 1e-6), 0.5, 1e-2, 1e-4, 1e-6};
    (void)state;
    for (size_t n = 0; n < sizeof minors / sizeof *minors; n++) {
        const wf_solid torus = {.kind = WF_TORUS, .shape = {minors[n]}};
        uint32_t seed = 3;
        double worst = 0;
        int found = 0;
        const int rounds = 300 / test_step(10);
        for (int round = 0; round < rounds; round++) {
            wf_rays r = {.count = WF_PACKET};
            wf_runs runs;
            for (int i = 0; i < WF_PACKET; i++) {
                double turn = uniform(&seed, 0, 6.3), about = uniform(&seed, 0, 6.3);
                double out = 1 + 0.9 * minors[n] * cos(about);
                double p[3] = {out * cos(turn), 0.9 * minors[n] * sin(about), out * sin(turn)};
                r.ox[i] = uniform(&seed, -4, 4), r.oy[i] = uniform(&seed, 1, 4),
                r.oz[i] = uniform(&seed, -4, 4);
                r.dx[i] = p[0] - r.ox[i], r.dy[i] = p[1] - r.oy[i], r.dz[i] = p[2] - r.oz[i];
            }
            wf_solid_ops_best()->intersect[WF_TORUS](&torus, NULL, &r, &runs);
            for (int i = 0; i < WF_PACKET; i++)
                for (int k = 0; k < 4; k++) {
                    double s = k % 2 ? runs.out[k / 2][i] : runs.in[k / 2][i];
                    if (isinf(s)) continue;
                    double off = fabs((double)torus_at(&r, i, s, minors[n])) / (2 * minors[n]);
                    worst = fmax(worst, off);
                    found++;
                }
        }
        print_message("torus of R/r %-10.7g: %d ends, at most %.2g off the surface\n",
                      1 / minors[n], found, worst);
        /* Every ray was aimed at the tube. */
        assert_true(found >= 2 * rounds * WF_PACKET);
        assert_true(worst <= 3e-15 + 3e-16 / minors[n]);
    }
}

/* ---- Large, small, far, late ---- */

static void write_scaled(char *text, size_t size, double s) {
    snprintf(text, size,
             "camera{eye={0, %.17g, %.17g}, look_at={0, %.17g, 0}}\n"
             "light{point={%.17g, %.17g, %.17g}}\n"
             "add(halfspace{normal={0, 1, 0}}:material{texture=checker{1, 0.2, size=%.17g}})\n"
             "local a = box{min={%.17g, 0, %.17g}, max={%.17g, %.17g, %.17g}}\n"
             "add((a - sphere{center={0, %.17g, 0}, radius=%.17g}):spin{rpm=60})\n"
             "add(torus{center={0, %.17g, 0}, major=%.17g, minor=%.17g})\n",
             3 * s, 9 * s, s, 5 * s, 9 * s, 6 * s, s, -s, -s, s, 2 * s, s, s, 1.25 * s, 2.5 * s,
             0.75 * s, 0.25 * s);
}

/* In other units of length, up to 10^8 times larger or smaller, a picture is the same. */
static void powers_of_ten(void **state) {
    char one[2048], other[2048];
    double worst = 0;
    (void)state;
    write_scaled(one, sizeof one, 1);
    scene_job a = job_of(one, 16);
    float *p = scene_frame(&a, 0);
    for (int k = -8; k <= 8; k++) {
        double sum = 0;
        write_scaled(other, sizeof other, pow(10, k));
        scene_job b = job_of(other, 16);
        float *q = scene_frame(&b, 0);
        for (int n = 0; n < 3 * WIDTH * LINES; n++)
            sum += ((double)p[n] - (double)q[n]) * ((double)p[n] - (double)q[n]);
        worst = fmax(worst, sqrt(sum / (3 * WIDTH * LINES)));
        free(q);
    }
    print_message("10^-8 to 10^8: RMSE %.2g at most\n", worst);
    assert_true(worst <= 1e-6);
    free(p);
}

/* A closed box far from the origin: no ray gets out between its walls. */
static void far_boxes(void **state) {
    const char *text =
        "local o = {148376, 1234, -223423}\n"
        "camera{eye={o[1] + 0.3, o[2] + 0.2, o[3] + 0.1}, look_at={o[1] - 1, o[2] - 1, o[3] - "
        "1},\n"
        "       fov=120}\n"
        "local function wall(a, b) add(box{min=a, max=b}:translate(o)" WHITE ") end\n"
        "wall({-2, -2, -2}, {-1, 2, 2}) wall({1, -2, -2}, {2, 2, 2})\n"
        "wall({-1, -2, -2}, {1, -1, 2}) wall({-1, 1, -2}, {1, 2, 2})\n"
        "wall({-1, -1, -2}, {1, 1, -1}) wall({-1, -1, 1}, {1, 1, 2})\n";
    scene_job job = job_of(text, 1024);
    (void)state;
    double lost = (1 - mean_of(&job)) * 1024 * WIDTH * LINES;
    print_message("of %d rays in a box at (148376, 1234, -223423) %.2g are lost\n",
                  1024 * WIDTH * LINES, lost);
    assert_true(lost == 0);
}

/* A wheel at 180 rpm has made 1,001,000 turns by frame 10^7 of 30000/1001. */
static void late_frames(void **state) {
    const char *text = ORTHO
        "add(box{min={-20, -2, -1}, max={20, 2, 1}}:spin{axis={0, 0, 1}, rpm=180}" WHITE ")\n";
    scene_job job = job_of(text, 16);
    job.raster = "64x48@30000/1001i,tff,par=1:1";
    job.sampler = WF_SAMPLER_GRID;
    (void)state;
    float *first = scene_field(&job, 0), *late = scene_field(&job, 20000000);
    double worst = 0;
    for (int n = 0; n < 3 * WIDTH * LINES / 2; n++)
        worst = fmax(worst, fabs((double)first[n] - (double)late[n]));
    print_message("frame 10^7 differs from frame 0 by %.2g\n", worst);
    assert_true(worst <= 1e-6);
    free(first);
    free(late);
}

/* ---- Rays along planes ---- */

/* Half-spaces whose faces no ray meets, however they are turned: what one takes away is what is
 * left of its complement, to the bit. */
static void along_planes(void **state) {
    (void)state;
    int differ = 0;
    for (int k = 0; k < 24; k++) {
        double turn = 0.1 + 0.26 * k, x = cos(turn), y = sin(turn);
        char taken[1024], left[1024];
        const char *shape =
            ORTHO "local function side(x, y, at) return halfspace{normal={x, y, 0}, offset=at} "
                  "end\n"
                  "add(((side(%.17g, %.17g, 11.3) %s side(%.17g, %.17g, %.17g)) *\n"
                  "     halfspace{normal={0, 0, 1}})" WHITE ")";
        snprintf(taken, sizeof taken, shape, x, y, "-", x, y, 2.1);
        snprintf(left, sizeof left, shape, x, y, "*", -x, -y, -2.1);
        scene_job jobs[] = {job_of(taken, 16), job_of(left, 16)};
        double means[] = {mean_of(&jobs[0]), mean_of(&jobs[1])};
        differ += means[0] != means[1];
    }
    print_message(
        "of 24 slabs of half-spaces looked along, %d differ from their complement's\n", differ);
    assert_int_equal(differ, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangents),           cmocka_unit_test(gaps),
        cmocka_unit_test(needles_and_plates), cmocka_unit_test(tori),
        cmocka_unit_test(powers_of_ten),      cmocka_unit_test(far_boxes),
        cmocka_unit_test(late_frames),        cmocka_unit_test(along_planes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
