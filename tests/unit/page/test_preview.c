/* Tests that a preview stops when it is told to, and of which display it takes codes to be. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "convert/job/colors.h"
#include "convert/page/preview.h"

static char folder[] = "/tmp/weft-preview-XXXXXX", video[64], picture[64];

static int set_up(void **unused) {
    (void)unused;
    if (!mkdtemp(folder)) return 1;
    snprintf(video, sizeof video, "%s/v.y4m", folder);
    snprintf(picture, sizeof picture, "%s/p.png", folder);
    FILE *file = fopen(video, "w");
    if (!file) return 1;
    fputs("YUV4MPEG2 W4 H3 F25:1 It A1:1 C444\n", file);
    for (int i = 0; i < 3; i++) fprintf(file, "FRAME\n%36s", "");
    return fclose(file);
}

static int tear_down(void **unused) {
    (void)unused;
    unlink(video);
    unlink(picture);
    return rmdir(folder);
}

static void test_canceled(void **unused) {
    volatile sig_atomic_t canceled = 1;
    const wf_preview_request r = {
        .video = video, .frame = -1, .max_memory_bytes = 1 << 20, .canceled = &canceled};
    weft_error err;
    (void)unused;
    assert_int_equal(wf_preview_write(&r, picture, &err), WEFT_INTERRUPTED);
    assert_int_not_equal(access(picture, F_OK), 0);
    canceled = 0;
    assert_int_equal(wf_preview_write(&r, picture, &err), WEFT_OK);
    assert_int_equal(access(picture, F_OK), 0);
}

static void test_transfer(void **unused) {
    (void)unused;
    assert_int_equal(wf_color_transfer_of("rec2100-pq"), WF_TRANSFER_PQ);
    assert_int_equal(wf_color_transfer_of("rec2100-hlg"), WF_TRANSFER_HLG);
    assert_int_equal(wf_color_transfer_of("rec2020"), WF_TRANSFER_BT1886);
    assert_int_equal(wf_color_transfer_of("nowhere"), WF_TRANSFER_BT1886);
    assert_int_equal(wf_color_transfer_of(NULL), WF_TRANSFER_BT1886);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_canceled),
                                       cmocka_unit_test(test_transfer)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
