#include "filters/base/isa.h"

#include <stdbool.h>

#if defined(__x86_64__)
/* F16C, which clang cannot ask for, came with an earlier generation than AVX2. */
static bool has_v3(void) {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi2");
}

static bool has_v4(void) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}

int wf_isa_levels(void) {
    return !has_v3() ? 1 : has_v4() ? 3 : 2;
}
#else
int wf_isa_levels(void) {
    return 1;
}
#endif
