/* The OpenColorIO module: the shipped configuration against weft's own conversions, foreign
 * configurations, damaged ones, names that are not there. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "color/space/builtin.h"
#include "color/space/ocio/ocio.h"
#include "color/space/space.h"
#include "convert/base/module.h"

static wf_ocio_open_fn *ocio_open;
static wf_ocio_input_fn *ocio_input;

static int load_module(void **state) {
    (void)state;
    void *symbol;
    weft_error err;
    if (wf_module_symbol("ocio", "wf_ocio_open", "a view", &symbol, &err)) {
        print_message("skipped: %s\n", err.text);
        exit(77);
    }
    memcpy(&ocio_open, &symbol, sizeof ocio_open);
    if (wf_module_symbol("ocio", "wf_ocio_input_open", "a view", &symbol, &err)) return -1;
    memcpy(&ocio_input, &symbol, sizeof ocio_input);
    return 0;
}

static wf_transform opened(const wf_ocio_query *query) {
    wf_transform t;
    char why[900];
    if (!ocio_open(query, &t, why, sizeof why)) fail_msg("%s", why);
    return t;
}

/* Refused, with a reason that has both texts. */
static void assert_refused(const wf_ocio_query *query, const char *says, const char *and_says) {
    wf_transform t;
    char why[900] = "";
    assert_false(ocio_open(query, &t, why, sizeof why));
    if (!strstr(why, says) || !strstr(why, and_says))
        fail_msg("\"%s\" is not about %s, %s", why, says, and_says);
    assert_null(t.apply);
    char small[9];
    assert_false(ocio_open(query, &t, small, sizeof small));
    assert_int_equal(strlen(small), 8);
}

/* ---- The shipped configuration ---- */

enum { PIXELS = 6151 };

