/* The outputs: every kind of the registry, frame by frame, read back by decoders written here
 * from the definitions of the formats and, for pictures, by the module's own reader too. */
#include <dirent.h>
#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>
#include <cmocka.h>
#include <xxhash.h>

#include "convert/base/module.h"
#include "convert/media/oiio/oiio.h"
#include "convert/write/sink.h"
#include "tests/unit/support/jobs.h"

#define FRAMES 3
#define PAD    5 /* samples between the end of a line and the next one */

/* ---- Frames of noise ---- */

static uint32_t mix(uint32_t x) {
    x = (x ^ x >> 16) * 0x45d9f3b;
    x = (x ^ x >> 16) * 0x45d9f3b;
    return x ^ x >> 16;
}

typedef struct clip {
    wf_output output;
    wf_raster raster;
    wf_output_options options;
    size_t width[3], stride[3], lines;
    void *plane[FRAMES][3];
} clip;

static size_t sample_bytes(const clip *c) {
    return c->options.layout == WF_LINEAR ? sizeof(float) : sizeof(uint16_t);
}

static float float_at(uint32_t noise) {
    uint32_t bits = noise % 0x7f000000u | (noise & 1) << 31; /* finite, of any size and sign */
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void fill(clip *c, int frame, int p) {
    size_t count = c->stride[p] * c->lines;
    c->plane[frame][p] = malloc(count * sample_bytes(c));
    assert_non_null(c->plane[frame][p]);
    for (size_t i = 0; i < count; i++) {
        uint32_t noise = mix(mix((uint32_t)(frame * 3 + p)) + (uint32_t)i);
        if (c->options.layout == WF_LINEAR)
            ((float *)c->plane[frame][p])[i] = float_at(noise);
        else
            ((uint16_t *)c->plane[frame][p])[i] =
                (uint16_t)(noise & ((1u << c->options.bits) - 1));
    }
}

static clip make_clip(wf_output row, const char *raster, int bits, bool subsampled) {
    char why[256];
    const wf_output_kind *kind = row.kind;
    clip c = {.output = row};
    if (!wf_raster_parse(raster, &c.raster, why, sizeof why)) fail_msg("%s", why);
    c.options = (wf_output_options){.layout = kind->layout,
                                    .bits = bits,
                                    .full_range = kind->full_range,
                                    .subsampled = subsampled,
                                    .frame_count = FRAMES,
                                    .stream_header = true,
                                    .timecode = "01:02:03:04",
                                    .color_space = "rec709"};
    c.lines = (size_t)c.raster.lines;
    for (int p = 0; p < 3; p++) {
        c.width[p] = (size_t)c.raster.width_px / (p && subsampled ? 2 : 1);
        c.stride[p] = c.width[p] + PAD;
        for (int f = 0; f < FRAMES; f++) fill(&c, f, p);
    }
    return c;
}

static void free_clip(clip *c) {
    for (int f = 0; f < FRAMES; f++)
        for (int p = 0; p < 3; p++) free(c->plane[f][p]);
}

static unsigned code_at(const clip *c, int frame, int p, size_t x, size_t y) {
    return ((const uint16_t *)c->plane[frame][p])[y * c->stride[p] + x];
}

/* ---- Driving a sink ---- */

static weft_status write_frames(clip *c, const char *output, int first, int end,
                                weft_error *err) {
    wf_sink *sink;
    c->options.output = output;
    c->options.raster = &c->raster;
    c->options.first_frame = first;
    c->options.frame_count = end - first;
    weft_status status = c->output.ops->open(&c->options, &sink, err);
    if (status) return status;
    for (int f = first; !status && f < end; f++) {
        wf_frame frame = {.index = f};
        for (int p = 0; p < 3; p++) {
            frame.plane[p] = c->plane[f][p];
            frame.stride[p] = c->stride[p];
        }
        status = c->output.ops->write(sink, &frame, err);
    }
    if (!status) return c->output.ops->commit(sink, err);
    c->output.ops->abandon(sink);
    return status;
}

/* Writes frames first <= f < end of c into NAME; output receives the path. */
static void written(clip *c, const char *name, int first, int end, char output[512]) {
    char file[512];
    weft_error err = {""};
    bool hash = !strncmp(name, "hash:", 5);
    job_path(file, hash ? name + 5 : name);
    snprintf(output, 512, "%s%.500s", hash ? "hash:" : "", file);
    if (write_frames(c, output, first, end, &err)) fail_msg("%s: %s", output, err.text);
}

static bool is_delivery(const wf_output_kind *kind) {
    return kind->container;
}

static wf_output output_for(const char *output) {
    weft_error err = {""};
    wf_output row = wf_output_for(output, NULL, &err);
    if (!row.kind) fail_msg("%s", err.text);
    return row;
}

/* A name that asks for a kind: its first ending, with a number for sequences. */
static void name_for(const wf_output_kind *kind, char name[64]) {
    int length = (int)strcspn(kind->endings, " ");
    bool scheme = kind->endings[length - 1] == ':';
    if (scheme)
        snprintf(name, 64, "%.*s%s", length, kind->endings,
                 !strcmp(kind->endings, "hash:") ? "out" : "");
    else
        snprintf(name, 64, "out.%s%.*s", kind->sequence ? "####." : "", length, kind->endings);
}

/* ---- Y4M ---- */

/* The value of a word of the header line: words begin with a letter, fields of X with a name.
 */
static const char *word_of(const char *header, const char *letter, char value[64]) {
    char copy[512], *rest = copy;
    snprintf(copy, sizeof copy, "%.*s", (int)strcspn(header, "\n"), header);
    for (const char *word; (word = strsep(&rest, " "));)
        if (!strncmp(word, letter, strlen(letter))) {
            snprintf(value, 64, "%.60s", word + strlen(letter));
            return value;
        }
    *value = '\0';
    return value;
}

static void check_word(const char *header, const char *letter, const char *wanted) {
    char value[64];
    assert_string_equal(word_of(header, letter, value), wanted);
}

static void check_y4m_frames(const clip *c, const uint8_t *at, const uint8_t *end, int first,
                             int last) {
    size_t bytes = c->options.bits > 8 ? 2 : 1;
    for (int f = first; f < last; f++) {
        assert_true(end - at > 6 && !memcmp(at, "FRAME\n", 6));
        at += 6;
        for (int p = 0; p < 3; p++) {
            assert_true((size_t)(end - at) >= c->width[p] * c->lines * bytes);
            for (size_t y = 0; y < c->lines; y++)
                for (size_t x = 0; x < c->width[p]; x++, at += bytes) {
                    unsigned got = bytes == 2 ? at[0] | (unsigned)at[1] << 8 : at[0];
                    assert_int_equal(got, code_at(c, f, p, x, y));
                }
        }
    }
    assert_ptr_equal(at, end);
}

/* What ffmpeg, mpv and mjpegtools read for the sampling and depth. */
static const struct {
    bool subsampled;
    int bits;
    const char *tag, *extension;
} y4m_tags[] = {
    {true, 8, "422", ""},
    {true, 10, "422p10", "422P10"},
    {true, 12, "422p12", "422P12"},
    {true, 16, "422p16", "422P16"},
    {false, 8, "444", ""},
    {false, 10, "444p10", "444P10"},
    {false, 12, "444p12", "444P12"},
    {false, 16, "444p16", "444P16"},
};

/* Rasters of the tests, with what Y4M says of them. */
static const struct {
    const char *raster, *size, *rate, *order, *aspect;
} y4m_rasters[] = {
    {"525i", "W720 H486", "30000:1001", "b", "10:11"},
    {"625i", "W720 H576", "25:1", "t", "12:11"},
    {"52x14@30i,tff", "W52 H14", "30:1", "t", "1:1"},
    {"2x2@29.97i,bff,par=4320:4739", "W2 H2", "30000:1001", "b", "4320:4739"},
    {"50x6@24psf", "W50 H6", "24:1", "p", "1:1"},
    {"48x5@59.94p", "W48 H5", "60000:1001", "p", "1:1"},
};

static void check_y4m_header(const clip *c, const char *header, size_t raster, size_t tag) {
    char size[64], value[64], other[64];
    assert_memory_equal(header, "YUV4MPEG2 ", 10);
    snprintf(size, sizeof size, "W%.20s H%.20s", word_of(header, "W", value),
             word_of(header, "H", other));
    assert_string_equal(size, y4m_rasters[raster].size);
    check_word(header, "F", y4m_rasters[raster].rate);
    check_word(header, "I", y4m_rasters[raster].order);
    check_word(header, "A", y4m_rasters[raster].aspect);
    check_word(header, "C", y4m_tags[tag].tag);
    check_word(header, "XYSCSS=", y4m_tags[tag].extension);
    check_word(header, "XCOLORRANGE=", c->options.full_range ? "FULL" : "LIMITED");
}

static void y4m_holds_the_codes(void **state) {
    (void)state;
    for (size_t r = 0; r < sizeof y4m_rasters / sizeof *y4m_rasters; r++)
        for (size_t t = 0; t < sizeof y4m_tags / sizeof *y4m_tags; t++) {
            char output[512];
            size_t size;
            job_clean();
            clip c = make_clip(output_for("out.y4m"), y4m_rasters[r].raster, y4m_tags[t].bits,
                               y4m_tags[t].subsampled);
            c.options.full_range = t % 2;
            written(&c, "out.y4m", 0, FRAMES, output);
            uint8_t *bytes = job_file("out.y4m", &size), *frames = memchr(bytes, '\n', size);
            assert_non_null(frames);
            check_y4m_header(&c, (const char *)bytes, r, t);
            check_y4m_frames(&c, frames + 1, bytes + size, 0, FRAMES);
            free(bytes);
            free_clip(&c);
        }
}

/* ---- Raw ---- */

/* Six pixels are four little-endian words of three codes, ten bits each from the lowest:
 * Cb0 Y0 Cr0, Y1 Cb1 Y2, Cr1 Y3 Cb2, Y4 Cr2 Y5; lines take whole 128 bytes for 48 pixels. */
static unsigned v210_code(const uint8_t *line, size_t nth) {
    const uint8_t *b = line + nth / 3 * 4;
    uint32_t word = b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    assert_int_equal(word >> 30, 0);
    return word >> (10 * (nth % 3)) & 1023;
}

/* In this order the codes are Cb Y Cr Y again and again, from the line's beginning. */
static void check_v210_line(const clip *c, int f, size_t y, const uint8_t *line,
                            size_t line_bytes) {
    size_t width = c->width[0];
    for (size_t nth = 0; nth < line_bytes / 4 * 3; nth++) {
        size_t pair = nth / 4, place = nth % 4;
        unsigned wanted = 2 * pair >= width ? 0
                          : place == 0      ? code_at(c, f, 1, pair, y)
                          : place == 2      ? code_at(c, f, 2, pair, y)
                                            : code_at(c, f, 0, 2 * pair + place / 2, y);
        assert_int_equal(v210_code(line, nth), wanted);
    }
}

static const char *const raw_rasters[] = {"525i",     "52x14@30i,tff", "2x2@30p",
                                          "4x3@30p",  "46x4@25i,tff",  "48x6@30i,bff",
                                          "50x6@30p", "1920x4@25i,tff"};

static void v210_holds_the_codes(void **state) {
    (void)state;
    for (size_t r = 0; r < sizeof raw_rasters / sizeof *raw_rasters; r++) {
        char output[512];
        size_t size;
        job_clean();
        clip c = make_clip(output_for("out.v210"), raw_rasters[r], 10, true);
        written(&c, "out.v210", 0, FRAMES, output);
        uint8_t *bytes = job_file("out.v210", &size);
        size_t line_bytes = (c.width[0] + 47) / 48 * 128;
        assert_int_equal(size, line_bytes * c.lines * FRAMES);
        for (size_t n = 0; n < c.lines * FRAMES; n++)
            check_v210_line(&c, (int)(n / c.lines), n % c.lines, bytes + n * line_bytes,
                            line_bytes);
        free(bytes);
        free_clip(&c);
    }
}

static void uyvy_holds_the_codes(void **state) {
    (void)state;
    for (size_t r = 0; r < sizeof raw_rasters / sizeof *raw_rasters; r++) {
        char output[512];
        size_t size, at = 0;
        job_clean();
        clip c = make_clip(output_for("out.uyvy"), raw_rasters[r], 8, true);
        written(&c, "out.uyvy", 0, FRAMES, output);
        uint8_t *bytes = job_file("out.uyvy", &size);
        assert_int_equal(size, 2 * c.width[0] * c.lines * FRAMES);
        for (int f = 0; f < FRAMES; f++)
            for (size_t y = 0; y < c.lines; y++)
                for (size_t x = 0; x < c.width[0]; x++) {
                    assert_int_equal(bytes[at++], code_at(&c, f, x % 2 ? 2 : 1, x / 2, y));
                    assert_int_equal(bytes[at++], code_at(&c, f, 0, x, y));
                }
        free(bytes);
        free_clip(&c);
    }
}

/* ---- Hash ---- */

static void hashes_are_of_the_codes(void **state) {
    (void)state;
    char output[512], line[64];
    size_t size, length = 0;
    static uint8_t codes[52 * 14 * 2 * 2];
    job_clean();
    clip c = make_clip(output_for("hash:out"), "52x14@30i,tff", 10, true);
    written(&c, "hash:out", 0, FRAMES, output);
    uint8_t *bytes = job_file("out", &size);
    for (int f = 0; f < FRAMES; f++) {
        uint8_t *to = codes;
        for (int p = 0; p < 3; p++)
            for (size_t i = 0; i < c.width[p] * c.lines; i++, to += 2) {
                unsigned code = code_at(&c, f, p, i % c.width[p], i / c.width[p]);
                to[0] = (uint8_t)code;
                to[1] = (uint8_t)(code >> 8);
            }
        XXH128_canonical_t sum;
        XXH128_canonicalFromHash(&sum, XXH3_128bits(codes, sizeof codes));
        int used = snprintf(line, sizeof line, "%08d ", f);
        for (int i = 0; i < 16; i++) used += snprintf(line + used, 3, "%02x", sum.digest[i]);
        line[used++] = '\n';
        assert_true(length + (size_t)used <= size);
        assert_memory_equal(bytes + length, line, (size_t)used);
        length += (size_t)used;
    }
    assert_int_equal(length, size);
    free(bytes);
    free_clip(&c);
}

/* ---- Pictures ---- */

static weft_error oiio_error;

static void *oiio_entry(const char *name) {
    void *symbol;
    if (wf_module_symbol("oiio", name, "a picture", &symbol, &oiio_error)) {
        print_message("skipped: %s\n", oiio_error.text);
        skip();
    }
    return symbol;
}

/* Whether a sequence of this kind can be written: some are the module's. */
static bool is_there(const wf_output_kind *kind) {
    bool own = !strcmp(kind->name, "OpenEXR") || !strcmp(kind->name, "PNG");
    return own || !wf_module_check("oiio", kind->name, NULL);
}

/* The picture at path as floats [3][lines][width]. */
static float *read_picture(const char *path, wf_image_info *info, weft_error *err) {
    void *probe_at = oiio_entry("wf_oiio_probe"), *read_at = oiio_entry("wf_oiio_read");
    wf_oiio_probe_fn *probe;
    wf_oiio_read_fn *read;
    memcpy(&probe, &probe_at, sizeof probe);
    memcpy(&read, &read_at, sizeof read);
    const int channel[3] = {0, 1, 2};
    char *names = NULL;
    int count;
    weft_status status = probe(path, -1, (size_t)1 << 30, info, &count, &names, err);
    free(names);
    if (status) return NULL;
    size_t samples =
        (size_t)(info->data.x1 - info->data.x0) * (size_t)(info->data.y1 - info->data.y0);
    float *planes = malloc(3 * samples * sizeof *planes);
    assert_non_null(planes);
    for (size_t i = 0; i < 3 * samples; i++) planes[i] = -12345;
    if (!read(path, -1, channel, 3, &info->data, planes, err)) return planes;
    free(planes);
    return NULL;
}

static void check_samples(const clip *c, int f, const float *planes) {
    double most = (double)((1u << (c->options.bits & 31)) - 1);
    size_t width = c->width[0];
    for (size_t p = 0; p < 3; p++)
        for (size_t i = 0; i < width * c->lines; i++) {
            float got = planes[p * width * c->lines + i];
            size_t at = i / width * c->stride[p] + i % width;
            if (c->options.layout == WF_LINEAR)
                assert_memory_equal(&got, (const float *)c->plane[f][p] + at, sizeof got);
            else
                assert_int_equal((int)((double)got * most + 0.5),
                                 ((const uint16_t *)c->plane[f][p])[at]);
        }
}

static void check_info(const clip *c, const wf_image_info *info) {
    double aspect = wf_ratio_value(c->raster.pixel_aspect);
    assert_int_equal(info->data.x1 - info->data.x0, c->raster.width_px);
    assert_int_equal(info->data.y1 - info->data.y0, c->raster.lines);
    assert_memory_equal(&info->data, &info->display, sizeof info->data);
    /* PNG and TIFF hold the aspect as a ratio of resolutions. */
    assert_true(info->pixel_aspect > aspect * 0.9997 && info->pixel_aspect < aspect * 1.0003);
    if (!strcasecmp(c->output.kind->name, "DPX") || c->options.layout == WF_LINEAR) {
        assert_true(wf_ratio_equal(info->rate, c->raster.frame_rate));
        assert_memory_equal(info->timecode, "01:02:03:0", 10);
    }
}

static void check_picture_files(clip *c, const char *ending) {
    char name[64], path[512], output[512];
    snprintf(name, sizeof name, "out.####.%s", ending);
    job_clean();
    written(c, name, 0, FRAMES, output);
    for (int f = 0; f < FRAMES; f++) {
        wf_image_info info;
        weft_error err = {""};
        snprintf(name, sizeof name, "out.%04d.%s", f, ending);
        job_path(path, name);
        float *planes = read_picture(path, &info, &err);
        if (!planes) fail_msg("%s", err.text);
        check_samples(c, f, planes);
        check_info(c, &info);
        if (*info.timecode) assert_int_equal(info.timecode[10], '4' + f);
        free(planes);
    }
}

static void pictures_hold_the_codes(void **state) {
    (void)state;
    static const char *const rasters[] = {"525i", "53x14@30i,tff", "1x1@24p",
                                          "7x3@23.976p,par=160:177"};
    oiio_entry("wf_oiio_read");
    for (size_t k = 0; wf_output_at(k).kind; k++) {
        const wf_output row = wf_output_at(k);
        const wf_output_kind *kind = row.kind;
        if (!kind->sequence) continue;
        char ending[16];
        snprintf(ending, sizeof ending, "%.*s", (int)strcspn(kind->endings, " "),
                 kind->endings);
        for (size_t r = 0; r < sizeof rasters / sizeof *rasters; r++)
            for (int bits = 8; bits <= 32; bits++) {
                bool linear = kind->layout == WF_LINEAR;
                if (linear ? bits != 32 : bits == 32 || !(kind->bits_mask & 1u << bits))
                    continue;
                clip c = make_clip(row, rasters[r], bits, false);
                check_picture_files(&c, ending);
                free_clip(&c);
            }
    }
}

static uint32_t big_endian(const uint8_t *b) {
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static uint32_t dpx_u32(const uint8_t *dpx, size_t offset) {
    uint32_t word = big_endian(dpx + offset);
    return dpx[0] == 'X' ? __builtin_bswap32(word) : word;
}

static float dpx_r32(const uint8_t *dpx, size_t offset) {
    uint32_t word = dpx_u32(dpx, offset);
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

/* The elements of the header by their offsets in SMPTE ST 268, and 10-bit pixels as filled
 * words: R, G, B from bit 31 down. */
static void check_dpx(const clip *c, const uint8_t *dpx, size_t size, int interlace, int field,
                      int transfer) {
    float rate = (float)wf_ratio_value(c->raster.frame_rate);
    assert_memory_equal(dpx, "SDPX", 4); /* big-endian, which every reader takes */
    assert_int_equal(dpx_u32(dpx, 16), size);
    assert_int_equal(dpx_u32(dpx, 772), c->raster.width_px);
    assert_int_equal(dpx_u32(dpx, 776), c->raster.lines);
    assert_int_equal(dpx[800], 50); /* R G B */
    assert_int_equal(dpx[801], transfer);
    assert_int_equal(dpx[802], transfer);
    assert_int_equal(dpx[803], 10);
    assert_true(dpx_r32(dpx, 1724) == rate && dpx_r32(dpx, 1940) == rate);
    assert_int_equal(dpx_u32(dpx, 1920), 0x01020304);
    assert_int_equal(dpx[1928], interlace);
    assert_int_equal(dpx[1929], field);
    assert_int_equal(dpx_u32(dpx, 1628), c->raster.pixel_aspect.num);
    assert_int_equal(dpx_u32(dpx, 1632), c->raster.pixel_aspect.den);
    size_t offset = dpx_u32(dpx, 4), width = c->width[0];
    assert_int_equal(size, offset + 4 * width * c->lines);
    for (size_t i = 0; i < width * c->lines; i++)
        for (int p = 0; p < 3; p++)
            assert_int_equal(dpx_u32(dpx, offset + 4 * i) >> (22 - 10 * p) & 1023,
                             code_at(c, 0, p, i % width, i / width));
}

static void dpx_says_how_it_is_interlaced(void **state) {
    (void)state;
    static const struct {
        const char *raster, *space;
        int interlace, field, transfer;
    } rows[] = {
        {"525i", "rec601-525", 1, 2, 8},         {"525i-rp202", "rec601-525", 1, 1, 8},
        {"625i", "rec601-625", 1, 1, 7},         {"1080i59.94", "rec709", 1, 1, 6},
        {"1080psf25", "rec709-camera", 0, 1, 6}, {"52x14@24p", "rec2020", 0, 1, 0},
    };
    oiio_entry("wf_oiio_dpx");
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        char output[512];
        size_t size;
        job_clean();
        clip c = make_clip(output_for("out.dpx"), rows[r].raster, 10, false);
        c.options.color_space = rows[r].space;
        written(&c, "out.dpx", 0, 1, output);
        uint8_t *dpx = job_file("out.dpx", &size);
        assert_true(size > 2048);
        check_dpx(&c, dpx, size, rows[r].interlace, rows[r].field, rows[r].transfer);
        free(dpx);
        free_clip(&c);
    }
}

/* Datum n of a line: 12 bits are packed from the lowest of big-endian 32-bit words on, the rest
 * are big-endian by themselves. */
static unsigned dpx_datum(const uint8_t *line, size_t n, int bits) {
    if (bits == 8) return line[n];
    if (bits == 16) return (unsigned)line[2 * n] << 8 | line[2 * n + 1];
    size_t word = n * 12 / 32, shift = n * 12 % 32;
    uint64_t both = big_endian(line + 4 * word);
    if (shift > 20) both |= (uint64_t)big_endian(line + 4 * word + 4) << 32;
    return both >> shift & 4095;
}

static void dpx_packs_every_depth(void **state) {
    (void)state;
    oiio_entry("wf_oiio_dpx");
    for (int bits = 8; bits <= 16; bits += 4) {
        char output[512];
        size_t size;
        job_clean();
        clip c = make_clip(output_for("out.dpx"), "52x14@30i,tff", bits, false);
        written(&c, "out.dpx", 0, 1, output);
        uint8_t *dpx = job_file("out.dpx", &size);
        size_t line = (3 * c.width[0] * (size_t)bits + 31) / 32 * 4, offset = dpx_u32(dpx, 4);
        assert_int_equal(dpx[803], bits);
        if (bits == 12) assert_int_equal(dpx[805], 0); /* packed */
        assert_int_equal(size - offset, line * c.lines);
        for (size_t y = 0; y < c.lines; y++)
            for (size_t n = 0; n < 3 * c.width[0]; n++)
                assert_int_equal(dpx_datum(dpx + offset + y * line, n, bits),
                                 code_at(&c, 0, (int)(n % 3), n / 3, y));
        free(dpx);
        free_clip(&c);
    }
}

static void labels_count_on(void **state) {
    (void)state;
    char output[512];
    size_t size;
    oiio_entry("wf_oiio_dpx");
    job_clean();
    clip c = make_clip(output_for("out.####.dpx"), "525i", 10, false);
    c.options.timecode = "00:00:59;28";
    written(&c, "out.####.dpx", 0, FRAMES, output);
    static const uint32_t words[FRAMES] = {0x00005968, 0x00005969,
                                           0x00010042}; /* bit 6: drop frame */
    for (int f = 0; f < FRAMES; f++) {
        char name[32];
        snprintf(name, sizeof name, "out.%04d.dpx", f);
        uint8_t *dpx = job_file(name, &size);
        assert_int_equal(dpx_u32(dpx, 1920), words[f]);
        free(dpx);
    }
    free_clip(&c);
}

/* ---- Names ---- */

static void names_ask_for_kinds(void **state) {
    (void)state;
    static const struct {
        const char *output, *kind;
    } rows[] = {{"-", "y4m -"},
                {"a.b/c.Y4M", "y4m -"},
                {"x.v210", "v210"},
                {"x.uyvy", "uyvy"},
                {"x.####.exr", "exr"},
                {"x.%04d.dpx", "dpx"},
                {"x.@@@.tiff", "tif tiff"},
                {"x.#.tif", "tif tiff"},
                {"x.PNG", "png"},
                {"null:", "null:"},
                {"hash:out.exr", "hash:"},
                {"hash:-", "hash:"},
                {"a.mov", "mov"},
                {"b.c/a.MXF", "mxf"},
                {"a.mkv", "mkv"}};
    weft_error err;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_string_equal(output_for(rows[i].output).kind->endings, rows[i].kind);
    for (size_t k = 0; wf_output_at(k).kind; k++) {
        char name[64];
        const wf_output row = wf_output_at(k);
        const wf_output_kind *kind = row.kind;
        name_for(kind, name);
        wf_output found = wf_output_for(name, is_delivery(kind) ? kind->name : NULL, &err);
        assert_ptr_equal(found.kind, kind);
        assert_ptr_equal(found.ops, row.ops);
    }
}

static void other_names_are_refused(void **state) {
    (void)state;
    static const char *const unknown[] = {"",       "x",  "y4m",    "exr/x", "x.exr/", "x.jpg",
                                          "x.####", "--", "x.y4m2", "hash",  "a.m4v",  "mov"};
    static const struct {
        const char *output, *codec, *says;
    } wrong[] = {{"a.mov", "imx50", "goes into .mxf"}, {"a.mkv", "v210", "takes ffv1"},
                 {"a.mov", "prorez", "prores"},        {"a.mxf", "", "xdcamhd422"},
                 {"a.y4m", "v210", "no codec"},        {"-", "ffv1", "no codec"}};
    weft_error err;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_null(wf_output_for(wrong[i].output, wrong[i].codec, &err).kind);
        if (!strstr(err.text, wrong[i].says))
            fail_msg("'%s' lacks %s", err.text, wrong[i].says);
    }
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        assert_null(wf_output_for(unknown[i], NULL, &err).kind);
        for (size_t k = 0; wf_output_at(k).kind; k++) {
            char name[64];
            name_for(wf_output_at(k).kind, name);
            if (!strstr(err.text, name) && !strstr(name, "hash:"))
                fail_msg("'%s' lacks %s", err.text, name);
        }
    }
    assert_null(wf_output_for("x", NULL, NULL).kind);
}

