/* The push interface under arbitrary calls: options by the first byte, then calls of a letter
 * and its arguments. Every failure says why, and fields come in their order, each once. */
#include <stdlib.h>
#include <string.h>

#include "convert/weft.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define MOST 32 /* samples a call */

typedef struct feed {
    const uint8_t *data;
    size_t size;
} feed;

static uint8_t byte_of(feed *f) {
    if (!f->size) return 0;
    f->size--;
    return *f->data++;
}

/* Mostly in the picture, at times anything. */
static float number_of(feed *f) {
    float any;
    uint8_t bytes[4], first = byte_of(f);
    if (first < 250) return (float)first / 8;
    for (int i = 0; i < 4; i++) bytes[i] = byte_of(f);
    memcpy(&any, bytes, sizeof any);
    return any;
}

static int64_t field_of(feed *f) {
    static const int64_t far[] = {INT64_MIN, INT64_MAX, -1, 1 << 30};
    uint8_t n = byte_of(f);
    return n < 240 ? n % 12 : far[n % 4];
}

static void on_field(const weft_field *field, void *user) {
    int64_t *next = user;
    if (field->index != (*next)++ || field->lines < 1 || !field->rgb) abort();
}

static weft_status push(weft_fields *fields, feed *f, weft_error *err) {
    float value[8][MOST];
    size_t count = byte_of(f) % MOST;
    for (int c = 0; c < 8; c++)
        for (size_t i = 0; i < count; i++) value[c][i] = number_of(f);
    const weft_samples samples = {.count = count,
                                  .x = value[0],
                                  .y = value[1],
                                  .t = value[2],
                                  .field = field_of(f),
                                  .red = value[3],
                                  .green = value[4],
                                  .blue = value[5],
                                  .weight = byte_of(f) % 2 ? value[6] : NULL,
                                  .alpha = byte_of(f) % 2 ? value[7] : NULL};
    return weft_fields_push(fields, &samples, err);
}

static weft_status push_tile(weft_fields *fields, feed *f, weft_error *err) {
    float rgb[3 * MOST], alpha[MOST];
    for (int i = 0; i < 3 * MOST; i++) rgb[i] = (float)i;
    for (int i = 0; i < MOST; i++) alpha[i] = number_of(f);
    const weft_tile tile = {.x0 = (double)number_of(f),
                            .y0 = (double)number_of(f),
                            .x1 = (double)number_of(f),
                            .y1 = (double)number_of(f),
                            .t = (double)number_of(f),
                            .field = field_of(f),
                            .width = byte_of(f) % 9 - 1,
                            .height = byte_of(f) % 5,
                            .rgb = rgb,
                            .alpha = byte_of(f) % 2 ? alpha : NULL};
    return weft_fields_push_tile(fields, &tile, err);
}

static void call(weft_fields *fields, feed *f) {
    weft_error err = {""};
    weft_status status;
    switch (byte_of(f) % 8) {
    case 0:
        status = weft_fields_until(fields, field_of(f), &err);
        break;
    case 1:
        status = weft_fields_finish(fields, &err);
        break;
    case 2:
    case 3:
        status = push_tile(fields, f, &err);
        break;
    default:
        status = push(fields, f, &err);
        break;
    }
    if (status && !*err.text) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const apertures[] = {"box", "line", "shaped", "mitchell:1/3,1/3"};
    feed f = {data, size};
    weft_job *job = weft_job_new();
    weft_fields *fields = NULL;
    int64_t next = 0;
    if (!job) abort();
    weft_job_set(job, "raster", byte_of(&f) % 2 ? "24x16@30i,tff" : "24x16@25p", NULL);
    weft_job_set(job, "aperture", apertures[byte_of(&f) % 4], NULL);
    weft_job_set(job, "on-empty", byte_of(&f) % 2 ? "nearest" : "error", NULL);
    if (byte_of(&f) % 2) weft_job_set(job, "alpha-out", NULL, NULL);
    weft_status status =
        weft_fields_new(job, 1 + byte_of(&f) % 4, on_field, &next, &fields, NULL);
    for (int i = 0; !status && f.size && i < 64; i++) call(fields, &f);
    weft_fields_free(fields);
    weft_job_free(job);
    return 0;
}
