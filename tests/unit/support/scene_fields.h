#ifndef WF_TESTS_UNIT_SUPPORT_SCENE_FIELDS_H
#define WF_TESTS_UNIT_SUPPORT_SCENE_FIELDS_H

#include "tracer/sample/sampling.h"
#include "tracer/scene/load.h"

/* A scene rendered field by field, for tests that know what it should be. Failures end the
 * test. */
typedef struct scene_job {
    const char *text; /* Lua; NULL: the file `path` below examples/scenes */
    const char *path;
    const char *raster, *aperture;
    wf_rational width, skew;
    wf_position position;
    wf_sampler_kind sampler;
    int count;
    double error;     /* asked for, instead of a count; 0: none */
    int64_t *samples; /* NULL, or: how many were traced for a field */
    uint64_t seed;
    bool no_skip;
    const char *params[4][2];
} scene_job;

/* Loads the job's scene; free it with wf_scene_free. */
void scene_load(const scene_job *job, wf_scene *scene);

/* The scene's error message; "" if it loads. */
void scene_refusal(const char *text, char *why, size_t why_size);

/* A field as [lines of the field][width][3] scene-linear; free it. */
float *scene_field(const scene_job *job, int64_t field);

/* A frame, both fields woven: [lines][width][3]; free it. */
float *scene_frame(const scene_job *job, int64_t frame);

#endif
