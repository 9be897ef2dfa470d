#ifndef WF_CONVERT_CHECK_ORDER_VOTES_H
#define WF_CONVERT_CHECK_ORDER_VOTES_H

#include <stdbool.h>

/* Votes on the order of fields, by blocks of the picture: one moving thing that repeats itself,
 * such as the spokes of a wheel, is not to outvote what is about it. */

/* Distances between fields, summed over pixels that move: within a frame, between its two
 * fields; from a bottom field to the next frame's top field, which follows it where top
 * is first; and from a top field to the next frame's bottom field. */
typedef struct wf_distances {
    double within, bottom_top, top_bottom;
} wf_distances;

typedef struct wf_order_votes wf_order_votes;

/* For pictures of this size. NULL: no memory. */
wf_order_votes *wf_order_votes_new(int width_px, int lines);
void wf_order_votes_free(wf_order_votes *votes); /* NULL is fine */

int wf_order_block_px(const wf_order_votes *votes); /* how wide and high a block is */

/* Adds distances of pixels about (x, y). */
void wf_order_votes_add(wf_order_votes *votes, int x, int y, const wf_distances *d);

/* After each pair of frames: every second, about, the blocks vote. */
void wf_order_votes_pair(wf_order_votes *votes);

/* All votes so far: by how much nearer the one order is, and the other; and the sum of all
 * distances between fields of two frames. */
typedef struct wf_order_count {
    double top, bottom, all;
} wf_order_count;
wf_order_count wf_order_votes_count(wf_order_votes *votes);

#endif
