/* Deliveries: the table against what the containers take, the lines that codecs drop and add,
 * and what files call colors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "convert/job/colors.h"
#include "convert/job/delivery.h"

static wf_raster raster_of(const char *name) {
    char why[256];
    wf_raster raster;
    if (!wf_raster_parse(name, &raster, why, sizeof why)) fail_msg("%s", why);
    return raster;
}

static const wf_delivery *find(const char *codec, const char *ending) {
    const wf_delivery *d;
    for (size_t i = 0; (d = wf_delivery_at(i)); i++)
        if (!strcmp(d->kind.name, codec) && !strcmp(d->kind.endings, ending)) return d;
    fail_msg("no %s in .%s", codec, ending);
    return NULL;
}

static const wf_delivery_form *form_of(const wf_delivery *d, const wf_raster *raster, int bits,
                                       weft_error *err) {
    wf_output_options options = {.output = "x", .raster = raster, .bits = bits};
    return wf_delivery_form_for(d, &options, err);
}

/* ---- Lines ---- */

/* Picture lines that are dropped or added above move both fields' first lines. Where
 * rasters begin is in filters/README.md; where those of codecs do, in SMPTE ST 314 (DV) and
 * ST 356 (D-10). */
static void lines_of_the_file(void **state) {
    (void)state;
    static const struct {
        const char *codec, *ending, *raster;
        int lines, line1, line2;
        bool top_first;
    } rows[] = {
        {"dvcpro50", "mov", "525i", 480, 23, 285, false},
        {"dvcpro50", "mov", "525i-imx", 480, 23, 285, false},
        {"dvcpro50", "mxf", "525i-dv", 480, 23, 285, false},
        {"dvcpro50", "mxf", "625i-dv-wide", 576, 23, 335, false},
        {"imx50", "mxf", "625i", 608, 7, 320, true},
        {"imx50", "mxf", "525i-imx", 512, 7, 270, true},
        {"xdcamhd422", "mxf", "1080i50", 1080, 21, 584, true},
        {"v210", "mov", "525i", 486, 21, 283, false},
        {"ffv1", "mkv", "525i-rp202", 480, 23, 286, true},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const wf_delivery *d = find(rows[i].codec, rows[i].ending);
        wf_raster raster = raster_of(rows[i].raster);
        weft_error err = {""};
        const wf_delivery_form *form = form_of(d, &raster, d->kind.default_bits, &err);
        if (!form) fail_msg("%s", err.text);
        wf_raster kept = wf_delivery_raster(form, &raster);
        assert_int_equal(kept.lines, rows[i].lines);
        assert_int_equal(kept.line1, rows[i].line1);
        assert_int_equal(kept.line2, rows[i].line2);
        assert_int_equal(kept.top_first, rows[i].top_first);
        assert_true(wf_raster_map_valid(kept.line1, kept.line2, kept.total_lines));
    }
}

/* Whatever a codec makes of a named raster, the order is the one that its line map gives. */
static void order_follows_from_the_map(void **state) {
    (void)state;
    const wf_delivery *d;
    const wf_raster *r;
    int taken = 0;
    for (size_t i = 0; (d = wf_delivery_at(i)); i++)
        for (size_t n = 0; (r = wf_raster_at(n)); n++) {
            const wf_delivery_form *form = form_of(d, r, d->kind.default_bits, NULL);
            if (!form || r->scan != WF_INTERLACED) continue;
            wf_raster kept = wf_delivery_raster(form, r);
            bool top = wf_raster_map_top_first(kept.line1, kept.line2, kept.total_lines);
            if (kept.top_first != top) fail_msg("%s of %s", d->kind.name, r->name);
            taken++;
        }
    assert_true(taken > 20);
}

/* ---- The table ---- */

static void every_codec_takes_some_raster(void **state) {
    (void)state;
    const wf_delivery *d;
    const wf_raster *r;
    for (size_t i = 0; (d = wf_delivery_at(i)); i++)
        for (int bits = 8; bits <= 16; bits++) {
            int taken = 0;
            if (!(d->kind.bits_mask & 1u << bits)) continue;
            for (size_t n = 0; (r = wf_raster_at(n)); n++)
                taken += form_of(d, r, bits, NULL) != NULL;
            if (!taken) fail_msg("%s takes nothing of %d bits", d->kind.name, bits);
        }
}

