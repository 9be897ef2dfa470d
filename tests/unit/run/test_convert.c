/* The whole job through the public interface: EXR files in, files out, held against the plain
 * float64 evaluation of the resampling rules and the formulas of the codes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/read/source.h"
#include "convert/weft.h"
#include "filters/aperture/aperture.h"
#include "filters/base/half.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"
#include "tests/unit/support/reference.h"
#include "tests/unit/support/sizes.h"

/* ---- Sequences ---- */

typedef struct movie {
    int width, height, subframes;
    wf_box data; /* of subframe 0, in display coordinates */
    int drift;   /* the data window moves by this many pixels a subframe */
    const char *channels;
    bool neutral; /* R = G = B */
    bool sparse;  /* 0 but for a few spikes */
    int missing;  /* number of a subframe that is not written; 0: none */
} movie;

typedef struct shot {
    const movie *m;
    int k;
} shot;

static uint32_t mix(uint32_t x) {
    x = (x ^ x >> 16) * 0x45d9f3b;
    x = (x ^ x >> 16) * 0x45d9f3b;
    return x ^ x >> 16;
}

/* A half: mostly ordinary light, some zeros, some spikes of 65504. Channel 3 is alpha. */
static float light(const movie *m, int k, int a, int b, int channel) {
    if (m->neutral) channel = 0;
    uint32_t bits =
        mix(mix(mix(mix((uint32_t)k + 9) + (uint32_t)channel) + (uint32_t)a) + (uint32_t)b);
    uint32_t low = bits % 1000;
    if (channel == 3) return (float)(bits >> 8 & 255) / 256;
    if (m->neutral) return wf_half_value((uint16_t)(bits % 0x3d00)); /* 0 .. 1.25 */
    if (m->sparse && low >= 5) return 0;
    if (low < 3) return 65504;
    if (low < 100) return 0;
    return wf_half_value(
        (uint16_t)((0x2000 + (bits >> 8) % 0x2000) | (low < 120 ? 0x8000 : 0)));
}

static float in_file(const void *user, int channel, int x, int y) {
    const shot *s = user;
    bool alpha = s->m->channels[0] == 'A';
    return light(s->m, s->k, x, y, alpha ? 3 - channel : 2 - channel);
}

static wf_box window_of(const movie *m, int k) {
    wf_box box = m->data;
    box.x0 += k * m->drift;
    box.x1 += k * m->drift;
    return box;
}

/* A window that moves inside the display window is the whole of it with zeros around. */
static float seen(const void *user, int k, int a, int b, int channel) {
    const movie *m = user;
    wf_box box = window_of(m, k);
    bool inside = a >= box.x0 && a < box.x1 && b >= box.y0 && b < box.y1;
    return inside ? light(m, k, a, b, channel) : 0;
}

/* Writes in.1001.exr and on. */
static void write_movie(const movie *m, const char *rate, exr_compression_t compression,
                        int tile) {
    job_clean();
    for (int k = 0; k < m->subframes; k++) {
        char path[512], name[64];
        shot s = {m, k};
        exr_part p = {.display = {0, 0, m->width, m->height},
                      .data = window_of(m, k),
                      .channels = m->channels,
                      .type = EXR_PIXEL_HALF,
                      .compression = compression,
                      .tile_width = tile,
                      .tile_height = tile,
                      .rate = rate,
                      .value = in_file,
                      .user = &s};
        snprintf(name, sizeof name, "in.%d.exr", 1001 + k);
        job_path(path, name);
        if (1001 + k != m->missing) assert_true(exr_write(path, &p, 1));
    }
}

static movie plain_movie(int width, int height, int subframes) {
    return (movie){.width = width,
                   .height = height,
                   .subframes = subframes,
                   .data = {0, 0, width, height},
                   .channels = "B G R"};
}

/* ---- Linear output against the reference ---- */

typedef struct scenario {
    const char *raster, *aperture, *rate, *options;
    double tau, position;
    int center, fit;
    movie m;
    float background;
} scenario;

static void must_parse(const char *text, weft_raster *raster) {
    weft_error err = {""};
    if (weft_raster_parse(text, raster, &err)) fail_msg("%s", err.text);
}

