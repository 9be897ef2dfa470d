/* Likely mistakes in scenes: each is answered, with file and line and what to write, and scenes
 * without any are not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tracer/scene/load.h"

#define CAMERA "camera{eye={0, 1, 6}, look_at={0, 0, 0}}\n"
#define VIEW   CAMERA "light{point={4, 8, 5}} "
#define SCENE  VIEW "add(sphere{})\n"

/* What was heard while a scene was loaded. */
typedef struct heard {
    char text[8192];
    int warnings, lines;
} heard;

static void hear(heard *h, const char *text) {
    size_t used = strlen(h->text);
    snprintf(h->text + used, sizeof h->text - used, "%s\n", text);
}

static void warned(void *user, const char *text) {
    ((heard *)user)->warnings++;
    hear(user, text);
}

static void printed(void *user, const char *line) {
    ((heard *)user)->lines++;
    hear(user, line);
}

/* Loads a scene with --set n=3; the error, if there is one, is heard too. */
static bool load(const char *text, heard *h) {
    const wf_param params[] = {{"n", "3"}};
    const wf_load_options options = {.steps = 10000000,
                                     .memory_bytes = (size_t)256 << 20,
                                     .params = params,
                                     .param_count = strstr(text, "param") ? 1 : 0,
                                     .print = printed,
                                     .warn = warned,
                                     .tell_user = h};
    wf_scene scene;
    char why[1024];
    *h = (heard){.warnings = 0};
    bool good =
        wf_scene_load_text(text, strlen(text), "test.lua", &options, &scene, why, sizeof why);
    wf_scene_free(&scene);
    if (!good) hear(h, why);
    return good;
}

/* ---- Warnings ---- */

static const struct {
    const char *text, *says;
} mistakes[] = {
    {SCENE "sphere{}", "test.lua:3: solid: it is not in the picture; add(..)"},
    {SCENE "union(sphere{}, sphere{})", "test.lua:3: solid: it is not in the picture"},
    {SCENE "\nlocal s = sphere{} s:spin{rpm=3} add(s)", "test.lua:4: solid: what a method"},
    {SCENE "local s = sphere{} s:material{color=.3} add(s)", "s = s:material{..}"},
    {SCENE "local s = sphere{} s:temporal_width(1) add(s)", "s = s:temporal_width{..}"},
    {VIEW "add(sphere{}:material{color={255, 0, 0}})", "test.lua:2: material: colors count"},
    {VIEW "add(sphere{}:material{color={255, 128, 0}})", "write {1, 0.22, 0}"},
    {VIEW "add(sphere{}:material{color=1.5})", "reflects more light than it gets"},
    {VIEW "add(sphere{}:material{unlit=true, color={255, 240, 200}})",
     "material: colors count"},
    {VIEW "add(sphere{}:material{texture=checker{{255, 255, 255}, 0}})",
     "checker: colors count"},
    {SCENE "background{135, 206, 235}", "test.lua:3: background: colors count"},
    {CAMERA "light{point={1, 9, 1}, color={255, 255, 255}} add(sphere{})",
     "light: colors count"},
    {SCENE CAMERA, "test.lua:3: camera: there is one already"},
    {SCENE "light{point={0, 9, 0}, inner=10}", "test.lua:3: light: inner= and outer= are of"},
    {VIEW "add(sphere{}:material{index=1.3})", "test.lua:2: material: index= bends what"},
    {VIEW "add(sphere{}:material{shininess=9})", "material: shininess= is of the highlight"},
    {CAMERA "add(sphere{})", "light: there is none, and nothing is unlit; light{point="},
    {VIEW, "nothing is in the picture; add(sphere{})"},
    {SCENE "local x = param.m", "--set: the scene does not read param.n; it reads m"},
    {SCENE "local x = param.nn", "--set: the scene does not read param.n"},
    {SCENE "local x = {param}", "--set: the scene does not read param.n; it reads none"},
    {VIEW "add(sphere{}:material{color=RED})", "test.lua:2: scene: nothing is called RED"},
    {SCENE "local x = sphre",
     "test.lua:3: scene: nothing is called sphre; did you mean sphere?"},
};

static void mistakes_are_told(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof mistakes / sizeof *mistakes; n++) {
        heard h;
        bool good = load(mistakes[n].text, &h);
        if (!good || !h.warnings || !strstr(h.text, mistakes[n].says))
            fail_msg("'%s' was answered '%s', which lacks '%s'", mistakes[n].text, h.text,
                     mistakes[n].says);
    }
}

/* ---- Errors that say what was meant ---- */

