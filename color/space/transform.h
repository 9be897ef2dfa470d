#ifndef WF_COLOR_SPACE_TRANSFORM_H
#define WF_COLOR_SPACE_TRANSFORM_H

#include <stdbool.h>
#include <stddef.h>

/* Scene-linear to display-encoded R'G'B', in place: three planes of width_px samples. Called
 * from many threads at once; never fails once made. */
typedef struct wf_transform {
    void (*apply)(const void *self, float *r, float *g, float *b, size_t width_px);
    void (*free)(void *self);
    void *self;
} wf_transform;

/* One of the shipped spaces, which must be scene-linear, to another without OpenColorIO: the
 * same matrices and curves as color/weft.ocio. NaN counts as 0 and Inf as very bright; negative
 * R'G'B' becomes 0, above 1 it is kept; neutrals stay neutral to the bit. False with a reason
 * (and the names there are) if a name is unknown. */
bool wf_builtin_transform(const char *from, const char *to, wf_transform *out, char *why,
                          size_t why_size);

/* The name of shipped space i, NULL past the end; *is_output tells an encoding from an input.
 */
const char *wf_builtin_space(size_t index, bool *is_output);

#endif