/* Codes of the sample description for all that XDCAM and AVC-Intra take in QuickTime, each for
 * one raster alone (but psf is p, and ai13 is 24 and 30); one for all of H.264, none for
 * others. */
static void codes_of_quicktime(void **state) {
    (void)state;
    const wf_delivery *d;
    const wf_raster *r;
    for (size_t i = 0; (d = wf_delivery_at(i)); i++) {
        bool has = !strcmp(d->kind.name, "xdcamhd422") || !strcmp(d->kind.name, "avci100") ||
                   !strcmp(d->kind.name, "h264");
        for (size_t n = 0; (r = wf_raster_at(n)); n++) {
            if (!form_of(d, r, d->kind.default_bits, NULL)) continue;
            wf_delivery_mark mark = wf_delivery_quicktime(d, r);
            assert_int_equal(strlen(mark.tag), has ? 4 : 0);
            assert_int_equal(mark.name != NULL, has);
            if (mark.name) assert_true(strlen(mark.name) <= 31);
        }
    }
}

/* ---- Refusals ---- */

static void wrong_rasters_are_told_right_ones(void **state) {
    (void)state;
    static const struct {
        const char *codec, *ending, *raster, *says;
    } rows[] = {
        {"dvcpro50", "mov", "625i", "625i-dv"},
        {"dvcpro50", "mov", "525i-rp202", "525i-dv"},
        {"imx50", "mxf", "525i", "525i-imx"},
        {"imx50", "mxf", "625i-dv", "625i"},
        {"xdcamhd422", "mxf", "1080i60", "1080i59.94"},
        {"xdcamhd422", "mov", "720p60", "720p59.94"},
        {"dnxhr", "mov", "1080i50", "progressive"},
        {"avci100", "mxf", "2160p25", "1080p25"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const wf_delivery *d = find(rows[i].codec, rows[i].ending);
        wf_raster raster = raster_of(rows[i].raster);
        weft_error err = {""};
        assert_null(form_of(d, &raster, d->kind.default_bits, &err));
        if (!strstr(err.text, rows[i].says)) fail_msg("'%s' lacks %s", err.text, rows[i].says);
    }
}

/* ---- Colors ---- */

/* Rec. ITU-T H.273: tables 2, 3 and 4. */
static void code_points(void **state) {
    (void)state;
    static const struct {
        const char *space;
        wf_matrix matrix;
        int primaries, transfer, coefficients;
    } rows[] = {
        {"rec601-525", WF_601_525, 6, 1, 6},  {"rec601-625", WF_601_625, 5, 1, 6},
        {"rec709", WF_709, 1, 1, 1},          {"rec2020", WF_2020, 9, 14, 9},
        {"rec2100-pq", WF_2020, 9, 16, 9},    {"rec2100-hlg", WF_709, 9, 18, 9},
        {"rec2100-pq", WF_601_625, 9, 16, 9}, {"rec2020", WF_709, 9, 14, 1},
        {"rec709-camera", WF_709, 1, 1, 1},   {"", WF_601_625, 5, 1, 6},
        {"someone's own", WF_2020, 9, 14, 9}, {NULL, WF_709, 1, 1, 1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        wf_color_tags tags = wf_color_tags_of(rows[i].space, rows[i].matrix);
        assert_int_equal(tags.primaries, rows[i].primaries);
        assert_int_equal(tags.transfer, rows[i].transfer);
        assert_int_equal(tags.matrix, rows[i].coefficients);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_of_the_file),
        cmocka_unit_test(order_follows_from_the_map),
        cmocka_unit_test(every_codec_takes_some_raster),
        cmocka_unit_test(codes_of_quicktime),
        cmocka_unit_test(wrong_rasters_are_told_right_ones),
        cmocka_unit_test(code_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
