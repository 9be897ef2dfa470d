/* Plans: the subframes that are planned, alone, give the video that all give, to the bit;
 * without any one of them something is missing; and sizes, regions and samples in closed form.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cmocka.h>
#include <jansson.h>

#include "convert/read/source.h"
#include "tests/unit/support/dice.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"
#include "tests/unit/support/sizes.h"

enum { WIDTH = 8, LINES = 12, MOST = 4096 };

/* ---- Plans ---- */

/* The plan of the options "name=value ..", as JSON; json_decref. */
static json_t *plan_of(const char *options) {
    const char *text;
    weft_error err = {""};
    weft_job *job = weft_job_new();
    if (job_set(job, options, &err)) fail_msg("%s", err.text);
    if (weft_job_plan(job, "json", &text, &err)) fail_msg("%s: %s", options, err.text);
    json_t *plan = json_loads(text, 0, NULL);
    assert_non_null(plan);
    weft_job_free(job);
    return plan;
}

static void refused(const char *options, const char *word) {
    const char *text;
    weft_error err = {""};
    weft_job *job = weft_job_new();
    assert_int_equal(job_set(job, options, &err), WEFT_OK);
    assert_int_equal(weft_job_plan(job, "json", &text, &err), WEFT_USAGE);
    assert_null(text);
    if (!strstr(err.text, word)) fail_msg("'%s' does not say '%s'", err.text, word);
    weft_job_free(job);
}

static int numbers_of(const json_t *plan, int64_t *numbers) {
    size_t i;
    json_t *subframe, *list = json_object_get(plan, "subframes");
    json_array_foreach(list, i, subframe) {
        assert_true(i < MOST);
        numbers[i] = json_integer_value(json_object_get(subframe, "number"));
    }
    return (int)json_array_size(list);
}

/* ---- Pictures ---- */

static float noise(const void *user, int channel, int x, int y) {
    uint32_t h =
        (uint32_t)(*(const int *)user * 7919 + channel * 104729 + x * 1299709 + y * 31);
    h = (h ^ (h >> 15)) * 2246822519u;
    h = (h ^ (h >> 13)) * 3266489917u;
    return (float)(h >> 16) / 65536;
}

static void name_of(char path[512], int64_t k) {
    char name[32];
    snprintf(name, sizeof name, "in.%04d.exr", (int)k);
    job_path(path, name);
}

static void make(int count) {
    char path[512];
    for (int k = 0; k < count; k++) {
        const exr_part part = {.display = {0, 0, WIDTH, LINES},
                               .data = {0, 0, WIDTH, LINES},
                               .channels = "B G R",
                               .type = EXR_PIXEL_HALF,
                               .compression = EXR_COMPRESSION_NONE,
                               .value = noise,
                               .user = &k};
        name_of(path, k);
        assert_true(exr_write(path, &part, 1));
    }
}

/* Leaves the planned ones alone. */
static void keep(const int64_t *numbers, int planned, int count) {
    char path[512];
    for (int k = 0, i = 0; k < count; k++) {
        if (i < planned && numbers[i] == k) {
            i++;
            continue;
        }
        name_of(path, k);
        unlink(path);
    }
}

/* ---- The same video ---- */

static const char *pick(const char *const *words, int count) {
    return words[dice(count)];
}
#define PICK(...)                                                                              \
    pick((const char *const[]){__VA_ARGS__},                                                   \
         (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *)))

/* Options of looking that plan and convert share. */
static void random_looks(char *looks, size_t size, bool *film) {
    *film = dice(5) == 0;
    const char *raster = *film ? "8x12@30000/1001i,tff"
                               : PICK("8x12@25i,tff", "8x12@25i,bff", "8x12@25psf", "8x12@50p");
    const char *rate = *film ? PICK("24", "192", "192000/1001", "120")
                             : PICK("400", "50", "100", "333", "120", "480000/1001", "777/2");
    snprintf(looks, size,
             "raster=%s subframe-rate=%s aperture=%s temporal-width=%s shutter-position=%s "
             "scan-skew=%s subframe-time=%s cadence=%s ",
             raster, rate,
             PICK("line", "rotated", "box", "ccd", "notch", "shaped", "diamond",
                  "mitchell:1/3,1/3", "crisp", "calm"),
             PICK("0", "1/2", "1/3", "1", "2", "0.7", "5", "1/16"),
             PICK("start", "center", "end"), PICK("0", "0", "1", "1/3"),
             PICK("start", "center"), *film ? "2:3" : "none");
}

static void planned_alone_are_enough(void **state) {
    (void)state;
    char looks[400], options[512], report[JOB_REPORT], path[512];
    static int64_t numbers[MOST];
    bool film;
    for (int round = 0; round < 120; round += test_step(4)) {
        dice_state = (unsigned)round * 2654435761u + 17;
        random_looks(looks, sizeof looks, &film);
        int first = dice(5), last = first + dice(3);
        snprintf(options, sizeof options, "%s frames=%d-%d", looks, first, last);
        json_t *plan = plan_of(options);
        int planned = numbers_of(plan, numbers),
            count = (int)numbers[planned - 1] + 1 + dice(9);
        json_decref(plan);
        job_clean();
        make(count);
        snprintf(options, sizeof options, "%s frames=0-%d output-frames=%d-%d overwrite", looks,
                 count - 1, first, last);
        job_done(options, "all.y4m", report);
        size_t size;
        uint8_t *all = job_file("all.y4m", &size);
        keep(numbers, planned, count);
        job_done(options, "out.y4m", report);
        job_same("out.y4m", all, size);
        /* Without a range as well: their numbers count from 0. */
        snprintf(options, sizeof options, "%s output-frames=%d-%d overwrite", looks, first,
                 last);
        job_done(options, "alone.y4m", report);
        job_same("alone.y4m", all, size);
        assert_non_null(strstr(report, "\"missing\": []"));
        snprintf(options, sizeof options, "%s frames=0-%d output-frames=%d-%d overwrite", looks,
                 count - 1, first, last);
        name_of(path, numbers[dice(planned)]);
        if (planned > 1 && unlink(path) == 0)
            job_refused(options, "out.y4m", WEFT_FAILED, "is missing (1 of the");
        free(all);
    }
}

