/* Labels in the headers of DPX sequences: SMPTE ST 268-1's television header, in both byte
 * orders. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/check/verify/frame_labels.h"
#include "convert/job/timecode.h"

static char directory[] = "/tmp/weft-labels-XXXXXX";

enum { TELEVISION_AT = 1920, HEADER_BYTES = 2048, UNDEFINED = 0xff };

static int make_directory(void **state) {
    (void)state;
    return mkdtemp(directory) ? 0 : -1;
}

static int remove_directory(void **state) {
    (void)state;
    return rmdir(directory);
}

/* What a header says; bytes less than HEADER_BYTES cut it off. */
typedef struct header {
    bool labeled, little;
    wf_timecode label;
    int interlace;
    size_t bytes;
} header;

static void path_of(char path[64], int number) {
    snprintf(path, 64, "%s/f.%04d.dpx", directory, number);
}

static void write_header(int number, const header *h, wf_rational rate) {
    uint8_t bytes[HEADER_BYTES] = {0};
    uint32_t word = h->labeled ? wf_timecode_bcd(&h->label, rate) : UINT32_MAX;
    char path[64];
    memcpy(bytes, h->little ? "XPDS" : "SDPX", 4);
    for (int i = 0; i < 4; i++)
        bytes[TELEVISION_AT + i] = (uint8_t)(word >> (h->little ? 8 * i : 24 - 8 * i));
    bytes[TELEVISION_AT + 8] = (uint8_t)h->interlace;
    path_of(path, number);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, h->bytes, file), h->bytes);
    assert_int_equal(fclose(file), 0);
}

/* Writes the headers, reads their labels and removes the files. */
static wf_frame_labels labels_of(const header *headers, int count, wf_rational rate) {
    wf_frame_labels labels;
    weft_error err = {""};
    char pattern[64], path[64];
    for (int i = 0; i < count; i++) write_header(i + 1, &headers[i], rate);
    snprintf(pattern, sizeof pattern, "%s/f.####.dpx", directory);
    if (wf_frame_labels_read(pattern, rate, 1, &labels, &err)) fail_msg("%s", err.text);
    for (int i = 0; i < count; i++) {
        path_of(path, i + 1);
        unlink(path);
    }
    return labels;
}

static header at(int seconds, int frames) {
    return (header){.labeled = true,
                    .label = {.hours = 10, .seconds = seconds, .frames = frames},
                    .interlace = 1,
                    .bytes = HEADER_BYTES};
}

static void assert_label(wf_timecode label, const char *text) {
    char is[WF_TIMECODE_SIZE];
    assert_string_equal(wf_timecode_text(&label, is), text);
}

static void labels_that_follow(void **state) {
    (void)state;
    header h[3] = {at(0, 23), at(0, 24), at(1, 0)};
    for (int little = 0; little < 2; little++) {
        h[1].little = little;
        wf_frame_labels l = labels_of(h, 3, wf_ratio(25, 1));
        assert_int_equal(l.files, 3);
        assert_int_equal(l.labeled, 3);
        assert_int_equal(l.wrong, 0);
        assert_int_equal(l.interlace, 1);
        assert_label(l.first, "10:00:00:23");
    }
}

/* From 50 frames a second on the word counts pairs, and a flag tells which of the pair it is.
 */
static void pairs_of_frames(void **state) {
    (void)state;
    const header h[3] = {at(0, 48), at(0, 49), at(1, 0)};
    wf_frame_labels l = labels_of(h, 3, wf_ratio(50, 1));
    assert_int_equal(l.labeled, 3);
    assert_int_equal(l.wrong, 0);
    assert_label(l.first, "10:00:00:48");
}

static void the_first_that_does_not_follow(void **state) {
    (void)state;
    const header h[4] = {at(0, 5), at(0, 6), at(0, 8), at(0, 9)};
    wf_frame_labels l = labels_of(h, 4, wf_ratio(25, 1));
    assert_int_equal(l.wrong, 2);
    assert_int_equal(l.wrong_at, 2);
    assert_label(l.is, "10:00:00:08");
    assert_label(l.should, "10:00:00:07");
}

static void what_headers_do_not_say(void **state) {
    (void)state;
    header h[3] = {at(0, 0), at(0, 1), at(0, 2)};
    h[1].labeled = false;
    h[2].interlace = 0;
    wf_frame_labels l = labels_of(h, 3, wf_ratio(25, 1));
    assert_int_equal(l.files, 3);
    assert_int_equal(l.labeled, 2);
    assert_int_equal(l.wrong, 0); /* the third is two after the first */
    assert_int_equal(l.interlace, -1);
    h[0].interlace = UNDEFINED;
    l = labels_of(h, 1, wf_ratio(25, 1));
    assert_int_equal(l.interlace, -1);
}

/* A file that ends before its television header has no label. */
static void cut_off_headers(void **state) {
    (void)state;
    header h[2] = {at(0, 0), at(0, 1)};
    h[0].bytes = TELEVISION_AT + 3;
    h[1].bytes = 0;
    wf_frame_labels l = labels_of(h, 2, wf_ratio(25, 1));
    assert_int_equal(l.files, 2);
    assert_int_equal(l.labeled, 0);
    assert_int_equal(l.interlace, -1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(labels_that_follow),
        cmocka_unit_test(pairs_of_frames),
        cmocka_unit_test(the_first_that_does_not_follow),
        cmocka_unit_test(what_headers_do_not_say),
        cmocka_unit_test(cut_off_headers),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
