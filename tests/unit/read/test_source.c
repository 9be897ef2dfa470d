/* The source: every storage, compression and type against the values written; windows, layers
 * and parts; reuse of equal chunks; what NaN becomes against its definition; damaged files. */
#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/read/nan_fix.h"
#include "convert/read/source.h"
#include "convert/read/exr/unzip.h"
#include "filters/base/half.h"
#include "tests/unit/support/exr_write.h"

static char directory[64] = "/tmp/weft-source-XXXXXX";
static wf_source_options plain = {.nan_fix = WF_NAN_NONE, .max_memory_bytes = (size_t)1 << 30};

static const char *temporary(const char *name) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return path;
}

static uint32_t mix(uint32_t x) {
    x = (x ^ x >> 16) * 0x45d9f3b;
    x = (x ^ x >> 16) * 0x45d9f3b;
    return x ^ x >> 16;
}

/* Exact in a half: any sign, exponents from 2^-14 to 2^15. `user` seeds it. */
static float noise(const void *user, int channel, int x, int y) {
    uint32_t seed = user ? *(const uint32_t *)user : 0;
    uint32_t bits = mix(mix(mix(seed + 77 * (uint32_t)channel) + (uint32_t)x) + (uint32_t)y);
    uint16_t half = (uint16_t)bits;
    if ((half & 0x7c00) == 0x7c00) half &= 0x83ff;
    return wf_half_value(half);
}

/* Slow changes, which compress, exact in a half. */
static float smooth(const void *user, int channel, int x, int y) {
    (void)user;
    return (float)(x / 8 + 3 * (y / 4) + 100 * channel) / 64.0f;
}

static exr_part part_of(int width, int height) {
    return (exr_part){.display = {0, 0, width, height},
                      .data = {0, 0, width, height},
                      .channels = "B G R",
                      .type = EXR_PIXEL_HALF,
                      .compression = EXR_COMPRESSION_ZIP,
                      .value = noise};
}

static wf_subframe *opened(const char *path, int part, const wf_source_options *options) {
    wf_subframe *s = NULL;
    weft_error err = {""};
    if (wf_subframe_open(path, part, options, &s, &err)) fail_msg("%s", err.text);
    return s;
}

static wf_reader *reader_for(const wf_source_options *options) {
    wf_reader *reader = NULL;
    weft_error err = {""};
    if (wf_reader_new(options, &reader, &err)) fail_msg("%s", err.text);
    return reader;
}

static float sample(const wf_rows *rows, int c, int x, int y) {
    size_t at = (size_t)(y - rows->y0) * rows->line_stride + (size_t)(x - rows->x0);
    return rows->type == WF_HALF ? wf_half_value(((const uint16_t *)rows->plane[c])[at])
                                 : ((const float *)rows->plane[c])[at];
}

/* Channel c of R G B[, A] in the alphabetical order in which the file has them. */
static int place_of(int c, const exr_part *p) {
    static const int rgb[] = {2, 1, 0}, rgba[] = {3, 2, 1, 0};
    return p->channels[0] == 'A' ? rgba[c] : p->channels[0] == 'Y' ? 0 : rgb[c];
}

static void expect_rows(const wf_rows *rows, const exr_part *p, double tolerance) {
    for (int c = 0; c < rows->channels; c++)
        for (int y = rows->y0; y < rows->y1; y++)
            for (int x = rows->x0; x < rows->x1; x++) {
                double is = (double)sample(rows, c, x, y);
                double should = (double)p->value(p->user, place_of(c, p), x, y);
                if (!(fabs(is - should) <= tolerance * fabs(should)))
                    fail_msg("channel %d at %d,%d is %g, should be %g", c, x, y, is, should);
            }
}

/* All rows in runs of every length, in both orders. */
static void expect_part(const char *path, int number, const exr_part *p, double tolerance) {
    wf_source_options options = plain;
    options.want_alpha = true;
    wf_subframe *s = opened(path, number, &options);
    wf_reader *reader = reader_for(&options);
    const wf_image_info *info = wf_subframe_info(s);
    assert_memory_equal(&info->data, &p->data, sizeof p->data);
    assert_memory_equal(&info->display, &p->display, sizeof p->display);
    for (int step = 1; step < 80; step += 13)
        for (int y = p->data.y0; y < p->data.y1; y += step) {
            wf_rows rows;
            weft_error err = {""};
            int end = y + step < p->data.y1 ? y + step : p->data.y1;
            if (wf_reader_rows(reader, s, y, end, &rows, &err)) fail_msg("%s", err.text);
            assert_true(rows.y0 == y && rows.y1 == end && rows.x0 == p->data.x0 &&
                        rows.x1 == p->data.x1);
            expect_rows(&rows, p, tolerance);
        }
    wf_reader_free(reader);
    wf_subframe_close(s);
}

