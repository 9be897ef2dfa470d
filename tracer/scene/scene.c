/* What is done to a scene as a whole. */
#include "tracer/scene/scene.h"

#include <stdlib.h>

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
