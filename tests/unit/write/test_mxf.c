/* The MXF writer by itself: its bytes against the standards' values, the label of every raster,
 * and what it refuses. Whole files are walked by mxf_check.py (test_rawmxf.sh). */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/write/mxf_klv.h"
#include "convert/write/mxf.h"
#include "tests/unit/support/jobs.h"

/* A picture may have any number of bytes as far as the writer is concerned. */
#define PICTURE_BYTES 100

static wf_raster raster_of(const char *name) {
    wf_raster raster;
    char why[256];
    if (!wf_raster_parse(name, &raster, why, sizeof why)) fail_msg("%s", why);
    return raster;
}

static wf_mxf_options options_for(const wf_raster *raster, int64_t frames, int tracks) {
    return (wf_mxf_options){.raster = raster,
                            .bits = 10,
                            .frame_bytes = PICTURE_BYTES,
                            .color_space = "",
                            .frame_count = frames,
                            .sound = {.tracks = tracks, .bits = 24}};
}

/* Writes `frames` frames, the first of bytes `fill`, into out.mxf, or says why it could not. */
static weft_status write_file(const wf_mxf_options *o, int64_t frames, uint8_t fill,
                              weft_error *err) {
    char path[512];
    uint8_t picture[PICTURE_BYTES];
    wf_outfile *file;
    wf_mxf *mxf;
    job_path(path, "out.mxf");
    assert_int_equal(wf_outfile_open(path, true, &file, err), WEFT_OK);
    weft_status status = wf_mxf_open(o, file, &mxf, err);
    bool opened = !status;
    for (int64_t i = 0; i < frames && !status; i++) {
        memset(picture, fill + (int)i, sizeof picture);
        status = wf_mxf_write(mxf, picture, err);
    }
    if (!status) status = wf_mxf_finish(mxf, err);
    if (opened) wf_mxf_free(mxf);
    if (!status) return wf_outfile_commit(file, err);
    wf_outfile_abandon(file);
    return status;
}

static uint8_t *written(const wf_mxf_options *o, uint8_t fill, size_t *size) {
    weft_error err = {""};
    if (write_file(o, o->frame_count, fill, &err)) fail_msg("%s", err.text);
    return job_file("out.mxf", size);
}

static uint64_t number(const uint8_t *bytes, int count) {
    uint64_t value = 0;
    for (int i = 0; i < count; i++) value = value << 8 | bytes[i];
    return value;
}

/* The first place of `what`; fails if there is none. */
static const uint8_t *find(const uint8_t *bytes, size_t size, const void *what, size_t length) {
    const uint8_t *at = memmem(bytes, size, what, length);
    assert_non_null(at);
    return at;
}

/* ---- Partitions ---- */

/* ST 377-1: a header partition pack, closed and complete, of version 1.3. */
static const uint8_t pack_begins[] = {
    0x06, 0x0e, 0x2b, 0x34, 0x02, 0x05, 0x01, 0x01, 0x0d, 0x01, 0x02, 0x01, /* key */
    0x01, 0x02, 0x04, 0x00, 0x83, 0x00, 0x00, 0x68, /* 88 bytes and a label */
    0x00, 0x01, 0x00, 0x03, 0x00, 0x00, 0x02, 0x00, /* version, grid */
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, /* this */
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, /* the previous one */
};
static const uint8_t pack_ends[] = {
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,                         /* index bytes */
    0x00, 0x00, 0x00, 0x00,                                                 /* index SID */
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,                         /* body offset */
    0x00, 0x00, 0x00, 0x00,                                                 /* body SID */
    0x06, 0x0e, 0x2b, 0x34, 0x04, 0x01, 0x01, 0x01, 0x0d, 0x01, 0x02, 0x01, /* OP1a */
    0x01, 0x01, 0x09, 0x00, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x10, /* one label: */
    0x06, 0x0e, 0x2b, 0x34, 0x04, 0x01, 0x01, 0x01, 0x0d, 0x01, 0x03, 0x01, /* 525 lines, */
    0x02, 0x05, 0x01, 0x01, /* frame wrapped (ST 384) */
};