static void every_kind_of_file(void **state) {
    (void)state;
    static const exr_compression_t exact[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,
                                              EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
                                              EXR_COMPRESSION_PIZ,  EXR_COMPRESSION_PXR24};
    static const char *const channels[] = {"B G R", "A B G R", "Y"};
    const char *path = temporary("kind.exr");
    for (int i = 0; i < 6 * 3 * 2 * 2 * 2; i++) {
        exr_part p = part_of(67, 45);
        p.compression = exact[i % 6];
        p.channels = channels[i / 6 % 3];
        p.type = i / 18 % 2 ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF;
        p.value = i / 36 % 2 ? smooth : noise;
        if (i / 72) p.tile_width = 32, p.tile_height = 16;
        assert_true(exr_write(path, &p, 1));
        expect_part(path, -1, &p, 0);
    }
}

/* B44 is exact where 4x4 blocks are flat. */
static float blocks(const void *user, int channel, int x, int y) {
    return smooth(user, channel, x / 4 * 4, y / 4 * 4);
}

static void b44(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        exr_part p = part_of(64, 48);
        p.compression = i % 2 ? EXR_COMPRESSION_B44 : EXR_COMPRESSION_B44A;
        p.value = blocks;
        if (i / 2) p.tile_width = 32, p.tile_height = 16;
        const char *path = temporary("b44.exr");
        assert_true(exr_write(path, &p, 1));
        expect_part(path, -1, &p, 0);
    }
}

static void windows_anywhere(void **state) {
    (void)state;
    static const wf_box data[] = {{10, 5, 50, 40},
                                  {-7, -9, 90, 70},
                                  {-30, 20, -3, 31},
                                  {63, 47, 64, 48},
                                  {1000, 2000, 1033, 2070}};
    for (int i = 0; i < 10; i++) {
        exr_part p = part_of(64, 48);
        p.data = data[i % 5];
        if (i / 5) p.tile_width = 16, p.tile_height = 16;
        const char *path = temporary("window.exr");
        assert_true(exr_write(path, &p, 1));
        expect_part(path, -1, &p, 0);
    }
}

static void attributes(void **state) {
    (void)state;
    exr_part p = part_of(16, 16);
    p.rate = "480000/1001", p.time = "7/480", p.pixel_aspect = 1.5f;
    const char *path = temporary("attributes.exr");
    assert_true(exr_write(path, &p, 1));
    wf_subframe *s = opened(path, -1, &plain);
    const wf_image_info *info = wf_subframe_info(s);
    assert_true(info->rate.num == 480000 && info->rate.den == 1001);
    assert_true(info->time_s.num == 7 && info->time_s.den == 480 && info->pixel_aspect == 1.5);
    assert_string_equal(info->format, "OpenEXR scanline, ZIP, B G R half");
    assert_int_equal(info->band_lines, 16);
    wf_subframe_close(s);
    p.subframe_rate = "240"; /* weft's own comes first */
    assert_true(exr_write(path, &p, 1));
    s = opened(path, -1, &plain);
    assert_true(wf_subframe_info(s)->rate.num == 240 && wf_subframe_info(s)->rate.den == 1);
    wf_subframe_close(s);
}

static void refused(const char *path, int part, const wf_source_options *options,
                    const char *word) {
    wf_subframe *s = NULL;
    weft_error err = {""};
    assert_int_not_equal(wf_subframe_open(path, part, options, &s, &err), WEFT_OK);
    assert_null(s);
    if (!strstr(err.text, word)) fail_msg("'%s' does not say '%s'", err.text, word);
}

