#include "color/line/line.h"

extern const wf_line_ops wf_line_ops_v1;

#if defined(__x86_64__)
#include <stdbool.h>

extern const wf_line_ops wf_line_ops_v3, wf_line_ops_v4;
static const wf_line_ops *const levels[] = {&wf_line_ops_v1, &wf_line_ops_v3, &wf_line_ops_v4};

static bool has_v3(void) {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi2");
}

static bool has_v4(void) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}

static size_t level_count(void) {
    return !has_v3() ? 1 : has_v4() ? 3 : 2;
}
#else
static const wf_line_ops *const levels[] = {&wf_line_ops_v1};

static size_t level_count(void) {
    return 1;
}
#endif

const wf_line_ops *wf_line_ops_at(size_t index) {
    return index < level_count() ? levels[index] : NULL;
}

const wf_line_ops *wf_line_ops_best(void) {
    return levels[level_count() - 1];
}
