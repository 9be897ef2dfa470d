#ifndef WF_COLOR_SPACE_BUILTIN_H
#define WF_COLOR_SPACE_BUILTIN_H

#include <stdbool.h>
#include <stddef.h>

#include "color/space/transform.h"

/* One of the shipped spaces, which must be scene-linear, to another without OpenColorIO: the
 * same matrices and curves as color/weft.ocio. NaN counts as 0 and Inf as very bright; negative
 * R'G'B' becomes 0, above 1 it is kept; neutrals stay neutral to the bit. False with a reason
 * (and the names there are) if a name is unknown. */
bool wf_builtin_transform(const char *from, const char *to, wf_transform *out, char *why,
                          size_t why_size);

#endif
