#ifndef WF_COLOR_SPACE_OCIO_OCIO_H
#define WF_COLOR_SPACE_OCIO_OCIO_H

#include <stdbool.h>
#include <stddef.h>

#include "color/space/transform.h"

/* Names in an OpenColorIO configuration; NULL or "" where not given. */
typedef struct wf_ocio_query {
    const char *config; /* file; NULL: the configuration that weft ships */
    const char *from;   /* NULL: the configuration's scene_linear role */
    const char *to;     /* or display and view */
    const char *display, *view, *look;
} wf_ocio_query;

/* The entry point of the OpenColorIO module. Unknown names are refused with the list of the
 * names there are. Before OpenColorIO sees them NaN is made 0, and Inf the largest half;
 * negative R'G'B' is made 0 after it, but light (a scene-linear `to`) may be negative. */
typedef bool wf_ocio_open_fn(const wf_ocio_query *query, wf_transform *out, char *why,
                             size_t why_size);

#endif
