#ifndef WF_CONVERT_READ_CHOICE_EXR_PARTS_H
#define WF_CONVERT_READ_CHOICE_EXR_PARTS_H

#include <openexr.h>

#include "convert/read/choice/layers.h"

/* The parts of an open EXR with their channels, whose names are the file's: it must stay open.
 */
typedef struct wf_exr_parts {
    wf_part *part;
    wf_channel *channel; /* of all parts */
    int count;
} wf_exr_parts;

/* The channels of a part; NULL if the file has none. */
const exr_attr_chlist_t *wf_exr_channels(exr_const_context_t exr, int part);

/* False when memory is out, with nothing to free. */
bool wf_exr_parts_find(exr_const_context_t exr, wf_exr_parts *out);
void wf_exr_parts_free(wf_exr_parts *parts);

#endif
