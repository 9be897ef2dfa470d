#ifndef WF_CONVERT_RUN_SUM_TILE_CACHE_H
#define WF_CONVERT_RUN_SUM_TILE_CACHE_H

#include "filters/gather/samples.h"

/* Sums that the samples of one unit of time and one band of rows add to fields. What is still
 * is summed tile by tile, and kept for fields that will see it again. */

/* A field that takes a unit's samples. Fields that see a unit alike share a slot of the cache.
 */
typedef struct wf_taker {
    int64_t field, shift; /* it takes them as samples of a field so much later */
    int slot;             /* of the cache: the way in which it sees the unit */
    int like;             /* the number of the first taker with this slot */
    bool waits;           /* it is in flight; for others what is still is only kept */
} wf_taker;

/* Sums of tiles that are still, [tile][slot]. Any number of threads, each at other tiles. */
typedef struct wf_tile_cache {
    int tiles, slots;
    wf_gather **sums;
} wf_tile_cache;

bool wf_tile_cache_new(int tiles, int slots, wf_tile_cache *cache); /* false: no memory */
void wf_tile_cache_free(wf_tile_cache *cache);

/* Samples of one unit: who takes them, and the cache, or NULL. Borrowed. */
typedef struct wf_taking {
    const wf_gather_desc *desc;
    const wf_taker *takers;
    int count;
    wf_tile_cache *cache;
} wf_taking;

/* What one unit adds in one band of rows; one thread. */
typedef struct wf_band_sums {
    const wf_taking *taking;
    wf_gather **sums;  /* [takers]; NULL for those that do not wait */
    wf_gather **patch; /* [takers] of the tile in hand; NULL where `like` is another */
    wf_sample_tile tile;
    bool still, failed; /* the tile in hand is still; memory ran out */
    int64_t reused;     /* tiles whose sums were in the cache */
} wf_band_sums;

/* Rows first <= j < end. False: no memory; free it all the same. */
bool wf_band_sums_new(const wf_taking *taking, int first, int end, wf_band_sums *band);
void wf_band_sums_free(wf_band_sums *band);

/* What samples are handed to, until wf_band_sums_end. */
wf_receiver wf_band_sums_receiver(wf_band_sums *band);
/* False: no memory, and samples were lost. */
bool wf_band_sums_end(wf_band_sums *band);

#endif
