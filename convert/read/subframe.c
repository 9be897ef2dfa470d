/* An open picture: what it says of itself, and its end. */
#include "convert/read/subframe.h"

#include <stdlib.h>

const wf_image_info *wf_subframe_info(const wf_subframe *subframe) {
    return &subframe->info;
}

void wf_subframe_close(wf_subframe *s) {
    if (!s) return;
    if (s->exr) exr_finish(&s->exr);
    free(s->whole);
    free(s->path);
    free(s);
}
