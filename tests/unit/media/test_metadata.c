/* The own readers of QuickTime and MXF: what headers built here say, cut off at every byte, and
 * with every bit flipped. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/base/big_endian.h"
#include "convert/media/klv.h"
#include "convert/media/metadata_mov.h"
#include "convert/media/metadata_mxf.h"

#define MOST 2048

typedef void reader_fn(FILE *file, wf_metadata *metadata);

typedef struct bytes {
    uint8_t data[MOST];
    size_t size;
} bytes;

static void put(bytes *b, uint64_t value, size_t count) {
    wf_put_big_endian(b->data + b->size, value, count);
    b->size += count;
}

static void put_text(bytes *b, const char *text) {
    memcpy(b->data + b->size, text, strlen(text));
    b->size += strlen(text);
}

static wf_metadata metadata_of(const uint8_t *data, size_t size, reader_fn *reader) {
    wf_metadata metadata = {.frame_layout = -1, .dominance = -1, .siting = -1};
    uint8_t *exact = malloc(size); /* a sanitizer sees the first byte beyond */
    assert_non_null(exact);
    memcpy(exact, data, size);
    FILE *file = fmemopen(exact, size, "rb");
    assert_non_null(file);
    reader(file, &metadata);
    fclose(file);
    free(exact);
    return metadata;
}

/* ---- QuickTime ---- */

static size_t begin(bytes *b, const char *name) {
    put(b, 0, 4);
    put_text(b, name);
    return b->size - 8;
}

static void end(bytes *b, size_t begun) {
    wf_put_big_endian(b->data + begun, b->size - begun, 4);
}

static void put_handler(bytes *b, const char *kind) {
    size_t hdlr = begin(b, "hdlr");
    put(b, 0, 8);
    put_text(b, kind);
    end(b, hdlr);
}

static void put_entry(bytes *b, bool video) {
    size_t entry = begin(b, video ? "v210" : "tmcd"), part;
    put(b, 0, 8);
    if (!video) {
        put(b, 0, 4);
        put(b, 1, 4); /* drop frame */
        put(b, 30000, 4);
        put(b, 1001, 4);
        put(b, 30, 1);
        put(b, 0, 1);
    } else {
        for (int i = 0; i < 70; i++) put(b, 0, 1);
        part = begin(b, "fiel");
        put(b, 0x020e, 2);
        end(b, part);
        part = begin(b, "pasp");
        put(b, 10, 4);
        put(b, 11, 4);
        end(b, part);
        part = begin(b, "clap");
        for (int i = 0; i < 8; i++) put(b, i == 0 ? 1409 : i == 2 ? 480 : i == 1 ? 2 : 1, 4);
        end(b, part);
    }
    end(b, entry);
}

static void put_track(bytes *b, bool video) {
    size_t trak = begin(b, "trak"), mdia = begin(b, "mdia");
    put_handler(b, video ? "vide" : "tmcd");
    size_t minf = begin(b, "minf"), stbl = begin(b, "stbl"), stsd = begin(b, "stsd");
    put(b, 1, 8);
    put_entry(b, video);
    end(b, stsd);
    end(b, stbl);
    end(b, minf);
    end(b, mdia);
    end(b, trak);
}

static bytes make_mov(void) {
    bytes b = {.size = 0};
    size_t moov = begin(&b, "moov");
    put_track(&b, true);
    put_track(&b, false);
    end(&b, moov);
    return b;
}

static void test_mov(void **state) {
    (void)state;
    bytes b = make_mov();
    wf_metadata c = metadata_of(b.data, b.size, wf_metadata_mov);
    assert_true(c.has_fiel && c.has_pasp && c.has_clap && !c.has_colr);
    assert_int_equal(c.fiel[0], 2);
    assert_int_equal(c.fiel[1], 14);
    assert_int_equal(c.clean[0], 1409 * 32768);
    assert_int_equal(c.clean[1], 480 * 65536);
    assert_int_equal(c.timecode_base, 30);
    assert_true(c.timecode_drop);
}

/* ---- MXF ---- */