static void frames_need_names(void **state) {
    (void)state;
    char path[512];
    weft_error err = {""};
    for (size_t k = 0; wf_output_at(k).kind; k++) {
        if (!wf_output_at(k).kind->sequence || !is_there(wf_output_at(k).kind)) continue;
        char name[32];
        job_clean();
        snprintf(name, sizeof name, "still.%.*s",
                 (int)strcspn(wf_output_at(k).kind->endings, " "),
                 wf_output_at(k).kind->endings);
        job_path(path, name);
        clip c =
            make_clip(wf_output_at(k), "8x4@30p", wf_output_at(k).kind->default_bits, false);
        assert_int_equal(write_frames(&c, path, 0, 2, &err), WEFT_USAGE);
        assert_non_null(strstr(err.text, "still.####."));
        c.options.chunked = true; /* another chunk would replace it */
        assert_int_equal(write_frames(&c, path, 1, 2, &err), WEFT_USAGE);
        c.options.chunked = false;
        assert_int_not_equal(access(path, F_OK), 0);
        if (write_frames(&c, path, 0, 1, &err)) fail_msg("%s", err.text);
        assert_int_equal(access(path, F_OK), 0);
        free_clip(&c);
    }
}

/* ---- Chunks, presence, failure ---- */

static int files_there(void) {
    DIR *dir = opendir(job_directory);
    int count = 0;
    assert_non_null(dir);
    for (const struct dirent *entry; (entry = readdir(dir));)
        count += entry->d_name[0] != '.' || entry->d_name[1] > '.';
    closedir(dir);
    return count;
}

