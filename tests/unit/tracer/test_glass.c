/* Glass: rays through nested and touching media, held against a tracer of its own that knows
 * spheres and boxes in closed form; and light that comes through what is clear. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/unit/support/scene_fields.h"
#include "tests/unit/support/sizes.h"
#include "tracer/trace/tracer.h"

/* ---- Another tracer ---- */

typedef struct vec {
    double v[3];
} vec;

/* A sphere (radius > 0) about `a`, or the box from a to b. */
typedef struct body {
    double radius;
    vec a, b;
    double index; /* 0: opaque */
} body;

#define FLOOR 1.6

static double dot(vec p, vec q) {
    return p.v[0] * q.v[0] + p.v[1] * q.v[1] + p.v[2] * q.v[2];
}

static vec along(vec p, double s, vec d) {
    return (vec){{p.v[0] + s * d.v[0], p.v[1] + s * d.v[1], p.v[2] + s * d.v[2]}};
}

static vec unit(vec p) {
    return along((vec){{0, 0, 0}}, 1 / sqrt(dot(p, p)), p);
}

/* The run of a line within a body, and the axis of the box's face at each end. */
static bool run_of(const body *b, vec o, vec d, double run[2], int axis[2]) {
    if (b->radius > 0) {
        vec c = along(o, -1, b->a);
        double half = dot(c, d), rest = half * half - dot(c, c) + b->radius * b->radius;
        if (!(rest > 0)) return false;
        run[0] = -half - sqrt(rest);
        run[1] = -half + sqrt(rest);
        return true;
    }
    run[0] = -HUGE_VAL, run[1] = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        double s = (b->a.v[k] - o.v[k]) / d.v[k], e = (b->b.v[k] - o.v[k]) / d.v[k];
        if (fmin(s, e) > run[0]) run[0] = fmin(s, e), axis[0] = k;
        if (fmax(s, e) < run[1]) run[1] = fmax(s, e), axis[1] = k;
    }
    return run[0] < run[1];
}

static double volume_of(const body *b) {
    vec size = along(b->b, -1, b->a);
    return b->radius > 0 ? 4.18879020478639 * pow(b->radius, 3)
                         : size.v[0] * size.v[1] * size.v[2];
}

static bool holds(const body *b, vec p) {
    vec c = along(p, -1, b->a);
    if (b->radius > 0) return dot(c, c) < b->radius * b->radius;
    for (int k = 0; k < 3; k++)
        if (!(p.v[k] > b->a.v[k] && p.v[k] < b->b.v[k])) return false;
    return true;
}

/* The index of refraction at a place: that of the smallest body that holds it. */
static double index_at(const body *bodies, int count, vec p) {
    double least = HUGE_VAL, index = 1;
    for (int n = 0; n < count; n++)
        if (holds(&bodies[n], p) && volume_of(&bodies[n]) < least) {
            least = volume_of(&bodies[n]);
            index = bodies[n].index;
        }
    return index;
}

/* The next boundary of any body; false: there is none. */
static bool next_boundary(const body *bodies, int count, vec o, vec d, double *s, vec *n) {
    *s = HUGE_VAL;
    for (int k = 0; k < count; k++) {
        double run[2];
        int axis[2] = {0, 0};
        if (!run_of(&bodies[k], o, d, run, axis)) continue;
        for (int e = 0; e < 2; e++) {
            if (!(run[e] > 1e-9) || !(run[e] < *s)) continue;
            *s = run[e];
            *n = (vec){{0, 0, 0}};
            n->v[axis[e]] = 1;
            if (bodies[k].radius > 0) *n = unit(along(along(o, run[e], d), -1, bodies[k].a));
        }
    }
    return *s < HUGE_VAL;
}

/* Where a ray ends: on the floor at `at`, or not. */
typedef struct ending {
    bool floor, grazes; /* grazes: rounding decides where it goes */
    int surfaces;
    vec at;
} ending;

static vec bent(vec d, vec n, double before, double behind) {
    double cosine = -dot(d, n), ratio = before / behind;
    double rest = 1 - ratio * ratio * (1 - cosine * cosine);
    if (rest < 0) return along(d, 2 * cosine, n);
    return unit(along(along((vec){{0, 0, 0}}, ratio, d), ratio * cosine - sqrt(rest), n));
}