/* ---- What is planned ---- */

static void check_box(const json_t *plan, const char *key, int n, const int *wanted) {
    const json_t *box = json_object_get(plan, key);
    assert_int_equal(json_array_size(box), n);
    for (int i = 0; i < n; i++)
        assert_int_equal(json_integer_value(json_array_get(box, (size_t)i)), wanted[i]);
}

/* Four of eight at a half, all at one, one of eight at an instant. */
static void how_many_of_eight(void **state) {
    (void)state;
    static const struct {
        const char *width;
        int count, samples;
    } rows[] = {{"1/2", 4, 16}, {"1", 8, 8}, {"0", 1, 64}, {"1/4", 2, 32}};
    static int64_t numbers[MOST];
    char options[256];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        snprintf(options, sizeof options,
                 "raster=1080i50 subframe-rate=400 frames=3-4 samples-a-pixel=64 "
                 "temporal-width=%s",
                 rows[i].width);
        json_t *plan = plan_of(options);
        assert_int_equal(numbers_of(plan, numbers), 4 * rows[i].count);
        for (int k = 0; k < 4 * rows[i].count; k++)
            assert_int_equal(numbers[k], 48 + k / rows[i].count * 8 + k % rows[i].count);
        assert_int_equal(json_integer_value(json_object_get(plan, "samples_a_pixel")),
                         rows[i].samples);
        json_decref(plan);
    }
}

/* 486 lines of pixels 10:11, and three times 243 of pixels half as wide. */
static void sizes_and_regions(void **state) {
    (void)state;
    json_t *plan = plan_of("raster=525i subframe-rate=480000/1001 frames=0-0 aperture=box");
    check_box(plan, "size", 2, (const int[]){720, 486});
    check_box(plan, "pixel_aspect", 2, (const int[]){10, 11});
    check_box(plan, "region", 4, (const int[]){0, -1, 720, 487});
    assert_string_equal(json_string_value(json_object_get(plan, "raster")), "525i");
    assert_string_equal(json_string_value(json_object_get(plan, "rate")), "480000/1001");
    const json_t *second = json_array_get(json_object_get(plan, "subframes"), 1);
    assert_string_equal(json_string_value(json_object_get(second, "time")), "1001/480000");
    json_decref(plan);
    plan = plan_of("raster=525i subframe-rate=480 frames=0-0 aperture=notch size=1440x740 "
                   "scene-fps=24 samples-a-pixel=30 temporal-width=1");
    check_box(plan, "size", 2, (const int[]){1440, 729});
    check_box(plan, "pixel_aspect", 2, (const int[]){15, 22});
    check_box(plan, "region", 4, (const int[]){0, -3, 1440, 732});
    second = json_array_get(json_object_get(plan, "subframes"), 1);
    assert_string_equal(json_string_value(json_object_get(second, "frame")), "1/20");
    json_decref(plan);
}

static void what_will_not_do(void **state) {
    (void)state;
    refused("raster=1080i50 frames=0-9", "400");
    refused("raster=1080i50 subframe-rate=25 frames=0-9", "400");
    refused("raster=1080i50 subframe-rate=400", "--frames");
    refused("raster=1080i50 subframe-rate=400 frames=0-9x2", "A-B");
    refused("raster=1080i50 subframe-rate=400 frames=0-9999999", "in parts");
    refused("raster=525i subframe-rate=100 frames=0-9 cadence=2:3", "film");
    refused("raster=1080i50 subframe-rate=400 frames=0-9 temporal-width=1 shutter-angle=180",
            "one of them");
    refused("raster=8x12@25i subframe-rate=1000000 frames=0-0 temporal-width=64", "room for");
}

/* Canceled before it began: while files are looked at, of which the second is damaged, and,
 * where there are none, while fields are. */
static void refining_can_be_stopped(void **state) {
    (void)state;
    static const char looks[] =
        "raster=8x12@25i,tff subframe-rate=100 frames=0-3 error=0.01 refine=";
    char path[512], options[1024];
    const char *text;
    job_path(path, "stopped");
    assert_int_equal(mkdir(path, 0700), 0);
    snprintf(options, sizeof options, "%s%s", looks, path);
    for (int files = 0; files < 2; files++) {
        weft_error err = {""};
        weft_job *job = weft_job_new();
        if (job_set(job, options, &err)) fail_msg("%s", err.text);
        weft_job_cancel(job);
        assert_int_equal(weft_job_plan(job, "json", &text, &err), WEFT_INTERRUPTED);
        assert_null(text);
        weft_job_free(job);
        for (int k = 0; k < 2; k++) {
            FILE *file;
            job_path(path, k ? "stopped/in.0002.exr" : "stopped/in.0000.exr");
            assert_non_null(file = fopen(path, "wb"));
            fputs("no picture", file);
            fclose(file);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planned_alone_are_enough), cmocka_unit_test(how_many_of_eight),
        cmocka_unit_test(sizes_and_regions),        cmocka_unit_test(what_will_not_do),
        cmocka_unit_test(refining_can_be_stopped),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
