/* Subframes that exist in a rectangle alone: what each pixel is, by the cells of those that
 * exist there, in closed form. The aperture is one line high and one pixel wide and pictures
 * have the raster's size, so that a pixel sees itself. */
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/read/source.h"
#include "tests/unit/support/dice.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"
#include "tests/unit/support/sizes.h"

enum { WIDTH = 16, LINES = 12, FILES = 40, TICKS = 1000, FRAMES_A_SECOND = 25 };

/* A sequence: times in ticks of 1/1000 s. */
typedef struct shot {
    int files, time[FILES];
    wf_box region[FILES];
    bool whole[FILES], boxes, center;
    int display_x, display_y; /* of the display window's corner */
    int one;                  /* the file being written */
} shot;

static float value_at(int k, int x, int y) {
    uint32_t h = (uint32_t)(k * 7919 + x * 1299709 + y * 31 + 11);
    h = (h ^ (h >> 15)) * 2246822519u;
    h = (h ^ (h >> 13)) * 3266489917u;
    return (float)(h >> 16) / 65536;
}

/* Outside of its region a file holds what must never be seen. */
static float value(const void *user, int channel, int x, int y) {
    const shot *s = user;
    int k = s->one;
    (void)channel;
    x -= s->display_x, y -= s->display_y;
    const wf_box *r = &s->region[k];
    bool in = s->whole[k] || (x >= r->x0 && x < r->x1 && y >= r->y0 && y < r->y1);
    return in ? value_at(k, x, y) : 1000;
}

static void write_file(shot *s, int k) {
    char path[512], name[32], time[48], text[64];
    const wf_box *r = &s->region[k];
    int x = s->display_x, y = s->display_y;
    const wf_box moved = {r->x0 + x, r->y0 + y, r->x1 + x, r->y1 + y};
    s->one = k;
    snprintf(name, sizeof name, "in.%04d.exr", k);
    snprintf(time, sizeof time, "%d/%d", s->time[k], TICKS);
    snprintf(text, sizeof text, "%d,%d,%d,%d", r->x0, r->y0, r->x1, r->y1);
    exr_part p = {.display = {x, y, x + WIDTH, y + LINES},
                  .data = {x, y, x + WIDTH, y + LINES},
                  .channels = "B G R",
                  .type = EXR_PIXEL_FLOAT,
                  .compression = k % 2 ? EXR_COMPRESSION_ZIPS : EXR_COMPRESSION_NONE,
                  .time = time,
                  .value = value,
                  .user = s};
    if (!s->whole[k] && s->boxes) p.region = &moved;
    if (!s->whole[k] && !s->boxes) p.attribute[0] = "weft:region", p.attribute[1] = text;
    job_path(path, name);
    assert_true(exr_write(path, &p, 1));
}

static void random_shot(shot *s) {
    *s = (shot){.files = 12 + dice(FILES - 12), .boxes = dice(2), .center = dice(2)};
    if (dice(2)) s->display_x = dice(9) - 4, s->display_y = dice(9) - 4;
    for (int k = 0, t = 0; k < s->files; k++, t += 1 + dice(9)) {
        int x = dice(WIDTH), y = dice(LINES);
        s->time[k] = t;
        s->whole[k] = !k || dice(3) == 0;
        s->region[k] = (wf_box){x, y, x + 1 + dice(WIDTH - x), y + 1 + dice(LINES - y)};
    }
    if (s->whole[1]) s->whole[1] = false;
    job_clean();
    for (int k = 0; k < s->files; k++) write_file(s, k);
}

/* ---- What a pixel is ---- */

static bool exists(const shot *s, int k, int x, int y) {
    const wf_box *r = &s->region[k];
    return s->whole[k] || (x >= r->x0 && x < r->x1 && y >= r->y0 && y < r->y1);
}

/* The mean of the files that exist at a pixel over the window from..to, in ticks from the first
 * file's time. `end`: where the last cell of the sequence ends. */
