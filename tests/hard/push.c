/* Pushes samples and tiles into fields that are written to a file, as a renderer does: the push
 * interface for campaigns. */
#include <stdio.h>
#include <stdlib.h>

#include <weft.h>

enum { WIDTH = 48, LINES = 36, SAMPLES = WIDTH * LINES };

static float x[SAMPLES], y[SAMPLES], t[SAMPLES], light[SAMPLES], rgb[SAMPLES][3];

static void fill(void) {
    for (int i = 0; i < SAMPLES; i++) {
        x[i] = (float)(i % WIDTH) + 0.5f;
        y[i] = (float)(i / WIDTH) + 0.5f;
        t[i] = 0.25f;
        light[i] = rgb[i][0] = rgb[i][1] = rgb[i][2] = (float)i / SAMPLES;
    }
}

static void on_field(const weft_field *field, void *user) {
    *(long *)user += field->lines;
}

static weft_status push(weft_fields *fields, weft_error *err) {
    weft_status status = WEFT_OK;
    for (int n = 0; n < 6 && !status; n++) {
        weft_samples samples = {.count = SAMPLES,
                                .x = x,
                                .y = y,
                                .t = t,
                                .field = n,
                                .red = light,
                                .green = light,
                                .blue = light};
        weft_tile tile = {.x1 = WIDTH,
                          .y1 = LINES,
                          .field = n,
                          .width = WIDTH,
                          .height = LINES,
                          .rgb = rgb[0]};
        status = weft_fields_push(fields, &samples, err);
        if (!status) status = weft_fields_push_tile(fields, &tile, err);
        if (!status) status = weft_fields_until(fields, n + 1, err);
    }
    return status ? status : weft_fields_finish(fields, err);
}

static weft_status make(weft_job *job, const char *output, weft_error *err) {
    weft_fields *fields = NULL;
    long lines = 0;
    weft_status status = weft_job_set(job, "raster", "48x36@30i,tff", err);
    if (!status) status = weft_job_set_output(job, output, err);
    if (!status) status = weft_fields_new(job, 3, on_field, &lines, &fields, err);
    if (!status) status = push(fields, err);
    weft_fields_free(fields);
    if (!status && lines != 6 * LINES / 2) return WEFT_FAILED;
    return status;
}

int main(int argc, char **argv) {
    weft_error err = {""};
    weft_job *job = argc == 2 ? weft_job_new() : NULL;
    if (!job) return fprintf(stderr, "weft: out of memory, or no OUTPUT\n"), 1;
    fill();
    weft_status status = make(job, argv[1], &err);
    weft_job_free(job);
    if (status) fprintf(stderr, "weft: %s\n", err.text);
    return status == WEFT_NO_MEMORY ? 1 : (int)status;
}