static void put_head(bytes *b, const char *hex, size_t length) {
    for (size_t i = 0; i < 32; i += 2) {
        char two[3] = {hex[i], hex[i + 1], 0};
        put(b, strtoul(two, NULL, 16), 1);
    }
    put(b, 0x83, 1);
    put(b, length, 3);
}

static void put_item(bytes *b, unsigned tag, uint64_t value, size_t count) {
    put(b, tag, 2);
    put(b, count, 2);
    put(b, value, count);
}

static bytes make_mxf(void) {
    bytes b = {.size = 0};
    put_head(&b, "060e2b34020501010d01020101020400", 88);
    memset(b.data + b.size, 0, 88);
    b.data[b.size + 64 + 12] = b.data[b.size + 64 + 13] = 1;
    b.size += 88;
    put_head(&b, "060e2b34025301010d01010101011400", 11);
    put_item(&b, WF_MXF_BASE, 25, 2);
    put_item(&b, WF_MXF_DROP, 0, 1);
    put_head(&b, "060e2b34025301010d01010101012800", 47);
    put_item(&b, WF_MXF_FRAME_LAYOUT, 1, 1);
    put_item(&b, WF_MXF_DOMINANCE, 1, 1);
    put_item(&b, WF_MXF_SITING, 4, 1);
    put_item(&b, WF_MXF_ASPECT, (uint64_t)16 << 32 | 9, 8);
    put(&b, WF_MXF_LINE_MAP, 2);
    put(&b, 16, 2);
    put(&b, (uint64_t)2 << 32 | 4, 8);
    put(&b, (uint64_t)21 << 32 | 584, 8);
    return b;
}

static void test_mxf(void **state) {
    (void)state;
    bytes b = make_mxf();
    wf_metadata c = metadata_of(b.data, b.size, wf_metadata_mxf);
    assert_string_equal(c.pattern, "OP1a");
    assert_int_equal(c.timecode_base, 25);
    assert_false(c.timecode_drop);
    assert_int_equal(c.frame_layout, 1);
    assert_int_equal(c.dominance, 1);
    assert_int_equal(c.siting, 4);
    assert_true(wf_ratio_equal(c.aspect, wf_ratio(16, 9)));
    assert_true(c.has_line_map && c.line_map[0] == 21 && c.line_map[1] == 584);
}

/* ---- Damage ---- */

static const struct {
    bytes (*make)(void);
    reader_fn *reader;
} kinds[] = {{make_mov, wf_metadata_mov}, {make_mxf, wf_metadata_mxf}};

/* A header that is cut off says nothing that the whole one does not. */
static void test_cut(void **state) {
    (void)state;
    for (size_t k = 0; k < 2; k++) {
        bytes b = kinds[k].make();
        wf_metadata whole = metadata_of(b.data, b.size, kinds[k].reader);
        for (size_t size = 1; size < b.size; size++) {
            wf_metadata c = metadata_of(b.data, size, kinds[k].reader);
            assert_true(!c.has_fiel || c.fiel[1] == whole.fiel[1]);
            assert_true(!c.has_clap || c.clean[1] == whole.clean[1]);
            assert_true(!c.has_line_map || c.line_map[1] == whole.line_map[1]);
            assert_true(!c.timecode_base || c.timecode_base == whole.timecode_base);
            assert_true(c.frame_layout == -1 || c.frame_layout == whole.frame_layout);
        }
    }
}

static void test_flipped(void **state) {
    (void)state;
    for (size_t k = 0; k < 2; k++) {
        bytes b = kinds[k].make();
        wf_metadata whole = metadata_of(b.data, b.size, kinds[k].reader);
        size_t changed = 0;
        for (size_t bit = 0; bit < 8 * b.size; bit++) {
            b.data[bit / 8] ^= (uint8_t)(1u << bit % 8);
            wf_metadata c = metadata_of(b.data, b.size, kinds[k].reader);
            b.data[bit / 8] ^= (uint8_t)(1u << bit % 8);
            assert_true(memchr(c.pattern, 0, sizeof c.pattern) != NULL);
            changed += c.fiel[1] != whole.fiel[1] || c.line_map[1] != whole.line_map[1];
        }
        assert_true(changed > 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mov),
        cmocka_unit_test(test_mxf),
        cmocka_unit_test(test_cut),
        cmocka_unit_test(test_flipped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