/* The layer that is chosen is the one that is read (test_pick.c has the choice itself). */
static void layers(void **state) {
    (void)state;
    static const struct {
        const char *channels, *layer, *refusal;
        int first; /* index of the channel that must come out as R */
    } cases[] = {
        {"L.B L.G L.R", NULL, NULL, 2},
        {"V.Combined.B V.Combined.G V.Combined.R V.Depth.Z V.Normal.X", NULL, NULL, 2},
        {"V.Combined.B V.Combined.G V.Combined.R V.Diff.B V.Diff.G V.Diff.R", NULL, NULL, 2},
        {"V.Combined.B V.Combined.G V.Combined.R V.Diff.B V.Diff.G V.Diff.R", "V.Diff", NULL,
         5},
        {"B G R d.B d.G d.R", "d", NULL, 5},
        {"B G R d.Y", "d", NULL, 3},
        {"Ci.b Ci.g Ci.r a", NULL, NULL, 2},
        {"blue green red", NULL, NULL, 2},
        {"N.X N.Y N.Z RGBA.A RGBA.B RGBA.G RGBA.R", NULL, NULL, 6},
        {"B G R id#", NULL, NULL, 2},
        {"a.B a.G a.R b.B b.G b.R", NULL,
         "choose one with --layer; it has a (R G B), b (R G B)", 0},
        {"a.B a.G a.R b.B b.G b.R", "c", "no layer 'c'; it has a (R G B), b (R G B)", 0},
        {"U V", NULL, "it has U V", 0},
        {"B/2 G R", NULL, "channel B is subsampled 2x2", 0},
        {"B# G# R#", NULL, "there is no picture in it", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        exr_part p = part_of(20, 20);
        const char *path = temporary("layers.exr");
        p.channels = cases[i].channels;
        assert_true(exr_write(path, &p, 1));
        wf_source_options options = plain;
        options.layer = cases[i].layer;
        if (cases[i].refusal) {
            refused(path, -1, &options, cases[i].refusal);
            continue;
        }
        wf_subframe *s = opened(path, -1, &options);
        wf_reader *reader = reader_for(&options);
        wf_rows rows;
        assert_int_equal(wf_reader_rows(reader, s, 0, 20, &rows, NULL), WEFT_OK);
        assert_true(sample(&rows, 0, 7, 11) == noise(NULL, cases[i].first, 7, 11));
        wf_reader_free(reader);
        wf_subframe_close(s);
    }
}

static void parts(void **state) {
    (void)state;
    uint32_t seed[3] = {1, 2, 3};
    exr_part p[3];
    static const char *const name[] = {"left", "glow", "7"};
    for (int i = 0; i < 3; i++) {
        p[i] = part_of(30, 20 + i);
        p[i].name = name[i];
        p[i].user = &seed[i];
    }
    const char *path = temporary("parts.exr");
    assert_true(exr_write(path, p, 3));
    for (int i = 0; i < 3; i++) expect_part(path, i, &p[i], 0);
    wf_source_options options = plain;
    refused(path, -1, &options, "choose one with --part; it has part 0 'left': R G B; part 1");
    options.part = "glow";
    wf_subframe *s = opened(path, -1, &options);
    assert_int_equal(wf_subframe_info(s)->data.y1, 21);
    wf_subframe_close(s);
    options.part = NULL, options.layer = "7"; /* parts are layers too */
    s = opened(path, -1, &options);
    assert_int_equal(wf_subframe_info(s)->data.y1, 22);
    wf_subframe_close(s);
    options.part = "glare";
    refused(path, -1, &options,
            "no part 'glare'; it has part 0 'left': R G B; part 1 'glow': R G B; part 2 '7'");
}

/* ---- Channels with fewer samples than pixels ---- */

/* Every row of a picture against a function of R G B and the place. */
static void expect_light(const char *path, const wf_source_options *options, int channels,
                         float (*light)(int c, int x, int y), double tolerance) {
    wf_subframe *s = opened(path, -1, options);
    wf_reader *reader = reader_for(options);
    wf_box data = wf_subframe_info(s)->data;
    for (int y = data.y0; y < data.y1; y += 7) {
        wf_rows rows;
        weft_error err = {""};
        int end = y + 7 < data.y1 ? y + 7 : data.y1;
        if (wf_reader_rows(reader, s, y, end, &rows, &err)) fail_msg("%s", err.text);
        assert_int_equal(rows.channels, channels);
        for (int c = 0; c < channels; c++)
            for (int v = y; v < end; v++)
                for (int x = data.x0; x < data.x1; x++) {
                    double is = (double)sample(&rows, c, x, v), should = (double)light(c, x, v);
                    if (!(fabs(is - should) <= tolerance))
                        fail_msg("%s: channel %d at %d,%d is %g, should be %g", path, c, x, v,
                                 is, should);
                }
    }
    wf_reader_free(reader);
    wf_subframe_close(s);
}

static const exr_compression_t exact[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,
                                          EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
                                          EXR_COMPRESSION_PIZ,  EXR_COMPRESSION_PXR24};

static float blue_green_red(int c, int x, int y) {
    return smooth(NULL, 2 - c, x, y);
}

/* A mask at half size, ids: whatever lies beside the picture. */
static void subsampled_beside_the_picture(void **state) {
    (void)state;
    for (int i = 0; i < 12; i++) {
        exr_part p = part_of(66, 45);
        p.data = (wf_box){-4, 6, 64, 54};
        p.channels = i / 6 ? "B G R id# mask.V/2 zone/4" : "B G R mask.V/2";
        p.compression = exact[i % 6];
        p.value = smooth;
        const char *path = temporary("beside.exr");
        if (i / 6) p.data.y0 = 4, p.data.y1 = 48;
        assert_true(exr_write(path, &p, 1));
        expect_light(path, &plain, 3, blue_green_red, 0);
    }
}

/* Two colors of one ratio everywhere, so that RY and BY are flat and interpolation exact. */
static float lit(int x, int y) {
    return (float)(x + 2 * y + 16) / 64;
}

static const double red_709 = 0.2126390058715104, blue_709 = 0.0721923153607337;

static float luminance_chroma(const void *user, int channel, int x, int y) {
    const float *ratio = user; /* of RY and BY */
    return channel == 2 ? lit(x, y) : ratio[1 - channel];
}

static float chroma_light(int c, int x, int y) {
    double light = (double)lit(x, y), red = 1.5 * light, blue = 0.25 * light;
    double green = (light - red_709 * red - blue_709 * blue) / (1 - red_709 - blue_709);
    return (float)(c == 0 ? red : c == 1 ? green : blue);
}

/* R = (1 + RY) Y, B = (1 + BY) Y, and G from Y = .2126 R + .7152 G + .0722 B. */
static void luminance_and_chroma(void **state) {
    (void)state;
    static const float ratio[2] = {0.5f, -0.75f};
    static const char *const channels[] = {"BY/2 RY/2 Y", "BY/4 RY/4 Y", "BY RY Y"};
    for (int i = 0; i < 18; i++) {
        exr_part p = part_of(68, 44);
        p.channels = channels[i / 6];
        p.compression = exact[i % 6];
        p.value = luminance_chroma, p.user = ratio;
        const char *path = temporary("chroma.exr");
        assert_true(exr_write(path, &p, 1));
        expect_light(path, &plain, 3, chroma_light, 2e-5);
    }
    exr_part p = part_of(64, 48);
    p.channels = "BY/8 RY/8 Y";
    p.value = luminance_chroma, p.user = ratio;
    const char *path = temporary("eighths.exr");
    assert_true(exr_write(path, &p, 1));
    refused(path, -1, &plain, "8x8");
}

/* A PIZ file that says that it has another compression. */
static const char *mislabeled(int compression) {
    static const float ratio[2] = {0.5f, -0.75f};
    exr_part p = part_of(64, 48);
    p.channels = "BY/2 RY/2 Y";
    p.value = luminance_chroma, p.user = ratio;
    p.compression = EXR_COMPRESSION_PIZ; /* as many lines a chunk as DWAA */
    const char *path = temporary("mislabeled.exr");
    assert_true(exr_write(path, &p, 1));
    uint8_t bytes[4096];
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    size_t got = fread(bytes, 1, sizeof bytes, file);
    static const char name[] = "compression\0compression\0\1\0\0"; /* and its 0 */
    const uint8_t *at = memmem(bytes, got, name, sizeof name);
    assert_non_null(at);
    assert_false(fseek(file, (long)(at - bytes) + (long)sizeof name, SEEK_SET));
    fputc(compression, file);
    assert_false(fclose(file));
    return path;
}

/* Bytes that are no DWA, in a file that says so; unit/read/test_exr_chunks.c reads what is. */
static void false_chroma_under_dwa(void **state) {
    (void)state;
    refused(mislabeled(EXR_COMPRESSION_DWAA), -1, &plain, "cannot be read");
}

static void newer_compressions_are_named(void **state) {
    (void)state;
    refused(mislabeled(10), -1, &plain, "HTJ2K256, of OpenEXR 3.4");
    refused(mislabeled(11), -1, &plain, "HTJ2K32, of OpenEXR 3.4");
    refused(mislabeled(12), -1, &plain, "Zstd, of OpenEXR 3.5");
    refused(mislabeled(255), -1, &plain, "number 255");
}

static float spoiled_chroma(const void *user, int channel, int x, int y) {
    return channel == 1 && x == 20 && y == 12 ? NAN : luminance_chroma(user, channel, x, y);
}

/* A bad sample of chroma spoils the four pixels it is of, and none that interpolation reaches.
 */
static void bad_chroma_does_not_spread(void **state) {
    (void)state;
    static const float ratio[2] = {0.5f, -0.75f};
    exr_part p = part_of(68, 44);
    p.channels = "BY/2 RY/2 Y";
    p.value = spoiled_chroma, p.user = ratio;
    const char *path = temporary("spoiled.exr");
    assert_true(exr_write(path, &p, 1));
    wf_source_options keep = plain;
    keep.nan_fix = WF_NAN_NONE;
    wf_subframe *s = opened(path, -1, &keep);
    wf_reader *reader = reader_for(&keep);
    wf_rows rows;
    assert_int_equal(wf_reader_rows(reader, s, 0, 44, &rows, NULL), WEFT_OK);
    for (int y = 0; y < 44; y++)
        for (int x = 0; x < 68; x++) {
            bool bad = x / 2 == 10 && y / 2 == 6;
            float is = sample(&rows, 0, x, y), should = chroma_light(0, x, y);
            if (bad != !isfinite(is) || (!bad && fabsf(is - should) > 2e-5f))
                fail_msg("%d,%d is %g, should be %g", x, y, (double)is, (double)should);
        }
    wf_reader_free(reader);
    wf_subframe_close(s);
    keep.nan_fix = WF_NAN_BOX3;
    expect_light(path, &keep, 3, chroma_light, 0.1);
}

static float waving(const void *user, int channel, int x, int y) {
    (void)user;
    double wave = 0.25 * cos(0.3 * x) + 0.2 * sin(0.25 * y);
    return channel == 2 ? 1 : (float)(channel == 1 ? wave : -wave);
}

static float waving_light(int c, int x, int y) {
    double wave = 0.25 * cos(0.3 * x) + 0.2 * sin(0.25 * y), red = 1 + wave, blue = 1 - wave;
    double green = (1 - red_709 * red - blue_709 * blue) / (1 - red_709 - blue_709);
    return (float)(c == 0 ? red : c == 1 ? green : blue);
}

/* Chroma that varies slowly comes back between its samples as well: far more closely than a
 * repeated sample (0.07 off) or a straight line between two (0.005) would. */
static void chroma_is_interpolated(void **state) {
    (void)state;
    exr_part p = part_of(160, 120);
    p.channels = "BY/2 RY/2 Y";
    p.type = EXR_PIXEL_FLOAT;
    p.value = waving;
    const char *path = temporary("waving.exr");
    assert_true(exr_write(path, &p, 1));
    wf_subframe *s = opened(path, -1, &plain);
    wf_reader *reader = reader_for(&plain);
    wf_rows rows;
    assert_int_equal(wf_reader_rows(reader, s, 0, 120, &rows, NULL), WEFT_OK);
    for (int c = 0; c < 3; c++)
        for (int y = 40; y < 80; y++)
            for (int x = 40; x < 120; x++)
                assert_true(fabs((double)sample(&rows, c, x, y) -
                                 (double)waving_light(c, x, y)) < 7e-4);
    wf_reader_free(reader);
    wf_subframe_close(s);
}

static float other_primaries_light(int c, int x, int y) {
    double light = (double)lit(x, y), red = 1.5 * light, blue = 0.25 * light;
    return (float)(c == 0 ? red : c == 1 ? 3 * light - red - blue : blue);
}

/* XYZ of red, green and blue are .5 1/3 .1, .2 1/3 .2 and .2 1/3 .6: each gives a third of the
 * luminance of white, their sum. */
static void luma_of_the_files_primaries(void **state) {
    (void)state;
    static const float ratio[2] = {0.5f, -0.75f};
    static const float even[8] = {.535714f, .357143f, .272727f, .454545f,
                                  .176471f, .294118f, .321429f, .357143f};
    exr_part p = part_of(40, 30);
    p.channels = "BY/2 RY/2 Y";
    p.chromaticities = even;
    p.value = luminance_chroma, p.user = ratio;
    const char *path = temporary("even.exr");
    assert_true(exr_write(path, &p, 1));
    expect_light(path, &plain, 3, other_primaries_light, 2e-5);
}

/* ---- Alpha ---- */

/* A B G R: alpha in eighths. */
static float with_alpha(const void *user, int channel, int x, int y) {
    (void)user;
    return channel ? (float)(x + 8 * channel) / 16 : (float)(y % 9) / 8;
}

static float as_stored(int c, int x, int y) {
    return with_alpha(NULL, 3 - c, x, y);
}

static float multiplied(int c, int x, int y) {
    return c == 3 ? as_stored(c, x, y) : as_stored(c, x, y) * as_stored(3, x, y);
}

static void alpha_by_every_option(void **state) {
    (void)state;
    const struct {
        wf_alpha alpha;
        bool wanted;
        int channels;
        float (*light)(int c, int x, int y);
        const char *value, *reason;
    } cases[] = {{WF_ALPHA_UNSET, false, 3, as_stored, "premultiplied", "default"},
                 {WF_ALPHA_UNSET, true, 4, as_stored, "premultiplied", "default"},
                 {WF_ALPHA_PREMULTIPLIED, true, 4, as_stored, "premultiplied", "option"},
                 {WF_ALPHA_STRAIGHT, false, 3, multiplied, "straight", "option"},
                 {WF_ALPHA_STRAIGHT, true, 4, multiplied, "straight", "option"},
                 {WF_ALPHA_IGNORED, true, 3, as_stored, "ignore", "option"}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        exr_part p = part_of(40, 30);
        p.channels = "A B G R";
        p.type = i % 2 ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF;
        p.value = with_alpha;
        const char *path = temporary("alpha.exr");
        assert_true(exr_write(path, &p, 1));
        wf_source_options options = plain;
        options.alpha = cases[i / 2].alpha, options.want_alpha = cases[i / 2].wanted;
        expect_light(path, &options, cases[i / 2].channels, cases[i / 2].light, 0);
        wf_taken_list taken = {0};
        wf_subframe *s = opened(path, -1, &options);
        wf_subframe_take(s, &taken);
        wf_subframe_close(s);
        assert_string_equal(taken.row[taken.count - 1].key, "alpha");
        assert_string_equal(taken.row[taken.count - 1].value, cases[i / 2].value);
        assert_string_equal(taken.row[taken.count - 1].reason, cases[i / 2].reason);
    }
}

static float odd_alpha(const void *user, int channel, int x, int y) {
    return channel == 3 && x == 5 && y == 15 ? NAN : with_alpha(user, channel, x, y);
}

static float mended(int c, int x, int y) {
    double sum = 0;
    if (c || x != 5 || y != 15) return multiplied(c, x, y);
    for (int v = 14; v < 17; v++)
        for (int u = 4; u < 7; u++) sum += u == 5 && v == 15 ? 0 : (double)as_stored(0, u, v);
    return (float)(sum / 8) * as_stored(3, x, y);
}

/* NaN is replaced among samples as they are stored, also by rows beyond those read (the rows of
 * a call end at 13, 20 ..). */
static void not_finite_before_alpha(void **state) {
    (void)state;
    exr_part p = part_of(40, 30);
    p.channels = "A B G R";
    p.value = odd_alpha;
    const char *path = temporary("oddalpha.exr");
    assert_true(exr_write(path, &p, 1));
    wf_source_options options = plain;
    options.alpha = WF_ALPHA_STRAIGHT, options.nan_fix = WF_NAN_BOX3;
    expect_light(path, &options, 3, mended, 1e-6);
}

/* ---- Files that are not finished ---- */

/* Renderers write the table of chunks last: until then it is zero, all of it or its end. */
static void still_being_written(void **state) {
    (void)state;
    exr_part p = part_of(33, 100);
    for (int entry = 0; entry < 3; entry++) {
        char path[512];
        snprintf(path, sizeof path, "%s", temporary("growing.exr"));
        assert_true(exr_write(path, &p, 1));
        FILE *file = fopen(path, "r+b");
        unsigned char bytes[1024];
        size_t got = fread(bytes, 1, sizeof bytes, file), at = 8;
        while (at + 1 < got && bytes[at]) { /* name, type, size, value */
            at += strlen((char *)bytes + at) + 1;
            at += strlen((char *)bytes + at) + 1;
            at += 4 + (size_t)(bytes[at] + 256 * bytes[at + 1]);
        }
        const unsigned char none[7 * 8] = {0}; /* seven chunks of 16 lines */
        size_t from = entry == 0 ? 0 : entry == 1 ? 6 : 3;
        fseek(file, (long)(at + 1 + 8 * from), SEEK_SET);
        fwrite(none, 8, 7 - from, file);
        fclose(file);
        refused(path, -1, &plain, "may still be being written");
    }
}

/* However much of a file is there already, that is said. */
static void cut_short(void **state) {
    (void)state;
    static const long part[] = {0, 30, 150, 400, 2000, 5000};
    exr_part p = part_of(33, 100);
    char path[512];
    snprintf(path, sizeof path, "%s", temporary("cut.exr"));
    for (size_t i = 0; i < sizeof part / sizeof *part; i++) {
        assert_true(exr_write(path, &p, 1));
        assert_int_equal(truncate(path, part[i]), 0);
        refused(path, -1, &plain, "may still be being written");
    }
}

static void parts_in_time(void **state) {
    (void)state;
    exr_part p[3] = {part_of(8, 8), part_of(8, 8), part_of(8, 8)};
    p[0].time = "3/240", p[1].time = "1/480", p[2].time = "2/240";
    const char *path = temporary("timed.exr");
    assert_true(exr_write(path, p, 3));
    int count, *part;
    wf_rational *time;
    assert_int_equal(wf_source_timed_parts(path, &count, &part, &time, NULL), WEFT_OK);
    assert_int_equal(count, 3);
    assert_true(part[0] == 1 && part[1] == 2 && part[2] == 0 && time[0].den == 480);
    free(part);
    free(time);
}

/* Chunks equal to those of the picture before are not inflated, and only those. */
static void equal_chunks_are_reused(void **state) {
    (void)state;
    uint32_t seed[2] = {1, 2};
    exr_part p[3] = {part_of(40, 64), part_of(40, 64), part_of(40, 64)};
    p[0].user = p[1].user = &seed[0], p[2].user = &seed[1];
    const char *path = temporary("equal.exr");
    assert_true(exr_write(path, p, 3));
    wf_reader *reader = reader_for(&plain);
    wf_subframe *s[3];
    wf_rows rows;
    bool same;
    for (int i = 0; i < 3; i++) s[i] = opened(path, i, &plain);
    assert_int_equal(wf_reader_rows(reader, s[0], 0, 64, &rows, NULL), WEFT_OK);
    assert_int_equal(wf_reader_counts(reader).chunks_decoded, 4);
    assert_int_equal(wf_reader_same(reader, s[1], 0, 64, &same, NULL), WEFT_OK);
    assert_true(same);
    expect_rows(&rows, &p[0], 0);
    assert_int_equal(wf_reader_rows(reader, s[1], 0, 64, &rows, NULL), WEFT_OK);
    expect_rows(&rows, &p[1], 0);
    assert_int_equal(wf_reader_counts(reader).chunks_decoded, 4);
    assert_int_equal(wf_reader_counts(reader).chunks_reused, 8);
    assert_int_equal(wf_reader_same(reader, s[2], 0, 64, &same, NULL), WEFT_OK);
    assert_false(same);
    expect_rows(&rows, &p[1], 0);
    assert_int_equal(wf_reader_rows(reader, s[2], 0, 64, &rows, NULL), WEFT_OK);
    expect_rows(&rows, &p[2], 0);
    assert_int_equal(wf_reader_rows(reader, s[2], 16, 32, &rows, NULL), WEFT_OK);
    expect_rows(&rows, &p[2], 0);
    assert_int_equal(wf_reader_counts(reader).chunks_decoded, 9);
    for (int i = 0; i < 3; i++) wf_subframe_close(s[i]);
    wf_reader_free(reader);
}

/* ---- Mending ---- */

/* One sample in 13 is not finite; around 20,20 none is. */
static float holes(const void *user, int channel, int x, int y) {
    uint32_t bits = mix(mix((uint32_t)(x + 50 * channel)) + (uint32_t)y);
    bool hole = bits % 13 == 0 || (abs(x - 20) < 3 && abs(y - 20) < 3);
    if (!hole) return noise(user, channel, x, y);
    return bits % 3 == 0 ? NAN : bits % 3 == 1 ? INFINITY : -INFINITY;
}

/* The definition, from the picture as it was. */
static double fixed(const exr_part *p, int channel, int x, int y, bool black) {
    double sum = 0;
    int count = 0;
    double value = (double)p->value(p->user, channel, x, y);
    if (isfinite(value)) return value;
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++) {
            if (i < p->data.x0 || i >= p->data.x1 || j < p->data.y0 || j >= p->data.y1)
                continue;
            double neighbor = (double)p->value(p->user, channel, i, j);
            if (isfinite(neighbor)) sum += neighbor, count++;
        }
    return black || !count ? 0 : sum / count;
}

