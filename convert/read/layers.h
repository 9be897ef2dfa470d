#ifndef WF_CONVERT_READ_LAYERS_H
#define WF_CONVERT_READ_LAYERS_H

#include <stdbool.h>
#include <stddef.h>

/* Which channels of a part are the picture. */
typedef struct wf_pick {
    int channel[4]; /* R G B A in the list given; a lone Y three times */
    int count;      /* 3, or 4 with alpha */
} wf_pick;

/* Chooses among channel names: the layer asked for ("diffuse": diffuse.R ..), or without one
 * the bare R G B, a lone Y, the only layer that has R G B, or the only one called Combined.
 * False with a reason that lists the layers there are; why may be NULL. want_alpha: take A too
 * where there is one. */
bool wf_pick_channels(const char *const *name, int count, const char *layer, bool want_alpha,
                      wf_pick *out, char *why, size_t why_size);

#endif
