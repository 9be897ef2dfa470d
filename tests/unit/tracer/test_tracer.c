/* The tracer's pictures against closed forms: areas, moving edges and bars under every aperture
 * and temporal width, own temporal widths, and what must not change a picture. */
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

#define WIDTH  64
#define LINES  48
#define RASTER "64x48@30i,tff,par=1:1"

/* x to the right and y up, in pixels and lines from the middle of the picture. */
#define CAMERA "camera{eye={0, 0, 100}, look_at={0, 0, 0}, ortho_height=raster.lines}\n"
#define WHITE  ":material{unlit=true, color=1}"
/* Rays along a half-space that they are in never see its surface: it gets a front. */
#define FRONT "halfspace{normal={0, 0, 1}}"

static scene_job job_of(const char *text, const char *aperture, wf_rational width) {
    return (scene_job){.text = text,
                       .raster = RASTER,
                       .aperture = aperture,
                       .width = width,
                       .sampler = WF_SAMPLER_SOBOL,
                       .count = 256};
}

static const float *at(const float *frame, int i, int j) {
    return frame + 3 * (j * WIDTH + i);
}

/* ---- Areas ---- */

/* How much of the unit interval about 0 lies left of x; its integral. */
static double ramp(double x) {
    return x < -0.5 ? 0 : x > 0.5 ? x : (x + 0.5) * (x + 0.5) / 2;
}

/* Area of [-1/2,1/2] x [-h,h] (divided by 2 h) where x < a + b y: a trapezoid's integral in
 * closed form by the integral of a clamped ramp. */
static double covered(double a, double b, double h) {
    if (fabs(b) < 1e-12) return fmin(fmax(a + 0.5, 0), 1);
    double low = a - fabs(b) * h, high = a + fabs(b) * h;
    return (ramp(high) - ramp(low)) / (high - low);
}

/* A straight edge at a slope, through line (1 line high) and box (2). */
static void edges(void **state) {
    static const struct {
        const char *aperture;
        double half_height;
    } rows[] = {{"line", 0.5}, {"box", 1}};
    (void)state;
    for (size_t n = 0; n < 2; n++)
        for (int k = 0; k < 4; k += test_step(3)) {
            double slope = 0.13 + 0.31 * k, shift = 0.37 * k, sum = 0, bias = 0;
            char text[512];
            snprintf(text, sizeof text,
                     CAMERA "add((halfspace{normal={1, %.17g, 0}, offset=%.17g} * " FRONT
                            ")" WHITE ")",
                     -slope, shift);
            scene_job job = job_of(text, rows[n].aperture, (wf_rational){0, 1});
            float *frame = scene_frame(&job, 0);
            for (int j = 1; j < LINES - 1; j++)
                for (int i = 0; i < WIDTH; i++) {
                    double x = i + 0.5 - WIDTH / 2.0, y = LINES / 2.0 - j - 0.5;
                    double truth = covered(shift + slope * y - x, slope, rows[n].half_height);
                    double e = (double)*at(frame, i, j) - truth;
                    assert_true(fabs(e) < 0.06);
                    sum += e * e;
                    bias += e;
                }
            double pixels = WIDTH * (LINES - 2);
            assert_true(sqrt(sum / pixels) < 3e-3);
            assert_true(fabs(bias / pixels) < 1e-4);
            free(frame);
        }
}

/* The light of a whole disc is its area, wherever it lies. */
static void discs(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        char text[512];
        double radius = 3.7 + 4.1 * k, light[2] = {0};
        snprintf(text, sizeof text,
                 CAMERA "add(sphere{center={%.17g, %.17g, 0}, radius=%.17g}" WHITE ")",
                 0.77 * k, -1.3 + k, radius);
        scene_job job = job_of(text, "line", (wf_rational){0, 1});
        float *frame = scene_frame(&job, 0);
        for (int j = 0; j < LINES; j++)
            for (int i = 0; i < WIDTH; i++) light[j % 2] += (double)*at(frame, i, j);
        assert_true(fabs((light[0] + light[1]) / (M_PI * radius * radius) - 1) < 5e-4);
        free(frame);
    }
}

/* ---- Motion ---- */

/* A pixel at x of an edge (white to the left) that moves from a to b evenly: the box of the
 * pixel and the box of the way are one after the other, in either order (Potmesil and
 * Chakraborty 1983). */
static double swept(double x, double a, double b) {
    if (a == b) return fmin(fmax(a - x + 0.5, 0), 1);
    return (ramp(b - x) - ramp(a - x)) / (b - a);
}