/* A clip that a kind takes, small. */
static clip small_clip(wf_output row) {
    const wf_output_kind *kind = row.kind;
    job_clean();
    return make_clip(row, "52x14@30i,tff", kind->default_bits, kind->layout == WF_YCBCR);
}

/* Of deliveries those that take the small clip, are their container's default, and can be
 * written here at all. */
static bool can_be_tried(wf_output row) {
    const wf_output_kind *kind = row.kind;
    if (!is_delivery(kind)) return !kind->sequence || is_there(kind);
    char name[64];
    name_for(kind, name);
    clip c = small_clip(row);
    c.options.output = name;
    c.options.raster = &c.raster;
    bool can = !wf_module_check("libav", name, NULL) && output_for(name).kind == kind &&
               !row.ops->check(&c.options, NULL);
    free_clip(&c);
    return can;
}

static void chunks_join(void **state) {
    (void)state;
    for (size_t k = 0; wf_output_at(k).kind; k++) {
        char name[64], output[512], part[2][512];
        size_t size, first_size, second_size;
        const wf_output row = wf_output_at(k);
        const wf_output_kind *kind = row.kind;
        if (!kind->joins || kind->sequence || !strcmp(kind->endings, "null:")) continue;
        clip c = small_clip(row);
        name_for(kind, name);
        written(&c, name, 0, FRAMES, output);
        bool hash = !strncmp(name, "hash:", 5);
        snprintf(part[0], 512, "%s1", name);
        snprintf(part[1], 512, "%s2", name);
        written(&c, part[0], 0, 1, output);
        c.options.stream_header = false;
        written(&c, part[1], 1, FRAMES, output);
        uint8_t *whole = job_file(name + (hash ? 5 : 0), &size);
        uint8_t *first = job_file(part[0] + (hash ? 5 : 0), &first_size);
        uint8_t *second = job_file(part[1] + (hash ? 5 : 0), &second_size);
        assert_int_equal(first_size + second_size, size);
        assert_memory_equal(whole, first, first_size);
        assert_memory_equal(whole + first_size, second, second_size);
        free(whole), free(first), free(second);
        free_clip(&c);
    }
}

