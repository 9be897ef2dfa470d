/* Scenes: what they may say, and how they are refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/unit/support/scene_fields.h"
#include "tracer/scene/motion.h"

#define CAMERA "camera{eye={0, 0, 5}, look_at={0, 0, 0}}\n"

/* ---- Refusals: a line and words that the message must have ---- */

static const struct {
    const char *text, *line, *says;
} refused[] = {
    {"add(sphere{})", "test.lua", "no camera"},
    {CAMERA "add(sphere{radius=0})", "test.lua:2:", "radius must be a number > 0, not 0"},
    {CAMERA "add(sphere{radius=-1})", "test.lua:2:", "not -1"},
    {CAMERA "add(sphere{radius=0/0})", "test.lua:2:", "radius"},
    {CAMERA "add(sphere{radius=math.huge})", "test.lua:2:", "radius"},
    {CAMERA "\nadd(sphere{radius='big'})", "test.lua:3:", "'big'"},
    {CAMERA "add(sphere{radus=1})", "test.lua:2:", "did you mean radius"},
    {CAMERA "add(sphere{zzz=1})", "test.lua:2:", "no key 'zzz'; it takes center, radius"},
    {CAMERA "add(sphere(3))", "test.lua:2:", "it takes a table"},
    {CAMERA "add(sphere{3})", "test.lua:2:", "sphere"},
    {CAMERA "add(spere{})", "test.lua:2:", "did you mean sphere"},
    {CAMERA "add(sphere{}:velosity{1, 0, 0})", "test.lua:2:", "did you mean velocity"},
    {CAMERA "add(sphere{center={1, 2}})", "test.lua:2:", "three numbers"},
    {CAMERA "add(ellipsoid{radii={1, 0, 1}})", "test.lua:2:", "radii"},
    {CAMERA "add(box{min={0, 0, 0}, max={1, 0, 1}})", "test.lua:2:", "beyond"},
    {CAMERA "add(cylinder{from={1, 1, 1}, to={1, 1, 1}, radius=1})",
     "test.lua:2:", "two points"},
    {CAMERA "add(cylinder{from={1, 1, 1}, radius=1})", "test.lua:2:", "the key to= is missing"},
    {CAMERA "add(cone{from={0, 0, 0}, to={0, 1, 0}, radii={0, 0}})", "test.lua:2:", "> 0"},
    {CAMERA "add(torus{axis={0, 0, 0}, major=1, minor=1})", "test.lua:2:", "axis"},
    {CAMERA "add(halfspace{normal={0, 0, 0}})", "test.lua:2:", "normal"},
    {CAMERA "add(quadric{1, 2, 3})", "test.lua:2:", "ten numbers"},
    {CAMERA "add(quadric{0, 0, 0, 0, 0, 0, 0, 0, 0, 1})", "test.lua:2:", "all"},
    {CAMERA "add(polyhedron{planes={{0, 0, 0, 1}}})", "test.lua:2:", "{0, 0, 0}"},
    {CAMERA "add(polyhedron{planes={}})", "test.lua:2:", "list"},
    {CAMERA "add(sphere{}:spin{axis={0, 0, 0}, rpm=1})", "test.lua:2:", "axis"},
    {CAMERA "add(sphere{}:spin{})", "test.lua:2:", "rpm= is missing"},
    {CAMERA "add(sphere{}:scale{1, 0, 1})", "test.lua:2:", "0"},
    {CAMERA "add(sphere{}:matrix{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})", "test.lua:2:", "flat"},
    {CAMERA "add(sphere{}:temporal_width(-1))", "test.lua:2:", "0 to 64"},
    {CAMERA "add(sphere{}:material{color={-1, 0, 0}})", "test.lua:2:", "color"},
    {CAMERA "add(sphere{}:material{reflect=2})", "test.lua:2:", "0 to 1"},
    {CAMERA "add(sphere{}:material{texture=3})", "test.lua:2:", "checker"},
    {CAMERA "add(sphere{}:keyframes{{time=1}, {time=1}})", "test.lua:2:", "later"},
    {CAMERA "add(union())", "test.lua:2:", "none"},
    {CAMERA "add(union{})", "test.lua:2:", "none"},
    {CAMERA "add(union(1, 2))", "test.lua:2:", "must be a solid"},
    {CAMERA "add(light{point={0, 1, 0}})", "test.lua:2:", "need not be added"},
    {CAMERA "light{}", "test.lua:2:", "point="},
    {CAMERA "light{direction={0, 0, 0}}", "test.lua:2:", "direction"},
    {"camera{eye={0, 0, 0}, look_at={0, 0, 0}}", "test.lua:1:", "one point"},
    {"camera{eye={0, 5, 0}, look_at={0, 0, 0}}", "test.lua:1:", "along up"},
    {"camera{eye={0, 0, 1}, look_at={0, 0, 0}, fov=180}", "test.lua:1:", "below 180"},
    {CAMERA "duration(-1)", "test.lua:2:", "seconds"},
    {CAMERA "background{1, 0/0, 0}", "test.lua:2:", "background"},
    {CAMERA "add(sphere{}:material{texture=image{file='none.png'}})", "test.lua:2:", "image"},
    {CAMERA "include 'none.lua'", "test.lua:2:", "none.lua"},
    {CAMERA "include '/etc/passwd'", "test.lua:2:", "below"},
    {CAMERA "include '../../../../../../../../etc/passwd'", "test.lua:2:", "out of"},
    {CAMERA "x = = 1", "test.lua:2:", "near '='"},
    {CAMERA "error('stop here')", "test.lua:2:", "stop here"},
    {CAMERA "error({})", "test.lua", "no text"},
    {"\033Lua binary", "test.lua", ""},

    /* What would take for ever, or everything. */
    {CAMERA "while true do end", "test.lua:2:", "steps"},
    {CAMERA "while true do pcall(function() while true do end end) end",
     "test.lua:2:", "steps"},
    {CAMERA "local function f() return f() end f()", "test.lua:2:", "steps"},
    {CAMERA "local function f() return 1 + f() end f()", "test.lua", "memory"},
    {CAMERA "local s = string.rep('x', 1e9)", "test.lua", "memory"},
    {CAMERA "local s = ('x'):rep(1e6):rep(1e6)", "test.lua", "memory"},
    {CAMERA "local t = {} while true do t[#t + 1] = {} end", "test.lua", ""},
    {CAMERA "local s = 'x' while true do s = s .. s end", "test.lua", "memory"},
    {CAMERA "string.find(string.rep('a', 5000), string.rep('a-', 20) .. 'b')", "test.lua",
     "steps"},
    {CAMERA "table.move({}, 1, 1e15, 2)", "test.lua", "steps"},
    {CAMERA "table.concat({}, '', 1, 1e15)", "test.lua", "steps"},
    {CAMERA "local t = {} for i = 1, 2e6 do t[i] = -i end table.sort(t)", "test.lua", "steps"},
    {CAMERA "local s = sphere{} for i = 1, 60 do s = union(s, s) end add(s)", "test.lua", ""},
    {CAMERA "local s = sphere{} for i = 1, 500 do s = s:spin{rpm=i} end add(s)",
     "test.lua:2:", "motions"},
    {CAMERA "setmetatable({}, {__gc = function() while true do end end})",
     "test.lua:2:", "__gc"},
    {CAMERA "load('x = 1')()", "test.lua:2:", "load"},
    {CAMERA "require 'os'", "test.lua:2:", "require"},
    {CAMERA "io.open('x')", "test.lua:2:", "io"},
    {CAMERA "os.exit()", "test.lua:2:", "os"},
    {CAMERA "getmetatable(sphere{}).__index.material = nil", "test.lua:2:", ""},
    {CAMERA "string.dump(print)", "test.lua:2:", ""},
    {CAMERA "math.randomseed()", "test.lua:2:", ""},
};

