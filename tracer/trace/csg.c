#include "tracer/trace/csg.h"

#include <math.h>

#include "filters/base/isa.h"

extern const wf_csg_ops wf_csg_v1;
#if defined(__x86_64__)
extern const wf_csg_ops wf_csg_v3, wf_csg_v4;
static const wf_csg_ops *const levels[] = {&wf_csg_v1, &wf_csg_v3, &wf_csg_v4};
#else
static const wf_csg_ops *const levels[] = {&wf_csg_v1};
#endif

const wf_csg_ops *wf_csg_at(size_t level) {
    return level < (size_t)wf_isa_levels() ? levels[level] : NULL;
}

const wf_csg_ops *wf_csg_best(void) {
    return levels[wf_isa_levels() - 1];
}

void wf_hits_clear(wf_hits *hits) {
    for (int i = 0; i < WF_PACKET; i++) {
        hits->s[i] = HUGE_VAL;
        hits->solid[i] = -1;
        hits->entering[i] = 0;
    }
}