static double ratio(const char *text) {
    char *end;
    double num = strtod(text, &end);
    return *end == '/' ? num / strtod(end + 1, NULL) : num;
}

static reference refer(const scenario *s, const weft_raster *raster, wf_aperture *a) {
    char why[256];
    bool parsed = wf_aperture_parse(strcmp(s->aperture, "mitchell") ? s->aperture : "box", a,
                                    why, sizeof why);
    assert_true(parsed);
    double fields = (raster->interlaced && !raster->segmented ? 2.0 : 1.0) *
                    (double)raster->rate_num / (double)raster->rate_den;
    double cell_w = (double)raster->width_px / s->m.width,
           cell_h = (double)raster->lines / s->m.height;
    if (s->fit) cell_w = cell_h = (s->fit == 1) == (cell_w > cell_h) ? cell_w : cell_h;
    wf_box data = s->m.drift ? (wf_box){0, 0, s->m.width, s->m.height} : s->m.data;
    return (reference){
        .width = raster->width_px,
        .lines = raster->lines,
        .interlaced = raster->interlaced,
        .psf = raster->segmented,
        .top_first = raster->top_first,
        .field_period_s = 1 / fields,
        .aperture = s->aperture,
        .b = 1.0 / 3,
        .c = 1.0 / 3,
        .steps = a->stairs.height,
        .step_count = a->stairs.count,
        .half_u = a->half_u,
        .tau = s->tau,
        .position = s->position,
        .rate = ratio(s->rate),
        .center = s->center,
        .subframes = s->m.subframes,
        .cells_x = s->m.width,
        .cells_y = s->m.height,
        .cell_w = cell_w,
        .cell_h = cell_h,
        .origin_x = (raster->width_px - s->m.width * cell_w) / 2,
        .origin_y = (raster->lines - s->m.height * cell_h) / 2,
        .padded = s->fit == 2,
        .background = {s->background, s->background, s->background},
        .data = {data.x0, data.y0, data.x1, data.y1},
        .has_alpha = s->m.channels[0] == 'A' && s->background > 0,
        .sample = seen,
        .user = &s->m,
    };
}

static wf_subframe *open_frame(int frame) {
    char path[512], name[64];
    wf_source_options options = {.nan_fix = WF_NAN_NONE, .max_memory_bytes = (size_t)1 << 30};
    wf_subframe *subframe = NULL;
    weft_error err = {""};
    snprintf(name, sizeof name, "out.%04d.exr", frame);
    job_path(path, name);
    if (wf_subframe_open(path, -1, &options, &subframe, &err)) fail_msg("%s", err.text);
    return subframe;
}

static void compare(const scenario *s, const reference *r, const wf_rows *rows, int frame,
                    int j, int step) {
    int per_frame = r->interlaced || r->psf ? 2 : 1;
    int second = per_frame == 2 && (j % 2 == 0) != r->top_first;
    if (r->psf) second = j % 2;
    for (int i = j % step; i < r->width; i += step) {
        int c = (i / step + j) % 3;
        reference_value should =
            reference_pixel(r, i, j, (int64_t)frame * per_frame + second, c);
        double is = (double)((const float *)rows->plane[c])[i];
        double bound = fmax(4e-6 * fmax(fabs(should.value), 0.05), 1e-6 * should.scale);
        if (!(fabs(is - should.value) <= bound))
            fail_msg("%s on %s, %s: frame %d line %d pixel %d is %.9g, should be %.9g",
                     s->aperture, s->raster, s->options, frame, j, i, is, should.value);
    }
}

static void check_frame(const scenario *s, const reference *r, int frame, int step) {
    wf_subframe *subframe = open_frame(frame);
    wf_source_options options = {.nan_fix = WF_NAN_NONE, .max_memory_bytes = (size_t)1 << 30};
    wf_reader *reader = NULL;
    assert_int_equal(wf_reader_new(&options, &reader, NULL), WEFT_OK);
    for (int j = 0; j < r->lines; j += j < 3 || j >= r->lines - 4 ? 1 : step) {
        wf_rows rows;
        assert_int_equal(wf_reader_rows(reader, subframe, j, j + 1, &rows, NULL), WEFT_OK);
        assert_int_equal(rows.type, WF_FLOAT);
        compare(s, r, &rows, frame, j, step);
    }
    wf_reader_free(reader);
    wf_subframe_close(subframe);
}