static double pixels_a_field(double velocity) {
    return velocity * 1 / 60.0;
}

static void moving_edges(void **state) {
    static const wf_rational widths[] = {{0, 1}, {1, 4}, {1, 2}, {1, 1}, {2, 1}, {3, 2}};
    static const char *const apertures[] = {"line", "box", "notch"};
    (void)state;
    for (size_t w = 0; w < sizeof widths / sizeof *widths; w += (size_t)test_step(2))
        for (int position = WF_START; position <= WF_END; position++) {
            double tau = wf_ratio_value(widths[w]), v = pixels_a_field(240), sum = 0;
            double early = position == WF_START ? 0 : position == WF_CENTER ? tau / 2 : tau;
            const char *text = CAMERA "add((halfspace{normal={1, 0, 0}, offset=-3.3} * " FRONT
                                      "):velocity{240, 0, 0}" WHITE ")";
            scene_job job = job_of(text, apertures[w % 3], widths[w]);
            job.position = (wf_position)position;
            float *field = scene_field(&job, 3);
            double a = -3.3 + (3 - early) * v, b = a + tau * v;
            for (int l = 1; l < LINES / 2 - 1; l++)
                for (int i = 0; i < WIDTH; i++) {
                    double truth = swept(i + 0.5 - WIDTH / 2.0, a, b);
                    double e = (double)field[3 * (l * WIDTH + i)] - truth;
                    assert_true(fabs(e) < 0.06);
                    sum += e * e;
                }
            assert_true(sqrt(sum / (WIDTH * (LINES / 2 - 2))) < 3e-3);
            free(field);
        }
}

/* Every aperture sees a uniform moving plane as uniform, and a vertical edge as the swept
 * horizontal box says, except the shaped one, which is wider. */
static void own_temporal_width(void **state) {
    const char *own = CAMERA "add((halfspace{normal={1, 0, 0}} * " FRONT
                             "):velocity{480, 0, 0}" WHITE ":temporal_width(0.25))";
    (void)state;
    for (int whole = 0; whole < 2; whole++) {
        scene_job job = job_of(own, "box", whole ? (wf_rational){1, 1} : (wf_rational){0, 1});
        float *field = scene_field(&job, 2);
        double v = pixels_a_field(480), a = 2 * v, sum = 0;
        for (int l = 1; l < LINES / 2 - 1; l++)
            for (int i = 0; i < WIDTH; i++) {
                double truth = swept(i + 0.5 - WIDTH / 2.0, a, a + 0.25 * v);
                double e = (double)field[3 * (l * WIDTH + i)] - truth;
                sum += e * e;
            }
        assert_true(sqrt(sum / (WIDTH * (LINES / 2 - 2))) < 3e-3);
        free(field);
    }
}

/* Line j of a tube camera looks later, and an edge that moves leans. */
static void scan_skew(void **state) {
    const char *text =
        CAMERA "add((halfspace{normal={1, 0, 0}} * " FRONT "):velocity{480, 0, 0}" WHITE ")";
    (void)state;
    for (int instant = 0; instant < 2; instant++) {
        scene_job job =
            job_of(text, "box", instant ? (wf_rational){0, 1} : (wf_rational){1, 2});
        job.skew = (wf_rational){1, 1};
        float *field = scene_field(&job, 0);
        double v = pixels_a_field(480), worst = 0;
        for (int l = 0; l < LINES / 2; l++)
            for (int i = 0; i < WIDTH; i++) {
                double a = v * (2 * l) / LINES, b = a + (instant ? 0 : 0.5 * v);
                double e =
                    (double)field[3 * (l * WIDTH + i)] - swept(i + 0.5 - WIDTH / 2.0, a, b);
                worst = fmax(worst, fabs(e));
            }
        assert_true(worst < 0.06);
        free(field);
    }
}

/* A dot on the rim of a wheel stands where its angle says, with velocity on top. */
static void wheel_on_a_cart(void **state) {
    const char *text =
        CAMERA "add(sphere{center={10, 0, 0}, radius=2}:spin{axis={0, 0, 1}, rpm=300}"
               ":velocity{60, 0, 0}" WHITE ")";
    (void)state;
    for (int64_t n = 0; n < 6; n++) {
        scene_job job = job_of(text, "line", (wf_rational){0, 1});
        job.raster = "64x48@60p,par=1:1";
        float *frame = scene_frame(&job, n);
        double x = 0, y = 0, light = 0, angle = 2 * M_PI * 5 * (double)n / 60;
        for (int j = 0; j < LINES; j++)
            for (int i = 0; i < WIDTH; i++) {
                double w = (double)*at(frame, i, j);
                light += w;
                x += w * (i + 0.5 - WIDTH / 2.0);
                y += w * (LINES / 2.0 - j - 0.5);
            }
        assert_true(fabs(light / (4 * M_PI) - 1) < 2e-3);
        assert_true(fabs(x / light - (10 * cos(angle) + (double)n)) < 1.5e-2);
        assert_true(fabs(y / light - 10 * sin(angle)) < 1.5e-2);
        free(frame);
    }
}