static int64_t pixels_with_holes(const exr_part *p) {
    int64_t count = 0;
    for (int y = p->data.y0; y < p->data.y1; y++)
        for (int x = p->data.x0; x < p->data.x1; x++) {
            bool hole = false;
            for (int c = 0; c < 3; c++) hole |= !isfinite(p->value(p->user, c, x, y));
            count += hole;
        }
    return count;
}

static void expect_fixed(const char *path, const exr_part *p, wf_nan_fix how, int step) {
    wf_source_options options = plain;
    options.nan_fix = how;
    wf_subframe *s = opened(path, -1, &options);
    wf_reader *reader = reader_for(&options);
    for (int y = p->data.y0; y < p->data.y1; y += step) {
        wf_rows rows;
        int end = y + step < p->data.y1 ? y + step : p->data.y1;
        assert_int_equal(wf_reader_rows(reader, s, y, end, &rows, NULL), WEFT_OK);
        for (int c = 0; c < 3; c++)
            for (int j = y; j < end; j++)
                for (int x = p->data.x0; x < p->data.x1; x++) {
                    double should = fixed(p, place_of(c, p), x, j, how == WF_NAN_BLACK);
                    double is = (double)sample(&rows, c, x, j);
                    if (!(fabs(is - should) <= 1e-6 * fabs(should) + 1e-12))
                        fail_msg("%d,%d is %g, should be %g", x, j, is, should);
                }
    }
    assert_int_equal(wf_reader_counts(reader).nan.fixed, pixels_with_holes(p));
    wf_reader_free(reader);
    wf_subframe_close(s);
}

