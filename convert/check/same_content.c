/* Where two frames show the same, in both fields. */
#include "convert/check/same_content.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define SAME 0.01f /* of white: fields of one parity that differ by no more show the same */

/* A line of the raster and the two lines of the other field about it, from which a bob display
 * makes the light of that field here. At the picture's edge both are the only one there is. */
typedef struct line_pair {
    const float *own, *above, *below;
} line_pair;

static line_pair lines_at(const float *light, int width_px, int lines, int y) {
    const float *own = light + (size_t)y * (size_t)width_px;
    ptrdiff_t width = width_px;
    const float *above = y > 0 ? own - width : own + width;
    const float *below = y < lines - 1 ? own + width : own - width;
    return (line_pair){own, above, below};
}

void wf_same_content(const float *light, const float *other, int width_px, int lines, int y,
                     int down, bool *restrict same) {
    if (y + down < 0 || y + down >= lines) {
        memset(same, 0, (size_t)width_px * sizeof *same);
        return;
    }
    line_pair a = lines_at(light, width_px, lines, y);
    line_pair b = lines_at(other, width_px, lines, y + down);
    for (int x = 0; x < width_px; x++) {
        float about_a = 0.5f * (a.above[x] + a.below[x]);
        float about_b = 0.5f * (b.above[x] + b.below[x]);
        /* Both are looked at everywhere, for vectors have no branches. */
        same[x] = (fabsf(a.own[x] - b.own[x]) <= SAME) & (fabsf(about_a - about_b) <= SAME);
    }
}