/* How much every other line stands out from its neighbors, over rows first <= j < end. */
static double comb(const float *frame, int width, int first, int end) {
    double sum = 0;
    for (int j = first; j < end; j++)
        for (int i = 0; i < width; i++) {
            const float *v = frame + 3 * (j * width + i) + 1;
            sum += fabs(2 * (double)v[0] - (double)v[-3 * width] - (double)v[3 * width]);
        }
    return sum / (width * (end - first));
}

/* Figure 6: figures that move are serrated when the two fields of a frame are woven, what
 * stands is not, and neither is when both fields are of one instant. */
static void serration(void **state) {
    scene_job job = {.path = "carousel.lua",
                     .raster = "360x244@30i,par=10:11",
                     .aperture = "box",
                     .sampler = WF_SAMPLER_SOBOL,
                     .width = {0, 1},
                     .count = 16};
    (void)state;
    float *woven = scene_frame(&job, 5);
    job.raster = "360x244@30psf,par=10:11";
    float *still = scene_frame(&job, 5);
    double figures[2] = {comb(woven, 360, 100, 190), comb(still, 360, 100, 190)};
    double ground[2] = {comb(woven, 360, 236, 243), comb(still, 360, 236, 243)};
    print_message("comb: figures %.4f woven, %.4f of one instant; ground %.4f and %.4f\n",
                  figures[0], figures[1], ground[0], ground[1]);
    assert_true(figures[0] > 1.5 * figures[1]);
    assert_true(fabs(ground[0] - ground[1]) < 0.05 * ground[1]);
    free(woven);
    free(still);
}

/* ---- What must not change a picture ---- */

static const char busy[] =
    "camera{eye={0, 3, 9}, look_at={0, 1, 0}}\n"
    "light{point={5, 9, 6}}\n"
    "background{0.2, 0.3, 0.5}\n"
    "add(halfspace{normal={0, 1, 0}}:material{texture=checker{1, 0.2}})\n"
    "local a, b = box{min={-1, 0, -1}, max={1, 2, 1}}, sphere{center={0, 1, 0}, radius=1.3}\n"
    "add((a - b):spin{rpm=60}:material{color={1, 0.3, 0.2}, reflect=0.3})\n"
    "add((a * b):translate{3, 0, 0}:velocity{-4, 0, 0})\n"
    "add((a + b):scale(0.5):translate{-3, 0, 1}:spin{rpm=33, center={-3, 0, 0}})\n"
    "add(torus{center={0, 2.6, 0}, major=0.7, minor=0.2}:keyframes{{time=0}, {time=1, "
    "degrees=90,"
    " axis={1, 0, 0}}})\n"
    "add(cone{from={2, 0, 2}, to={2, 1, 2}, radii={0.5, 0}}:material{refract=0.8, color=1})\n";

static void same_pictures(const scene_job *a, const scene_job *b, double most) {
    for (int64_t n = 0; n < 2; n++) {
        float *p = scene_field(a, n), *q = scene_field(b, n);
        for (int k = 0; k < 3 * WIDTH * LINES / 2; k++)
            if (!(fabs((double)p[k] - (double)q[k]) <= most))
                fail_msg("value %d: %.9g and %.9g", k, (double)p[k], (double)q[k]);
        free(p);
        free(q);
    }
}

static void skipping(void **state) {
    scene_job on = job_of(busy, "shaped", (wf_rational){1, 2}), off = on;
    (void)state;
    on.count = off.count = 16;
    off.no_skip = true;
    same_pictures(&on, &off, 0);
}

/* Shared samples of long windows are other samples of the same picture. */
static void long_windows(void **state) {
    scene_job once = job_of(CAMERA "add(sphere{radius=9}:velocity{200, 90, 0}" WHITE ")", "box",
                            (wf_rational){2, 1});
    scene_job apart = once;
    (void)state;
    /* A width of its own, equal to the job's, keeps fields from sharing. */
    apart.text = CAMERA "add(sphere{radius=9}:velocity{200, 90, 0}" WHITE ":temporal_width(2))";
    same_pictures(&once, &apart, 0.02);
}