static void header_is_the_standards(void **state) {
    (void)state;
    size_t size;
    wf_raster raster = raster_of("525i");
    wf_mxf_options o = options_for(&raster, 3, 0);
    uint8_t *file = written(&o, 1, &size);
    assert_memory_equal(file, pack_begins, sizeof pack_begins);
    uint64_t footer = number(file + 44, 8), header = number(file + 52, 8);
    assert_memory_equal(file + 60, pack_ends, sizeof pack_ends);
    assert_int_equal(footer, 512 + header + 512 + 3 * 512); /* three units of one grid step */
    assert_int_equal(number(file + footer + 28, 8), footer);
    /* The random index pack: body SIDs and places; at the very end its own length. */
    assert_int_equal(number(file + size - 4, 4), 60);
    const uint8_t *index = file + size - 40;
    assert_int_equal(number(index, 4), 0);
    assert_int_equal(number(index + 4, 8), 0);
    assert_int_equal(number(index + 12, 4), 1);
    assert_int_equal(number(index + 16, 8), 512 + header);
    assert_int_equal(number(index + 24, 4), 0);
    assert_int_equal(number(index + 28, 8), footer);
    free(file);
}

/* A 2160-line v210 frame is longer than three bytes of length can say; its index too. */
static void large_frames_have_long_lengths(void **state) {
    (void)state;
    size_t size, bytes = (size_t)3840 / 6 * 16 * 2160;
    wf_raster raster = raster_of("2160p25");
    wf_mxf_options o = options_for(&raster, 1, 0);
    weft_error err = {""};
    char path[512];
    wf_outfile *file;
    wf_mxf *mxf;
    uint8_t *picture = calloc(1, bytes);
    assert_non_null(picture);
    o.frame_bytes = bytes;
    job_path(path, "out.mxf");
    assert_int_equal(wf_outfile_open(path, true, &file, &err), WEFT_OK);
    assert_int_equal(wf_mxf_open(&o, file, &mxf, &err), WEFT_OK);
    assert_int_equal(wf_mxf_write(mxf, picture, &err), WEFT_OK);
    assert_int_equal(wf_mxf_finish(mxf, &err), WEFT_OK);
    wf_mxf_free(mxf);
    assert_int_equal(wf_outfile_commit(file, &err), WEFT_OK);
    free(picture);
    uint8_t *read = job_file("out.mxf", &size);
    static const uint8_t element[] = {0x06, 0x0e, 0x2b, 0x34, 0x01, 0x02, 0x01, 0x01, 0x0d,
                                      0x01, 0x03, 0x01, 0x15, 0x01, 0x02, 0x01, 0x87};
    static const uint8_t unit_size[] = {0x3f, 0x05, 0x00, 0x04};
    assert_int_equal(number(find(read, size, element, sizeof element) + 17, 7), bytes);
    const uint8_t *unit = find(read, size, unit_size, sizeof unit_size);
    assert_int_equal(number(unit + 4, 4), (24 + bytes + 20 + 511) / 512 * 512);
    free(read);
}

/* ---- Labels ---- */

/* The last two bytes of ST 384's essence container labels, frame wrapped; 7f01 is that of
 * rasters which only the descriptor tells. */
static const struct {
    const char *raster;
    unsigned label;
} labels[] = {
    {"525i", 0x0101},        {"525i-imx", 0x0101},   {"525i-dv-wide", 0x0101},
    {"625i", 0x0105},        {"625i-dv", 0x0105},    {"1080p25", 0x0221},
    {"1080i50", 0x0229},     {"1080p29.97", 0x0231}, {"1080i59.94", 0x0239},
    {"1080p30", 0x0241},     {"1080i60", 0x0249},    {"1080p50", 0x0251},
    {"1080p59.94", 0x0259},  {"1080p60", 0x0261},    {"720p25", 0x0309},
    {"720p29.97", 0x0311},   {"720p30", 0x0315},     {"720p50", 0x0319},
    {"720p59.94", 0x0321},   {"720p60", 0x0325},     {"1080psf25", 0x7f01},
    {"1080p23.976", 0x7f01}, {"2160p50", 0x7f01},    {"720x486@29.97i,bff", 0x7f01},
};

static void rasters_have_their_labels(void **state) {
    (void)state;
    static const uint8_t picture_set[] = {0x0d, 0x01, 0x01, 0x01, 0x01, 0x01, 0x28, 0x00},
                         container[] = {0x30, 0x04, 0x00, 0x10};
    for (size_t i = 0; i < sizeof labels / sizeof *labels; i++) {
        size_t size;
        wf_raster raster = raster_of(labels[i].raster);
        wf_mxf_options o = options_for(&raster, 1, 0);
        uint8_t *file = written(&o, 1, &size);
        const uint8_t *set = find(file, size, picture_set, sizeof picture_set);
        const uint8_t *item = find(set, 512, container, sizeof container);
        if (number(item + 18, 2) != labels[i].label)
            fail_msg("%s: %04x", labels[i].raster, (unsigned)number(item + 18, 2));
        free(file);
    }
}

/* ---- Sound ---- */

