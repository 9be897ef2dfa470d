/* Scenes of so many solids that rays go through trees one by one: what is seen is, bit for bit,
 * what a search of all solids finds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/unit/support/scene_fields.h"

#define WIDTH  40
#define LINES  30
#define RASTER "40x30@30i,tff,par=1:1"

/* Solids of all kinds, of sizes over two decades, many at whole places so that faces coincide;
 * `dress` says what is done with each. */
#define CROWD                                                                                  \
    "camera{eye={0, 4, 12}, look_at={0, 0.5, 0}, fov=45}\n"                                    \
    "light{point={8, 14, 9}, color={.8, .8, .8}}\n"                                            \
    "light{point={-6, 9, 6}, look_at={0, 0, 0}, inner=30, outer=60}\n"                         \
    "background{.2, .3, .5}\n"                                                                 \
    "math.randomseed(tonumber(param.seed))\n"                                                  \
    "local function r(a, b) return a + (b - a) * math.random() end\n"                          \
    "local function place(s)\n"                                                                \
    "  local x, y, z = r(-6, 6), r(-1, 2), r(-8, 4)\n"                                         \
    "  if math.random(3) == 1 then x, y, z = x // 1, y // 1, z // 1 end\n"                     \
    "  return s:rotate{axis={r(-1, 1), r(-1, 1), 1}, degrees=math.random(4) * 45}\n"           \
    "    :translate{x, y, z}\n"                                                                \
    "end\n"                                                                                    \
    "local kinds = {\n"                                                                        \
    "  function(a) return sphere{radius=a} end,\n"                                             \
    "  function(a) return box{min={-a, -a, -a}, max={a, a, a}} end,\n"                         \
    "  function(a) return cylinder{from={0, -a, 0}, to={0, a, 0}, radius=a / 2} end,\n"        \
    "  function(a) return cone{from={0, 0, 0}, to={0, 2 * a, 0}, radii={a, 0}} end,\n"         \
    "  function(a) return torus{major=a, minor=a / 4} end,\n"                                  \
    "  function(a) return polyhedron{planes={{1, 0, 0, a}, {-1, 0, 0, a}, {0, 1, 0, a},\n"     \
    "    {0, -1, 0, a}, {0, 0, 1, a}, {0, 0, -1, a}, {1, 1, 1, a}}} end}\n"                    \
    "local function one(a)\n"                                                                  \
    "  return place(kinds[math.random(#kinds)](a or 2 ^ r(-4, -1)))\n"                         \
    "end\n"                                                                                    \
    "local function color(s, more)\n"                                                          \
    "  local m = more or {}\n"                                                                 \
    "  m.color = {r(0, 1), r(0, 1), r(0, 1)}\n"                                                \
    "  return s:material(m)\n"                                                                 \
    "end\n"                                                                                    \
    "add(halfspace{normal={0, 1, 0}, offset=-1}:material{texture=checker{.8, .2}})\n"

/* clang-format off */
static const struct {
    const char *name, *text;
} crowds[] = {
    {"still", CROWD "for n = 1, 300 do add(color(one())) end"},
    {"mirrors and glass", CROWD
     "for n = 1, 200 do\n"
     "  local m = {{reflect=.5, specular=.5}, {refract=.8, index=1.5}, {}, {unlit=true}}\n"
     "  add(color(one(), m[math.random(4)]))\n"
     "end"},
    {"motion", CROWD
     "for n = 1, 60 do add(color(one()):velocity{r(-9, 9), r(-9, 9), r(-9, 9)}) end\n"
     "for n = 1, 60 do add(color(one()):spin{axis={0, 1, r(-1, 1)}, rpm=r(-900, 900)}) end\n"
     "for n = 1, 30 do add(color(one()):keyframes{{time=0}, {time=.01, translate={1, 0, 0},\n"
     "  axis={0, 1, 0}, degrees=40}, {time=.03, translate={1, r(0, 2), 0}}}) end\n"
     "for n = 1, 30 do add(color(one()):velocity{9, 0, 0}:temporal_width(.2)) end\n"
     "local all = {}\n"
     "for n = 1, 90 do all[n] = color(one()) end\n"
     "add(union(table.unpack(all)):spin{axis={0, 1, 0}, rpm=300}:velocity{0, 3, 0})"},
    {"set operations", CROWD
     "for n = 1, 80 do\n"
     "  local a, b, c = color(one(.6)), color(one(.6)), color(one(.4), {reflect=.4})\n"
     "  add(a + b - c)\n"
     "  add((b * (a + c)):velocity{1, 0, 0})\n"
     "  add((one(.5) - sphere{radius=r(.1, .6)}:translate{r(-6, 6), r(-1, 2), r(-8, 4)})\n"
     "    :spin{rpm=60})\n"
     "end"},
    {"inside of unions", CROWD
     "local all, clear = {sphere{center={0, 4, 12}, radius=.5}}, {}\n"
     "for n = 1, 150 do all[#all + 1] = color(one()) end\n"
     "for n = 1, 70 do clear[n] = color(one(.7), {refract=.9, index=1.3, reflect=.1}) end\n"
     "add(union(table.unpack(all)))\n"
     "add(union(table.unpack(clear)))"},
    {"endless ones in unions", CROWD
     "local all = {halfspace{normal={0, 1, .1}, offset=-.8}}\n"
     "for n = 1, 120 do all[#all + 1] = color(one(), {reflect=.3}) end\n"
     "add(union(table.unpack(all)))"},
    {"coincident", CROWD
     "for x = -5, 5 do for z = -6, 3 do for k = 1, 3 do\n"
     "  add(color(box{min={x, -1, z}, max={x + 1, k % 2, z + 1}})) end end end\n"
     "for n = 1, 40 do local s = one() add(color(s)) add(color(s)) end"},
};
/* clang-format on */

static void same_crowds(const scene_job *a, const scene_job *b, const char *name) {
    float *p = scene_field(a, 0), *q = scene_field(b, 0);
    for (int k = 0; k < 3 * WIDTH * LINES / 2; k++)
        if (p[k] != q[k])
            fail_msg("%s, seed %s: value %d: %.9g by trees and %.9g without", name,
                     a->params[0][1], k, (double)p[k], (double)q[k]);
    free(p);
    free(q);
}

static void trees_and_none(void **state) {
    (void)state;
    int seeds = getenv("WEFT_LONG_TESTS") ? 40 : 2;
    for (size_t n = 0; n < sizeof crowds / sizeof *crowds; n++)
        for (int seed = 0; seed < seeds; seed++) {
            char text[16];
            snprintf(text, sizeof text, "%d", seed);
            scene_job on = {.text = crowds[n].text,
                            .raster = RASTER,
                            .aperture = "box",
                            .width = {1, 2},
                            .sampler = WF_SAMPLER_SOBOL,
                            .count = 4,
                            .params = {{"seed", text}}};
            scene_job off = on;
            off.no_skip = true;
            same_crowds(&on, &off, crowds[n].name);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_and_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