/* Bytes that make a file of a frame; none for streams. */
static void path_of_frame(const wf_output_kind *kind, const char *name, int frame,
                          char path[512]) {
    char plain[64];
    snprintf(plain, sizeof plain, "%s", strncmp(name, "hash:", 5) ? name : name + 5);
    if (kind->sequence)
        snprintf(plain, sizeof plain, "out.%04d.%.*s", frame, (int)strcspn(kind->endings, " "),
                 kind->endings);
    job_path(path, plain);
}

static void presence(void **state) {
    (void)state;
    for (size_t k = 0; wf_output_at(k).kind; k++) {
        char name[64], output[512], path[512];
        weft_error err = {""};
        const wf_output row = wf_output_at(k);
        const wf_output_kind *kind = row.kind;
        name_for(kind, name);
        if (!can_be_tried(row)) continue;
        if (!strcmp(name, "null:")) {
            assert_false(wf_output_present(kind, name, -1));
            continue;
        }
        clip c = small_clip(row);
        int index = kind->sequence ? 1 : -1;
        path_of_frame(kind, name, 1, path);
        job_path(output, strncmp(name, "hash:", 5) ? name : name + 5);
        if (!strncmp(name, "hash:", 5)) snprintf(output, sizeof output, "hash:%.500s", path);
        assert_false(wf_output_present(kind, output, index));
        FILE *empty = fopen(path, "w");
        assert_non_null(empty);
        fclose(empty);
        assert_false(wf_output_present(kind, output, index)); /* nothing of ours is empty */
        c.options.resume = true;                              /* and it is replaced */
        if (write_frames(&c, output, 0, FRAMES, &err)) fail_msg("%s", err.text);
        assert_true(wf_output_present(kind, output, index));
        c.options.resume = false;
        assert_int_equal(write_frames(&c, output, 0, FRAMES, &err), WEFT_FAILED);
        assert_non_null(strstr(err.text, "--overwrite"));
        c.options.overwrite = true;
        if (write_frames(&c, output, 0, FRAMES, &err)) fail_msg("%s", err.text);
        free_clip(&c);
    }
    assert_false(wf_output_present(output_for("-").kind, "-", -1));
    assert_false(wf_output_present(output_for("x.y4m").kind, job_directory, -1));
}

