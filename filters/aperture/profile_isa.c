/* The apertures themselves (filters/README.md, Apertures), as loops over samples. */
#include <math.h>

#include "filters/aperture/profile.h"
#include "filters/base/isa_file.h"

#define PROFILE                                                                                \
    const wf_aperture *a, double tau, int count, const double *restrict v,                     \
        const double *restrict q, double *restrict height, double *restrict half_u

static void line(PROFILE) {
    (void)a, (void)tau, (void)q;
    for (int i = 0; i < count; i++) {
        half_u[i] = 0.5;
        height[i] = fabs(v[i]) <= 0.5 ? 1 : 0;
    }
}

static void box(PROFILE) {
    (void)a, (void)tau, (void)q;
    for (int i = 0; i < count; i++) {
        half_u[i] = 0.5;
        height[i] = fabs(v[i]) <= 1 ? 1 : 0;
    }
}

/* f, the quadratic notch filter. */
static inline double notch_f(double v) {
    double s = fabs(v), near = 0.5 - s * s / 4, far = s * s / 4 - s + 1;
    return s < 1 ? near : s < 2 ? far : 0;
}

static void notch(PROFILE) {
    (void)a, (void)tau, (void)q;
    for (int i = 0; i < count; i++) {
        half_u[i] = 0.5;
        height[i] = notch_f(v[i]);
    }
}

/* |u| < 2 f(v): the border does not belong to it. */
static void shaped(PROFILE) {
    (void)a, (void)tau, (void)q;
    for (int i = 0; i < count; i++) {
        double half = 2 * notch_f(v[i]);
        half_u[i] = half * (1 - 0x1p-52);
        height[i] = half > 0 ? 1 : 0;
    }
}

static void diamond(PROFILE) {
    (void)a;
    for (int i = 0; i < count; i++) {
        half_u[i] = 0.5;
        height[i] = fabs(v[i]) + fabs(2 * q[i] / tau) <= 1 ? 1 : 0;
    }
}

static void mitchell(PROFILE) {
    double n[4], f[4];
    (void)tau, (void)q;
    wf_mitchell_poly(a, n, f);
    for (int i = 0; i < count; i++) {
        double s = fabs(v[i]);
        double near = (n[0] + s * (n[1] + s * (n[2] + s * n[3]))) / 6;
        double far = (f[0] + s * (f[1] + s * (f[2] + s * f[3]))) / 6;
        half_u[i] = 0.5;
        height[i] = s < 1 ? near : s < 2 ? far : 0;
    }
}

static void design(PROFILE) {
    const double *step = a->stairs.height;
    int count_v = a->stairs.count;
    (void)tau, (void)q;
    for (int i = 0; i < count; i++) {
        int at = (int)fmin(fabs(v[i]) * WF_STAIRS_STEPS, count_v);
        half_u[i] = a->half_u;
        height[i] = at < count_v ? step[at] : 0;
    }
}

const wf_profile_ops WF_ISA_TABLE(wf_profile_ops) = {
    .of =
        {
            [WF_PROFILE_LINE] = line,
            [WF_PROFILE_BOX] = box,
            [WF_PROFILE_NOTCH] = notch,
            [WF_PROFILE_SHAPED] = shaped,
            [WF_PROFILE_DIAMOND] = diamond,
            [WF_PROFILE_MITCHELL] = mitchell,
            [WF_PROFILE_DESIGN] = design,
        },
};