/* How many frames there are, in double: the time that is shown, and frames that are whole. */
static int frames_of(const scenario *s, const reference *r, const weft_raster *raster) {
    double cells = s->m.subframes, rate = ratio(s->rate);
    double frame_s = (double)raster->rate_den / (double)raster->rate_num;
    bool fields = raster->interlaced && !raster->segmented;
    double period_s = fields ? frame_s / 2 : frame_s;
    double end = (cells - (s->center ? 0.5 : 0)) / rate / period_s;
    int frames = (int)floor(cells / rate / frame_s + 1e-9);
    for (;; frames++) {
        double first = fields ? 2 * frames : frames, last = fields ? first + 1 : first;
        double until =
            last + (1 - s->position) * s->tau + r->skew * (raster->lines - 1) / raster->lines;
        if (first >= end - 1e-9 || until > end + (s->tau > 0 ? 1e-9 : -1e-9)) return frames;
    }
}

static void check(const scenario *s, int step) {
    char options[512], report[JOB_REPORT];
    weft_raster raster;
    must_parse(s->raster, &raster);
    wf_aperture aperture;
    reference r = refer(s, &raster, &aperture);
    snprintf(options, sizeof options,
             "raster=%s aperture=%s%s temporal-width=%.17g subframe-rate=%s overwrite %s",
             s->raster, s->aperture,
             strcmp(s->aperture, "mitchell") ? "" : ":0.3333333333333333,0.3333333333333333",
             s->tau, s->rate, s->options);
    job_done(options, "out.####.exr", report);
    int frames = (int)job_number(report, "frames");
    assert_true(frames >= 1);
    assert_int_equal(frames, frames_of(s, &r, &raster));
    check_frame(s, &r, 0, step);
    if (frames > 1) check_frame(s, &r, frames - 1, step);
}

static const char *const apertures[] = {"line",   "rotated", "box",      "ccd",   "notch",
                                        "shaped", "diamond", "mitchell", "crisp", "calm"};
#define APERTURES (sizeof apertures / sizeof *apertures)

static void linear_output_of_awkward_ratios(void **state) {
    (void)state;
    scenario s = {.raster = "97x62@30i,bff",
                  .rate = "240",
                  .options = "",
                  .m = plain_movie(360, 244, 24),
                  .tau = 0.5};
    write_movie(&s.m, NULL, EXR_COMPRESSION_ZIP, 0);
    for (size_t a = 0; a < APERTURES; a += (size_t)test_step(3)) {
        s.aperture = apertures[a];
        check(&s, 7);
    }
    s = (scenario){.raster = "64x48@25i,tff",
                   .rate = "1000/3",
                   .options = "shutter-position=center threads=3",
                   .position = 0.5,
                   .m = plain_movie(81, 50, 40),
                   .tau = 1.5};
    write_movie(&s.m, NULL, EXR_COMPRESSION_PIZ, 0);
    for (size_t a = 0; a < APERTURES; a += (size_t)test_step(3)) {
        s.aperture = apertures[a];
        check(&s, 5);
    }
}

