/* Kernels of equal steps. */
#include "filters/aperture/stairs.h"

#include <math.h>
#include <stdlib.h>

#include "filters/base/sinc.h"

int wf_comb_count(double lines) {
    return (int)lround((lines - 1) * WF_STAIRS_STEPS) + 1;
}

/* A pulse covers the steps of one line to each side of it, and so does its mirror image. */
double wf_comb_share(int step, int pulse) {
    int right = step >= pulse - WF_STAIRS_STEPS && step < pulse + WF_STAIRS_STEPS;
    int left = step < WF_STAIRS_STEPS - pulse;
    return pulse ? right + left : right;
}

void wf_stairs_init(wf_stairs *stairs, double lines, const double *comb) {
    int pulses = wf_comb_count(lines);
    double sum = comb[0];
    for (int k = 1; k < pulses; k++) sum += 2 * comb[k];
    *stairs = (wf_stairs){.count = pulses - 1 + WF_STAIRS_STEPS};
    for (int i = 0; i < stairs->count; i++) {
        for (int k = 0; k < pulses; k++)
            stairs->height[i] += wf_comb_share(i, k) * comb[k] / (2 * sum);
        stairs->area[i + 1] = stairs->area[i] + stairs->height[i] / WF_STAIRS_STEPS;
    }
}

double wf_stairs_integral(const wf_stairs *stairs, double v) {
    double steps = fmin(fabs(v) * WF_STAIRS_STEPS, stairs->count);
    int whole = (int)fmin(steps, stairs->count - 1);
    double part = (steps - whole) / WF_STAIRS_STEPS;
    return copysign(stairs->area[whole] + part * stairs->height[whole], v);
}

double wf_stairs_response(const wf_stairs *stairs, double f) {
    double sum = 0, phase = 2 * M_PI * f / WF_STAIRS_STEPS;
    for (int i = 0; i < stairs->count; i++) sum += stairs->height[i] * cos(phase * (i + 0.5));
    return 2.0 / WF_STAIRS_STEPS * wf_sinc(f / WF_STAIRS_STEPS) * sum;
}

double wf_stairs_power(const wf_stairs *stairs) {
    double sum = 0;
    for (int i = 0; i < stairs->count; i++) sum += stairs->height[i] * stairs->height[i];
    return 2 * sum / WF_STAIRS_STEPS;
}