static ending follow(const body *bodies, int count, vec o, vec d) {
    ending e = {.surfaces = 0};
    for (; e.surfaces < 20; e.surfaces++) {
        vec n;
        double s, to_floor = d.v[1] < 0 ? (-FLOOR - o.v[1]) / d.v[1] : HUGE_VAL;
        bool any = next_boundary(bodies, count, o, d, &s, &n);
        e.floor = to_floor < HUGE_VAL && (!any || to_floor <= s * (1 + 1e-9));
        if (e.floor) e.at = along(o, to_floor, d);
        if (e.floor || !any) break;
        vec p = along(o, s, d);
        if (dot(d, n) > 0) n = along((vec){{0, 0, 0}}, -1, n);
        e.grazes |= fabs(dot(d, n)) < .02;
        double before = index_at(bodies, count, along(p, -1e-7, d));
        double behind = index_at(bodies, count, along(p, 1e-7, d));
        double rest = 1 - pow(before / behind, 2) * (1 - pow(dot(d, n), 2));
        e.grazes |= fabs(rest) < 1e-4;
        d = bent(d, n, before, behind);
        o = p;
    }
    return e;
}

/* ---- Both, side by side ---- */

static const struct {
    const char *name;
    body bodies[4];
    int count;
    bool floor_last; /* the scene adds the floor after the bodies */
} stacks[] = {
    {"water in glass", {{1.5, .index = 1.5}, {1.2, .index = 1.33}}, 2, false},
    {"water before glass", {{1.2, .index = 1.33}, {1.5, .index = 1.5}}, 2, true},
    {"air in water in glass",
     {{1.5, .index = 1.5},
      {1.1, {{.2, .1, 0}}, .index = 1.33},
      {.5, {{.3, 0, .2}}, .index = 1}},
     3,
     false},
    {"three panes that touch",
     {{0, {{-9, -1.5, 0}}, {{9, 9, 1}}, 1.5},
      {0, {{-9, -1.5, 1}}, {{9, 9, 2}}, 1.33},
      {0, {{-9, -1.5, 2}}, {{9, 9, 3}}, 1.7}},
     3,
     false},
    {"panes in another order",
     {{0, {{-9, -1.5, 2}}, {{9, 9, 3}}, 1.7},
      {0, {{-9, -1.5, 0}}, {{9, 9, 1}}, 1.5},
      {0, {{-9, -1.5, 1}}, {{9, 9, 2}}, 1.33}},
     3,
     true},
    {"a block on the floor", {{0, {{-1, -FLOOR, -1}}, {{1, 0.3, 1}}, 1.5}}, 1, false},
    {"a block before the floor", {{0, {{-1, -FLOOR, -1}}, {{1, 0.3, 1}}, 1.5}}, 1, true},
    {"water that shares a face with glass",
     {{0, {{-1, -1, -1}}, {{1, 1, 1}}, 1.5}, {0, {{-.5, -1, -.5}}, {{.5, .2, .5}}, 1.33}},
     2,
     false},
    {"spheres that overlap",
     {{1.2, {{-.6, 0, 0}}, .index = 1.5}, {1, {{.7, 0, .2}}, .index = 1.33}},
     2,
     false},
    {"a diamond in oil, far smaller", {{1.5, .index = 1.47}, {.05, .index = 2.4}}, 2, false},
};

#define STACKS ((int)(sizeof stacks / sizeof *stacks))

/* Camera and bodies may turn about the middle of the rings together, which shows the same. */
static const char *const turns[] = {"", ":rotate{degrees=37}", ":spin{rpm=7.3}"};

/* A floor of rings tells exactly where rays end. */
static void write_scene(int n, const char *turn, char *text, size_t size) {
    static const char floor[] =
        "add(halfspace{normal={0, 1, 0}, offset=-1.6}:material{unlit=true, "
        "texture=zoneplate{height=40, center={0, -1.6, 0}, across={1, 0, 0}, "
        "down={0, 0, 1}}})\n";
    size_t used = (size_t)snprintf(
        text, size, "camera{eye={0, 2, 9}, look_at={0, 0, 0}, fov=40}%s depth(24)\n%s", turn,
        stacks[n].floor_last ? "" : floor);
    for (int k = 0; k < stacks[n].count; k++) {
        const body *b = &stacks[n].bodies[k];
        if (b->radius > 0)
            used += (size_t)snprintf(text + used, size - used,
                                     "add(sphere{center={%g, %g, %g}, radius=%g}", b->a.v[0],
                                     b->a.v[1], b->a.v[2], b->radius);
        else
            used += (size_t)snprintf(text + used, size - used,
                                     "add(box{min={%g, %g, %g}, max={%g, %g, %g}}", b->a.v[0],
                                     b->a.v[1], b->a.v[2], b->b.v[0], b->b.v[1], b->b.v[2]);
        used += (size_t)snprintf(text + used, size - used,
                                 ":material{color=1, diffuse=0, ambient=0, refract=1, "
                                 "index=%g}%s)\n",
                                 b->index, turn);
    }
    if (stacks[n].floor_last) snprintf(text + used, size - used, "%s", floor);
}

