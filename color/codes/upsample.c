/* Brings chroma of any siting to every luma sample of an axis. */
#include "color/codes/upsample.h"

#include <string.h>

#include "color/codes/chroma.h"

/* ---- Taps ---- */

#define MIDDLE (WF_UPSAMPLE_MOST_TAPS / 2) /* where tap[] has chroma sample 0 */

/* Adds the taps that make the value at at / parts chroma steps, parts being 1, 2, 4 or 8: a
 * point that is new at this fineness is the half-band's sum of those that are not. */
static void add_taps(double *tap, int at, int parts, double share) {
    const wf_chroma_filter *filter = wf_chroma_filter_of(WF_CHROMA_BT601);
    while (parts > 1 && at % 2 == 0) at /= 2, parts /= 2;
    if (parts == 1) {
        tap[MIDDLE + at] += share;
        return;
    }
    for (int j = 0; j < (int)filter->pairs; j++)
        for (int side = -1; side <= 1; side += 2)
            add_taps(tap, at + side * (1 + 2 * j), parts, 2 * (double)filter->pair[j] * share);
}

static void init_phase(wf_upsample_phase *phase, int at, int parts) {
    double tap[WF_UPSAMPLE_MOST_TAPS] = {0};
    int first = 0, last = WF_UPSAMPLE_MOST_TAPS - 1;
    add_taps(tap, at, parts, 1);
    while (tap[first] == 0) first++;
    while (tap[last] == 0) last--;
    *phase = (wf_upsample_phase){.first = first - MIDDLE, .count = last - first + 1};
    memcpy(phase->tap, tap + first, (size_t)phase->count * sizeof *tap);
}

void wf_upsampler_init(wf_upsampler *u, int factor, bool center) {
    *u = (wf_upsampler){.factor = factor, .center = center && factor > 1};
    /* The first chroma sample lies (factor - 1) / 2 luma samples after the first, if amid. */
    for (int p = 0; p < factor; p++)
        init_phase(&u->phase[p], 2 * p - (u->center ? factor - 1 : 0), 2 * factor);
}

/* ---- Lines ---- */

int wf_upsample_reflected(const wf_upsampler *u, int index, int count, int luma) {
    bool at_first = !u->center, at_last = at_first && u->factor * (count - 1) == luma - 1;
    if (count == 1) return 0;
    while (index < 0 || index >= count)
        index = index < 0 ? -index - !at_first : 2 * count - 1 - index - at_last;
    return index;
}

/* Several sums side by side, so that they can be vectors. */
enum { BESIDE = 8 };

static void fill_phase(const wf_upsampler *u, int p, const double *chroma, int count,
                       double *line) {
    const wf_upsample_phase *phase = &u->phase[p];
    for (int j = 0; j < count; j += BESIDE) {
        const double *from = chroma + j + phase->first;
        double sum[BESIDE] = {0};
        for (int i = 0; i < phase->count; i++)
            for (int b = 0; b < BESIDE; b++) sum[b] += phase->tap[i] * from[i + b];
        for (int b = 0; b < BESIDE && j + b < count; b++)
            line[(j + b) * u->factor + p] = sum[b];
    }
}

void wf_upsample_line(const wf_upsampler *u, double *chroma, int count, double *line,
                      int luma) {
    for (int i = 1; i <= WF_UPSAMPLE_MARGIN; i++) {
        chroma[-i] = chroma[wf_upsample_reflected(u, -i, count, luma)];
        chroma[count - 1 + i] = chroma[wf_upsample_reflected(u, count - 1 + i, count, luma)];
    }
    for (int p = 0; p < u->factor && p < luma; p++)
        fill_phase(u, p, chroma, (luma - p + u->factor - 1) / u->factor, line);
}
