/* Renders a scene field by field for tests that know what it should be. */
#include "tests/unit/support/scene_fields.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define BAND 16

static wf_load_options options_for(const wf_raster *r, const wf_param *params, size_t count) {
    return (wf_load_options){.steps = 100000000,
                             .memory_bytes = (size_t)512 << 20,
                             .params = params,
                             .param_count = count,
                             .width_px = r->width_px,
                             .lines = r->lines,
                             .pixel_aspect = wf_ratio_value(r->pixel_aspect),
                             .frame_rate = wf_ratio_value(r->frame_rate),
                             .field_rate = 1 / wf_ratio_value(wf_raster_field_period(r))};
}

static void parse_raster(const char *name, wf_raster *raster) {
    char why[512];
    if (!wf_raster_parse(name, raster, why, sizeof why)) fail_msg("%s", why);
}

void scene_load(const scene_job *job, wf_scene *scene) {
    wf_raster raster;
    wf_param params[4];
    char why[1024], path[1024];
    size_t count = 0;
    parse_raster(job->raster, &raster);
    for (; count < 4 && job->params[count][0]; count++)
        params[count] = (wf_param){job->params[count][0], job->params[count][1]};
    wf_load_options options = options_for(&raster, params, count);
    bool good;
    if (job->text) {
        good = wf_scene_load_text(job->text, strlen(job->text), "test.lua", &options, scene,
                                  why, sizeof why);
    } else {
        const char *source = getenv("WEFT_SOURCE");
        snprintf(path, sizeof path, "%s/examples/scenes/%s", source ? source : ".", job->path);
        good = wf_scene_load(path, &options, scene, why, sizeof why);
    }
    if (!good) fail_msg("%s", why);
}

void scene_refusal(const char *text, char *why, size_t why_size) {
    wf_raster raster;
    wf_scene scene;
    parse_raster("525i", &raster);
    wf_load_options options = options_for(&raster, NULL, 0);
    options.steps = 10000000;
    options.memory_bytes = (size_t)64 << 20;
    if (wf_scene_load_text(text, strlen(text), "test.lua", &options, &scene, why, why_size))
        why[0] = '\0';
    wf_scene_free(&scene);
}

/* ---- Fields ---- */

static void gather_samples(void *user, const wf_samples *samples) {
    wf_gather_add(user, samples);
}

/* As the program does it: bands into sums of their own, merged in order. Returns how many
 * samples were traced. */
static int64_t gather_unit(const wf_sampling *sampling, const wf_gather_desc *desc,
                           int64_t field, wf_gather *all) {
    int lines = desc->raster->lines;
    int64_t samples = 0;
#pragma omp parallel num_threads(2)
    {
        wf_sampling_scratch *scratch = wf_sampling_scratch_new(sampling);
#pragma omp for schedule(dynamic, 1) ordered
        for (int first = 0; first < lines; first += BAND) {
            int end = first + BAND < lines ? first + BAND : lines, line, line_end;
            wf_gather_lines(desc, field, first, end, &line, &line_end);
            wf_gather *band = wf_gather_new(desc, field, line, line_end);
            const wf_receiver receiver = {.user = band, .samples = gather_samples};
            if (!scratch || !band ||
                !wf_sampling_rows(sampling, scratch, first, end, &receiver))
                abort();
#pragma omp ordered
            wf_gather_merge(all, band);
            wf_gather_free(band);
        }
#pragma omp atomic
        samples += wf_sampling_counted(scratch).samples;
        wf_sampling_scratch_free(scratch);
    }
    return samples;
}

static wf_gather *gather_field(const wf_sampling_desc *desc, int64_t field, int64_t *samples) {
    const wf_raster *r = desc->gather.raster;
    wf_sampling *sampling = wf_sampling_new(desc);
    int lines = wf_raster_field_lines(r, wf_raster_parity(r, field));
    wf_gather *all = wf_gather_new(&desc->gather, field, 0, lines);
    int64_t unit, last;
    wf_sampling_scratch *scratch = sampling ? wf_sampling_scratch_new(sampling) : NULL;
    assert_true(scratch && all);
    *samples = 0;
    for (wf_sampling_units(sampling, field, &unit, &last); unit <= last; unit++) {
        assert_true(wf_sampling_look(sampling, scratch, unit));
        *samples += gather_unit(sampling, &desc->gather, field, all);
    }
    wf_sampling_scratch_free(scratch);
    wf_sampling_free(sampling);
    return all;
}

static void take_line(const wf_gather *gather, int line, int width, float *out) {
    float *plane = malloc(3 * (size_t)width * sizeof *plane);
    float *const rgb[3] = {plane, plane + width, plane + 2 * width};
    assert_non_null(plane);
    int empty = wf_gather_line(gather, line, rgb);
    if (empty >= 0) fail_msg("line %d, pixel %d: no sample", line, empty);
    for (int i = 0; i < width; i++)
        for (int c = 0; c < 3; c++) out[3 * i + c] = rgb[c][i];
    free(plane);
}

float *scene_field(const scene_job *job, int64_t field) {
    wf_raster raster;
    wf_scene scene;
    char why[512];
    parse_raster(job->raster, &raster);
    scene_load(job, &scene);
    wf_sampling_desc desc = {.scene = &scene,
                             .gather = {.raster = &raster,
                                        .width = job->width,
                                        .skew = job->skew,
                                        .position = job->position},
                             .sampler = job->sampler,
                             .count = job->count,
                             .seed = job->seed,
                             .error = job->error,
                             .skip = !job->no_skip};
    if (!wf_aperture_parse(job->aperture, &desc.gather.aperture, why, sizeof why))
        fail_msg("%s", why);
    int64_t samples;
    wf_gather *gather = gather_field(&desc, field, job->samples ? job->samples : &samples);
    int lines = wf_raster_field_lines(&raster, wf_raster_parity(&raster, field));
    float *out = malloc(3 * (size_t)raster.width_px * (size_t)lines * sizeof *out);
    assert_non_null(out);
    for (int l = 0; l < lines; l++)
        take_line(gather, l, raster.width_px, out + 3 * (size_t)l * (size_t)raster.width_px);
    wf_gather_free(gather);
    wf_scene_free(&scene);
    return out;
}

float *scene_frame(const scene_job *job, int64_t frame) {
    wf_raster raster;
    parse_raster(job->raster, &raster);
    int per_frame = wf_raster_fields_per_frame(&raster), step = wf_raster_line_step(&raster);
    size_t row = 3 * (size_t)raster.width_px;
    float *out = malloc(row * (size_t)raster.lines * sizeof *out);
    assert_non_null(out);
    for (int k = 0; k < per_frame; k++) {
        int64_t n = frame * per_frame + k;
        int parity = wf_raster_parity(&raster, n),
            lines = wf_raster_field_lines(&raster, parity);
        float *field = scene_field(job, n);
        for (int l = 0; l < lines; l++)
            memcpy(out + (size_t)(parity + l * step) * row, field + (size_t)l * row,
                   row * sizeof *out);
        free(field);
    }
    return out;
}