static void linear_output_of_other_kinds(void **state) {
    (void)state;
    movie drifting = plain_movie(96, 64, 20);
    drifting.sparse = true;
    drifting.drift = 2;
    drifting.data = (wf_box){3, 9, 53, 41};
    movie window = plain_movie(96, 64, 20), over = window, alpha = window;
    window.data = (wf_box){20, 9, 70, 41};
    over.data = (wf_box){-9, -8, 104, 71};
    alpha.channels = "A B G R";
    const scenario cases[] = {
        {.raster = "48x32@25psf",
         .rate = "250",
         .options = "",
         .tau = 1,
         .m = plain_movie(96, 64, 20)},
        {.raster = "48x32@60p",
         .rate = "480",
         .options = "shutter-position=end",
         .position = 1,
         .tau = 2,
         .m = plain_movie(96, 64, 20)},
        {.raster = "48x32@30i,bff",
         .rate = "240",
         .options = "subframe-time=center",
         .center = 1,
         .tau = 0.75,
         .m = drifting},
        {.raster = "48x32@30i,bff",
         .rate = "240",
         .options = "",
         .tau = 0,
         .m = plain_movie(96, 64, 20)},
        {.raster = "48x32@30i,bff", .rate = "240", .options = "", .tau = 1, .m = window},
        {.raster = "48x32@30i,bff", .rate = "240", .options = "threads=2", .tau = 1, .m = over},
        {.raster = "48x32@30i,bff",
         .rate = "240",
         .options = "background=0.5",
         .background = 0.5f,
         .tau = 1,
         .m = alpha},
        {.raster = "48x40@30i,bff",
         .rate = "240",
         .options = "fit=crop",
         .fit = 1,
         .tau = 1,
         .m = alpha},
        {.raster = "48x40@30i,bff",
         .rate = "240",
         .options = "fit=pad background=0.25",
         .fit = 2,
         .background = 0.25f,
         .tau = 1,
         .m = plain_movie(96, 64, 20)},
        {.raster = "48x40@30i,bff",
         .rate = "30",
         .options = "shutter-position=center",
         .position = 0.5,
         .tau = 0.5,
         .m = plain_movie(60, 44, 7)},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int tile = 0; tile <= 32; tile += 32) {
            write_movie(&cases[i].m, NULL, EXR_COMPRESSION_ZIPS, tile);
            for (size_t a = 3; a < 7; a++) {
                scenario s = cases[i];
                s.aperture = apertures[a];
                check(&s, 3);
            }
        }
}

/* ---- Codes ---- */

/* 10-bit luma of neutral pictures is the formula of the light that reaches the pixel. */
static void neutral_luma(void **state) {
    (void)state;
    scenario s = {.raster = "96x64@30i,bff,601-525",
                  .aperture = "shaped",
                  .rate = "240",
                  .tau = 1,
                  .m = plain_movie(192, 128, 8)};
    s.m.neutral = true;
    write_movie(&s.m, NULL, EXR_COMPRESSION_ZIP, 0);
    job_done("raster=96x64@30i,bff,601-525 subframe-rate=240 temporal-width=1", "out.y4m",
             NULL);
    weft_raster raster;
    must_parse(s.raster, &raster);
    wf_aperture aperture;
    reference r = refer(&s, &raster, &aperture);
    size_t size;
    uint8_t *bytes = job_file("out.y4m", &size);
    const uint8_t *frame = memchr(bytes, '\n', size);
    frame = frame + 1 + strlen("FRAME\n");
    assert_int_equal(size - (size_t)(frame - bytes), 96 * 64 * 2 * 2);
    int off = 0, total = 0;
    for (int j = 0; j < 64; j++)
        for (int i = 0; i < 96; i++, total++) {
            double linear = reference_pixel(&r, i, j, j % 2 == 0, 0).value;
            double should = floor(64 + 876 * pow(linear, 1 / 2.4) + 0.5);
            int code = frame[2 * (j * 96 + i)] | frame[2 * (j * 96 + i) + 1] << 8;
            should = fmin(should, 1019);
            off += code != (int)should;
            if (abs(code - (int)should) > 1)
                fail_msg("line %d pixel %d: %d, not %g", j, i, code, should);
        }
    for (int i = 0; i < 96 * 64; i++) { /* both chroma planes */
        const uint8_t *code = frame + 2 * (96 * 64 + i);
        assert_int_equal(code[0] | code[1] << 8, 512);
    }
    print_message("%d of %d luma codes are off by one\n", off, total);
    assert_true(off <= total / 1000);
    free(bytes);
}

/* ---- One result ---- */

static void join_chunks(const char *options, int count, const uint8_t *bytes, size_t size) {
    uint8_t *joined = malloc(size + 1);
    size_t filled = 0;
    for (int i = 1; i <= count; i++) {
        char all[512];
        snprintf(all, sizeof all, "%s chunk=%d/%d overwrite", options, i, count);
        job_done(all, "part.y4m", NULL);
        size_t part_size;
        uint8_t *part = job_file("part.y4m", &part_size);
        assert_true(filled + part_size <= size);
        memcpy(joined + filled, part, part_size);
        filled += part_size;
        free(part);
    }
    assert_int_equal(filled, size);
    assert_memory_equal(joined, bytes, size);
    free(joined);
}

