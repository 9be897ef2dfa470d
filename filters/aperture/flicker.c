/* Flicker of the still zone plate, by the midpoint rule. */
#include "filters/aperture/flicker.h"

#include <math.h>

#define WIDTH  720
#define HEIGHT 486
#define ASPECT (10.0 / 11)

double wf_flicker_fy(int point) {
    return 0.5 * (point + 0.5) / WF_FLICKER_POINTS;
}

double wf_flicker_fx(int point) {
    return ASPECT * ASPECT * WIDTH / (2.0 * HEIGHT) * (point + 0.5) / WF_FLICKER_POINTS;
}

double wf_flicker(wf_flicker_response *response, const void *user) {
    double sum = 0;
    for (int j = 0; j < WF_FLICKER_POINTS; j++) {
        double fy = wf_flicker_fy(j), bob = sin(M_PI * fy) * sin(M_PI * fy);
        for (int i = 0; i < WF_FLICKER_POINTS; i++) {
            double seen = bob * response(user, wf_flicker_fx(i), fy);
            sum += seen * seen;
        }
    }
    return sqrt(sum / 8) / WF_FLICKER_POINTS;
}

static double still(const void *user, double fx, double fy) {
    return wf_response(user, 0, fx, fy, 0);
}

double wf_aperture_flicker(const wf_aperture *a) {
    return wf_flicker(still, a);
}
