#ifndef WF_COLOR_CODES_CHROMA_420_H
#define WF_COLOR_CODES_CHROMA_420_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Chroma of 4:2:0 from that of 4:2:2: half as many rows, each field's from its own lines. */

/* Row `row` of lines / 2 of a plane of chroma whose `lines` rows of `count` codes begin
 * `stride` codes apart. Where fields are woven, the rows of the top field lie a quarter, those
 * of the bottom field three quarters of one of its lines below its line 2k; else amid lines 2k
 * and 2k + 1 (Rec. ITU-T H.264, figures 6-1 and 6-2). The codes are in the interpolating
 * half-band sinc(d / 2) cos^2(pi d / 8), |d| < 4 lines, whose weights add up to one; rows
 * beyond the picture are those of its edge. Codes are rounded and lie from `least` to `most`.
 * `lines` is even, a multiple of four where woven. Pure: any number of threads. */
void wf_chroma_420_row(const uint16_t *rows, size_t stride, int lines, int count, int row,
                       bool woven, int least, int most, uint16_t *to);

#endif
