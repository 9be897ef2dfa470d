#ifndef WF_CONVERT_READ_EXR_WAVELET_H
#define WF_CONVERT_READ_EXR_WAVELET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "filters/base/isa.h"

/* PIZ's wavelet: pairs of words became their mean and their difference, along lines and down
 * columns, and of every four results the mean of all went through that again. */

/* One table for each instruction set; all give the same words. */
typedef struct wf_wavelet_ops {
    /* Undoes one step: every 2x2 words of `high` become what they were, where `mean`
     * [lines / 2][width / 2] holds what belongs at the even columns of even lines. What is left
     * of an odd width or number of lines was paired in one direction alone. Arithmetic is
     * modulo 2^16. narrow: words were under 2^14, and differences are of numbers with signs. */
    void (*undo)(uint16_t *high, size_t stride, size_t width, size_t lines,
                 const uint16_t *mean, bool narrow);
    /* Every other word of `count` pairs. */
    void (*evens)(uint16_t *to, const uint16_t *from, size_t count);
    /* word[i] = table[from[i]]. */
    void (*look_up)(uint8_t *to, const uint16_t *from, const uint16_t *table, size_t count);
} wf_wavelet_ops;

WF_ISA_DECLARE(wf_wavelet_ops);

/* How many words wf_wavelet_undo needs besides the plane. */
size_t wf_wavelet_scratch(size_t width, size_t lines);

/* Undoes all steps of a plane [lines][width]. */
void wf_wavelet_undo(const wf_wavelet_ops *ops, uint16_t *plane, size_t width, size_t lines,
                     bool narrow, uint16_t *scratch);

#endif
