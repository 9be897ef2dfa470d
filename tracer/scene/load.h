#ifndef WF_TRACER_SCENE_LOAD_H
#define WF_TRACER_SCENE_LOAD_H

#include "tracer/scene/scene.h"

/* Reads a picture for a texture as scene-linear floats, which the scene then owns. False with a
 * reason. */
typedef bool wf_image_load_fn(void *user, const char *path, bool srgb, wf_image *out, char *why,
                              size_t why_size);

/* A value that the scene reads as param.NAME: a number where the text is one. */
typedef struct wf_param {
    const char *name, *value;
} wf_param;

typedef struct wf_load_options {
    int64_t steps;       /* of the script */
    size_t memory_bytes; /* of the script and the scene */
    const wf_param *params;
    size_t param_count;
    /* What the script sees as raster.width, .lines, .pixel_aspect, .frame_rate, .field_rate. */
    double width_px, lines, pixel_aspect, frame_rate, field_rate;
    wf_image_load_fn *load_image; /* NULL: there are no pictures */
    void *image_user;
    /* Get lines that the script prints, without control codes, and warnings of what is likely a
     * mistake, with file and line; NULL: nobody listens. */
    void (*print)(void *user, const char *line);
    void (*warn)(void *user, const char *text);
    void *tell_user;
} wf_load_options;

/* Runs a scene file (text, Lua 5.4) and makes the scene that it describes; free it with
 * wf_scene_free in any case. False with what is wrong and where: file and line. */
bool wf_scene_load(const char *path, const wf_load_options *options, wf_scene *scene, char *why,
                   size_t why_size);

/* The same for text that is already here; path names it in messages, and its folder is where
 * include and image look. */
bool wf_scene_load_text(const char *text, size_t size, const char *path,
                        const wf_load_options *options, wf_scene *scene, char *why,
                        size_t why_size);

#endif