#define RAYS 4096

/* Light at places of a raster of 100 x 100. */
static void trace_places(const wf_scene *scene, const double *x, const double *y,
                         float *light) {
    const wf_view view = {100, 100, 1, 1 / 50.0};
    const wf_window_of_time window = {{13, 10}, 0, 0.5, 0};
    static double f[RAYS];
    static float other[2][RAYS];
    wf_tracer *t = wf_tracer_new(scene, &view);
    bool empty;
    assert_true(wf_tracer_look(t, &window, true));
    wf_trace_scratch *s = wf_trace_scratch_new(t);
    assert_true(wf_trace_prepare(t, s, (double[]){0, 100}, (double[]){0, 100}, &empty));
    const wf_trace_samples samples = {
        .count = RAYS, .x = x, .y = y, .f = f, .rgb = {light, other[0], other[1]}};
    assert_true(wf_trace(t, s, &samples));
    wf_trace_scratch_free(s);
    wf_tracer_free(t);
}

static double number(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static vec of(wf_vec v) {
    return (vec){{v.x, v.y, v.z}};
}

static ending follow_camera(int n, const wf_camera *c, double x, double y) {
    double right = (2 * x / 100 - 1) * c->half_height, up = (1 - 2 * y / 100) * c->half_height;
    vec d = along(along(of(c->forward), right, of(c->right)), up, of(c->up));
    return follow(stacks[n].bodies, stacks[n].count, of(c->eye), unit(d));
}

/* Of how many rays the end was compared, and of how many it was another. */
typedef struct tally {
    int compared, other, bent;
    double worst;
} tally;

static double light_of(ending e) {
    double square = e.at.v[0] * e.at.v[0] + e.at.v[2] * e.at.v[2];
    return e.floor ? .5 + .5 * cos(3.14159265358979323846 * square / 40) : 0;
}

/* Rays may end where the other tracer's do if they are turned by so much of a pixel: 1.5e-8
 * rad.
 */
#define TURN 2e-6

static tally compare(int n, const wf_scene *scene) {
    static double x[RAYS], y[RAYS];
    static float light[RAYS];
    uint64_t state = (uint64_t)n + 7;
    tally t = {.worst = 0};
    for (int k = 0; k < RAYS; k++) {
        x[k] = 100 * number(&state);
        y[k] = 100 * number(&state);
    }
    trace_places(scene, x, y, light);
    for (int k = 0; k < RAYS; k++) {
        ending e = follow_camera(n, &scene->camera, x[k], y[k]);
        double square = e.at.v[0] * e.at.v[0] + e.at.v[2] * e.at.v[2];
        if (e.grazes || e.surfaces > 20 || (e.floor && square > 900)) continue;
        double error = fabs((double)light[k] - light_of(e));
        double change =
            fabs(light_of(follow_camera(n, &scene->camera, x[k] + TURN, y[k])) - light_of(e)) +
            fabs(light_of(follow_camera(n, &scene->camera, x[k], y[k] + TURN)) - light_of(e));
        t.compared++;
        t.bent += e.surfaces > 0;
        t.other += error > 2e-7 + change;
        t.worst = fmax(t.worst, error);
    }
    return t;
}

static void media_bend_rays(void **state) {
    (void)state;
    for (int k = 0; k < 3 * STACKS; k += test_step(4)) {
        int n = k % STACKS;
        const char *turn = turns[k / STACKS];
        char text[2048];
        wf_scene scene;
        write_scene(n, turn, text, sizeof text);
        const scene_job job = {.text = text, .raster = "100x100@25p,par=1:1"};
        scene_load(&job, &scene);
        tally t = compare(n, &scene);
        wf_scene_free(&scene);
        printf("%s%s: %d rays, %d through glass, %d elsewhere, worst %.2g\n", stacks[n].name,
               turn, t.compared, t.bent, t.other, t.worst);
        assert_true(t.compared > RAYS / 4 && t.bent > 50);
        assert_int_equal(t.other, 0);
    }
}

/* ---- Light that comes through ---- */

#define VIEW                                                                                   \
    "camera{eye={0, 3, 0}, look_at={0, 0, 0}, up={0, 0, -1}, ortho_height=0.002}\n"            \
    "add(halfspace{normal={0, 1, 0}}:material{color=1, ambient=0, diffuse=1})\n"
#define SUN "light{direction={0, -1, 0}}\n"

/* A pane above the camera, of one material. */
#define PANE(material) "add(box{min={-5, 4, -5}, max={5, 5, 5}}:material{" material "})\n"

static const struct {
    const char *name, *text;
    double light[3]; /* on the floor in the middle */
} lit[] = {
    {"nothing", SUN, {1, 1, 1}},
    {"an opaque pane", SUN PANE("color=1"), {0, 0, 0}},
    {"a pane of refract .5", SUN PANE("color=1, refract=.5"), {.5, .5, .5}},
    {"a clear pane", SUN PANE("color=1, refract=1"), {1, 1, 1}},
    {"a tinted pane", SUN PANE("color={1, .5, .25}, refract=.8"), {.8, .4, .2}},
    {"two panes",
     SUN PANE("color={1, .5, .25}, refract=.8") "add(box{min={-5, 6, -5}, max={5, 7, 5}}"
                                                ":material{color=1, refract=.5})",
     {.4, .2, .1}},
    {"one pane in another",
     SUN PANE("color=1, refract=.5") "add(box{min={-4, 4.2, -4}, max={4, 4.8, 4}}"
                                     ":material{color={0, 1, 1}, refract=.5})",
     {0, .25, .25}},
    {"panes that touch",
     SUN PANE("color=1, refract=.5") "add(box{min={-5, 5, -5}, max={5, 6, 5}}"
                                     ":material{color=1, refract=.5})",
     {.25, .25, .25}},
    {"two that are one",
     SUN "add(union(box{min={-5, 4, -5}, max={5, 5, 5}}, box{min={-4, 4.5, -4}, max={4, 6, 4}})"
         ":material{color=1, refract=.5})",
     {.5, .5, .5}},
    {"two lumps with a gap",
     SUN "add(difference(box{min={-5, 4, -5}, max={5, 8, 5}}, box{min={-6, 5, -6}, "
         "max={6, 6, 6}}):material{color=1, refract=.5})",
     {.25, .25, .25}},
    {"something opaque within",
     SUN PANE("color=1, refract=.5") "add(sphere{center={0, 4.5, 0}, radius=.2})",
     {0, 0, 0}},
    {"something opaque beyond",
     SUN PANE("color=1, refract=.5") "add(sphere{center={0, 9, 0}, radius=.2})",
     {0, 0, 0}},
    {"the camera and the floor within",
     SUN "add(sphere{radius=20}:material{color=1, refract=.5})",
     {.5, .5, .5}},
    {"the lamp within",
     "light{point={0, 4.5, 0}} add(sphere{center={0, 4.5, 0}, radius=.4}"
     ":material{color={1, .5, 1}, refract=.5})",
     {.5, .25, .5}},
    {"all of it within",
     "light{point={0, 4.5, 0}} add(sphere{radius=20}:material{color=1, refract=.5})",
     {1, 1, 1}},
    {"a spot",
     "light{point={0, 9, 0}, look_at={0, 0, 0}}" PANE("color=1, refract=.5"),
     {.5, .5, .5}},
    {"without shadows",
     "light{direction={0, -1, 0}, shadows=false}" PANE("color=1"),
     {1, 1, 1}},
    {"a stained window",
     SUN PANE("refract=1, texture=stripe{{1, 0, 0}, {0, 1, 0}, axis={0, 1, 0}, size=100}"),
     {1, 0, 0}},
    {"many panes",
     SUN "for i = 1, 40 do add(box{min={-5, 4 + i, -5}, max={5, 4.5 + i, 5}}"
         ":material{color=1, refract=.99}) end",
     {0.6689717585696803, 0.6689717585696803, 0.6689717585696803}},
};

static void light_comes_through(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof lit / sizeof *lit; n++) {
        char text[1024];
        snprintf(text, sizeof text, "%s%s", VIEW, lit[n].text);
        const scene_job job = {.text = text,
                               .raster = "8x8@25p,par=1:1",
                               .aperture = "box",
                               .width = {0, 1},
                               .sampler = WF_SAMPLER_GRID,
                               .count = 1};
        float *frame = scene_frame(&job, 0);
        for (int c = 0; c < 3; c++) {
            double seen = (double)frame[3 * (8 * 4 + 4) + c];
            if (!(fabs(seen - lit[n].light[c]) <= 1e-6))
                fail_msg("%s: %g of color %d, not %g", lit[n].name, seen, c, lit[n].light[c]);
        }
        free(frame);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(media_bend_rays),
        cmocka_unit_test(light_comes_through),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