static double pixel(const shot *s, int x, int y, double from, double to, double begin,
                    double end) {
    int there[FILES], n = 0;
    double sum = 0, all = 0;
    for (int k = 0; k < s->files; k++)
        if (exists(s, k, x, y)) there[n++] = k;
    for (int i = 0; i < n; i++) {
        int before = i ? s->time[there[i - 1]] : 0, here = s->time[there[i]];
        int after = i + 1 < n ? s->time[there[i + 1]] : 0;
        double opens = s->center ? (before + here) / 2.0 : here;
        double closes = s->center ? (here + after) / 2.0 : after;
        if (!i) opens = begin;
        if (i + 1 == n) closes = end;
        double length = fmin(closes, to) - fmax(opens, from);
        if (length <= 0) continue;
        sum += length * (double)value_at(there[i], x, y);
        all += length;
    }
    return sum / all;
}

static void check_frame(const shot *s, int n, double width) {
    char name[32], path[512];
    const wf_source_options options = {.max_memory_bytes = 1 << 24};
    wf_subframe *frame;
    wf_reader *reader;
    wf_rows rows;
    weft_error err = {""};
    int last = s->files - 1;
    double each = (double)TICKS / FRAMES_A_SECOND;
    double begin = s->center ? -s->time[1] / 2.0 : 0;
    double lasts = s->time[last] - s->time[last - 1];
    double end = s->time[last] + (s->center ? lasts / 2 : lasts);
    snprintf(name, sizeof name, "out.%04d.exr", n);
    job_path(path, name);
    if (wf_subframe_open(path, -1, &options, &frame, &err)) fail_msg("%s", err.text);
    assert_int_equal(wf_reader_new(&options, &reader, &err), WEFT_OK);
    assert_int_equal(wf_reader_rows(reader, frame, 0, LINES, &rows, &err), WEFT_OK);
    double from = n * each;
    for (int y = 0; y < LINES; y++)
        for (int x = 0; x < WIDTH; x++) {
            double wanted = pixel(s, x, y, from, from + width * each, begin, end);
            double got = (double)((const float *)
                                      rows.plane[0])[(size_t)y * rows.line_stride + (size_t)x];
            if (!(fabs(got - wanted) <= 2e-6))
                fail_msg("frame %d, pixel %d,%d is %.9g, not %.9g", n, x, y, got, wanted);
        }
    wf_reader_free(reader);
    wf_subframe_close(frame);
}

static void pixels_by_what_exists(void **state) {
    (void)state;
    static const double widths[] = {0.5, 1, 0.3125, 2};
    char options[256], report[JOB_REPORT];
    shot s;
    for (int round = 0; round < 40; round += test_step(4)) {
        dice_state = (unsigned)round * 2654435761u + 5;
        random_shot(&s);
        double width = widths[dice(4)];
        snprintf(options, sizeof options,
                 "raster=16x12@25p aperture=line temporal-width=%g subframe-time=%s threads=%d",
                 width, s.center ? "center" : "start", 1 + dice(3));
        job_done(options, "out.####.exr", report);
        int frames = (int)job_number(report, "frames");
        assert_true(frames >= 1);
        for (int n = 0; n < frames; n++) check_frame(&s, n, width);
    }
}

static void what_will_not_do(void **state) {
    (void)state;
    static const char looks[] = "raster=16x12@25p aperture=line temporal-width=1";
    shot s;
    dice_state = 3;
    random_shot(&s);
    s.boxes = false;
    s.whole[0] = false;
    write_file(&s, 0);
    job_refused(looks, "out.####.exr", WEFT_FAILED, "the first subframe has a weft:region");
    s.whole[0] = true;
    write_file(&s, 0);
    s.region[1] = (wf_box){5, 5, 5, 9};
    write_file(&s, 1);
    job_refused(looks, "out.####.exr", WEFT_FAILED, "is no rectangle of its pixels");
    s.region[1] = (wf_box){WIDTH, 0, WIDTH + 4, 4};
    write_file(&s, 1);
    job_refused(looks, "out.####.exr", WEFT_FAILED, "0,0,16,12 for all of it");
    s.region[1] = (wf_box){0, 0, INT_MAX, 9};
    write_file(&s, 1);
    job_refused(looks, "out.####.exr", WEFT_FAILED, "is no rectangle of its pixels");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_by_what_exists),
        cmocka_unit_test(what_will_not_do),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