static void not_finite(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        exr_part p = part_of(50, 50);
        p.data = (wf_box){-3, 4, 40, 49};
        p.value = holes;
        p.type = i % 2 ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF;
        p.compression = i / 2 % 2 ? EXR_COMPRESSION_ZIPS : EXR_COMPRESSION_ZIP;
        if (i / 4) p.tile_width = 16, p.tile_height = 16;
        const char *path = temporary("holes.exr");
        assert_true(exr_write(path, &p, 1));
        for (int step = 1; step < 50; step += 7) {
            expect_fixed(path, &p, WF_NAN_BOX3, step);
            expect_fixed(path, &p, WF_NAN_BLACK, step);
        }
    }
}

static void not_finite_can_be_an_error(void **state) {
    (void)state;
    exr_part p = part_of(50, 50);
    p.value = holes;
    const char *path = temporary("holes.exr");
    assert_true(exr_write(path, &p, 1));
    wf_source_options options = plain;
    options.nan_fix = WF_NAN_ERROR;
    wf_subframe *s = opened(path, -1, &options);
    wf_reader *reader = reader_for(&options);
    wf_rows rows;
    weft_error err = {""};
    assert_int_equal(wf_reader_rows(reader, s, 18, 50, &rows, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "of line 18 is NaN or infinite"));
    wf_reader_free(reader);
    wf_subframe_close(s);
}