static uint64_t random_bits(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static double random_unit(uint64_t *state) {
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

/* Colors that every set of primaries can show, from 2^-18 to 2^6, and runs of equal ones. */
static void random_colors(float rgb[3][PIXELS], uint64_t seed) {
    for (int i = 0; i < PIXELS; i++) {
        double level = exp2(-18 + 24 * random_unit(&seed));
        for (int c = 0; c < 3; c++) {
            double share = 0.6 + 0.4 * random_unit(&seed);
            rgb[c][i] = i % 11 > 7 ? rgb[c][i - 1] : (float)(level * (i % 5 ? share : 1));
        }
    }
}

/* What OpenColorIO's own arithmetic leaves: its HLG table ends at 1, and the linear part of its
 * OETF meets the power law with its slope, and so lies up to 2.5e-4 above Rec.709's. */
static double expected(const char *to, double own, double ocio, double *tolerance) {
    bool rounded = strstr(to, "camera") && strcmp(to, "rec2020-camera") != 0 && ocio < 0.082;
    bool steeper = !strcmp(to, "sRGB") && ocio < 0.041;
    *tolerance = rounded ? 2.5e-4 : steeper ? 1.1e-5 : 5e-6 * fmax(own, 1);
    return !strcmp(to, "rec2100-hlg") ? fmin(own, 1) : own;
}

static double worst;

static void compare(const char *from, const char *to) {
    static float own[3][PIXELS], ocio[3][PIXELS];
    char why[900];
    wf_transform builtin, module = opened(&(wf_ocio_query){.from = from, .to = to});
    assert_true(wf_builtin_transform(from, to, &builtin, why, sizeof why));
    random_colors(own, 20);
    memcpy(ocio, own, sizeof own);
    builtin.apply(builtin.self, own[0], own[1], own[2], PIXELS);
    module.apply(module.self, ocio[0], ocio[1], ocio[2], PIXELS);
    double most = 0;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < PIXELS; i++) {
            double tolerance, got = (double)ocio[c][i];
            double want = expected(to, (double)own[c][i], got, &tolerance);
            if (!(fabs(got - want) <= tolerance))
                fail_msg("%s to %s: %.9g, not %.9g", from, to, got, want);
            most = fmax(most, tolerance > 1e-4 ? 0 : fabs(got - want) / fmax(want, 1));
        }
    worst = fmax(worst, most);
    builtin.free(builtin.self);
    module.free(module.self);
}

static void every_pair(void **state) {
    (void)state;
    const wf_space *from, *to;
    for (size_t i = 0; (from = wf_space_at(i)); i++)
        for (size_t j = 0; (to = wf_space_at(j)); j++)
            if (!from->curve) compare(from->name, to->name);
    print_message("at most %.2g apart\n", worst);
}

/* Displays and their views are the spaces by other names. */
static void every_view(void **state) {
    (void)state;
    const struct {
        const char *display, *view, *to;
    } cases[] = {
        {"rec709", "Video", "rec709"},         {"rec709", "Camera", "rec709-camera"},
        {"rec601-525", "Video", "rec601-525"}, {"rec601-525", "Camera", "rec601-525-camera"},
        {"rec601-625", "Video", "rec601-625"}, {"rec601-625", "Camera", "rec601-625-camera"},
        {"rec2020", "Video", "rec2020"},       {"rec2020", "Camera", "rec2020-camera"},
        {"rec2100-pq", "Video", "rec2100-pq"}, {"rec2100-hlg", "Video", "rec2100-hlg"},
        {"rec2020", NULL, "rec2020"},          {NULL, "Camera", "rec709-camera"},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        float by_view[3] = {0.3f, 0.18f, 0.05f}, by_space[3] = {0.3f, 0.18f, 0.05f};
        wf_transform view =
            opened(&(wf_ocio_query){.display = cases[n].display, .view = cases[n].view});
        wf_transform space = opened(&(wf_ocio_query){.from = "lin_rec709", .to = cases[n].to});
        view.apply(view.self, &by_view[0], &by_view[1], &by_view[2], 1);
        space.apply(space.self, &by_space[0], &by_space[1], &by_space[2], 1);
        for (int c = 0; c < 3; c++) assert_true(fabsf(by_view[c] - by_space[c]) < 1e-6f);
        view.free(view.self);
        space.free(space.self);
    }
}

static void damaged_samples(void **state) {
    (void)state;
    wf_transform t = opened(&(wf_ocio_query){.to = "rec709"});
    float r[] = {NAN, INFINITY, -INFINITY, 0.5f, -4, 0.25f},
          g[] = {0.5f, 0.5f, 0.5f, NAN, 0.5f, 0.25f};
    float b[] = {0.5f, 0.5f, 0.5f, 0.5f, NAN, 0.25f}, half = (float)pow(0.5, 1 / 2.4);
    t.apply(t.self, r, g, b, 6);
    const float *plane[] = {r, g, b};
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 6; i++) assert_true(fabsf(plane[c][i]) < 200);
    assert_true(fabsf(r[0]) < 1e-6f && fabsf(g[3]) < 1e-6f && fabsf(b[4]) < 1e-6f);
    assert_true(fabs((double)r[4] + pow(4, 1 / 2.4)) < 1e-5 && r[2] < -100 && r[1] > 100);
    assert_true(fabsf(g[0] - half) < 1e-5f && fabsf(b[3] - half) < 1e-5f);
    assert_true(r[5] == g[5] && g[5] == b[5]);
    t.free(t.self);
}

/* Lines of any length are the same pixel by pixel. */
static void lengths(void **state) {
    (void)state;
    static float all[3][PIXELS], some[3][PIXELS];
    wf_transform t = opened(&(wf_ocio_query){.from = "ACEScg", .to = "rec601-525"});
    random_colors(all, 5);
    memcpy(some, all, sizeof all);
    t.apply(t.self, all[0], all[1], all[2], PIXELS);
    for (size_t start = 0, count = 0; start < PIXELS;
         start += count, count = (count + 37) % 700) {
        if (count > PIXELS - start) count = PIXELS - start;
        t.apply(t.self, some[0] + start, some[1] + start, some[2] + start, count);
    }
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < PIXELS; i++)
            assert_true(fabsf(all[c][i] - some[c][i]) <= 1e-6f * all[c][i]);
    t.free(t.self);
}

typedef struct task {
    const wf_transform *transform;
    float rgb[3][PIXELS];
} task;

static void *run_task(void *arg) {
    task *t = arg;
    t->transform->apply(t->transform->self, t->rgb[0], t->rgb[1], t->rgb[2], PIXELS);
    return NULL;
}