static void threads_and_chunks_give_the_same_bytes(void **state) {
    (void)state;
    static const char *const widths[] = {"0", "1/2", "1", "5/2"};
    static const char *const names[] = {"shaped", "diamond", "notch"};
    movie m = plain_movie(200, 130, 60);
    m.data = (wf_box){-4, -4, 190, 120}; /* sixteen-line chunks that bands cut */
    write_movie(&m, NULL, EXR_COMPRESSION_ZIP, 0);
    for (int i = 0; i < 12; i++) {
        char options[256], all[512];
        snprintf(options, sizeof options,
                 "raster=100x60@30i,tff subframe-rate=240 aperture=%s temporal-width=%s%s",
                 names[i % 3], widths[i / 3], i % 2 ? " scan-skew=1/2" : "");
        snprintf(all, sizeof all, "%s threads=1 overwrite", options);
        job_done(all, "one.y4m", NULL);
        size_t size;
        uint8_t *bytes = job_file("one.y4m", &size);
        for (int threads = 2; threads <= 3; threads++) {
            snprintf(all, sizeof all, "%s threads=%d overwrite", options, threads);
            job_done(all, "other.y4m", NULL);
            job_same("other.y4m", bytes, size);
        }
        snprintf(all, sizeof all, "%s max-memory=16M overwrite", options);
        job_done(all, "other.y4m", NULL);
        job_same("other.y4m", bytes, size);
        join_chunks(options, 3, bytes, size);
        join_chunks(options, 7, bytes, size);
        free(bytes);
    }
}

static void only_what_is_needed_is_opened(void **state) {
    (void)state;
    char report[JOB_REPORT];
    movie m = plain_movie(64, 48, 128);
    write_movie(&m, "480000/1001", EXR_COMPRESSION_ZIP, 0);
    job_done("raster=64x48@29.97i,bff temporal-width=0", "out.y4m", report);
    assert_true(job_number(report, "frames") == 8 && job_number(report, "opened") == 16);
    assert_true(job_number(report, "listed") == 128);
    job_done("raster=64x48@29.97i,bff temporal-width=1/2 overwrite", "out.y4m", report);
    assert_true(job_number(report, "opened") == 64);
    job_done("raster=64x48@29.97i,bff temporal-width=1 overwrite", "out.y4m", report);
    assert_true(job_number(report, "opened") == 128);
    job_done("raster=64x48@29.97i,bff temporal-width=2 overwrite", "out.y4m", report);
    assert_true(job_number(report, "opened") == 128);
    job_done("raster=64x48@29.97i,bff temporal-width=0 frames=1001-1064 overwrite", "out.y4m",
             report);
    assert_true(job_number(report, "frames") == 4 && job_number(report, "opened") == 8);
    job_done("raster=64x48@29.97i,bff temporal-width=1 frames=1001-1128x2 overwrite", "out.y4m",
             report);
    assert_true(job_number(report, "frames") == 8 && job_number(report, "opened") == 64);
}

/* ---- Faults ---- */

static void missing_subframes(void **state) {
    (void)state;
    char report[JOB_REPORT];
    weft_error err = {""};
    movie m = plain_movie(32, 24, 16);
    m.missing = 1004;
    write_movie(&m, "120", EXR_COMPRESSION_ZIP, 0);
    job_refused("raster=32x24@30i,tff temporal-width=1", "out.y4m", WEFT_FAILED,
                "subframe 1004 is missing");
    job_done("raster=32x24@30i,tff temporal-width=0", "out.y4m", NULL); /* not needed */
    assert_int_equal(job_run("raster=32x24@30i,tff temporal-width=1 on-missing=hold overwrite",
                             "out.y4m", report, &err),
                     WEFT_DEGRADED);
    assert_non_null(strstr(report, "1004"));
    size_t size;
    uint8_t *held = job_file("out.y4m", &size);
    char command[1300];
    snprintf(command, sizeof command, "cp %s/in.1003.exr %s/in.1004.exr", job_directory,
             job_directory);
    assert_int_equal(system(command), 0);
    job_done("raster=32x24@30i,tff temporal-width=1", "again.y4m", NULL);
    job_same("again.y4m", held, size);
    free(held);
}

