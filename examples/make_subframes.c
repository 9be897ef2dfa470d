/* Makes a sequence of high-rate EXR subframes without a renderer: what interlaced television
 * finds hard (a spoked wheel, a running zone plate, drifting near-horizontal lines, a small
 * fast light) and a row of color patches to judge color by.
 *
 *     make_subframes DIRECTORY [COUNT]
 *
 * Scene-linear Rec. 709, half float, 1440x972 at pixel aspect 10:11 (the display aspect of
 * 525-line video), 480000/1001 a second: eight subframes a field, 128 by default, after which
 * every motion repeats. Each subframe is exposed for the whole of its own 1/480 second, and
 * every edge is filtered in closed form over the pixel and that exposure, so that the pictures
 * are free of aliasing in space and of steps in time. Patterns repeat at 7.5 Hz at most, so
 * that at 50 fields a second, too, three field periods are less than half a repetition, and
 * only the right order of fields looks right. */
#include <OpenEXR/openexr.h>

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { WIDTH = 1440, HEIGHT = 972, PERIOD = 128 };

static const float PI = 3.14159265f;
static const float PIXEL_ASPECT = 10.0f / 11.0f;

typedef struct color {
    float r, g, b;
} color;

/* One picture point: x, y in square pixels from the top left, phase in whole repetitions. */
typedef struct point {
    float x, y, phase;
} point;