static const struct {
    const char *text, *says;
} errors[] = {
    {SCENE "background(0, 0, 1)", "test.lua:3: background: write background{0, 0, 1}"},
    {VIEW "add(sphere{}:translate(1, 2, 3))", "write translate{1, 2, 3}"},
    {VIEW "add(sphere{}:scale(1, 2, 3))", "write scale{1, 2, 3}"},
    {SCENE "duration(4, 3)", "it takes one value, not 2"},
    {VIEW "add(sphere({}, 3))", "it takes one value, not 2"},
    {VIEW "local s = sphere{} add(s.spin{rpm=3})", "write s:spin{..} with a colon"},
    {VIEW "add(cube{})", "did you mean box?"},
    {VIEW "add(ball{})", "did you mean sphere?"},
    {VIEW "add(plane{})", "did you mean halfspace?"},
    {VIEW "add(text{'x'})", "a picture of the text?"},
    {VIEW "add(sphere{pos={0, 0, 0}})", "did you mean center?"},
    {VIEW "camera{pos={0, 0, 0}}", "did you mean eye?"},
    {VIEW "light{pos={0, 0, 0}}", "did you mean point?"},
    {VIEW "add(sphere{}:material{colo"
          "ur=3})",
     "did you mean color?"},
    {VIEW "add(sphere{}:material{ior=3})", "did you mean index (with refract=)?"},
    {VIEW "add(sphere{}:material{transparency=1})", "did you mean refract?"},
    {VIEW "add(sphere{}:material{text=3})", "did you mean texture?"},
    {VIEW "add(sphere{}:color{1, 0, 0})", "did you mean material{color=..}?"},
    {VIEW "add(sphere{}:move{1, 0, 0})", "did you mean translate?"},
    {VIEW "print(math.sqr(1))", "did you mean sqrt?"},
    {VIEW "error('bell \\7')", "bell ?"},
};

static void errors_say_what_was_meant(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof errors / sizeof *errors; n++) {
        heard h;
        bool good = load(errors[n].text, &h);
        if (good || !strstr(h.text, errors[n].says))
            fail_msg("'%s' was answered '%s', which lacks '%s'", errors[n].text, h.text,
                     errors[n].says);
    }
}

/* ---- Silence ---- */

static const char *const clean[] = {
    SCENE,
    VIEW "local s = sphere{} for i = 1, 3 do add(s:translate{i, 0, 0}) end",
    VIEW "local s = sphere{} - box{min={0, 0, 0}, max={1, 1, 1}} add(s:spin{rpm=3})",
    VIEW "add(sphere{}:material{refract=1, index=1.3, specular=.5, shininess=9})",
    CAMERA "light{point={0, 9, 0}, look_at={0, 0, 0}, inner=10} add(sphere{})",
    CAMERA "light{point={1, 2, 3}}:spin{rpm=3} add(sphere{})",
    CAMERA "add(sphere{}:material{unlit=true, color={20, 18, 15}})",
    CAMERA "add(sphere{}:material{ambient=1})",
    CAMERA "light{point={1, 9, 1}, color={400, 400, 400}, fall_off=2} add(sphere{})",
    SCENE "local x = param.n",
    SCENE "for name, value in pairs(param) do assert(name == 'n' and value == 3) end",
    SCENE "count = (count or 0) + 1",
    SCENE "background{1, 1, 1}",
};

static void clean_scenes_are_silent(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof clean / sizeof *clean; n++) {
        heard h;
        if (!load(clean[n], &h) || *h.text)
            fail_msg("'%s' was answered '%s'", clean[n], h.text);
    }
}

/* Mistakes in a loop are told once, and of many kinds the first few. */
static void warnings_are_few(void **state) {
    heard h;
    (void)state;
    assert_true(load(SCENE "for i = 1, 1000 do sphere{}:material{color=255} end", &h));
    assert_int_equal(h.warnings, 2);
    char many[4096] = SCENE;
    for (int n = 0; n < 100; n++) strcat(many, "sphere{}\n");
    assert_true(load(many, &h));
    assert_in_range(h.warnings, 4, 10);
}

/* ---- Printing ---- */

static void prints_are_bounded(void **state) {
    heard h;
    (void)state;
    assert_true(load(SCENE "print('one', 2, nil, true, '\\27[2J')", &h));
    assert_string_equal(h.text, "one\t2\tnil\ttrue\t?[2J\n");
    assert_true(load(SCENE "for i = 1, 1e5 do print(i) end", &h));
    assert_in_range(h.lines, 1000, 10000);
    assert_int_equal(h.warnings, 1);
    assert_true(load(SCENE "print(('x'):rep(1e6))", &h));
    assert_in_range(strlen(h.text), 500, 5000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mistakes_are_told),       cmocka_unit_test(errors_say_what_was_meant),
        cmocka_unit_test(clean_scenes_are_silent), cmocka_unit_test(warnings_are_few),
        cmocka_unit_test(prints_are_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