static void black_where_missing(void **state) {
    (void)state;
    scenario s = {.raster = "32x24@30i,tff",
                  .aperture = "box",
                  .rate = "120",
                  .tau = 0.5,
                  .options = "",
                  .m = plain_movie(64, 48, 8)};
    weft_error err = {""};
    s.m.missing = 1003; /* the whole of field 1's window, with tau 1/2 */
    write_movie(&s.m, "120", EXR_COMPRESSION_ZIP, 0);
    assert_int_equal(job_run("raster=32x24@30i,tff aperture=box on-missing=black",
                             "out.####.exr", NULL, &err),
                     WEFT_DEGRADED);
    wf_subframe *frame = open_frame(0);
    wf_source_options options = {.max_memory_bytes = (size_t)1 << 30};
    wf_reader *reader = NULL;
    wf_rows rows;
    assert_int_equal(wf_reader_new(&options, &reader, NULL), WEFT_OK);
    for (int j = 0; j < 24; j++) {
        double sum = 0;
        assert_int_equal(wf_reader_rows(reader, frame, j, j + 1, &rows, NULL), WEFT_OK);
        for (int i = 0; i < 32; i++) sum += fabs((double)((const float *)rows.plane[0])[i]);
        assert_true((sum == 0) == (j % 2 == 1));
    }
    wf_reader_free(reader);
    wf_subframe_close(frame);
}

static void faults_are_named(void **state) {
    (void)state;
    char path[512];
    movie m = plain_movie(32, 24, 16);
    write_movie(&m, NULL, EXR_COMPRESSION_ZIP, 0);
    job_refused("raster=32x24@30i,tff", "out.y4m", WEFT_USAGE, "--subframe-rate");
    job_refused("raster=32x24@30i,tff subframe-rate=1000", "out.y4m", WEFT_FAILED,
                "do not fill one frame");
    job_refused("raster=32x24@30i,tff subframe-rate=120 frames=2000-2010", "out.y4m",
                WEFT_FAILED, "2000");
    job_refused("raster=32x24@30i,tff subframe-rate=120", "out.avi", WEFT_USAGE, "out.avi");
    job_refused("raster=32x24@30i,tff subframe-rate=120", "nowhere/out.y4m", WEFT_FAILED,
                "nowhere");
    job_refused("raster=31x24@30i,tff subframe-rate=120", "out.y4m", WEFT_USAGE, "even width");
    job_refused("raster=32x24@30i,tff subframe-rate=120 to=nonsense", "out.y4m", WEFT_USAGE,
                "rec709");
    job_refused("raster=32x24@30i,tff subframe-rate=120 bits=9", "out.y4m", WEFT_USAGE, "bits");
    job_refused("raster=32x24@30i,tff subframe-rate=120 fix-nan=none", "out.y4m", WEFT_USAGE,
                "fix-nan");
    job_done("raster=32x24@30i,tff subframe-rate=120", "out.y4m", NULL);
    job_refused("raster=32x24@30i,tff subframe-rate=120", "out.y4m", WEFT_FAILED,
                "--overwrite");
    /* A subframe of another size in the middle, and a cut one. */
    movie other = plain_movie(30, 24, 1);
    shot s = {&other, 0};
    exr_part p = {.display = {0, 0, 30, 24},
                  .data = {0, 0, 30, 24},
                  .channels = "B G R",
                  .type = EXR_PIXEL_HALF,
                  .compression = EXR_COMPRESSION_ZIP,
                  .value = in_file,
                  .user = &s};
    job_path(path, "in.1009.exr");
    assert_true(exr_write(path, &p, 1));
    job_refused("raster=32x24@30i,tff subframe-rate=120 temporal-width=1", "new.y4m",
                WEFT_FAILED, "in.1009.exr");
    assert_int_equal(truncate(path, 400), 0);
    job_refused("raster=32x24@30i,tff subframe-rate=120 temporal-width=1", "new.y4m",
                WEFT_FAILED, "in.1009.exr");
    job_path(path, "new.y4m");
    assert_int_not_equal(access(path, F_OK), 0);
}

