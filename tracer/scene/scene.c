/* What is done to a scene as a whole. */
#include "tracer/scene/scene.h"

#include <stdlib.h>

bool wf_scene_has_alpha(const wf_scene *scene) {
    bool cut = scene->background_clear > 0;
    for (int n = 0; n < scene->material_count; n++) cut |= scene->materials[n].holdout;
    return cut;
}

void wf_scene_free(wf_scene *s) {
    for (int n = 0; n < s->image_count; n++) free(s->images[n].rgb);
    free(s->ops);
    free(s->keys);
    free(s->materials);
    free(s->images);
    free(s->solids);
    free(s->planes);
    free(s->steps);
    free(s->objects);
    free(s->lights);
    *s = (wf_scene){0};
}
