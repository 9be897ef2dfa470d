#include "tracer/trace/light.h"

#include "filters/base/isa.h"

extern const wf_light_ops wf_light_v1;
#if defined(__x86_64__)
extern const wf_light_ops wf_light_v3, wf_light_v4;
static const wf_light_ops *const levels[] = {&wf_light_v1, &wf_light_v3, &wf_light_v4};
#else
static const wf_light_ops *const levels[] = {&wf_light_v1};
#endif

const wf_light_ops *wf_light_best(void) {
    return levels[wf_isa_levels() - 1];
}
