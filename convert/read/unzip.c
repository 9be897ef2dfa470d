#include "convert/read/unzip.h"

#include "filters/base/isa.h"

extern const wf_unzip_ops wf_unzip_ops_v1;
#if defined(__x86_64__)
extern const wf_unzip_ops wf_unzip_ops_v3, wf_unzip_ops_v4;
static const wf_unzip_ops *const levels[] = {&wf_unzip_ops_v1, &wf_unzip_ops_v3,
                                             &wf_unzip_ops_v4};
#else
static const wf_unzip_ops *const levels[] = {&wf_unzip_ops_v1};
#endif

const wf_unzip_ops *wf_unzip_ops_at(size_t index) {
    return index < (size_t)wf_isa_levels() ? levels[index] : NULL;
}

const wf_unzip_ops *wf_unzip_ops_best(void) {
    return levels[wf_isa_levels() - 1];
}
