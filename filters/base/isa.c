/* Finds out which levels of the architecture the processor runs. */
#include "filters/base/isa.h"

#include <stdbool.h>

const char *wf_isa_name(size_t level) {
    static const char *const names[] = {"v1", "v3", "v4"};
    return names[level];
}

#if defined(__x86_64__)
/* Clang cannot ask for F16C, which came with an earlier generation than AVX2. */
static bool has_v3(void) {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi2");
}

static bool has_v4(void) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}

size_t wf_isa_levels(void) {
    return !has_v3() ? 1 : has_v4() ? 3 : 2;
}
#else
size_t wf_isa_levels(void) {
    return 1;
}
#endif
