/* Blocks of the picture vote on the order of its fields.
 *
 * The two fields of a frame are one step apart in either order. In the true order so are a
 * field and the next frame's, and in the false one these are three steps apart. So a block
 * whose nearer distance tells the truth has a distance within frames that is like it; if that
 * is like the farther one, what moves has come back to where something like it was, and its
 * vote does not count. */
#include "convert/check/order_votes.h"

#include <math.h>
#include <stdlib.h>

#define BLOCKS_DOWN 18
#define BLOCK_LEAST 16
#define PAIRS       25   /* of frames, after which the blocks vote */
#define CLEAR       0.8  /* a vote's nearer distance is less than this times the farther one */
#define ACTIVE      0.02 /* of the mean of all blocks: those that move less do not vote */

struct wf_order_votes {
    int block_px, across, down, pairs;
    wf_order_count count;
    wf_distances of[]; /* [down][across] */
};

wf_order_votes *wf_order_votes_new(int width_px, int lines) {
    int block = (lines + BLOCKS_DOWN - 1) / BLOCKS_DOWN;
    if (block < BLOCK_LEAST) block = BLOCK_LEAST;
    int across = (width_px + block - 1) / block, down = (lines + block - 1) / block;
    wf_order_votes *v =
        calloc(1, sizeof *v + (size_t)across * (size_t)down * sizeof(wf_distances));
    if (!v) return NULL;
    v->block_px = block;
    v->across = across;
    v->down = down;
    return v;
}

void wf_order_votes_free(wf_order_votes *votes) {
    free(votes);
}

int wf_order_block_px(const wf_order_votes *votes) {
    return votes->block_px;
}

void wf_order_votes_add(wf_order_votes *v, int x, int y, const wf_distances *d) {
    wf_distances *block = &v->of[y / v->block_px * v->across + x / v->block_px];
    block->within += d->within;
    block->bottom_top += d->bottom_top;
    block->top_bottom += d->top_bottom;
}

static double sum_of(const wf_distances *d) {
    return d->bottom_top + d->top_bottom;
}

static void vote(wf_order_votes *v, const wf_distances *d) {
    double nearer = fmin(d->bottom_top, d->top_bottom);
    double farther = fmax(d->bottom_top, d->top_bottom);
    if (nearer >= CLEAR * farther) return;
    /* Within is nearer to the farther distance, in ratios. */
    if (d->within * d->within > nearer * farther) return;
    if (d->bottom_top < d->top_bottom)
        v->count.top += farther - nearer;
    else
        v->count.bottom += farther - nearer;
}

static void vote_all(wf_order_votes *v) {
    size_t count = (size_t)v->across * (size_t)v->down;
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += sum_of(&v->of[i]);
    for (size_t i = 0; i < count; i++) {
        if (sum_of(&v->of[i]) > ACTIVE * sum / (double)count) vote(v, &v->of[i]);
        v->of[i] = (wf_distances){0, 0, 0};
    }
    v->count.all += sum;
    v->pairs = 0;
}

void wf_order_votes_pair(wf_order_votes *v) {
    if (++v->pairs == PAIRS) vote_all(v);
}

wf_order_count wf_order_votes_count(wf_order_votes *v) {
    if (v->pairs) vote_all(v);
    return v->count;
}
