#ifndef WF_COLOR_SPACE_TRANSFORM_H
#define WF_COLOR_SPACE_TRANSFORM_H

#include <stddef.h>

/* Scene-linear to display-encoded R'G'B', in place: three planes of width_px samples. Any
 * number of threads may apply one at once, and applying never fails. Whoever holds it calls
 * free(self). */
typedef struct wf_transform {
    void (*apply)(const void *self, float *r, float *g, float *b, size_t width_px);
    void (*free)(void *self);
    void *self;
} wf_transform;

#endif