/* ---- Damage ---- */

/* Reads everything there is to read; a failure must say which file. Returns whether it failed.
 */
static bool try_file(const char *path) {
    wf_source_options options = {
        .nan_fix = WF_NAN_BOX3, .want_alpha = true, .max_memory_bytes = (size_t)256 << 20};
    wf_subframe *s = NULL;
    weft_error err = {""};
    wf_reader *reader = reader_for(&options);
    weft_status status = wf_subframe_open(path, -1, &options, &s, &err);
    const wf_image_info *info = status ? NULL : wf_subframe_info(s);
    for (int y = status ? 0 : info->data.y0; !status && y < info->data.y1;
         y += info->band_lines) {
        wf_rows rows;
        int end = info->data.y1 - y < info->band_lines ? info->data.y1 : y + info->band_lines;
        status = wf_reader_rows(reader, s, y, end, &rows, &err);
    }
    if (status && !strstr(err.text, path)) fail_msg("'%s' does not name %s", err.text, path);
    wf_subframe_close(s);
    wf_reader_free(reader);
    return status != WEFT_OK;
}

static void copy_damaged(const char *from, const char *to, long keep, long flip, int bit) {
    FILE *in = fopen(from, "rb"), *out = fopen(to, "wb");
    assert_true(in && out);
    for (long i = 0; i < keep; i++) {
        int byte = fgetc(in);
        if (byte == EOF) break;
        fputc(i == flip ? byte ^ 1 << bit : byte, out);
    }
    fclose(in);
    fclose(out);
}

