#ifndef WF_CONVERT_CHECK_SAME_CONTENT_H
#define WF_CONVERT_CHECK_SAME_CONTENT_H

#include <stdbool.h>

/* Where two frames show the same. */

/* Fills same[width_px] of line y: whether the pixel, and the mean of those above and below it,
 * are within 1 % of white of the other frame's, `down` lines lower. Light is [lines][width_px];
 * beyond the picture nothing is the same. */
void wf_same_content(const float *light, const float *other, int width_px, int lines, int y,
                     int down, bool *same);

#endif