static void refusals(void **state) {
    char why[1024];
    (void)state;
    for (size_t n = 0; n < sizeof refused / sizeof *refused; n++) {
        scene_refusal(refused[n].text, why, sizeof why);
        if (!*why || !strstr(why, refused[n].line) || !strstr(why, refused[n].says))
            fail_msg("'%s' was answered '%s', which lacks '%s' or '%s'", refused[n].text, why,
                     refused[n].line, refused[n].says);
        assert_null(strchr(why, '\n'));
    }
}

/* ---- What scenes become ---- */

static void load(const char *text, wf_scene *scene) {
    scene_job job = {.text = text, .raster = "525i"};
    scene_load(&job, scene);
}

static void instances_and_depth(void **state) {
    wf_scene s;
    (void)state;
    load(CAMERA "local a = union(sphere{}, box{min={0, 0, 0}, max={1, 1, 1}})\n"
                "for i = 1, 6 do add(a:translate{i, 0, 0}:spin{rpm=10}) end\n",
         &s);
    assert_int_equal(s.object_count, 6);
    assert_int_equal(s.solid_count, 12);
    assert_int_equal(s.step_count, 18);
    wf_scene_free(&s);
    load(CAMERA "local s = sphere{}\n"
                "for i = 1, 100000 do s = difference(s, sphere{center={i, 0, 0}}) end add(s)",
         &s);
    assert_int_equal(s.solid_count, 100001);
    assert_int_equal(s.objects[0].most_stack, 2);
    wf_scene_free(&s);
    load(CAMERA "local s = sphere{}\n"
                "for i = 1, 100000 do s = difference(sphere{center={i, 0, 0}}, s) end add(s)",
         &s);
    assert_int_equal(s.objects[0].most_stack, 100001);
    wf_scene_free(&s);
}

