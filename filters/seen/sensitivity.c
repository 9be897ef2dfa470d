/* The achromatic contrast sensitivity of castleCSF: a sustained and a transient mechanism. */
#include "filters/seen/sensitivity.h"

#include <math.h>

/* A mechanism: its sensitivity by luminance, and a parabola of logarithms that is cut off below
 * the frequency where it is highest. */
typedef struct mechanism {
    double (*peak)(double cd_m2), (*best)(double cd_m2); /* sensitivity; cycles a degree */
    double width; /* 2^width: of the parabola, in squared decades */
    double drop;  /* how much lower it may be below the best frequency */
    double area_degree2, from_cycles_degree; /* of what is summed: A0 and f0 of Rovamo, Luntinen
                                                and Nasanen, 1993 */
} mechanism;

static double rising(double most, double half_cd_m2, double power, double cd_m2) {
    return most * pow(1 + half_cd_m2 / cd_m2, -power);
}

static double sustained_peak(double cd_m2) {
    double blinding = pow(1 + 5.58341e-07 / cd_m2, -9.66862e+09);
    return rising(56.4947, 7.54726, 0.144532, cd_m2) * (1 - blinding);
}

static double sustained_best(double cd_m2) {
    return rising(1.78119, 91.5718, 0.256682, cd_m2);
}

static double transient_peak(double cd_m2) {
    return 2748.09 * pow(cd_m2, 0.193434);
}

static double transient_best(double cd_m2) {
    (void)cd_m2;
    return 0.000316696;
}

static const mechanism sustained = {sustained_peak, sustained_best, 0.000213047,
                                    0.100207,       157.103,        0.702338},
                       transient = {transient_peak, transient_best, 2.6761,
                                    0.000241177,    3.81611,        3.01389};

static double square(double x) {
    return x * x;
}

static double of_grating(const mechanism *m, double f, double cd_m2, double area_degree2) {
    double best = m->best(cd_m2);
    double parabola = pow(10, -square(log10(f / best)) / exp2(m->width));
    if (f < best) parabola = fmax(parabola, 1 - m->drop);
    double summed = m->area_degree2 / (1 + square(f / m->from_cycles_degree));
    return m->peak(cd_m2) * parabola * sqrt(summed / (1 + summed / area_degree2)) * f;
}

double wf_sensitivity(double f, double hz, double cd_m2, double area_degree2) {
    const double power = 0.1898;
    double best_hz = fmax(2.41482 * log10(cd_m2) + 4.7036, 0);
    double slow = exp(-pow(hz, 1.3314) / 10.5795);
    double fast = exp(-square(pow(hz, power) - pow(best_hz, power)) / 0.0844836);
    return slow * of_grating(&sustained, f, cd_m2, area_degree2) +
           fast * of_grating(&transient, f, cd_m2, area_degree2);
}

double wf_sensitivity_disk(double hz, double cd_m2, double radius_degree) {
    enum { STEPS = 64 };
    double best = 0;
    for (int i = 0; i < STEPS; i++) {
        double f = 0.125 * pow(128, i / (STEPS - 1.0)); /* cycles a degree, up to 16 */
        best = fmax(best, wf_sensitivity(f, hz, cd_m2, 2.42437));
    }
    return best * pow(radius_degree, 1 / 3.01142);
}
