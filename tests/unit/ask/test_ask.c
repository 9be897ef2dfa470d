/* Questions asked of the library: structures of older and newer callers, reports, canceling. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "convert/weft.h"

/* A caller of a later version, with a member more. */
typedef struct later_measure {
    weft_measure known;
    const char *more;
} later_measure;

/* Two frames of gray, 16x8, 8 bits. */
static char *gray_video(void) {
    char *path = strdup("/tmp/weft-ask-XXXXXX.y4m");
    int fd = mkstemps(path, 4);
    FILE *file = fdopen(fd, "wb");
    fputs("YUV4MPEG2 W16 H8 F25:1 It A1:1 C422\n", file);
    for (int frame = 0; frame < 2; frame++) {
        fputs("FRAME\n", file);
        for (int i = 0; i < 16 * 8 * 2; i++) fputc(126 + (i >= 16 * 8 ? 2 : 0), file);
    }
    fclose(file);
    return path;
}

typedef struct asked {
    char *path;
    weft_job *job;
    weft_error err;
} asked;

static int set_up(void **state) {
    asked *a = calloc(1, sizeof *a);
    a->path = gray_video();
    a->job = weft_job_new();
    assert_int_equal(weft_job_add_input(a->job, a->path, &a->err), WEFT_OK);
    *state = a;
    return 0;
}

static int tear_down(void **state) {
    asked *a = *state;
    unlink(a->path);
    weft_job_free(a->job);
    free(a->path);
    free(a);
    return 0;
}

static void structures_grow(void **state) {
    asked *a = *state;
    weft_measure now = {.size = sizeof now, .display = "tube"};
    later_measure later = {.known = {.size = sizeof later}};
    assert_int_equal(weft_job_measure(a->job, &now, &a->err), WEFT_USAGE);
    assert_non_null(strstr(a->err.text, "tube"));
    /* To an older caller, whose structure ends before it, the member does not exist. */
    now.size = offsetof(weft_measure, display);
    assert_int_equal(weft_job_measure(a->job, &now, &a->err), WEFT_OK);
    assert_string_equal(a->err.text, "");
    assert_int_equal(weft_job_measure(a->job, &later.known, &a->err), WEFT_OK);
    later.more = "given";
    assert_int_equal(weft_job_measure(a->job, &later.known, &a->err), WEFT_USAGE);
    now.size = 0;
    assert_int_equal(weft_job_measure(a->job, &now, &a->err), WEFT_USAGE);
    assert_non_null(strstr(a->err.text, "sizeof(weft_measure)"));
}

static void what_is_given_out_grows(void **state) {
    (void)state;
    weft_profile all = {.size = sizeof all}, few = {.size = offsetof(weft_profile, rasters)};
    assert_true(weft_profile_at(0, &all));
    assert_true(weft_profile_at(0, &few));
    assert_non_null(all.rasters);
    assert_null(few.rasters);
    assert_string_equal(few.about, all.about);
    assert_false(weft_profile_at(10000, &all));
}

static void one_job_is_asked_again(void **state) {
    asked *a = *state;
    assert_string_equal(weft_job_report(a->job), "{}");
    assert_int_equal(weft_job_info(a->job, &a->err), WEFT_OK);
    assert_non_null(strstr(weft_job_report(a->job), "\"YUV4MPEG2\""));
    assert_int_equal(weft_job_verify(a->job, NULL, &a->err), WEFT_OK);
    assert_non_null(strstr(weft_job_report(a->job), "\"checks\""));
    assert_int_equal(weft_job_measure(a->job, NULL, NULL), WEFT_OK);
    assert_non_null(strstr(weft_job_report(a->job), "\"flicker\""));
    assert_int_equal(weft_job_filters(a->job, NULL, NULL), WEFT_OK);
    assert_non_null(strstr(weft_job_report(a->job), "\"apertures\""));
}

static void troubles_are_counted(void **state) {
    asked *a = *state;
    weft_job_add_input(a->job, "none-1.y4m", NULL);
    weft_job_add_input(a->job, "none-2.y4m", NULL);
    assert_int_equal(weft_job_measure(a->job, NULL, &a->err), WEFT_FAILED);
    assert_non_null(strstr(a->err.text, "none-1.y4m"));
    assert_non_null(strstr(a->err.text, "1 more"));
    assert_non_null(strstr(weft_job_report(a->job), "none-2.y4m"));
    assert_non_null(strstr(weft_job_report(a->job), "\"flicker\""));
}

static void canceled_jobs_stop(void **state) {
    asked *a = *state;
    weft_job_cancel(a->job);
    assert_int_equal(weft_job_measure(a->job, NULL, &a->err), WEFT_INTERRUPTED);
    assert_int_equal(weft_job_verify(a->job, NULL, &a->err), WEFT_INTERRUPTED);
    assert_int_equal(weft_job_info(a->job, &a->err), WEFT_INTERRUPTED);
}

static void nothing_is_nothing(void **state) {
    (void)state;
    weft_job *job = weft_job_new();
    weft_error err;
    assert_int_equal(weft_job_measure(job, NULL, &err), WEFT_USAGE);
    assert_int_equal(weft_job_verify(job, NULL, &err), WEFT_USAGE);
    assert_int_equal(weft_job_info(job, &err), WEFT_USAGE);
    assert_int_equal(weft_job_composite(job, NULL, &err), WEFT_USAGE);
    assert_int_equal(weft_plot(NULL, "a.svg", &err), WEFT_USAGE);
    assert_int_equal(weft_plot("a.json", NULL, &err), WEFT_USAGE);
    weft_job_free(job);
}

static void video_is_read(void **state) {
    asked *a = *state;
    weft_video *video;
    weft_video_info info = {.size = sizeof info};
    weft_picture picture = {.size = sizeof picture};
    assert_int_equal(weft_video_open(a->path, NULL, &video, &a->err), WEFT_OK);
    weft_video_tell(video, &info);
    assert_int_equal(info.width_px, 16);
    assert_int_equal(info.frames, 2);
    assert_string_equal(info.layout, "ycbcr");
    for (int n = 0; n < 2; n++) {
        assert_int_equal(weft_video_next(video, &picture, &a->err), WEFT_OK);
        assert_int_equal(picture.index, n);
        assert_true(picture.plane[0][16 * 8 - 1] == (float)(110 / 219.0));
        assert_true(picture.plane[2][8 * 8 - 1] == 0);
    }
    assert_int_equal(weft_video_next(video, &picture, &a->err), WEFT_OK);
    assert_null(picture.plane[0]);
    weft_video_close(video);
    assert_int_equal(weft_video_open("none.y4m", NULL, &video, &a->err), WEFT_FAILED);
    assert_null(video);
    weft_video_close(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(structures_grow, set_up, tear_down),
        cmocka_unit_test(what_is_given_out_grows),
        cmocka_unit_test_setup_teardown(one_job_is_asked_again, set_up, tear_down),
        cmocka_unit_test_setup_teardown(troubles_are_counted, set_up, tear_down),
        cmocka_unit_test_setup_teardown(canceled_jobs_stop, set_up, tear_down),
        cmocka_unit_test(nothing_is_nothing),
        cmocka_unit_test_setup_teardown(video_is_read, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