/* The innermost placements go into the solid, so that a still scene has nothing to carry. */
static void placements(void **state) {
    wf_scene s;
    (void)state;
    load(CAMERA "add(sphere{radius=2}:translate{1, 2, 3}:rotate{axis={0, 0, 1}, degrees=90})",
         &s);
    assert_int_equal(s.solids[0].op, -1);
    wf_vec p = wf_apply(&s.solids[0].place, (wf_vec){1, 0, 0});
    assert_true(fabs(p.x + 2) < 1e-15 && fabs(p.y - 3) < 1e-15 && fabs(p.z - 3) < 1e-15);
    wf_scene_free(&s);
    load(CAMERA "add(sphere{}:spin{rpm=3}:translate{1, 0, 0}:velocity{1, 2, 3})", &s);
    const wf_op *op = &s.ops[s.solids[0].op];
    assert_int_equal(op->kind, WF_OP_SPIN);
    assert_int_equal(s.ops[op->outer].kind, WF_OP_PLACE);
    assert_int_equal(s.ops[s.ops[op->outer].outer].kind, WF_OP_VELOCITY);
    wf_scene_free(&s);
}

/* In a chain the last word on looks and widths counts; parts of a group keep their own. */
static void looks_and_widths(void **state) {
    wf_scene s;
    (void)state;
    load(CAMERA "local red = sphere{}:material{color={1, 0, 0}}\n"
                "add(red:material{color={0, 0, 1}})\n"
                "add(union(red, sphere{}):material{color={0, 0, 1}})\n",
         &s);
    assert_true(s.materials[s.solids[0].material].color[2] == 1);
    assert_true(s.materials[s.solids[1].material].color[0] == 1);
    assert_true(s.materials[s.solids[2].material].color[2] == 1);
    wf_scene_free(&s);
    load(CAMERA "local wheel = sphere{}:spin{rpm=60}:temporal_width(0.25)\n"
                "add(union(wheel, sphere{}:spin{rpm=6}):velocity{1, 0, 0})\n",
         &s);
    const wf_op *wheel = &s.ops[s.solids[0].op], *other = &s.ops[s.solids[1].op];
    assert_true(wheel->own_width && wheel->width_fields == 0.25);
    assert_true(s.ops[wheel->outer].own_width && s.ops[wheel->outer].width_fields == 0.25);
    assert_false(other->own_width || s.ops[other->outer].own_width);
    wf_scene_free(&s);
}