/* Frames after one that exists are not written, so that a run does not end in its middle. */
static void what_exists_is_seen_first(void **state) {
    (void)state;
    char path[512];
    weft_error err = {""};
    clip c = small_clip(output_for("out.####.exr"));
    job_path(path, "out.0002.exr");
    FILE *file = fopen(path, "w");
    assert_true(file && fputs("something", file) >= 0 && !fclose(file));
    job_path(path, "out.####.exr");
    assert_int_equal(write_frames(&c, path, 0, FRAMES, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "out.0002.exr exists"));
    assert_int_equal(files_there(), 1);
    free_clip(&c);
}

/* A name that leads to a full device, which takes nothing: the write fails and says so. */
static void full_devices(void **state) {
    (void)state;
    for (size_t k = 0; wf_output_at(k).kind; k++) {
        char name[64], output[512], path[512], target[64];
        weft_error err = {""};
        const wf_output row = wf_output_at(k);
        const wf_output_kind *kind = row.kind;
        name_for(kind, name);
        if (!strcmp(name, "null:") || !can_be_tried(row)) continue;
        clip c = small_clip(row);
        path_of_frame(kind, name, 0, path);
        assert_int_equal(symlink("/dev/full", path), 0);
        job_path(output, strncmp(name, "hash:", 5) ? name : name + 5);
        if (!strncmp(name, "hash:", 5)) snprintf(output, sizeof output, "hash:%.500s", path);
        assert_int_equal(write_frames(&c, output, 0, FRAMES, &err), WEFT_FAILED);
        if (!strstr(err.text, "space") || !strstr(err.text, path)) fail_msg("%s", err.text);
        assert_int_equal(files_there(), 1);
        assert_int_equal(readlink(path, target, sizeof target), strlen("/dev/full"));
        free_clip(&c);
    }
}