static const struct {
    const char *raster;
    int64_t frames, samples; /* exactly, where a whole number of frames have one */
} sounds[] = {
    {"48x6@29.97p", 5, 8008},  {"48x6@59.94p", 5, 4004}, {"48x6@23.976p", 3, 6006},
    {"48x6@25i,tff", 4, 7680}, {"48x6@30p", 3, 4800},    {"48x6@120000/1001p", 5, 2002},
    {"48x6@12.5p", 2, 7680},
};

static int64_t samples_of_track(const uint8_t *file, size_t size, uint8_t track) {
    const uint8_t element[] = {0x06, 0x0e, 0x2b, 0x34, 0x01, 0x02, 0x01,  0x01, 0x0d,
                               0x01, 0x03, 0x01, 0x16, 2,    0x01, track, 0x87};
    int64_t samples = 0;
    for (const uint8_t *at = file, *end = file + size; at; at++) {
        at = memmem(at, (size_t)(end - at), element, sizeof element);
        if (!at) break;
        samples += (int64_t)number(at + 17, 7) / 3;
    }
    return samples;
}

static void sound_is_as_long_as_the_picture(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof sounds / sizeof *sounds; i++) {
        size_t size;
        wf_raster raster = raster_of(sounds[i].raster);
        wf_mxf_options o = options_for(&raster, sounds[i].frames, 2);
        uint8_t *file = written(&o, 1, &size);
        for (uint8_t track = 1; track <= 2; track++)
            assert_int_equal(samples_of_track(file, size, track), sounds[i].samples);
        assert_int_equal(samples_of_track(file, size, 3), 0);
        free(file);
    }
}

/* ---- Identity ---- */

static void identity_is_of_the_content(void **state) {
    (void)state;
    static const uint8_t package_uid[] = {0x44, 0x01, 0x00, 0x20};
    size_t size, again_size, other_size;
    wf_raster raster = raster_of("48x6@25p");
    wf_mxf_options o = options_for(&raster, 2, 1);
    uint8_t *file = written(&o, 1, &size), *again = written(&o, 1, &again_size),
            *other = written(&o, 2, &other_size);
    assert_int_equal(size, again_size);
    assert_memory_equal(file, again, size);
    assert_int_equal(size, other_size);
    const uint8_t *umid = find(file, size, package_uid, sizeof package_uid) + 4,
                  *other_umid = find(other, size, package_uid, sizeof package_uid) + 4;
    assert_memory_equal(umid, other_umid, 16);
    assert_memory_not_equal(umid + 16, other_umid + 16, 16);
    free(file), free(again), free(other);
}

/* ---- Refusals ---- */

static void what_does_not_fit_is_refused(void **state) {
    (void)state;
    wf_raster raster = raster_of("48x6@25p");
    wf_mxf_options o = options_for(&raster, 3, 0);
    char path[512];
    weft_error err = {""};
    job_clean();
    job_path(path, "out.mxf");
    assert_int_equal(write_file(&o, 2, 1, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "2 frames"));
    assert_int_equal(write_file(&o, 4, 1, &err), WEFT_FAILED);
    assert_int_equal(write_file(&o, 0, 1, &err), WEFT_FAILED);
    o.sound.tracks = WF_SOUND_TRACKS + 1;
    assert_int_equal(write_file(&o, 3, 1, &err), WEFT_USAGE);
    o.sound.tracks = 0;
    o.frame_bytes = (size_t)1 << 31;
    assert_int_equal(write_file(&o, 0, 1, &err), WEFT_USAGE);
    assert_int_equal(access(path, F_OK), -1);
}

/* ---- Filling ---- */

static void fill_items_end_on_the_grid(void **state) {
    (void)state;
    for (size_t before = 0; before <= 1024; before++) {
        wf_bytes b = {0};
        static const uint8_t zeros[1024];
        wf_bytes_put(&b, zeros, before);
        wf_klv_fill(&b, 512);
        assert_false(b.failed);
        assert_int_equal(b.size % 512, 0);
        if (b.size > before) {
            assert_true(b.size - before >= WF_KLV_FILL_LEAST && b.size - before < 532);
            assert_int_equal(number(b.data + before + 16, 4),
                             0x83000000 + b.size - before - 20);
        }
        free(b.data);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(header_is_the_standards),
        cmocka_unit_test(large_frames_have_long_lengths),
        cmocka_unit_test(rasters_have_their_labels),
        cmocka_unit_test(sound_is_as_long_as_the_picture),
        cmocka_unit_test(identity_is_of_the_content),
        cmocka_unit_test(what_does_not_fit_is_refused),
        cmocka_unit_test(fill_items_end_on_the_grid),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
