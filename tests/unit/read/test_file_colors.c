/* What a file's samples are taken for, by all that files can say of their colors. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "convert/read/file_colors.h"

#define AP1                                                                                    \
    .has_chromaticities = true,                                                                \
    .chromaticities = {0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767}
#define ODD                                                                                    \
    .has_chromaticities = true,                                                                \
    .chromaticities = {0.65, 0.33, 0.28, 0.61, 0.16, 0.05, 0.3127, 0.329}

/* The space and the transfer that are told, and whether the file said so. */
static const struct {
    wf_color_said said;
    const char *space, *transfer, *space_by, *transfer_by;
} rows[] = {
    {{.floats = true}, "lin_rec709", "linear", "default", "default"},
    {{.floats = true, AP1}, "ACEScg", "linear", "file", "default"},
    {{.floats = true, ODD},
     "primaries 0.65 0.33, 0.28 0.61, 0.16 0.05, white 0.3127 0.329",
     "linear",
     "file",
     "default"},
    {{.floats = true, .space = "ACEScg"}, "ACEScg", "linear", "file", "file"},
    {{.floats = true, .space = "lin_rec2020", AP1}, "lin_rec2020", "linear", "file", "file"},
    {{.floats = true, .space = "rec709"}, "rec709", "BT.1886", "file", "file"},
    {{.floats = true, .interop = "lin_ap1_scene"}, "ACEScg", "linear", "file", "file"},
    {{.floats = true, .interop = "lin_ap0_scene", AP1}, "ACES2065-1", "linear", "file", "file"},
    {{.floats = true, .interop = "srgb_rec709_scene"}, "sRGB", "sRGB", "file", "file"},
    {{.floats = true, .interop = "pq_rec2020_display"}, "rec2100-pq", "PQ", "file", "file"},
    {{.floats = true, .interop = "lin_p3d65_scene"}, "lin_p3d65", "linear", "file", "file"},
    {{.floats = true, .interop = "ACEScg"}, "ACEScg", "linear", "file", "file"},
    {{.floats = true, .interop = "unknown", AP1}, "ACEScg", "linear", "file", "default"},
    {{.bits = 8}, "sRGB", "sRGB", "default", "default"},
    {{.bits = 8, .srgb = true, .gamma = 0.5}, "sRGB", "sRGB", "file", "file"},
    {{.bits = 8, .primaries = 1, .transfer = 1, .srgb = true},
     "rec709",
     "BT.1886",
     "file",
     "file"},
    {{.bits = 16, .primaries = 9, .transfer = 16}, "rec2100-pq", "PQ", "file", "file"},
    {{.bits = 16, .primaries = 9, .transfer = 18}, "rec2100-hlg", "HLG", "file", "file"},
    {{.bits = 8, .primaries = 12, .transfer = 13}, "P3-D65 primaries", "sRGB", "file", "file"},
    {{.bits = 8, .primaries = 2, .transfer = 2}, "sRGB", "sRGB", "default", "default"},
    {{.bits = 8, .gamma = 0.45455}, "Rec.709 primaries", "gamma 2.2", "default", "file"},
    {{.bits = 16, .gamma = 1, AP1}, "ACEScg", "linear", "file", "file"},
    {{.dpx = true, .dpx_transfer = 2}, "lin_rec709", "linear", "default", "file"},
    {{.dpx = true, .dpx_transfer = 6, .dpx_colorimetric = 6},
     "rec709",
     "BT.1886",
     "file",
     "file"},
    {{.dpx = true, .dpx_transfer = 7, .dpx_colorimetric = 7},
     "rec601-625",
     "BT.1886",
     "file",
     "file"},
    {{.dpx = true, .dpx_transfer = 8, .dpx_colorimetric = 8},
     "rec601-525",
     "BT.1886",
     "file",
     "file"},
    {{.dpx = true, .dpx_transfer = 0, .space = "rec2100-pq"},
     "rec2100-pq",
     "PQ",
     "file",
     "file"},
};

static void what_is_taken(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        wf_file_colors colors = wf_file_colors_of(&rows[i].said);
        wf_taken_list list = {0};
        wf_file_colors_take(&colors, &list);
        const char *got[] = {list.row[0].value, list.row[1].value, list.row[0].reason,
                             list.row[1].reason};
        const char *want[] = {rows[i].space, rows[i].transfer, rows[i].space_by,
                              rows[i].transfer_by};
        for (int k = 0; k < 4; k++)
            if (strcmp(got[k], want[k])) fail_msg("row %zu: %s, not %s", i, got[k], want[k]);
        assert_string_equal(colors.trouble, "");
        assert_string_equal(colors.warning, "");
        assert_true(wf_chromaticities_usable(&colors.primaries));
    }
}

static void what_cannot_be_known(void **state) {
    (void)state;
    const wf_color_said cases[] = {{.dpx = true, .dpx_transfer = 1},
                                   {.dpx = true, .dpx_transfer = 3},
                                   {.dpx = true, .dpx_transfer = 11},
                                   {.bits = 8, .primaries = 1, .transfer = 9},
                                   {.bits = 8, .primaries = 1, .transfer = 77}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_file_colors colors = wf_file_colors_of(&cases[i]);
        assert_non_null(strstr(colors.trouble, "--from"));
    }
}

static void what_may_be_wrong(void **state) {
    (void)state;
    const struct {
        wf_color_said said;
        const char *says;
    } cases[] = {
        {{.floats = true, .space = "Arri LogC"}, "\"Arri LogC\""},
        {{.floats = true, .interop = "data"}, "\"data\""},
        {{.floats = true, .has_chromaticities = true}, "no primaries"},
        {{.floats = true,
          .has_chromaticities = true,
          .chromaticities = {NAN, 1, 0.3, 0.6, 0.15, 0.06, 0.3, 0.3}},
         "no primaries"},
        {{.bits = 8, .profile = "Display P3"}, "\"Display P3\""},
        {{.dpx = true, .dpx_transfer = 0}, "video"},
        {{.dpx = true, .dpx_transfer = 255}, "video"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_file_colors colors = wf_file_colors_of(&cases[i].said);
        if (!strstr(colors.warning, cases[i].says)) fail_msg("%zu: %s", i, colors.warning);
        assert_non_null(strstr(colors.warning, "--from"));
        assert_true(wf_chromaticities_usable(&colors.primaries));
    }
}

/* Narrow codes of a PNG: 16 is black and 235 white, of any depth. */
static void narrow_range(void **state) {
    (void)state;
    for (int bits = 8; bits <= 16; bits += 8) {
        const wf_color_said said = {
            .bits = bits, .primaries = 1, .transfer = 1, .narrow = true};
        const wf_file_colors colors = wf_file_colors_of(&said);
        double step = exp2(bits - 8), codes = exp2(bits) - 1;
        double black =
            (double)colors.decoding.scale * 16 * step / codes + (double)colors.decoding.offset;
        double white =
            (double)colors.decoding.scale * 235 * step / codes + (double)colors.decoding.offset;
        assert_true(fabs(black) < 1e-6 && fabs(white - 1) < 1e-6);
        assert_false(wf_file_colors_same(
            &colors, &(wf_file_colors){.primaries = colors.primaries,
                                       .decoding = wf_decoding_of(&wf_curve_bt1886)}));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_taken),
        cmocka_unit_test(what_cannot_be_known),
        cmocka_unit_test(what_may_be_wrong),
        cmocka_unit_test(narrow_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
