#ifndef WF_CONVERT_RUN_SUM_GATHERING_H
#define WF_CONVERT_RUN_SUM_GATHERING_H

#include <stdatomic.h>

#include "convert/run/sum/flow.h"
#include "convert/run/sum/tile_cache.h"
#include "filters/gather/samples.h"

/* Fields summed from samples: a unit of time is turned to, and its samples are handed over band
 * by band of frame rows. */

/* How a source's samples are read. */
typedef struct wf_sample_reading {
    /* Turns to a unit; an absent one is an error or has no samples. By one thread. */
    weft_status (*turn)(wf_run *run, int64_t unit, weft_error *err);
    /* Hands over the unit's samples of rows first <= j < end, with the worker's own buffers. */
    weft_status (*band)(wf_run *run, const wf_worker *worker, int first, int end,
                        const wf_receiver *receiver, weft_error *err);

    /* Of a source that hands its samples over in tiles, others leave these NULL: how the raster
     * is cut; whether fields that need the unit see nothing move; and whether a field sees a
     * unit from its beginning to its end, and one moment of it as well as another. */
    wf_sample_tiling (*tiling)(const wf_run *run);
    bool (*still)(const wf_run *run);
    bool (*whole)(const wf_run *run, int64_t field, int64_t unit);
} wf_sample_reading;

extern const wf_summing wf_summing_samples;

/* ---- Between the files of gathering ---- */

/* Rows that one thread gathers into sums of its own. Sums are added to the fields' in the order
 * of the bands, so that the bits do not depend on the threads. */
enum { WF_GATHER_ROWS = 16 };

/* A field that gathers samples. */
typedef struct wf_gathered {
    wf_gather *sums;
    bool still;   /* it sees nothing move: others of its parity look the same */
    bool follows; /* one of them, before it, gathers for both */
    bool kept;    /* and has: the sums are borrowed */
} wf_gathered;

/* run->sums. */
typedef struct wf_gathering {
    wf_gather_desc desc;
    wf_sample_tiling tiling; /* count 0: not in tiles */
    wf_gathered *flight;     /* fields flight_first on, flight_most at most */
    int64_t flight_first;
    int flight_count, flight_most;
    _Atomic int64_t filled; /* pixels that no sample reached: --on-empty nearest */

    /* What is still is kept: whole fields, one of each parity, and tiles. */
    bool keeps;
    int *way; /* [units of a field, from its last]: those of one number it sees alike; of a
                 source with tiles */
    int ways;
    wf_gather *kept[2];
    wf_tile_cache cache;
    wf_taker *takers; /* [most_takers] of the unit in hand */
    int taker_count, most_takers;
    int64_t tiles_reused, fields_reused; /* that were still and had been gathered before */
} wf_gathering;

/* wf_summing's add. (gathering_bands.c) */
weft_status wf_gathering_add(wf_run *run, const wf_units *units, weft_error *err);

#endif