static long size_of(const char *path) {
    FILE *file = fopen(path, "rb");
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    fclose(file);
    return size;
}

/* A file cut anywhere fails; one with a bit turned either fails or reads, and never more. */
static void truncated_and_flipped(void **state) {
    (void)state;
    char whole[512], broken[512];
    snprintf(whole, sizeof whole, "%s", temporary("whole.exr"));
    snprintf(broken, sizeof broken, "%s", temporary("broken.exr"));
    static const exr_compression_t how[] = {EXR_COMPRESSION_ZIP, EXR_COMPRESSION_PIZ,
                                            EXR_COMPRESSION_RLE, EXR_COMPRESSION_PXR24,
                                            EXR_COMPRESSION_B44, EXR_COMPRESSION_NONE};
    for (int i = 0; i < 12; i++) {
        exr_part p = part_of(33, 40);
        p.compression = how[i % 6];
        p.value = smooth;
        if (i / 6) p.tile_width = 16, p.tile_height = 16;
        assert_true(exr_write(whole, &p, 1));
        long size = size_of(whole);
        for (long keep = 0; keep < size; keep += 1 + size / 60) {
            copy_damaged(whole, broken, keep, -1, 0);
            assert_true(try_file(broken));
        }
        for (long at = 0; at < size; at += 1 + size / 200) {
            copy_damaged(whole, broken, size, at, (int)(mix((uint32_t)at) % 8));
            try_file(broken);
        }
    }
}

