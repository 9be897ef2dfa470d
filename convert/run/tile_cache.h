#ifndef WF_CONVERT_RUN_TILE_CACHE_H
#define WF_CONVERT_RUN_TILE_CACHE_H

#include "filters/gather/samples.h"

/* Sums that the samples of one unit of time and one band of rows add to fields. What is still
 * is summed tile by tile, and kept for fields that will see it again. */

/* A field that takes a unit's samples. */
typedef struct wf_taker {
    int64_t field, shift; /* it takes them as samples of a field so much later */
    int slot;             /* in which of the ways that there are fields see this unit */
    int like;             /* the first taker of this slot */
    bool waits;           /* is in flight; others only have what is still kept for them */
} wf_taker;

/* Sums of tiles that are still, [tile][slot]. Any number of threads, each at other tiles. */
typedef struct wf_tile_cache {
    int tiles, slots;
    wf_gather **sums;
} wf_tile_cache;

bool wf_tile_cache_new(int tiles, int slots, wf_tile_cache *shelf); /* false: no memory */
void wf_tile_cache_free(wf_tile_cache *shelf);

/* Samples of one unit: who takes them, and the shelf, or NULL. Borrowed. */
typedef struct wf_taking {
    const wf_gather_desc *desc;
    const wf_taker *takers;
    int count;
    wf_tile_cache *shelf;
} wf_taking;

/* The sums of one band; one thread. */
typedef struct wf_strips {
    const wf_taking *taking;
    wf_gather **sums;  /* [takers]; NULL for those that do not wait */
    wf_gather **patch; /* [takers]: the tile in hand; where like is another, NULL */
    wf_sample_tile tile;
    bool still, failed;
    int64_t reused;
} wf_strips;

/* Rows first <= j < end. False: no memory; free it all the same. */
bool wf_strips_new(const wf_taking *taking, int first, int end, wf_strips *strips);
void wf_strips_free(wf_strips *strips);

/* Hands samples to the strips, until wf_strips_end. */
wf_receiver wf_strips_receiver(wf_strips *strips);
/* False: no memory, and samples were lost. */
bool wf_strips_end(wf_strips *strips);

#endif
