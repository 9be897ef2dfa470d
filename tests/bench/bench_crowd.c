/* What rays cost among many solids, on one thread: CPU seconds of loading a scene, of building
 * its trees, and of tracing a picture of 360 x 243 at an instant, gathered to pixels.
 *
 *   bench-crowd SCENE.lua SAMPLES [NAME=VALUE..]
 *   bench-crowd SCENE.lua spheres [NAME=VALUE..]    writes x y z radius r g b, seven floats
 * each */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "tracer/sample/sampling.h"
#include "tracer/scene/load.h"

static double cpu_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void gather(void *user, const wf_samples *samples) {
    wf_gather_add(user, samples);
}

/* Spheres that stand in the world, for peers. */
static void write_spheres(const wf_scene *scene) {
    for (int n = 0; n < scene->solid_count; n++) {
        const wf_solid *s = &scene->solids[n];
        const float *color = scene->materials[s->material].color;
        const float ball[7] = {(float)s->place.d.x,
                               (float)s->place.d.y,
                               (float)s->place.d.z,
                               (float)s->place.m[0][0],
                               color[0],
                               color[1],
                               color[2]};
        if (s->kind == WF_SPHERE) fwrite(ball, sizeof ball, 1, stdout);
    }
}

static bool load(const wf_raster *r, char **argument, int count, wf_scene *scene) {
    char why[1024];
    wf_param params[16];
    wf_load_options options = {.steps = 2000000000,
                               .memory_bytes = (size_t)4 << 30,
                               .params = params,
                               .width_px = r->width_px,
                               .lines = r->lines,
                               .pixel_aspect = 1,
                               .frame_rate = 30,
                               .field_rate = 30};
    for (int n = 2; n < count && options.param_count < 16; n++) {
        char *value = strchr(argument[n], '=');
        if (!value) return false;
        *value = '\0';
        params[options.param_count++] = (wf_param){argument[n], value + 1};
    }
    if (wf_scene_load(argument[0], &options, scene, why, sizeof why)) return true;
    fprintf(stderr, "%s\n", why);
    return false;
}

/* Draws a picture; the seconds of building and of tracing, and how many rays. */
static bool draw(const wf_scene *scene, const wf_raster *r, int count, double seconds[2],
                 wf_trace_counts *counts) {
    double start = cpu_s();
    char why[256];
    wf_sampling_desc desc = {.scene = scene, .sampler = WF_SAMPLER_SOBOL, .count = count};
    desc.skip = true;
    desc.gather = (wf_gather_desc){.raster = r, .width = {0, 1}};
    if (!wf_aperture_parse("line", &desc.gather.aperture, why, sizeof why)) return false;
    wf_gather *all = wf_gather_new(&desc.gather, 0, 0, r->lines);
    const wf_receiver receiver = {.user = all, .samples = gather};
    wf_sampling *sampling = wf_sampling_new(&desc);
    wf_sampling_scratch *scratch = sampling ? wf_sampling_scratch_new(sampling) : NULL;
    bool good = all && scratch && wf_sampling_look(sampling, scratch, 0);
    seconds[0] = cpu_s() - start;
    good = good && wf_sampling_rows(sampling, scratch, 0, r->lines, &receiver);
    seconds[1] = cpu_s() - start - seconds[0];
    if (good) *counts = wf_sampling_counted(scratch);
    wf_sampling_scratch_free(scratch);
    wf_sampling_free(sampling);
    wf_gather_free(all);
    return good;
}

int main(int count, char **argument) {
    wf_raster raster;
    wf_scene scene;
    wf_trace_counts counts;
    struct rusage use;
    char why[256];
    double seconds[2], start = cpu_s();
    if (count < 3 || !wf_raster_parse("360x243@30p", &raster, why, sizeof why)) return 2;
    if (!load(&raster, argument + 1, count - 1, &scene)) return 1;
    double loading = cpu_s() - start;
    if (!strcmp(argument[2], "spheres")) {
        write_spheres(&scene);
        return 0;
    }
    if (!draw(&scene, &raster, atoi(argument[2]), seconds, &counts)) return 1;
    getrusage(RUSAGE_SELF, &use);
    printf("load %.4f build %.4f trace %.4f samples %lld rays %lld peak_mb %ld\n", loading,
           seconds[0], seconds[1], (long long)counts.samples, (long long)counts.rays,
           use.ru_maxrss >> 10);
    wf_scene_free(&scene);
    return 0;
}
