/* The steps of PIZ's wavelet, from the coarsest to the finest. */
#include "convert/read/exr/wavelet.h"

WF_ISA_DISPATCH(wf_wavelet_ops)

/* Every step has half of the columns and half of the lines of the one before; a column or line
 * that is left over takes no part in the steps after. */
size_t wf_wavelet_scratch(size_t width, size_t lines) {
    size_t words = 0;
    for (; width >= 2 && lines >= 2; words += width * lines) width /= 2, lines /= 2;
    return words;
}

void wf_wavelet_undo(const wf_wavelet_ops *ops, uint16_t *plane, size_t width, size_t lines,
                     bool narrow, uint16_t *scratch) {
    struct {
        uint16_t *word;
        size_t stride, width, lines;
    } step[64] = {{plane, width, width, lines}};
    size_t steps = 0;
    for (; step[steps].width >= 2 && step[steps].lines >= 2; steps++) {
        size_t half = step[steps].width / 2, most = step[steps].lines / 2;
        for (size_t y = 0; y < most; y++)
            ops->evens(scratch + y * half, step[steps].word + 2 * y * step[steps].stride, half);
        step[steps + 1].word = scratch;
        step[steps + 1].stride = step[steps + 1].width = half;
        step[steps + 1].lines = most;
        scratch += half * most;
    }
    while (steps--)
        ops->undo(step[steps].word, step[steps].stride, step[steps].width, step[steps].lines,
                  step[steps + 1].word, narrow);
}