static void scaled(char *text, size_t size, double s) {
    snprintf(
        text, size,
        "camera{eye={0, %.17g, %.17g}, look_at={0, %.17g, 0}}\n"
        "light{point={%.17g, %.17g, %.17g}}\n"
        "add(halfspace{normal={0, 1, 0}}:material{texture=checker{1, 0.2, size=%.17g}})\n"
        "local a = box{min={%.17g, 0, %.17g}, max={%.17g, %.17g, %.17g}}\n"
        "local b = sphere{center={0, %.17g, 0}, radius=%.17g}\n"
        "add((a - b):spin{rpm=60}:velocity{%.17g, 0, 0}:material{specular=0.5})\n"
        "add(torus{center={0, %.17g, 0}, major=%.17g, minor=%.17g}:material{reflect=0.5})\n"
        "add(cone{from={%.17g, 0, 0}, to={%.17g, %.17g, 0}, radii={%.17g, %.17g}})\n",
        3 * s, 9 * s, s, 5 * s, 9 * s, 6 * s, s, -s, -s, s, 2 * s, s, s, 1.25 * s, 2 * s,
        2.5 * s, 0.75 * s, 0.25 * s, -2 * s, -2 * s, s, 0.5 * s, 0.125 * s);
}

static void powers_of_two(void **state) {
    char one[2048], other[2048];
    (void)state;
    scaled(one, sizeof one, 1);
    for (int power = -40; power <= 40; power++) {
        scaled(other, sizeof other, ldexp(1, power));
        scene_job a = job_of(one, "box", (wf_rational){1, 2}), b = a;
        a.count = b.count = 2;
        b.text = other;
        same_pictures(&a, &b, 0);
    }
}

/* A - A is nothing; A + A and A * A are A; the order of operands does not matter. */
static void set_algebra(void **state) {
    static const char *const equal[][2] = {{"a - a", "sphere{center={900, 0, 0}}"},
                                           {"a + a", "a"},
                                           {"a * a", "a"},
                                           {"a + b", "b + a"},
                                           {"a * b", "b * a"},
                                           {"a - (b + c)", "(a - b) * (a - c)"},
                                           {"a - (b * c)", "(a - b) + (a - c)"},
                                           {"a * (b + c)", "(a * b) + (a * c)"},
                                           {"a + (b * c)", "(a + b) * (a + c)"}};
    const char *rest = "camera{eye={2, 3, 9}, look_at={0, 1, 0}}\nlight{point={5, 9, 6}}\n"
                       "local a = box{min={-1, 0, -1}, max={1, 2, 1}}\n"
                       "local b = sphere{center={0.5, 1, 0.5}, radius=1.2}\n"
                       "local c = cylinder{from={-3, 1, 0}, to={3, 1, 0}, radius=0.6}\n";
    char text[2][2048];
    (void)state;
    for (size_t n = 0; n < sizeof equal / sizeof *equal; n++) {
        for (int side = 0; side < 2; side++)
            snprintf(text[side], sizeof text[side], "%sadd(%s)\n", rest, equal[n][side]);
        scene_job a = job_of(text[0], "line", (wf_rational){0, 1}), b = a;
        a.count = b.count = 16;
        b.text = text[1];
        same_pictures(&a, &b, 1e-6);
    }
}

/* Tops and sides in one place: none of a hundred thousand rays sees through or shows the wrong
 * one here and there. */
static void coincident_faces(void **state) {
    const char *text = "camera{eye={0, 6, 0.01}, look_at={0, 0, 0}, fov=30}\n"
                       "local function flat(c) return {unlit=true, color=c} end\n"
                       "add(box{min={-1, 0, -1}, max={1, 1, 1}}:rotate{degrees=33}"
                       ":material(flat{1, 0, 0}))\n"
                       "add(cone{from={0, 0, 0}, to={0, 1, 0}, radii={0.9, 0.7}}"
                       ":material(flat{0, 1, 0}))\n";
    scene_job job = job_of(text, "line", (wf_rational){0, 1});
    float *frame = scene_frame(&job, 0);
    double least = 1, most = 0;
    (void)state;
    /* About the middle, all is the one or the other. */
    for (int j = LINES / 2 - 3; j < LINES / 2 + 3; j++)
        for (int i = WIDTH / 2 - 3; i < WIDTH / 2 + 3; i++) {
            least = fmin(least, (double)at(frame, i, j)[1]);
            most = fmax(most, (double)at(frame, i, j)[1]);
        }
    assert_true(least == most && (most == 0 || most == 1));
    free(frame);
}