static void one_transform_many_threads(void **state) {
    (void)state;
    enum { THREADS = 8 };
    static task tasks[THREADS];
    pthread_t thread[THREADS];
    wf_transform t = opened(&(wf_ocio_query){.to = "rec2100-hlg"});
    for (int i = 0; i < THREADS; i++) {
        tasks[i].transform = &t;
        random_colors(tasks[i].rgb, 77);
        assert_int_equal(pthread_create(&thread[i], NULL, run_task, &tasks[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) pthread_join(thread[i], NULL);
    for (int i = 1; i < THREADS; i++)
        assert_memory_equal(tasks[i].rgb, tasks[0].rgb, sizeof tasks[0].rgb);
    t.free(t.self);
}

/* A linear result keeps its sign. */
static void light_may_be_negative(void **state) {
    (void)state;
    float rgb[3] = {-0.25f, 0.5f, 0.25f};
    wf_transform t = opened(&(wf_ocio_query){.from = "lin_rec709", .to = "Raw"});
    t.apply(t.self, &rgb[0], &rgb[1], &rgb[2], 1);
    assert_true(rgb[0] == -0.25f && rgb[1] == 0.5f && rgb[2] == 0.25f);
    t.free(t.self);
}

/* ---- Refusals ---- */

static void names_that_are_not_there(void **state) {
    (void)state;
    assert_refused(&(wf_ocio_query){.to = "rec710"}, "no color space \"rec710\"",
                   "rec601-525-camera");
    assert_refused(&(wf_ocio_query){.from = "lin", .to = "rec709"}, "no color space \"lin\"",
                   "lin_p3d65");
    assert_refused(&(wf_ocio_query){.display = "tv"}, "no display \"tv\"",
                   "rec601-525, rec601-625");
    assert_refused(&(wf_ocio_query){.display = "rec709", .view = "x"},
                   "no view of rec709 \"x\"", "Video, Camera, Raw");
    assert_refused(&(wf_ocio_query){.to = "rec709", .look = "x"}, "no look \"x\"",
                   "there are none");
    assert_refused(&(wf_ocio_query){.to = "rec709", .display = "rec709"}, "--to",
                   "leave one out");
    assert_refused(&(wf_ocio_query){0}, "--to", "--display");
}

static void write_config(char *path, const char *text, size_t length) {
    const char *folder = getenv("TMPDIR");
    snprintf(path, 4096, "%s/test-ocio-%d.ocio", folder ? folder : "/tmp", (int)getpid());
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, length, file), length);
    fclose(file);
}

static void bad_files(void **state) {
    (void)state;
    const struct {
        const char *text, *says;
    } cases[] = {
        {"", "oading"},
        {"ocio_profile_version: 2\nroles: [", "oading"},
        {"ocio_profile_version: 2.9\n", "2.9"},
        {"nonsense", "oading"},
        {"\xff\xfe\x00\x01", ""},
    };
    char path[4096];
    assert_refused(&(wf_ocio_query){.config = "/nonexistent.ocio", .to = "rec709"},
                   "/nonexistent.ocio", "");
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        write_config(path, cases[n].text, strlen(cases[n].text));
        assert_refused(&(wf_ocio_query){.config = path, .to = "rec709"}, path, cases[n].says);
    }
    unlink(path);
}

static char *shipped_text(size_t *length) {
    char path[4096];
    const char *source = getenv("WEFT_SOURCE");
    if (!source) return NULL;
    snprintf(path, sizeof path, "%s/color/weft.ocio", source);
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    char *text = malloc(1 << 20);
    assert_non_null(text);
    *length = fread(text, 1, 1 << 20, file);
    fclose(file);
    return text;
}

/* Cut off or with a bit turned, a configuration opens or is refused, and what opens can be
 * used. */
static void damaged_files(void **state) {
    (void)state;
    size_t length;
    char path[4096], why[900], *text = shipped_text(&length);
    if (!text) {
        print_message("skipped: WEFT_SOURCE is unset\n");
        skip();
    }
    uint64_t seed = 9;
    int refused = 0;
    for (int n = 0; n < 120; n++) {
        size_t cut = n % 2 ? length : (size_t)(random_unit(&seed) * (double)length);
        char *bad = text + (size_t)(random_unit(&seed) * (double)length), kept = *bad;
        if (n % 2) *bad = (char)(*bad ^ 1 << random_bits(&seed) % 8);
        write_config(path, text, cut);
        *bad = kept;
        wf_transform t;
        float rgb[3] = {0.2f, 0.3f, 0.4f};
        if (ocio_open(&(wf_ocio_query){.config = path, .to = "rec2020"}, &t, why, sizeof why)) {
            t.apply(t.self, &rgb[0], &rgb[1], &rgb[2], 1);
            t.free(t.self);
        } else {
            refused++;
            assert_non_null(strstr(why, path));
        }
    }
    assert_true(refused > 30);
    unlink(path);
    free(text);
}

