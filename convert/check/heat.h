#ifndef WF_CONVERT_CHECK_HEAT_H
#define WF_CONVERT_CHECK_HEAT_H

#include <stdbool.h>
#include <stddef.h>

/* The RMS of what is measured at each pixel, over frames. Start with {0}, which takes nothing.
 */
typedef struct wf_heat {
    size_t samples;
    float *square;  /* sums; NULL: not wanted */
    unsigned *seen; /* how many each is the sum of */
} wf_heat;

bool wf_heat_init(wf_heat *heat, size_t samples); /* false: no memory */
void wf_heat_free(wf_heat *heat);
void wf_heat_add(wf_heat *heat, size_t at, float value);

/* The map, [samples], 0 where nothing was added; the caller's to free. NULL if not wanted. */
float *wf_heat_take(wf_heat *heat);

/* The value to draw in the strongest color, where so much is hardly exceeded: it, rounded up to
 * a round number. */
double wf_heat_top(double value);

#endif