static void parameters_and_raster(void **state) {
    wf_scene s;
    scene_job job = {.text = CAMERA
                     "assert(param.n == 3 and param.name == 'x' and not param.none)\n"
                     "assert(raster.width == 720 and raster.lines == 486)\n"
                     "assert(math.abs(raster.field_rate - 59.94) < 0.01)\n"
                     "assert(math.random(1000000) == math.tointeger(param.r))\n"
                     "duration(2.5)",
                     .raster = "525i",
                     .params = {{"n", "3"}, {"name", "x"}, {"r", "1"}}};
    char why[1024];
    wf_raster raster;
    (void)state;
    assert_true(wf_raster_parse("525i", &raster, why, sizeof why));
    /* Which number comes first is Lua's affair; that it is always the same one is ours. */
    static char number[32];
    scene_refusal(CAMERA "error('first ' .. math.random(1000000) .. '.')", why, sizeof why);
    assert_int_equal(sscanf(strstr(why, "first "), "first %31[0-9]", number), 1);
    job.params[2][1] = number;
    scene_load(&job, &s);
    assert_true(s.duration_s == 2.5);
    wf_scene_free(&s);
}

/* Tables are walked in the same order in every run; Lua's own is another in each. */
static void pairs_have_an_order(void **state) {
    wf_scene s;
    (void)state;
    load(CAMERA "local t, all = {}, {}\n"
                "for i = 1, 200 do t['k' .. i * 7919 % 1000] = i end\n"
                "t[true], t[-3], t[2.5], t[1], t[20] = 1, 2, 3, 4, 5\n"
                "for k, v in pairs(t) do\n"
                "  assert(t[k] == v)\n"
                "  all[#all + 1] = k\n"
                "  t[k] = nil\n"
                "  t.k999, t.k7 = nil, nil\n"
                "end\n"
                "assert(next(t) == nil and #all > 200 and all[#all] == true)\n"
                "assert(all[1] == -3 and all[2] == 1 and all[3] == 2.5 and all[4] == 20)\n"
                "for i = 6, #all - 1 do assert(all[i - 1] < all[i]) end\n"
                "local list = {}\n"
                "for k, v in pairs{5, 6, 7} do list[#list + 1] = k * v end\n"
                "assert(table.concat(list, ' ') == '5 12 21')\n"
                "local own = setmetatable({}, {__pairs=function() return next, {9} end})\n"
                "for k, v in pairs(own) do assert(k == 1 and v == 9) end\n"
                "assert(not pcall(pairs) and not pcall(pairs, 3))",
         &s);
    wf_scene_free(&s);
}

/* A moved camera is still the camera; a moved light that light. */
static void moved_cameras_and_lights(void **state) {
    wf_scene s;
    (void)state;
    load(CAMERA ":spin{rpm=1}:velocity{1, 0, 0}\n"
                "light{point={0, 1, 0}}:spin{rpm=5}\nlight{direction={0, -1, 0}}",
         &s);
    assert_int_equal(s.ops[s.camera.op].kind, WF_OP_SPIN);
    assert_int_equal(s.ops[s.ops[s.camera.op].outer].kind, WF_OP_VELOCITY);
    assert_int_equal(s.light_count, 2);
    assert_int_equal(s.ops[s.lights[0].op].kind, WF_OP_SPIN);
    assert_int_equal(s.lights[1].op, -1);
    wf_scene_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refusals),
        cmocka_unit_test(instances_and_depth),
        cmocka_unit_test(placements),
        cmocka_unit_test(looks_and_widths),
        cmocka_unit_test(parameters_and_raster),
        cmocka_unit_test(pairs_have_an_order),
        cmocka_unit_test(moved_cameras_and_lights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
