/* A renderer in few lines that hands its samples to weft as it makes them, field by field: nothing
 * is stored but the video.
 *
 *   cc push_samples.c $(pkg-config --cflags --libs weft) -lm -o push_samples
 *   ./push_samples out.y4m */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <weft.h>

#define FRAMES 15
#define EACH   8 /* samples a pixel and field */

static float drawn(void) { return (float)rand() / ((float)RAND_MAX + 1); }

/* One line of one field's samples: a ring that grows. */
static void render_line(int j, int64_t field, int width, int lines, float *v) {
    size_t count = (size_t)width * EACH;
    for (size_t k = 0; k < count; k++) {
        float x = (float)(k / EACH) + drawn(), y = (float)j + drawn(), t = 0.5f * drawn();
        float dx = (x - (float)width / 2) * 10 / 11, dy = y - (float)lines / 2;
        float r = sqrtf(dx * dx + dy * dy) - 4 * ((float)field + t);
        float light = fabsf(r - 60) < 12 ? 0.9f : 0.05f;
        const float sample[6] = {x, y, t, light, 0.8f * light, 0.3f};
        for (size_t c = 0; c < 6; c++) v[c * count + k] = sample[c];
    }
}

static weft_status render_field(weft_fields *fields, int64_t field, const weft_raster *raster,
                                float *v, weft_error *error) {
    size_t n = (size_t)raster->width_px * EACH;
    for (int j = 0; j < raster->lines; j++) {
        render_line(j, field, raster->width_px, raster->lines, v);
        const weft_samples line = {n,         v,         v + n,     v + 2 * n, field,
                                   v + 3 * n, v + 4 * n, v + 5 * n, NULL,      NULL};
        weft_status status = weft_fields_push(fields, &line, error);
        if (status) return status;
    }
    return weft_fields_until(fields, field + 1, error); /* all before the next instant is there */
}

int main(int argc, char **argv) {
    weft_error error = {""};
    weft_raster raster;
    weft_fields *fields = NULL;
    weft_job *job = weft_job_new();
    if (!job || argc != 2 || weft_raster_parse("525i", &raster, &error)) return 2;
    float *v = malloc(6 * (size_t)raster.width_px * EACH * sizeof *v);
    weft_status status = weft_job_set_output(job, argv[1], &error);
    if (!status) status = weft_job_set(job, "aperture", "box", &error);
    if (!status) status = weft_fields_new(job, FRAMES, NULL, NULL, &fields, &error);
    for (int64_t n = 0; v && !status && n < 2 * FRAMES; n++)
        status = render_field(fields, n, &raster, v, &error);
    if (!status) status = weft_fields_finish(fields, &error);
    if (status) fprintf(stderr, "push_samples: %s\n", error.text);
    weft_fields_free(fields);
    weft_job_free(job);
    free(v);
    return (int)status;
}
