/* Brings chroma of any siting to every luma sample of an axis. */
#include "color/codes/upsample.h"

#include "color/codes/chroma.h"

WF_ISA_DISPATCH(wf_upsample_ops)

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

/* Keeps the taps of chroma samples first to last; the sums meet at sample 0. */
static void keep_taps(wf_upsample_phase *phase, const double *tap, int first, int last) {
    *phase = (wf_upsample_phase){.first = first - MIDDLE, .count = last - first + 1};
    if (phase->count > 1) phase->middle = MIDDLE - first;
    for (int i = 0; i < phase->count; i++) {
        phase->tap[i] = (float)tap[first + i];
        phase->fine_tap[i] = tap[first + i];
    }
}

static void find_ends(const double *tap, int *first, int *last) {
    *first = 0;
    *last = WF_UPSAMPLE_MOST_TAPS - 1;
    while (tap[*first] == 0) ++*first;
    while (tap[*last] == 0) --*last;
}

static int larger(int a, int b) {
    return a > b ? a : b;
}

static int lesser(int a, int b) {
    return a < b ? a : b;
}

static void match_ends(int first[2], int last[2]) {
    if (first[0] == last[0] || first[1] == last[1]) return;
    first[0] = first[1] = lesser(first[0], first[1]);
    last[0] = last[1] = larger(last[0], last[1]);
}

void wf_upsampler_init(wf_upsampler *u, int factor, bool center) {
    double tap[WF_UPSAMPLE_MOST_FACTOR][WF_UPSAMPLE_MOST_TAPS] = {{0}};
    int first[WF_UPSAMPLE_MOST_FACTOR], last[WF_UPSAMPLE_MOST_FACTOR];
    *u = (wf_upsampler){.factor = factor, .center = center && factor > 1};
    /* The first chroma sample lies (factor - 1) / 2 luma samples after the first, if amid. */
    for (int p = 0; p < factor; p++) {
        add_taps(tap[p], 2 * p - (u->center ? factor - 1 : 0), 2 * factor, 1);
        find_ends(tap[p], &first[p], &last[p]);
    }
    if (factor == 2) match_ends(first, last);
    for (int p = 0; p < factor; p++) {
        keep_taps(&u->phase[p], tap[p], first[p], last[p]);
        u->before = larger(u->before, MIDDLE - first[p]);
        u->after = larger(u->after, last[p] - MIDDLE);
    }
}

bool wf_upsample_pairs(const wf_upsampler *u) {
    return u->factor == 2 && u->phase[0].count > 1 && u->phase[1].count > 1;
}

/* ---- Lines ---- */

int wf_upsample_reflected(const wf_upsampler *u, int index, int count, int luma) {
    bool at_first = !u->center, at_last = at_first && u->factor * (count - 1) == luma - 1;
    if (count == 1) return 0;
    while (index < 0 || index >= count)
        index = index < 0 ? -index - !at_first : 2 * count - 1 - index - at_last;
    return index;
}

static void reflect_ends(const wf_upsampler *u, float *chroma, int count, int luma) {
    for (int i = 1; i <= u->before; i++)
        chroma[-i] = chroma[wf_upsample_reflected(u, -i, count, luma)];
    for (int i = count; i < count + u->after; i++)
        chroma[i] = chroma[wf_upsample_reflected(u, i, count, luma)];
}

/* The samples of one phase, of which there are count or one less: what they are made of, if
 * they are there. */
static const float *phase_samples(const wf_upsampler *u, const wf_signal_loops *loops, int p,
                                  const float *chroma, int count, float *spare) {
    const wf_upsample_phase *phase = &u->phase[p];
    if (phase->count == 1) return chroma + phase->first;
    loops->weigh(spare, chroma, 1, phase, (size_t)count);
    return spare;
}

static void fill_pairs(const wf_upsampler *u, const wf_signal_loops *loops, const float *chroma,
                       float *spare, float *line, int luma) {
    int pairs = luma / 2;
    float *out[2] = {spare, spare + luma - pairs};
    const float *even = out[0], *odd = out[1];
    if (wf_upsample_pairs(u)) {
        loops->weigh_pair(out, chroma, 1, u->phase, (size_t)pairs);
        if (luma % 2) loops->weigh(out[0] + pairs, chroma + pairs, 1, &u->phase[0], 1);
    } else {
        even = phase_samples(u, loops, 0, chroma, luma - pairs, out[0]);
        odd = phase_samples(u, loops, 1, chroma, pairs, out[1]);
    }
    wf_upsample_ops_best()->interleave(line, even, odd, (size_t)pairs);
    if (luma % 2) line[luma - 1] = even[pairs];
}

void wf_upsample_line(const wf_upsampler *u, const wf_signal_loops *loops, float *chroma,
                      int count, float *spare, float *line, int luma) {
    reflect_ends(u, chroma, count, luma);
    if (u->factor == 2) {
        fill_pairs(u, loops, chroma, spare, line, luma);
        return;
    }
    for (int p = 0; p < u->factor && p < luma; p++) {
        int samples = (luma - p + u->factor - 1) / u->factor;
        const float *from = phase_samples(u, loops, p, chroma, samples, spare);
        for (int i = 0; i < samples; i++) line[i * u->factor + p] = from[i];
    }
}
