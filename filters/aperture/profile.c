#include "filters/aperture/profile.h"

#include "filters/base/isa.h"

#define LEVEL(v) extern wf_profile_fn *const wf_profiles_##v[WF_PROFILES];
LEVEL(v1)
#if defined(__x86_64__)
LEVEL(v3)
LEVEL(v4)
#endif

static wf_profile_fn *const *const levels[] = {
    wf_profiles_v1,
#if defined(__x86_64__)
    wf_profiles_v3,
    wf_profiles_v4,
#endif
};

wf_profile_fn *const *wf_profiles_best(void) {
    return levels[wf_isa_levels() - 1];
}
