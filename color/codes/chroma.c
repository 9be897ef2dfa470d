/* Chroma along a line: decimation to 4:2:2 and interpolation back. */
#include "color/codes/chroma.h"

#include "color/line/line.h"

#define OF_65536(n) ((n) / 65536.0f)

/* bt601: 39 taps, the equiripple half-band for the edges of Rec. ITU-R BT.601-7's template for
 * 4:2:2 chroma, 2.75 and 4.0 MHz at 13.5 MHz, rounded to 16 bits such that they add up to
 * exactly 1. Flat to 0.0053 dB up to 2.75/13.5 of the luma sampling rate, half at
 * 3.375/13.5, 64.3 dB down from 4.0/13.5 on; the template asks for 0.05 dB and 55 dB.
 * tests/unit/color/test_chroma.c computes them again. */
#define BT601_PAIRS                                                                            \
    {                                                                                          \
        OF_65536(20731), OF_65536(-6567), OF_65536(3559), OF_65536(-2170), OF_65536(1361),     \
            OF_65536(-836), OF_65536(496), OF_65536(-268), OF_65536(134), OF_65536(-56)        \
    }

static const wf_chroma_filter filters[] = {
    [WF_CHROMA_BT601] = {10, true, BT601_PAIRS},
    [WF_CHROMA_LUMA_ADJUST] = {10, true, BT601_PAIRS},
    [WF_CHROMA_121] = {1, true, {0.25f}},
    [WF_CHROMA_BOX] = {1, false, {0.5f}},
};

const wf_chroma_filter *wf_chroma_filter_of(wf_chroma chroma) {
    return chroma == WF_CHROMA_444 ? NULL : &filters[chroma];
}

size_t wf_chroma_scratch(size_t width_px) {
    return width_px / 2 + (width_px / 2 + 2 * WF_CHROMA_PAIRS);
}

/* The index in the line of the sample that stands at `index` of the line continued by
 * reflection. */
static size_t reflected(ptrdiff_t index, size_t width_px) {
    ptrdiff_t last = (ptrdiff_t)width_px - 1;
    while (index < 0 || index > last) index = index < 0 ? -index : 2 * last - index;
    return (size_t)index;
}

/* Fills odd[-1 - j] and odd[count + j], j < WF_CHROMA_PAIRS, which lie beyond the ends of odd.
 */
static void reflect_edges(float *odd, const float *line, size_t width_px) {
    ptrdiff_t count = (ptrdiff_t)(width_px / 2);
    for (ptrdiff_t j = 0; j < WF_CHROMA_PAIRS; j++) {
        odd[-1 - j] = line[reflected(-1 - 2 * j, width_px)];
        odd[count + j] = line[reflected(2 * (count + j) + 1, width_px)];
    }
}

void wf_chroma_decimate(const wf_chroma_filter *filter, float *line, size_t width_px,
                        float *scratch) {
    const wf_line_ops *ops = wf_line_ops_best();
    size_t count = width_px / 2;
    if (!count) return;
    float *even = scratch, *odd = scratch + count + WF_CHROMA_PAIRS;
    ops->deinterleave(even, odd, line, count);
    reflect_edges(odd, line, width_px);
    if (filter->symmetric)
        ops->half_band(line, even, odd, filter->pair, filter->pairs, count);
    else
        for (size_t i = 0; i < count; i++) line[i] = 0.5f * even[i] + filter->pair[0] * odd[i];
}

/* The sample between half[i] and half[i + 1] where taps reach beyond an end of the line. */
static float between_at_edge(const wf_chroma_filter *filter, const float *half, ptrdiff_t i,
                             size_t width_px) {
    float sum = 0;
    for (ptrdiff_t j = 0; j < (ptrdiff_t)filter->pairs; j++)
        sum += filter->pair[j] * (half[reflected(2 * (i - j), width_px) / 2] +
                                  half[reflected(2 * (i + 1 + j), width_px) / 2]);
    return 2 * sum;
}

/* The samples between are made in the second half of `line` and moved from there to their
 * places. The loop of decimation serves, less its middle tap: half of the sample before. */
void wf_chroma_interpolate(const wf_chroma_filter *filter, const float *half, size_t width_px,
                           float *line) {
    ptrdiff_t count = (ptrdiff_t)(width_px / 2), pairs = (ptrdiff_t)filter->pairs;
    ptrdiff_t inner = count - 2 * pairs > 0 ? count - 2 * pairs : 0;
    float *between = line + count;
    for (ptrdiff_t i = 0; i < count; i++)
        if (i < pairs || i >= pairs + inner)
            between[i] = between_at_edge(filter, half, i, width_px);
    if (inner)
        wf_line_ops_best()->half_band(between + pairs, half + pairs, half + pairs + 1,
                                      filter->pair, filter->pairs, (size_t)inner);
    for (ptrdiff_t i = pairs; i < pairs + inner; i++) between[i] = 2 * between[i] - half[i];
    for (ptrdiff_t i = 0; i < count; i++) {
        float odd = between[i];
        line[2 * i] = half[i];
        line[2 * i + 1] = odd;
    }
}