static void promises_it_cannot_keep(void **state) {
    (void)state;
    exr_part p = part_of(16, 16);
    const char *path = temporary("huge.exr");
    assert_true(exr_write(path, &p, 1));
    FILE *file = fopen(path, "r+b");
    char head[2000];
    size_t got = fread(head, 1, sizeof head, file);
    for (size_t i = 0; i + 40 < got; i++) /* both windows: 65536 x 32768 */
        if (!memcmp(head + i, "Window\0box2i\0", 13)) {
            const int32_t far[2] = {65535, 32767};
            fseek(file, (long)i + 13 + 4 + 8, SEEK_SET);
            fwrite(far, sizeof far, 1, file);
        }
    fclose(file);
    refused(path, -1, &plain, "is too short");
    refused("/nowhere/at.exr", -1, &plain, "No such file");
    refused(directory, -1, &plain, "directory");
}

static void damaged_files(void **state) {
    (void)state;
    const char *shared = getenv("WEFT_SHARED");
    char folder[512], path[1024];
    snprintf(folder, sizeof folder, "%s/data/exr-damaged", shared ? shared : "");
    DIR *list = shared ? opendir(folder) : NULL;
    if (!list) {
        print_message("skipped: no sample data (WEFT_SHARED is not set)\n");
        skip();
    }
    int files = 0, failed = 0;
    for (struct dirent *entry = readdir(list); entry; entry = readdir(list)) {
        if (entry->d_name[0] == '.') continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        files++, failed += try_file(path);
    }
    closedir(list);
    print_message("%d of %d damaged files were refused\n", failed, files);
    assert_true(files > 100 && failed > files / 2);
}

static int make_directory(void **state) {
    (void)state;
    return mkdtemp(directory) ? 0 : -1;
}

static int remove_directory(void **state) {
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", directory);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_file),
        cmocka_unit_test(b44),
        cmocka_unit_test(windows_anywhere),
        cmocka_unit_test(attributes),
        cmocka_unit_test(layers),
        cmocka_unit_test(parts),
        cmocka_unit_test(subsampled_beside_the_picture),
        cmocka_unit_test(luminance_and_chroma),
        cmocka_unit_test(false_chroma_under_dwa),
        cmocka_unit_test(newer_compressions_are_named),
        cmocka_unit_test(chroma_is_interpolated),
        cmocka_unit_test(bad_chroma_does_not_spread),
        cmocka_unit_test(luma_of_the_files_primaries),
        cmocka_unit_test(alpha_by_every_option),
        cmocka_unit_test(not_finite_before_alpha),
        cmocka_unit_test(still_being_written),
        cmocka_unit_test(cut_short),
        cmocka_unit_test(parts_in_time),
        cmocka_unit_test(equal_chunks_are_reused),
        cmocka_unit_test(not_finite),
        cmocka_unit_test(not_finite_can_be_an_error),
        cmocka_unit_test(truncated_and_flipped),
        cmocka_unit_test(promises_it_cannot_keep),
        cmocka_unit_test(damaged_files),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
