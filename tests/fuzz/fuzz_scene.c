/* Whatever a scene file holds, it is refused with a message or rendered to finite light, within
 * its budget. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/sample/sampling.h"
#include "tracer/scene/load.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_finite(void *user, const wf_samples *s) {
    (void)user;
    for (size_t i = 0; i < s->count; i++)
        for (int c = 0; c < 3; c++)
            if (!isfinite(s->rgb[c][i])) abort();
}

static void render(const wf_scene *scene, const wf_raster *raster) {
    wf_sampling_desc desc = {.scene = scene,
                             .gather = {.raster = raster, .width = {1, 2}},
                             .sampler = WF_SAMPLER_JITTER,
                             .count = 1,
                             .skip = true};
    char why[256];
    if (!wf_aperture_parse("box", &desc.gather.aperture, why, sizeof why)) abort();
    wf_sampling *sampling = wf_sampling_new(&desc);
    wf_sampling_scratch *scratch = sampling ? wf_sampling_scratch_new(sampling) : NULL;
    if (scratch && wf_sampling_look(sampling, scratch, 1))
        wf_sampling_rows(sampling, scratch, 0, raster->lines,
                         &(wf_receiver){.samples = check_finite});
    wf_sampling_scratch_free(scratch);
    wf_sampling_free(sampling);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    wf_raster raster;
    wf_scene scene;
    char why[1024];
    if (!wf_raster_parse("16x12@30i", &raster, why, sizeof why)) abort();
    const wf_load_options options = {.steps = 100000,
                                     .memory_bytes = (size_t)4 << 20,
                                     .width_px = 16,
                                     .lines = 12,
                                     .pixel_aspect = 1,
                                     .frame_rate = 30,
                                     .field_rate = 60};
    if (wf_scene_load_text((const char *)data, size, "fuzz.lua", &options, &scene, why,
                           sizeof why))
        render(&scene, &raster);
    else if (!*why)
        abort();
    wf_scene_free(&scene);
    return 0;
}
