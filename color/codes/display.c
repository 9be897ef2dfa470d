/* From R'G'B' to the light that a display makes of it. */
#include "color/codes/display.h"

#include <math.h>

#include "color/line/line.h"

#define GAMMA 2.4 /* BT.1886 */

static double bt1886_light(double signal) {
    return pow(signal, GAMMA);
}

/* BT.2100 table 4: cd/m2 over reference white's. */
static double pq_light(double signal) {
    const double m1 = 2610.0 / 16384, m2 = 2523.0 / 32, c1 = 3424.0 / 4096, c2 = 2413.0 / 128,
                 c3 = 2392.0 / 128;
    double e = pow(fmin(signal, 1), 1 / m2);
    return 10000 / 203.0 * pow(fmax(e - c1, 0) / (c2 - c3 * e), 1 / m1);
}

/* BT.2100 table 5: scene light, 0 to 1, and the display's gamma. */
static double hlg_scene(double signal) {
    const double a = 0.17883277, b = 1 - 4 * a, c = 0.5 - a * log(4 * a);
    return signal <= 0.5 ? signal * signal / 3 : (exp((signal - c) / a) + b) / 12;
}

static double hlg_light(double signal) {
    return pow(hlg_scene(signal) / hlg_scene(0.75), 1.2);
}

void wf_display_init(wf_display *display, wf_primaries primaries, wf_transfer transfer) {
    static double (*const light[])(double) = {[WF_TRANSFER_BT1886] = bt1886_light,
                                              [WF_TRANSFER_PQ] = pq_light,
                                              [WF_TRANSFER_HLG] = hlg_light};
    double xyz[3][3];
    wf_rgb_to_xyz(primaries, xyz);
    display->transfer = transfer;
    for (int c = 0; c < 3; c++) display->weight[c] = (float)xyz[1][c];
    for (int i = 0; i < WF_DISPLAY_STEPS + 2; i++)
        display->light[i] =
            (float)light[transfer]((double)WF_DISPLAY_END * i / WF_DISPLAY_STEPS);
}

/* Beyond the table: the curve of BT.1886 goes on, the others have ended. */
static float light_beyond(const wf_display *d, float signal, float *slope) {
    bool ended = d->transfer != WF_TRANSFER_BT1886 || signal > WF_MOST_SIGNAL;
    float at = fminf(signal, WF_MOST_SIGNAL);
    float light =
        d->transfer == WF_TRANSFER_BT1886 ? powf(at, (float)GAMMA) : d->light[WF_DISPLAY_STEPS];
    *slope = ended ? 0 : (float)GAMMA * light / at;
    return light;
}

float wf_display_light(const wf_display *d, float signal, float *slope) {
    const float scale = WF_DISPLAY_STEPS / WF_DISPLAY_END;
    *slope = 0;
    if (!(signal > 0)) return 0;
    if (signal >= WF_DISPLAY_END) return light_beyond(d, signal, slope);
    float at = signal * scale;
    int i = (int)at;
    float step = d->light[i + 1] - d->light[i];
    *slope = step * scale;
    return d->light[i] + (at - (float)i) * step;
}

void wf_display_luminance(const wf_display *display, const float *const rgb[3], float *light,
                          size_t count) {
    for (size_t i = 0; i < count; i++) {
        float sum = 0, slope;
        for (int c = 0; c < 3; c++)
            sum += display->weight[c] * wf_display_light(display, rgb[c][i], &slope);
        light[i] = sum;
    }
}