/* The file is the configuration that is compiled in. */
static void file_and_module_agree(void **state) {
    (void)state;
    size_t length;
    char path[4096], *text = shipped_text(&length);
    if (!text) {
        print_message("skipped: WEFT_SOURCE is unset\n");
        skip();
    }
    write_config(path, text, length);
    free(text);
    float rgb[2][3] = {{0.7f, 0.1f, 0.02f}, {0.7f, 0.1f, 0.02f}};
    for (int i = 0; i < 2; i++) {
        wf_transform t =
            opened(&(wf_ocio_query){.config = i ? path : NULL, .to = "rec601-625-camera"});
        t.apply(t.self, &rgb[i][0], &rgb[i][1], &rgb[i][2], 1);
        t.free(t.self);
    }
    assert_memory_equal(rgb[0], rgb[1], sizeof rgb[0]);
    unlink(path);
}

/* ---- Inputs ---- */

static wf_ocio_input input_of(const char *config, const char *from) {
    wf_ocio_input input;
    char why[900];
    if (!ocio_input(config, from, &input, why, sizeof why)) fail_msg("%s", why);
    return input;
}

/* Spaces of the shipped configuration are decoded as weft does it by itself. */
static void shipped_inputs(void **state) {
    (void)state;
    const wf_space *space;
    for (size_t i = 0; (space = wf_space_at(i)); i++) {
        wf_ocio_input input = input_of(NULL, space->name);
        assert_int_equal(input.decode.apply != NULL, space->curve != NULL);
        assert_true(input.has_ap0);
        assert_string_equal(input.light_space, space->curve ? "lin_rec709" : space->name);
        if (!space->curve) continue;
        wf_transform own;
        char why[900];
        assert_true(wf_builtin_transform(space->name, "lin_rec709", &own, why, sizeof why));
        float a[3] = {0.75f, 0.4f, 0.3f}, b[3] = {0.75f, 0.4f, 0.3f};
        own.apply(own.self, &a[0], &a[1], &a[2], 1);
        input.decode.apply(input.decode.self, &b[0], &b[1], &b[2], 1);
        for (int c = 0; c < 3; c++)
            if (fabsf(a[c] - b[c]) > 2e-4f)
                fail_msg("%s: %g, %g", space->name, (double)a[c], (double)b[c]);
        own.free(own.self);
        input.decode.free(input.decode.self);
    }
}

#define CONFIG(spaces)                                                                         \
    "ocio_profile_version: 2\nroles: {scene_linear: lin, default: lin}\n"                      \
    "file_rules:\n  - !<Rule> {name: Default, colorspace: lin}\n"                              \
    "displays:\n  d:\n    - !<View> {name: v, colorspace: out}\n"                              \
    "looks:\n  - !<Look> {name: l, process_space: out}\n"                                      \
    "colorspaces:\n  - !<ColorSpace> {name: lin}\n" spaces
#define SPACE(name, to_or_from, transform)                                                     \
    "  - !<ColorSpace>\n    name: " name "\n    " to_or_from "_scene_reference: " transform "\n"
#define NAN_MATRIX "!<MatrixTransform> {matrix: [.nan,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}"

/* Spaces that are made of themselves, or that give no numbers. */
static void hostile_spaces(void **state) {
    (void)state;
    const struct {
        const char *text, *says;
    } cases[] = {
        {CONFIG(SPACE("out", "from", "!<ColorSpaceTransform> {src: lin, dst: out}")),
         "color space \"out\" is made of itself"},
        {CONFIG(SPACE("out", "to", "!<ColorSpaceTransform> {src: out, dst: lin}")),
         "color space \"out\" is made of itself"},
        {CONFIG(SPACE("out", "from", "!<ColorSpaceTransform> {src: lin, dst: other}")
                    SPACE("other", "from", "!<ColorSpaceTransform> {src: lin, dst: out}")),
         "is made of itself"},
        {CONFIG(SPACE("out", "from",
                      "!<GroupTransform> {children: [!<LookTransform> {src: lin, dst: lin, "
                      "looks: l}]}")),
         "is made of itself"},
        {CONFIG(SPACE("out", "from", NAN_MATRIX)), "color space \"out\""},
        {CONFIG(SPACE("out", "from", "!<MatrixTransform> {offset: [0, .inf, 0, 0]}")),
         "color space \"out\""},
    };
    char path[4096];
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        write_config(path, cases[n].text, strlen(cases[n].text));
        assert_refused(&(wf_ocio_query){.config = path, .from = "lin", .to = "out"}, path,
                       cases[n].says);
        assert_refused(&(wf_ocio_query){.config = path, .display = "d", .view = "v"}, path,
                       "\"out\"");
        wf_ocio_input input;
        char why[900];
        assert_false(ocio_input(path, "out", &input, why, sizeof why));
        assert_non_null(strstr(why, "\"out\""));
    }
    unlink(path);
}

