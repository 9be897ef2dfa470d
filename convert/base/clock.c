/* The clock that runs are timed with. */
#include "convert/base/clock.h"

#include <time.h>

double wf_now_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
