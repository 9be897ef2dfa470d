#ifndef WF_CONVERT_READ_PICTURE_H
#define WF_CONVERT_READ_PICTURE_H

#include "tracer/scene/scene.h"

/* Reads a picture file of any format that subframes may have, for a texture: a
 * wf_image_load_fn. srgb: its values are sRGB and become linear. user is not used. */
bool wf_picture_load(void *user, const char *path, bool srgb, wf_image *out, char *why,
                     size_t why_size);

#endif