static color mix(color a, color b, float t) {
    return (color){a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}

static color scaled(color c, float s) {
    return (color){c.r * s, c.g * s, c.b * s};
}

static float length(float x, float y) {
    return sqrtf(x * x + y * y);
}

static float clamp01(float t) {
    return fminf(fmaxf(t, 0.0f), 1.0f);
}

/* How much of a pixel lies on the positive side of an edge at signed distance d from its
 * center, while the edge travels over motion pixels: a unit step convolved with boxes of width
 * 1 and motion. */
static float edge(float d, float motion) {
    if (motion < 0.01f) return clamp01(d + 0.5f);
    const float outer = 0.5f * (motion + 1.0f), inner = 0.5f * fabsf(motion - 1.0f);
    const float a = fmaxf(d + outer, 0.0f), b = fmaxf(d + inner, 0.0f);
    const float c = fmaxf(d - inner, 0.0f), e = fmaxf(d - outer, 0.0f);
    return clamp01((a * a - b * b - c * c + e * e) / (2.0f * motion));
}

/* Coverage of a band |d| < half. */
static float band(float d, float half, float motion) {
    return clamp01(edge(d + half, motion) - edge(d - half, motion));
}

/* How much a sinusoid is weakened by a box over cycles of its periods. */
static float box_response(float cycles) {
    const float x = PI * cycles;
    return fabsf(x) < 1e-3f ? 1.0f : sinf(x) / x;
}

static color background(point p) {
    const color top = {0.020f, 0.035f, 0.065f}, bottom = {0.070f, 0.075f, 0.095f};
    return mix(top, bottom, p.y / HEIGHT);
}

/* Twelve spokes, every other one red, that turn by two of them in a repetition (37.5 rpm). */
static color wheel_spokes(float r, float angle, float motion, color under) {
    const color steel = {0.55f, 0.60f, 0.68f}, red = {0.75f, 0.045f, 0.030f};
    const float pitch = PI / 6.0f, nearest = roundf(angle / pitch);
    const float across = r * sinf(angle - nearest * pitch);
    const float half = 13.0f - 0.022f * r;
    const float round_light =
        0.35f + 0.65f * sqrtf(clamp01(1.0f - across * across / (half * half)));
    const color paint = (int)nearest % 2 == 0 ? red : steel;
    return mix(under, scaled(paint, round_light), band(across, half, motion));
}

/* A ring of half width half about radius middle, lit as a torus from the upper left. */
static color ring(float r, float lit, float middle, float half, color paint, color under) {
    if (fabsf(r - middle) > half + 1.0f) return under;
    const float slope = fminf(fmaxf((r - middle) / half, -1.0f), 1.0f);
    const float facing = sqrtf(1.0f - slope * slope);
    const float light = 0.10f + 0.50f * facing + 0.75f * clamp01(slope * lit);
    return mix(under, scaled(paint, light), band(r - middle, half, 0.0f));
}

static color wheel(point p, color under) {
    const color gold = {0.90f, 0.52f, 0.13f}, rubber = {0.045f, 0.045f, 0.052f};
    const float x = p.x - 412.0f, y = p.y - 404.0f, r = length(x, y);
    if (r > 352.0f) return under;
    const float turn = PI / 3.0f, angle = atan2f(y, x) - turn * p.phase;
    const float lit = r > 1.0f ? -(0.6f * x + 0.8f * y) / r : 0.0f;
    color c = under;
    if (r < 318.0f) c = wheel_spokes(r, angle, r * turn / PERIOD, c);
    c = ring(r, lit, 334.0f, 16.0f, rubber, c);
    c = ring(r, lit, 307.0f, 13.0f, gold, c);
    c = mix(c, (color){0.30f, 0.17f, 0.05f}, edge(62.0f - r, 0.0f));
    return ring(r, lit, 40.0f, 21.0f, gold, c);
}

/* Rings whose spatial frequency grows to half a cycle a line of 486-line video, running outward
 * two rings a repetition. */
static color zone_plate(point p, color under) {
    const float radius = 222.0f, k = 0.25f * PI / radius;
    const float x = p.x - 1016.0f, y = p.y - 290.0f, r = length(x, y);
    if (r > radius + 1.0f) return under;
    const float seen = box_response(k * x / PI * PIXEL_ASPECT) * box_response(k * y / PI) *
                       box_response(2.0f / PERIOD);
    const float wave = cosf(k * r * r - 2.0f * PI * 2.0f * p.phase);
    const float level = 0.42f + 0.40f * seen * wave;
    return mix(under, (color){level, level, level}, edge(radius - r, 0.0f));
}

/* A light of peak 20 that circles the zone plate once in a repetition; a Gaussian spot, smeared
 * along its path by the exposure. */
static color orbiting_light(point p, color under) {
    const float radius = 250.0f, sigma = 3.6f, angle = 2.0f * PI * p.phase;
    const float dx = cosf(angle), dy = sinf(angle);
    const float x = p.x - 1016.0f - radius * dx, y = p.y - 290.0f - radius * dy;
    if (length(x, y) > 40.0f) return under;
    const float path = 2.0f * PI * radius / PERIOD, s = 1.0f / (sigma * sqrtf(2.0f));
    const float along = -x * dy + y * dx, across = x * dx + y * dy;
    const float smear =
        0.5f * (erff((along + 0.5f * path) * s) - erff((along - 0.5f * path) * s));
    const float halo = 0.25f * expf(-length(x, y) / 7.0f);
    const float light = 20.0f * smear * expf(-across * across * s * s) + halo;
    return (color){under.r + light, under.g + 0.86f * light, under.b + 0.62f * light};
}

/* Lines a little thinner than a line of video, nearly level, that sink by half a line of video
 * a field: the speed at which an interlaced picture crawls most. */
static color drifting_lines(point p, color under) {
    const float left = 724.0f, right = 1266.0f, top = 572.0f, bottom = 768.0f, pitch = 16.0f;
    const float frame = fminf(fminf(p.x - left, right - p.x), fminf(p.y - top, bottom - p.y));
    if (frame < -1.0f) return under;
    const float slope = 0.024f, y = p.y - top - slope * (p.x - left) - pitch * p.phase;
    const float line = y - pitch * roundf(y / pitch);
    const color paper = {0.62f, 0.59f, 0.52f}, ink = {0.012f, 0.020f, 0.060f};
    return mix(under, mix(paper, ink, band(line, 1.6f, pitch / PERIOD)), edge(frame, 0.0f));
}

static color patches(point p, color under) {
    static const color paint[8] = {{0.90f, 0.90f, 0.90f}, {0.75f, 0.72f, 0.02f},
                                   {0.03f, 0.62f, 0.72f}, {0.04f, 0.55f, 0.06f},
                                   {0.66f, 0.04f, 0.55f}, {0.70f, 0.03f, 0.02f},
                                   {0.02f, 0.04f, 0.60f}, {0.18f, 0.18f, 0.18f}};
    const float x = p.x - 44.0f, y = p.y - 860.0f, pitch = 1222.0f / 8.0f;
    if (x < 0.0f || x >= 8.0f * pitch || fabsf(y) > 46.0f) return under;
    const int i = (int)(x / pitch);
    const float inside = fminf(72.0f - fabsf(x - pitch * ((float)i + 0.5f)), 42.0f - fabsf(y));
    return mix(under, paint[i], edge(inside, 0.0f));
}

static color shade(point p) {
    return orbiting_light(
        p, patches(p, drifting_lines(p, zone_plate(p, wheel(p, background(p))))));
}

/* Lines y0 <= y < y0 + lines of subframe k into rgb: [3][lines][WIDTH]. */
static void paint_lines(int k, int y0, int lines, float *rgb) {
    const size_t plane = (size_t)lines * WIDTH;
    for (int y = 0; y < lines; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            const color c = shade((point){.x = ((float)x + 0.5f) * PIXEL_ASPECT,
                                          .y = (float)(y0 + y) + 0.5f,
                                          .phase = ((float)k + 0.5f) / PERIOD});
            float *out = rgb + (size_t)y * WIDTH + x;
            out[0] = c.r;
            out[plane] = c.g;
            out[2 * plane] = c.b;
        }
}

/* Writes the header; false if OpenEXR refused anything. */
static bool start_file(exr_context_t file, int k) {
    const exr_attr_rational_t rate = {480000, 1001}, time = {1001 * k, 480000};
    bool ok = exr_add_part(file, "rgb", EXR_STORAGE_SCANLINE, NULL) == EXR_ERR_SUCCESS;
    ok =
        ok && !exr_initialize_required_attr_simple(file, 0, WIDTH, HEIGHT, EXR_COMPRESSION_ZIP);
    ok = ok && !exr_set_pixel_aspect_ratio(file, 0, PIXEL_ASPECT);
    for (const char *name = "RGB"; *name; ++name)
        ok = ok && !exr_add_channel(file, 0, (char[]){*name, 0}, EXR_PIXEL_HALF,
                                    EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    ok = ok && !exr_attr_set_rational(file, 0, "framesPerSecond", &rate);
    ok = ok && !exr_attr_set_rational(file, 0, "weft:time", &time);
    return ok && !exr_write_header(file);
}

/* Packs and writes one chunk of lines from rgb: [3][lines][WIDTH]. */
static bool write_chunk(exr_context_t file, exr_encode_pipeline_t *encoder, int y0,
                        const float *rgb) {
    exr_chunk_info_t chunk;
    if (exr_write_scanline_chunk_info(file, 0, y0, &chunk)) return false;
    const bool first = encoder->channels == NULL;
    if (first ? exr_encoding_initialize(file, 0, &chunk, encoder)
              : exr_encoding_update(file, 0, &chunk, encoder))
        return false;
    for (int c = 0; c < encoder->channel_count; ++c) {
        exr_coding_channel_info_t *channel = &encoder->channels[c];
        const size_t plane = (size_t)(strchr("RGB", *channel->channel_name) - "RGB");
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = (int16_t)sizeof(float);
        channel->user_pixel_stride = (int32_t)sizeof(float);
        channel->user_line_stride = (int32_t)(WIDTH * sizeof(float));
        channel->encode_from_ptr =
            (const uint8_t *)(rgb + plane * (size_t)chunk.height * WIDTH);
    }
    if (first && exr_encoding_choose_default_routines(file, 0, encoder)) return false;
    return exr_encoding_run(file, 0, encoder) == EXR_ERR_SUCCESS;
}

static bool write_subframe(const char *directory, int k, int lines_per_chunk, float *rgb) {
    char path[4096];
    snprintf(path, sizeof path, "%s/subframe.%04d.exr", directory, k);
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.zip_level = 4;
    exr_context_t file;
    if (exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &setup)) return false;
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    bool ok = start_file(file, k);
    for (int y = 0; ok && y < HEIGHT; y += lines_per_chunk) {
        const int lines = HEIGHT - y < lines_per_chunk ? HEIGHT - y : lines_per_chunk;
        paint_lines(k, y, lines, rgb);
        ok = write_chunk(file, &encoder, y, rgb);
    }
    exr_encoding_destroy(file, &encoder);
    return exr_finish(&file) == EXR_ERR_SUCCESS && ok;
}

static const char usage[] =
    "usage: make_subframes DIRECTORY [COUNT]\n"
    "\n"
    "Makes COUNT subframes (1 to 9999; 128, after which all motion repeats) in DIRECTORY,\n"
    "which is made if it is not there: subframe.0000.exr and on, half float, 1440x972,\n"
    "480000/1001 a second, eight a field of 525-line video.\n";

/* COUNT; 0 where it is no number of subframes. */
static int read_count(const char *text) {
    char *end;
    const long count = strtol(text, &end, 10);
    return end != text && !*end && count >= 1 && count <= 9999 ? (int)count : 0;
}

int main(int argc, char **argv) {
    enum { LINES_PER_CHUNK = 16 }; /* of ZIP */
    if (argc == 2 && (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h")))
        return fputs(usage, stdout) < 0;
    const int count = argc > 2 ? read_count(argv[2]) : PERIOD;
    if (argc < 2 || argc > 3 || !count || *argv[1] == '-') {
        fputs(usage, stderr);
        return 2;
    }
    if (mkdir(argv[1], 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "make_subframes: %s: %s\n", argv[1], strerror(errno));
        return 1;
    }
    int failed = 0;
#pragma omp parallel reduction(+ : failed)
    {
        float *rgb = malloc(sizeof *rgb * 3 * LINES_PER_CHUNK * WIDTH);
#pragma omp for schedule(dynamic)
        for (int k = 0; k < count; ++k)
            failed += !rgb || !write_subframe(argv[1], k, LINES_PER_CHUNK, rgb);
        free(rgb);
    }
    if (failed) fprintf(stderr, "make_subframes: %d of %d subframes failed\n", failed, count);
    return failed ? 1 : 0;
}