static void inputs_are_safe(void **state) {
    (void)state;
    char command[1300];
    movie m = plain_movie(32, 24, 16);
    write_movie(&m, "120", EXR_COMPRESSION_ZIP, 0);
    snprintf(command, sizeof command,
             "cd %s && ln in.1003.exr out.0002.exr && cp in.1001.exr saved", job_directory);
    assert_int_equal(system(command), 0);
    job_refused("raster=32x24@30i,tff overwrite", "out.####.exr", WEFT_USAGE, "out.0002.exr");
    job_refused("raster=32x24@30i,tff overwrite frames=1001-1008", "in.1001.exr", WEFT_USAGE,
                "in.1001.exr");
    size_t size;
    uint8_t *saved = job_file("saved", &size);
    job_same("in.1001.exr", saved, size);
    free(saved);
}

static void identical_pictures_cost_nothing(void **state) {
    (void)state;
    char command[1300], report[JOB_REPORT];
    movie m = plain_movie(64, 48, 1);
    write_movie(&m, NULL, EXR_COMPRESSION_ZIP, 0);
    snprintf(command, sizeof command,
             "cd %s && for k in $(seq 1002 1064); do cp in.1001.exr in.$k.exr; done",
             job_directory);
    assert_int_equal(system(command), 0);
    job_done("raster=64x48@30i,tff subframe-rate=480 temporal-width=1 threads=1", "a.y4m",
             report);
    double chunks = job_number(report, "chunks_decoded") + job_number(report, "chunks_reused");
    assert_true(chunks == 64 * 3 && job_number(report, "chunks_decoded") == 3);
    job_done("raster=64x48@30i,tff subframe-rate=480 temporal-width=1 skip=off threads=1",
             "b.y4m", report);
    size_t size;
    uint8_t *bytes = job_file("a.y4m", &size);
    job_same("b.y4m", bytes, size);
    free(bytes);
}

static void resumed_sequences_are_whole(void **state) {
    (void)state;
    char path[512], report[JOB_REPORT];
    movie m = plain_movie(32, 24, 40);
    write_movie(&m, "120", EXR_COMPRESSION_ZIP, 0);
    job_done("raster=32x24@30i,tff", "out.####.exr", NULL);
    size_t size;
    uint8_t *frame = job_file("out.0004.exr", &size);
    job_path(path, "out.0004.exr");
    assert_int_equal(unlink(path), 0);
    job_path(path, "out.0007.exr");
    assert_int_equal(unlink(path), 0);
    job_done("raster=32x24@30i,tff resume", "out.####.exr", report);
    assert_true(job_number(report, "frames") == 2);
    job_same("out.0004.exr", frame, size);
    assert_int_equal(access(path, F_OK), 0);
    free(frame);
}

static void cancel_at_once(const weft_progress *progress, void *user) {
    (void)progress;
    weft_job_cancel(user);
}

static void canceled_jobs_leave_nothing(void **state) {
    (void)state;
    char path[512];
    weft_error err = {""};
    movie m = plain_movie(32, 24, 40);
    write_movie(&m, "120", EXR_COMPRESSION_ZIP, 0);
    weft_job *job = weft_job_new();
    job_path(path, "in.####.exr");
    weft_job_add_input(job, path, &err);
    job_path(path, "out.y4m");
    weft_job_set_output(job, path, &err);
    assert_int_equal(weft_job_set(job, "raster", "32x24@30i,tff", &err), WEFT_OK);
    weft_job_on_progress(job, cancel_at_once, job);
    assert_int_equal(weft_job_run(job, &err), WEFT_INTERRUPTED);
    assert_int_not_equal(access(path, F_OK), 0);
    weft_job_free(job);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_output_of_awkward_ratios),
        cmocka_unit_test(linear_output_of_other_kinds),
        cmocka_unit_test(neutral_luma),
        cmocka_unit_test(threads_and_chunks_give_the_same_bytes),
        cmocka_unit_test(only_what_is_needed_is_opened),
        cmocka_unit_test(missing_subframes),
        cmocka_unit_test(black_where_missing),
        cmocka_unit_test(faults_are_named),
        cmocka_unit_test(inputs_are_safe),
        cmocka_unit_test(identical_pictures_cost_nothing),
        cmocka_unit_test(resumed_sequences_are_whole),
        cmocka_unit_test(canceled_jobs_leave_nothing),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
