#ifndef WF_COLOR_SPACE_BUILTIN_H
#define WF_COLOR_SPACE_BUILTIN_H

#include <stdbool.h>
#include <stddef.h>

#include "color/space/space.h"
#include "color/space/transform.h"

/* One of the shipped spaces to another without OpenColorIO: the same matrices and curves as
 * color/weft.ocio. What is encoded is decoded first. NaN counts as 0 and Inf as very bright;
 * what is negative or above 1 is kept; neutrals stay neutral to the bit. False with a reason
 * (and the names there are) if a name is unknown. */
bool wf_builtin_transform(const char *from, const char *to, wf_transform *out, char *why,
                          size_t why_size);

/* The same from light of any primaries, which are usable (wf_chromaticities_usable). False: no
 * memory. */
bool wf_builtin_from_light(const wf_chromaticities *from, const wf_space *to,
                           wf_transform *out);

/* Light of some primaries to light of others. False: no memory. */
bool wf_builtin_mix(const wf_chromaticities *from, const wf_chromaticities *to,
                    wf_transform *out);

#endif
