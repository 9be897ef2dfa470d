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

/* False with a reason, which is empty where memory is out, as those below do.
 * Unknown names are refused with the list of the names there are, and so is a space, a look or
 * a view that is made of itself or gives no numbers for plain colors. Before OpenColorIO sees
 * them NaN is made 0, and Inf the largest half. */
typedef bool wf_ocio_open_fn(const wf_ocio_query *query, wf_transform *out, char *why,
                             size_t why_size);

/* What a space of a configuration is as an input. */
typedef struct wf_ocio_input {
    wf_transform decode;   /* to the scene_linear role, where the space is not proportional to
                              light; else empty. The caller frees it. */
    char light_space[128]; /* what light is in then: the space itself, or that of the role */
    bool has_ap0;          /* there is an aces_interchange role: ACES2065-1 by that name */
} wf_ocio_input;

/* from: NULL for the scene_linear role. Refuses what wf_ocio_open refuses. */
typedef bool wf_ocio_input_fn(const char *config, const char *from, wf_ocio_input *out,
                              char *why, size_t why_size);

/* What a view is shown on. */
typedef struct wf_ocio_shown {
    char display[128]; /* its name: the configuration's default one where NULL is given */
    char space[128];   /* the name of the view's color space; "" if there is none */
    bool is_data;      /* that is data, which no display decodes */
} wf_ocio_shown;
typedef bool wf_ocio_display_fn(const char *config, const char *display, const char *view,
                                wf_ocio_shown *out, char *why, size_t why_size);

#define WF_OCIO_AP0 "aces_interchange"

#endif
