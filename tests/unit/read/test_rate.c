/* How many pictures a second there are: what headers say of it in every type, and the steps of
 * numbers that it is divided by. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include <openexr.h>

#include "convert/read/rate.h"
#include "convert/read/source.h"

#define LENGTH(array) (sizeof(array) / sizeof *(array))

/* ---- Files ---- */

/* An attribute of a header, and of which type it is written. */
typedef struct said {
    exr_attribute_type_t type; /* EXR_ATTR_UNKNOWN: it is left out */
    double value;              /* of a float, a double or a whole number */
    int32_t num, den;          /* of a rational and of two whole numbers */
    const char *text;
} said;

static int set(exr_context_t exr, const char *name, const said *a) {
    const exr_attr_rational_t ratio = {a->num, (uint32_t)a->den};
    const exr_attr_v2i_t pair = {.x = a->num, .y = a->den};
    switch (a->type) {
    case EXR_ATTR_RATIONAL:
        return exr_attr_set_rational(exr, 0, name, &ratio);
    case EXR_ATTR_V2I:
        return exr_attr_set_v2i(exr, 0, name, &pair);
    case EXR_ATTR_INT:
        return exr_attr_set_int(exr, 0, name, (int32_t)a->value);
    case EXR_ATTR_FLOAT:
        return exr_attr_set_float(exr, 0, name, (float)a->value);
    case EXR_ATTR_DOUBLE:
        return exr_attr_set_double(exr, 0, name, a->value);
    case EXR_ATTR_STRING:
        return exr_attr_set_string(exr, 0, name, a->text);
    default:
        return EXR_ERR_SUCCESS;
    }
}

