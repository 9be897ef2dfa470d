/* What mixers of encoded video are given for what lies over something in light. */
#include "color/codes/key_law.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define GAMMA    2.4
#define HALVINGS 32 /* of the interval 0 .. 1, to less than a float tells apart */

/* One channel of a pixel over all backgrounds. */
typedef struct channel {
    double light, clear; /* A, 1 - alpha */
    double at_0, at_1;   /* t there */
} channel;

static double to_power(double value, double exponent) {
    return copysign(pow(fabs(value), exponent), value);
}

static channel channel_of(double encoded, double clear) {
    double light = to_power(encoded, GAMMA);
    return (channel){light, clear, encoded, to_power(light + clear, 1 / GAMMA)};
}

/* Where t(v) - m v is least. Below black t is not convex: its least is then looked for at the
 * ends alone. */
static double lowest_at(const channel *c, double m) {
    if (c->light <= 0 || m <= 0) return c->at_1 - m < c->at_0;
    double r = pow(m / c->clear, GAMMA / (GAMMA - 1)), rest = 1 - r * c->clear;
    double power = rest > 0 ? r * c->light / rest : 1;
    return power < 1 ? pow(power, 1 / GAMMA) : 1;
}

/* The ends of t(v) - m v over all backgrounds; *falls: its range becomes smaller as m grows. */
static void range_of(const channel *c, double m, double *least, double *most, bool *falls) {
    double at = lowest_at(c, m), end = c->at_1 - m;
    *falls = end > c->at_0;
    *most = *falls ? end : c->at_0;
    *least = to_power(c->light + c->clear * pow(at, GAMMA), 1 / GAMMA) - m * at;
    if (end < *least) *least = end;
    if (c->at_0 < *least) *least = c->at_0;
}

/* Whether the worst of the channels becomes better as m grows. */
static bool wants_more(const channel own[3], double m) {
    double worst = -1;
    bool more = false;
    for (int c = 0; c < 3; c++) {
        double least, most;
        bool falls;
        range_of(&own[c], m, &least, &most, &falls);
        if (most - least <= worst) continue;
        worst = most - least;
        more = falls;
    }
    return more;
}

static double best_slope(const channel own[3]) {
    double low = 0, high = 1;
    for (int i = 0; i < HALVINGS; i++) {
        double m = (low + high) / 2;
        if (wants_more(own, m))
            low = m;
        else
            high = m;
    }
    return (low + high) / 2;
}

static double clamped(double share) {
    return share > 0 ? share < 1 ? share : 1 : 0; /* NaN becomes 0 */
}

/* One pixel in place. */
static void weigh(double rgba[4]) {
    channel own[3];
    for (int c = 0; c < 3; c++) own[c] = channel_of(rgba[c], 1 - rgba[3]);
    double m = best_slope(own);
    for (int c = 0; c < 3; c++) {
        double least, most;
        bool falls;
        range_of(&own[c], m, &least, &most, &falls);
        rgba[c] = (least + most) / 2;
    }
    rgba[3] = 1 - m;
}

static bool is_empty(const double rgba[4]) {
    return rgba[3] == 0 && rgba[0] == 0 && rgba[1] == 0 && rgba[2] == 0;
}

void wf_key_line(wf_key_law law, float *const rgba[4], size_t count) {
    for (size_t i = 0; i < count; i++) {
        double pixel[4];
        for (int c = 0; c < 3; c++) pixel[c] = (double)rgba[c][i];
        pixel[3] = clamped((double)rgba[3][i]);
        if (law == WF_KEY_ENCODED && pixel[3] < 1 && !is_empty(pixel)) weigh(pixel);
        for (int c = 0; c < 4; c++) rgba[c][i] = (float)pixel[c];
    }
}

size_t wf_key_straighten(float *const rgba[4], size_t count) {
    size_t clipped = 0;
    for (size_t i = 0; i < count; i++) {
        bool over = false;
        for (int c = 0; c < 3; c++) {
            float value = rgba[3][i] > 0 ? rgba[c][i] / rgba[3][i] : 0;
            over |= value > 1;
            rgba[c][i] = value > 1 ? 1 : value;
        }
        clipped += over;
    }
    return clipped;
}
