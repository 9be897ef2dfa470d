/* The weights of the bank of low passes, by least squares with none below 0. */
#include "filters/seen/eye.h"

#include <math.h>
#include <stddef.h>

#include "filters/seen/sensitivity.h"

const double wf_eye_width[WF_EYE_BANDS] = {0.6, 1.5, 3.75, 9.4, 23.4};

enum { POINTS = 60, SWEEPS = 4000 };

static double degrees(double tangent) {
    return atan(tangent) * 180 / M_PI;
}

double wf_viewing_lines_degree(const wf_viewing *v) {
    return 1 / degrees(1 / (v->distance_heights * v->lines));
}

double wf_viewing_usual_heights(int lines) {
    return lines > 608 ? 3 : 6;
}

double wf_viewing_usual_white_cd_m2(bool high_dynamic_range) {
    return high_dynamic_range ? 203 : 100;
}

static double picture_degree2(const wf_viewing *v) {
    double half = 0.5 / v->distance_heights;
    double aspect = v->width_px * v->pixel_aspect / v->lines;
    return 4 * degrees(half) * degrees(half * aspect);
}

static double low_pass(int band, double cycles_degree) {
    double r = cycles_degree / wf_eye_width[band];
    return exp(-0.5 * r * r);
}

/* What the bank is to be at a luminance, and each band, over what the bank is to be. */
typedef struct wanted {
    double whole; /* sensitivity to the whole field */
    double sensitivity[POINTS], weight[POINTS], band[POINTS][WF_EYE_BANDS];
} wanted;

/* Frequency 0 counts as much as all others; what is far below the maximum counts less. */
static void want(const wf_viewing *v, double cd_m2, wanted *w) {
    double area = picture_degree2(v), most = 0;
    w->whole = wf_sensitivity_disk(v->hz, cd_m2, sqrt(area / M_PI));
    for (int i = 0; i < POINTS; i++) {
        double f = i ? 0.7 * pow(32 / 0.7, (i - 1) / (POINTS - 2.0)) : 0;
        w->sensitivity[i] = i ? wf_sensitivity(f, v->hz, cd_m2, area) : 0;
        most = fmax(most, w->sensitivity[i]);
        for (int k = 0; k < WF_EYE_BANDS; k++) w->band[i][k] = low_pass(k, f);
    }
    w->whole = w->sensitivity[0] = fmax(w->whole, most);
    for (int i = 0; i < POINTS; i++)
        w->weight[i] = (i ? 1 : 20) / fmax(w->sensitivity[i], 0.01 * most);
}

/* Takes the best value of one weight after the other, until nothing changes any more. */
static void fit(const wanted *w, double x[WF_EYE_BANDS]) {
    double normal[WF_EYE_BANDS][WF_EYE_BANDS] = {{0}}, right[WF_EYE_BANDS] = {0};
    double change = w->whole;
    for (int i = 0; i < POINTS; i++) {
        double weight = w->weight[i] * w->weight[i];
        for (int k = 0; k < WF_EYE_BANDS; k++) {
            right[k] += weight * w->band[i][k] * w->sensitivity[i];
            for (int l = 0; l < WF_EYE_BANDS; l++)
                normal[k][l] += weight * w->band[i][k] * w->band[i][l];
        }
    }
    for (int k = 0; k < WF_EYE_BANDS; k++) x[k] = w->whole / WF_EYE_BANDS;
    for (int sweep = 0; sweep < SWEEPS && change > 1e-7 * w->whole; sweep++) {
        change = 0;
        for (int k = 0; k < WF_EYE_BANDS; k++) {
            double rest = right[k], before = x[k];
            for (int l = 0; l < WF_EYE_BANDS; l++) rest -= l == k ? 0 : normal[k][l] * x[l];
            x[k] = fmax(rest / normal[k][k], 0);
            change += fabs(x[k] - before);
        }
    }
}

/* Below this the eye sees no flicker; it keeps least squares from dividing 0 by 0. */
#define LEAST_SENSITIVITY 1e-30

void wf_eye_init(wf_eye *eye, const wf_viewing *viewing) {
    for (int i = 0; i < WF_EYE_KNOTS; i++) {
        wanted w;
        double x[WF_EYE_BANDS] = {0}, sum = 0;
        double cd_m2 = ldexp(1 + i % 4 / 4.0, WF_EYE_LOW + i / 4);
        want(viewing, cd_m2, &w);
        if (w.whole > LEAST_SENSITIVITY) fit(&w, x);
        for (int k = 0; k < WF_EYE_BANDS; k++) sum += x[k];
        for (int k = 0; k < WF_EYE_BANDS; k++)
            eye->weight[i][k] = sum > 0 ? (float)(x[k] * w.whole / sum) : 0;
    }
}

double wf_eye_sensitivity(const wf_eye *eye, double cycles_degree, double cd_m2) {
    double low = ldexp(1, WF_EYE_LOW), high = ldexp(1, WF_EYE_LOW + WF_EYE_KNOTS / 4), sum = 0;
    int exponent;
    double mantissa = 2 * frexp(fmin(fmax(cd_m2, low), high), &exponent); /* 1 .. 2 */
    double at = 4 * (exponent - 1 - WF_EYE_LOW) + 4 * (mantissa - 1);
    int knot = (int)fmin(at, WF_EYE_KNOTS - 2);
    for (int k = 0; k < WF_EYE_BANDS; k++) {
        double a = (double)eye->weight[knot][k], b = (double)eye->weight[knot + 1][k];
        sum += (a + (at - knot) * (b - a)) * low_pass(k, cycles_degree);
    }
    return sum;
}