/* A picture of one pixel with framesPerSecond and weft:subframeRate as they are said. */
static void write_picture(const char *path, const said *frames, const said *subframes) {
    exr_context_t exr;
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    const uint16_t pixel[3] = {0x3800, 0x3800, 0x3800};
    int wrong = exr_start_write(&exr, path, EXR_WRITE_FILE_DIRECTLY, &how);
    wrong = wrong || exr_add_part(exr, "rgb", EXR_STORAGE_SCANLINE, NULL) ||
            exr_initialize_required_attr_simple(exr, 0, 1, 1, EXR_COMPRESSION_NONE);
    for (const char *name = "BGR"; *name; name++)
        wrong = wrong || exr_add_channel(exr, 0, (char[]){*name, 0}, EXR_PIXEL_HALF,
                                         EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    wrong = wrong || set(exr, "framesPerSecond", frames) ||
            set(exr, "weft:subframeRate", subframes) || exr_write_header(exr) ||
            exr_write_scanline_chunk(exr, 0, 0, pixel, sizeof pixel);
    assert_false(wrong);
    assert_int_equal(exr_finish(&exr), EXR_ERR_SUCCESS);
}

static wf_image_info info_of(const said *frames, const said *subframes) {
    char path[64];
    wf_subframe *subframe;
    weft_error err;
    const wf_source_options options = {.max_memory_bytes = 1 << 20};
    snprintf(path, sizeof path, "/tmp/rate.%d.exr", (int)getpid());
    write_picture(path, frames, subframes);
    if (wf_subframe_open(path, -1, &options, &subframe, &err)) fail_msg("%s", err.text);
    wf_image_info info = *wf_subframe_info(subframe);
    wf_subframe_close(subframe);
    unlink(path);
    return info;
}

/* ---- What headers say ---- */

#define RATIONAL(n, d)                                                                         \
    { .type = EXR_ATTR_RATIONAL, .num = n, .den = d }
#define V2I(n, d)                                                                              \
    { .type = EXR_ATTR_V2I, .num = n, .den = d }
#define INT(v)                                                                                 \
    { .type = EXR_ATTR_INT, .value = v }
#define FLOAT(v)                                                                               \
    { .type = EXR_ATTR_FLOAT, .value = v }
#define DOUBLE(v)                                                                              \
    { .type = EXR_ATTR_DOUBLE, .value = v }
#define TEXT(t)                                                                                \
    { .type = EXR_ATTR_STRING, .text = t }
static const said nothing = {.type = EXR_ATTR_UNKNOWN};

static void rates_of_every_type(void **state) {
    (void)state;
    const struct {
        said said;
        wf_rational rate;
    } cases[] = {
        {RATIONAL(24, 1), {24, 1}},
        {RATIONAL(48000, 2002), {24000, 1001}},
        {V2I(24, 1), {24, 1}},
        {V2I(30000, 1001), {30000, 1001}},
        {INT(25), {25, 1}},
        {FLOAT(24), {24, 1}},
        {FLOAT(23.976), {24000, 1001}},
        {FLOAT(23.98), {24000, 1001}},
        {FLOAT(24000.0 / 1001), {24000, 1001}},
        {FLOAT(29.97), {30000, 1001}},
        {FLOAT(59.94), {60000, 1001}},
        {FLOAT(12.5), {25, 2}},
        {FLOAT(480000.0 / 1001), {480000, 1001}},
        {DOUBLE(50.0 / 3), {50, 3}},
        {DOUBLE(119.88), {120000, 1001}},
        {DOUBLE(1000), {1000, 1}},
        {TEXT("24"), {24, 1}},
        {TEXT("24000/1001"), {24000, 1001}},
        {TEXT("23.976"), {24000, 1001}},
        {TEXT(" 25 fps"), {25, 1}},
        {TEXT("12.5fps "), {25, 2}},
        {FLOAT(0.001), {1, 1000}},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        wf_image_info info = info_of(&cases[i].said, &nothing);
        if (!wf_ratio_equal(info.rate, cases[i].rate) || info.counts_files || *info.no_rate)
            fail_msg("case %zu: %g %s", i, wf_ratio_value(info.rate), info.no_rate);
        assert_true(wf_ratio_equal(info.frames, cases[i].rate));
        info = info_of(&(said)INT(24), &cases[i].said);
        assert_true(wf_ratio_equal(info.rate, cases[i].rate) && info.counts_files);
        assert_true(wf_ratio_equal(info.frames, wf_ratio(24, 1)));
    }
}

static const wf_sequence plain = {.step = {1, 1}, .number_step = {1, 1}};

static void absurd_rates_are_refused(void **state) {
    (void)state;
    const struct {
        said said;
        const char *word;
    } cases[] = {
        {RATIONAL(24, 0), "framesPerSecond 24/0"},
        {RATIONAL(-24, 1), "-24/1"},
        {V2I(0, 1), "0/1"},
        {V2I(2000000, 1), "2000000/1"},
        {INT(-1), "-1"},
        {INT(0), "0"},
        {FLOAT(NAN), "nan"},
        {FLOAT(1e30), "1e+30"},
        {DOUBLE(INFINITY), "inf"},
        {DOUBLE(-24), "-24"},
        {TEXT("fast"), "'fast'"},
        {TEXT("24 fields"), "'24 f"},
        {TEXT(""), "''"},
        {DOUBLE(1e-5), "1e-05"},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        weft_error err = {""};
        wf_rational rate = {0, 0};
        wf_image_info info = info_of(&cases[i].said, &nothing);
        assert_int_equal(wf_rate_of_files("shot", &info, &plain, &rate, &err), WEFT_FAILED);
        if (!strstr(err.text, cases[i].word) || !strstr(err.text, "--subframe-rate"))
            fail_msg("no '%s' in: %s", cases[i].word, err.text);
    }
    weft_error err;
    wf_rational rate;
    wf_image_info info = info_of(&nothing, &nothing);
    assert_int_equal(wf_rate_of_files("shot", &info, &plain, &rate, &err), WEFT_USAGE);
    wf_sequence fine = {.step = {1, 1}, .number_step = {1, 1000000000}};
    info = info_of(&(said)INT(24), &nothing);
    assert_int_equal(wf_rate_of_files("shot", &info, &fine, &rate, &err), WEFT_FAILED);
}

static void the_last_rates_that_can_be(void **state) {
    (void)state;
    const struct {
        wf_rational rate;
        weft_status status;
    } cases[] = {{{1, 1000}, WEFT_OK},
                 {{1, 1001}, WEFT_FAILED},
                 {{1000000, 1}, WEFT_OK},
                 {{1000001, 1}, WEFT_FAILED}};
    for (size_t i = 0; i < LENGTH(cases); i++) {
        const wf_image_info info = {.rate = cases[i].rate};
        wf_rational rate;
        assert_int_equal(wf_rate_of_files("shot", &info, &plain, &rate, NULL), cases[i].status);
    }
}

/* ---- Steps ---- */

static void rates_are_divided_by_steps(void **state) {
    (void)state;
    const struct {
        wf_rational step, number_step, frames, files; /* the rate by either attribute */
    } cases[] = {
        {{1, 1}, {1, 1}, {24, 1}, {24, 1}}, {{1, 1}, {1, 4}, {96, 1}, {24, 1}},
        {{1, 1}, {4, 1}, {6, 1}, {24, 1}},  {{2, 1}, {1, 2}, {48, 1}, {12, 1}},
        {{1, 1}, {1, 3}, {72, 1}, {24, 1}}, {{4, 1}, {1, 1}, {24, 1}, {6, 1}},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        const wf_sequence s = {.step = cases[i].step, .number_step = cases[i].number_step};
        const wf_image_info by_frames = {.rate = {24, 1}, .frames = {24, 1}};
        const wf_image_info by_files = {.rate = {24, 1}, .counts_files = true};
        wf_rational rate;
        assert_int_equal(wf_rate_of_files("shot", &by_frames, &s, &rate, NULL), WEFT_OK);
        assert_true(wf_ratio_equal(rate, cases[i].frames));
        assert_int_equal(wf_rate_of_files("shot", &by_files, &s, &rate, NULL), WEFT_OK);
        assert_true(wf_ratio_equal(rate, cases[i].files));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_of_every_type),
        cmocka_unit_test(absurd_rates_are_refused),
        cmocka_unit_test(the_last_rates_that_can_be),
        cmocka_unit_test(rates_are_divided_by_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