/* From far away a scene is itself: nothing is lost and nothing shines through. */
static void far_from_the_origin(void **state) {
    const char *text =
        "local o = {148376, 1234, -223423}\n"
        "camera{eye={o[1], o[2] + 2, o[3] + 9}, look_at={o[1], o[2] + 1, o[3]}}\n"
        "add(box{min={-9, -9, -1}, max={9, 9, 0}}:translate(o)"
        ":material{unlit=true, color=1})\n"
        "add(sphere{center={0, 1, 0}}:translate(o):material{unlit=true, color=1})\n";
    scene_job job = job_of(text, "line", (wf_rational){0, 1});
    float *frame = scene_frame(&job, 0);
    (void)state;
    for (int k = 0; k < 3 * WIDTH * LINES; k++) assert_true(frame[k] == 1.0f);
    free(frame);
}

/* Inside a sphere one sees its inner side, and of a union no inner walls. */
static void camera_inside(void **state) {
    const char *text =
        "camera{eye={0, 0, 0}, look_at={0, 0, -1}, fov=90}\n"
        "add(union(sphere{radius=5}, sphere{center={0, 0, -2}, radius=1})"
        ":material{unlit=true, texture=stripe{1, 0.25, axis={0, 0, 1}, size=100}})\n";
    scene_job job = job_of(text, "line", (wf_rational){0, 1});
    float *frame = scene_frame(&job, 0);
    (void)state;
    for (int k = 0; k < 3 * WIDTH * LINES; k++) assert_true(frame[k] == 0.25f);
    free(frame);
}

/* Half a mirror shows half of what it mirrors; a pane of index 1 shows what is behind it. */
static void mirrors_and_panes(void **state) {
    const char *text = CAMERA
        "background{0.25, 0.5, 1}\n"
        "add(box{min={-40, -40, -1}, max={0, 40, 0}}:material{color=0, reflect=0.5, "
        "ambient=0, diffuse=0})\n"
        "add(box{min={0, -40, -1}, max={40, 40, 0}}:material{color=1, refract=1, index=1})";
    scene_job job = job_of(text, "line", (wf_rational){0, 1});
    float *frame = scene_frame(&job, 0);
    (void)state;
    for (int c = 0; c < 3; c++) {
        double sky = ldexp(1, c - 2);
        assert_true(fabs((double)at(frame, 10, 20)[c] - 0.5 * sky) < 1e-6);
        assert_true(fabs((double)at(frame, 50, 20)[c] - sky) < 1e-6);
    }
    free(frame);
}

/* Lambert's law on a slope, and darkness behind a wall. */
static void light_and_shadow(void **state) {
    const char *text = CAMERA
        "light{direction={0, -1, -1}, color={1, 0.5, 0.25}}\n"
        "add(halfspace{normal={0, 0, 1}}:material{color=0.8, ambient=0.125, diffuse=0.5})\n"
        "add(box{min={-50, 6, 0}, max={50, 8, 10}}:material{unlit=true, color=0})";
    scene_job job = job_of(text, "line", (wf_rational){0, 1});
    float *frame = scene_frame(&job, 0);
    (void)state;
    for (int c = 0; c < 3; c++) {
        double lit = 0.8 * (0.125 + 0.5 * M_SQRT1_2 * ldexp(1, -c));
        assert_true(fabs((double)at(frame, 30, 40)[c] - lit) < 1e-6);
        assert_true(fabs((double)at(frame, 30, 22)[c] - 0.1) < 1e-6); /* y = 1.5: in shadow */
    }
    free(frame);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges),
        cmocka_unit_test(discs),
        cmocka_unit_test(moving_edges),
        cmocka_unit_test(own_temporal_width),
        cmocka_unit_test(scan_skew),
        cmocka_unit_test(wheel_on_a_cart),
        cmocka_unit_test(serration),
        cmocka_unit_test(skipping),
        cmocka_unit_test(long_windows),
        cmocka_unit_test(powers_of_two),
        cmocka_unit_test(set_algebra),
        cmocka_unit_test(coincident_faces),
        cmocka_unit_test(far_from_the_origin),
        cmocka_unit_test(camera_inside),
        cmocka_unit_test(mirrors_and_panes),
        cmocka_unit_test(light_and_shadow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
