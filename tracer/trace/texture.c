#include "tracer/trace/texture.h"

#include "filters/base/isa.h"

#define LEVEL(v) extern wf_texture_fn *const wf_textures_##v[WF_TEXTURES];
LEVEL(v1)
#if defined(__x86_64__)
LEVEL(v3)
LEVEL(v4)
#endif

static wf_texture_fn *const *const levels[] = {
    wf_textures_v1,
#if defined(__x86_64__)
    wf_textures_v3,
    wf_textures_v4,
#endif
};

wf_texture_fn *const *wf_textures_best(void) {
    return levels[wf_isa_levels() - 1];
}
