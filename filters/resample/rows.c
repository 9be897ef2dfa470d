#include "filters/resample/rows.h"

#include "filters/base/isa.h"

extern const wf_row_ops wf_row_ops_v1;
#if defined(__x86_64__)
extern const wf_row_ops wf_row_ops_v3, wf_row_ops_v4;
static const wf_row_ops *const levels[] = {&wf_row_ops_v1, &wf_row_ops_v3, &wf_row_ops_v4};
#else
static const wf_row_ops *const levels[] = {&wf_row_ops_v1};
#endif

const wf_row_ops *wf_row_ops_at(size_t index) {
    return index < (size_t)wf_isa_levels() ? levels[index] : NULL;
}

const wf_row_ops *wf_row_ops_best(void) {
    return levels[wf_isa_levels() - 1];
}
