#ifndef WF_TRACER_SAMPLE_ADAPTIVE_POINTS_H
#define WF_TRACER_SAMPLE_ADAPTIVE_POINTS_H

#include "tracer/sample/adaptive_cells.h"

/* Gives every cell in question as many samples as it is to have, which is more than it has, and
 * adds their light to its sums. False: no memory. */
bool wf_points_draw(wf_adaptive *a);

/* Forgets the samples of rare cells: their next ones are of another set. */
#define WF_SECOND_SET 2
void wf_points_drop_rare(wf_adaptive *a);

/* Adds up all cells' samples again, once edges were found or forgotten. */
void wf_points_add_again(wf_adaptive *a);

/* Hands over all samples, those of each cell with the weight 1 together; of cells with edges
 * only what these do not say, which has no weight. False: no memory. */
bool wf_points_emit(const wf_adaptive *a);

void wf_points_free(wf_adaptive_samples *samples);

/* Makes space for so many more. False: no memory. */
bool wf_points_reserve(wf_adaptive_samples *samples, size_t more);

/* How uncertain the share of a cell is that so many scattered points tell; squared, as measured
 * on random edges. */
static inline double wf_points_share_error(double points) {
    return 0.1 / (points * sqrt(points));
}

/* Adds a sample at a place in a cell, 0..1 each in x, y and the window, for which there is
 * space; returns its number. Light and weight are yet to come. */
size_t wf_points_place(const wf_adaptive *a, wf_adaptive_samples *to, int at,
                       const double p[3]);

/* So many places in a cell that lie evenly, in x, y and time; [3][count or more]. */
void wf_points_even(const wf_adaptive *a, int at, int count, float *const places[3]);

/* Hands samples to the receiver, each with its weight. */
void wf_points_hand_over(const wf_adaptive *a, const wf_adaptive_samples *samples);

#endif