/* ---- A foreign configuration ---- */

static void aces_configuration(void **state) {
    (void)state;
    const char *shared = getenv("WEFT_SHARED");
    char path[4096];
    snprintf(path, sizeof path, "%s/data/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio",
             shared ? shared : "");
    if (!shared || access(path, R_OK)) {
        print_message("skipped: WEFT_SHARED has no data/ocio\n");
        skip();
    }
    wf_ocio_query q = {.config = path,
                       .display = "Rec.1886 Rec.709 - Display",
                       .view = "ACES 1.0 - SDR Video"};
    float r = 0.18f, g = 0.18f, b = 0.18f, plain = r;
    wf_transform t = opened(&q);
    t.apply(t.self, &r, &g, &b, 1);
    t.free(t.self);
    assert_true(fabsf(r - g) < 1e-4f && fabsf(g - b) < 1e-4f);
    assert_true(fabs((double)r - pow(0.1, 0.9811 / 2.4)) <
                2e-3); /* 10 % of white, for dim surroundings */
    r = g = b = plain;
    q.look = "ACES 1.3 Reference Gamut Compression";
    t = opened(&q);
    t.apply(t.self, &r, &g, &b, 1);
    t.free(t.self);
    assert_true(fabs((double)r - pow(0.1, 0.9811 / 2.4)) < 2e-3);
    /* ACEScg to linear Rec.709 is weft's own matrix, and keeps its sign */
    float own[3] = {0.9f, 0.1f, 0.05f}, theirs[3] = {0.9f, 0.1f, 0.05f};
    char why[900];
    wf_transform builtin;
    assert_true(wf_builtin_transform("ACEScg", "lin_rec709", &builtin, why, sizeof why));
    t = opened(&(wf_ocio_query){.config = path, .to = "Linear Rec.709 (sRGB)"});
    t.apply(t.self, &theirs[0], &theirs[1], &theirs[2], 1);
    builtin.apply(builtin.self, &own[0], &own[1], &own[2], 1);
    for (int c = 0; c < 3; c++) assert_true(fabsf(own[c] - theirs[c]) < 2e-6f);
    assert_true(own[1] < 0);
    builtin.free(builtin.self);
    t.free(t.self);
    wf_ocio_input input = input_of(path, "sRGB - Texture");
    assert_string_equal(input.light_space, "ACEScg");
    assert_true(input.has_ap0);
    r = g = b = 128 / 255.0f;
    input.decode.apply(input.decode.self, &r, &g, &b, 1);
    assert_true(fabs((double)r - pow((128 / 255.0 + 0.055) / 1.055, 2.4)) < 1e-5);
    input.decode.free(input.decode.self);
    assert_null(input_of(path, "Linear Rec.709 (sRGB)").decode.apply);
    assert_null(input_of(path, NULL).decode.apply);
    assert_refused(&(wf_ocio_query){.config = path, .to = "rec709"},
                   "no color space \"rec709\"", "ACEScct");
    assert_refused(&(wf_ocio_query){.config = path, .to = "ACEScg", .look = "+x, y"},
                   "no look \"x\"", "Reference Gamut Compression");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pair),
        cmocka_unit_test(every_view),
        cmocka_unit_test(damaged_samples),
        cmocka_unit_test(lengths),
        cmocka_unit_test(one_transform_many_threads),
        cmocka_unit_test(light_may_be_negative),
        cmocka_unit_test(names_that_are_not_there),
        cmocka_unit_test(bad_files),
        cmocka_unit_test(damaged_files),
        cmocka_unit_test(file_and_module_agree),
        cmocka_unit_test(shipped_inputs),
        cmocka_unit_test(hostile_spaces),
        cmocka_unit_test(aces_configuration),
    };
    return cmocka_run_group_tests(tests, load_module, NULL);
}
