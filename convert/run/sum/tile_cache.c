/* Sums of one band of rows, and the cache of those of tiles in which nothing moves. */
#include "convert/run/sum/tile_cache.h"

#include <stdlib.h>

/* ---- The cache ---- */

bool wf_tile_cache_new(int tiles, int slots, wf_tile_cache *cache) {
    *cache = (wf_tile_cache){.tiles = tiles, .slots = slots};
    cache->sums = calloc((size_t)tiles * (size_t)slots + 1, sizeof(wf_gather *));
    return cache->sums;
}

void wf_tile_cache_free(wf_tile_cache *cache) {
    for (int n = 0; cache->sums && n < cache->tiles * cache->slots; n++)
        wf_gather_free(cache->sums[n]);
    free(cache->sums);
    *cache = (wf_tile_cache){0};
}

static wf_gather **kept_for(const wf_band_sums *s, const wf_taker *taker) {
    const wf_tile_cache *cache = s->taking->cache;
    return cache ? &cache->sums[s->tile.index * cache->slots + taker->slot] : NULL;
}

/* ---- Life ---- */

bool wf_band_sums_new(const wf_taking *taking, int first_row, int end_row, wf_band_sums *s) {
    size_t count = (size_t)taking->count;
    *s = (wf_band_sums){.taking = taking};
    s->sums = calloc(count + 1, sizeof(wf_gather *));
    s->patch = calloc(count + 1, sizeof(wf_gather *));
    bool good = s->sums && s->patch;
    for (size_t n = 0; good && n < count; n++) {
        const wf_taker *t = &taking->takers[n];
        int first, end;
        if (!t->waits) continue;
        wf_gather_lines(taking->desc, t->field, first_row, end_row, &first, &end);
        s->sums[n] = wf_gather_new(taking->desc, t->field, first, end);
        good = s->sums[n];
    }
    return good;
}

void wf_band_sums_free(wf_band_sums *s) {
    for (int n = 0; s->taking && n < s->taking->count; n++) {
        if (s->sums) wf_gather_free(s->sums[n]);
        if (s->patch) wf_gather_free(s->patch[n]);
    }
    free(s->sums);
    free(s->patch);
    *s = (wf_band_sums){0};
}

/* ---- Still tiles ---- */

/* Whether what is kept of a tile is all that the fields in flight need; it is added to them. */
static bool take_kept(wf_band_sums *s) {
    const wf_taking *all = s->taking;
    for (int n = 0; n < all->count; n++)
        if (all->takers[n].waits && (!all->cache || !*kept_for(s, &all->takers[n])))
            return false;
    for (int n = 0; n < all->count; n++)
        if (all->takers[n].waits) wf_gather_merge(s->sums[n], *kept_for(s, &all->takers[n]));
    s->reused++;
    return true;
}

static bool serves(const wf_sample_tile *tile, const wf_taker *taker) {
    return tile->both || taker->shift == 0;
}

static void open_patches(wf_band_sums *s) {
    const double x[2] = {s->tile.left, s->tile.right}, y[2] = {s->tile.first, s->tile.end};
    for (int n = 0; n < s->taking->count; n++) {
        const wf_taker *t = &s->taking->takers[n];
        if (t->like != n || !serves(&s->tile, t)) continue;
        wf_patch where = wf_gather_patch(s->taking->desc, t->field, x, y);
        s->patch[n] = wf_gather_new_patch(s->taking->desc, t->field, where);
        s->failed |= !s->patch[n];
    }
}

/* Adds the tile in hand, if it is still, to the fields, and keeps it in the cache. */
static void put_away(wf_band_sums *s) {
    if (!s->still) return;
    for (int n = 0; n < s->taking->count; n++) {
        const wf_gather *patch = s->patch[s->taking->takers[n].like];
        if (s->sums[n] && patch) wf_gather_merge(s->sums[n], patch);
    }
    for (int n = 0; n < s->taking->count; n++) {
        wf_gather **kept = kept_for(s, &s->taking->takers[n]);
        if (!s->patch[n]) continue;
        if (kept && !*kept)
            *kept = s->patch[n];
        else
            wf_gather_free(s->patch[n]);
        s->patch[n] = NULL;
    }
    s->still = false;
}

/* ---- Receiving ---- */

static void add(const wf_taker *taker, wf_gather *sums, const wf_samples *samples) {
    wf_samples shifted = *samples;
    shifted.field += taker->shift;
    if (sums) wf_gather_add(sums, &shifted);
}

static void receive(void *user, const wf_samples *samples) {
    wf_band_sums *s = user;
    for (int n = 0; n < s->taking->count; n++)
        add(&s->taking->takers[n], s->still ? s->patch[n] : s->sums[n], samples);
}

static void fill(const wf_band_sums *s, const wf_sample_tile *tile) {
    for (int n = 0; n < s->taking->count; n++)
        if (s->sums[n]) wf_gather_fill(s->sums[n], tile, tile->all);
}

static bool begin_tile(void *user, const wf_sample_tile *tile) {
    wf_band_sums *s = user;
    put_away(s);
    s->tile = *tile;
    if (tile->all) {
        fill(s, tile);
        return false;
    }
    if (tile->still && take_kept(s)) return false;
    s->still = tile->still;
    if (s->still) open_patches(s);
    return !s->failed;
}

wf_receiver wf_band_sums_receiver(wf_band_sums *s) {
    return (wf_receiver){s, receive, begin_tile};
}

bool wf_band_sums_end(wf_band_sums *s) {
    put_away(s);
    return !s->failed;
}