static void unfinished_outputs_leave_nothing(void **state) {
    (void)state;
    for (size_t k = 0; wf_output_at(k).kind; k++) {
        char name[64], output[512], path[512];
        weft_error err = {""};
        wf_sink *sink;
        const wf_output row = wf_output_at(k);
        const wf_output_kind *kind = row.kind;
        if (!can_be_tried(row)) continue;
        clip c = small_clip(row);
        name_for(kind, name);
        job_path(path, strncmp(name, "hash:", 5) ? name : name + 5);
        snprintf(output, sizeof output, "%s%.500s",
                 strncmp(name, "hash:", 5) ? "" : "hash:", path);
        c.options.output = strcmp(name, "null:") ? output : name;
        c.options.raster = &c.raster;
        if (row.ops->open(&c.options, &sink, &err)) fail_msg("%s", err.text);
        if (!kind->sequence) {
            wf_frame frame = {.index = 0};
            for (int p = 0; p < 3; p++)
                frame.plane[p] = c.plane[0][p], frame.stride[p] = c.stride[p];
            if (row.ops->write(sink, &frame, &err)) fail_msg("%s", err.text);
        }
        row.ops->abandon(sink);
        assert_int_equal(files_there(), 0);
        free_clip(&c);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_ask_for_kinds),
        cmocka_unit_test(other_names_are_refused),
        cmocka_unit_test(y4m_holds_the_codes),
        cmocka_unit_test(v210_holds_the_codes),
        cmocka_unit_test(uyvy_holds_the_codes),
        cmocka_unit_test(hashes_are_of_the_codes),
        cmocka_unit_test(pictures_hold_the_codes),
        cmocka_unit_test(dpx_says_how_it_is_interlaced),
        cmocka_unit_test(dpx_packs_every_depth),
        cmocka_unit_test(labels_count_on),
        cmocka_unit_test(frames_need_names),
        cmocka_unit_test(chunks_join),
        cmocka_unit_test(presence),
        cmocka_unit_test(what_exists_is_seen_first),
        cmocka_unit_test(full_devices),
        cmocka_unit_test(unfinished_outputs_leave_nothing),
    };
    mallopt(M_PERTURB, 0x5a); /* what a sink leaves unwritten is not to be 0 by chance */
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
