#ifndef WF_TRACER_SAMPLE_SAMPLING_INSIDE_H
#define WF_TRACER_SAMPLE_SAMPLING_INSIDE_H

#include <math.h>

#include "tracer/sample/sampling.h"

/* What a sampling and its scratch are made of, for the files that draw samples. */

/* Tiles of cells: what can be seen in one is looked for once. */
#define TILE_WIDTH  16
#define TILE_HEIGHT 8

/* Adaptive samples of a cell come in quarters, each of at most so many. */
#define WF_QUARTERS  4
#define WF_MOST_EACH (WF_MOST_SAMPLES / WF_QUARTERS)

/* Samples that are kept until it is known what weight they have. Arrays of [capacity]. */
typedef struct wf_adaptive_samples {
    float *x, *y, *t; /* as in wf_samples */
    float *fraction;  /* when in the window, 0..1 */
    float *rgb[3];    /* once they are traced */
    float *weight;    /* once they are to be handed over */
    int *cell;        /* cell * WF_QUARTERS + quarter of the cell's samples */
    size_t count, capacity;
} wf_adaptive_samples;

struct wf_sampling {
    wf_sampling_desc desc;
    wf_tracer *tracer;
    wf_sampler *sampler;
    wf_raster raster;
    double tau, skew, anchor;
    bool periods;  /* units are field periods */
    bool instants; /* each line has an instant of its own */
    int64_t unit, field;
    bool still;               /* nothing seen moves in the unit */
    bool nothing;             /* but background is seen */
    double start;             /* of the unit's window, field periods from the field's instant */
    wf_error_sum *tile_error; /* [tiles]: what was last found of each, which one thread at a
                                 time writes */
    wf_trace_sight *tile_sight; /* [tiles], and that of all of the picture; as tile_error */
};

/* Memory that looking for edges keeps from tile to tile. */
typedef struct wf_edge_scratch {
    void *seekers, *seen;
    size_t seen_capacity;
} wf_edge_scratch;

/* In which order samples are traced; kept from round to round. */
typedef struct wf_packet_order {
    uint32_t *sample; /* numbers of samples, [capacity] */
    uint16_t *half;   /* of half cells in which they lie, [capacity] */
    size_t capacity;
} wf_packet_order;

struct wf_sampling_scratch {
    wf_trace_scratch *trace;
    size_t capacity; /* samples */
    float *x, *y, *f, *t, *rgb[3], *alpha;
    double *trace_x, *trace_y, *trace_f;
    wf_adaptive_samples kept, probes;
    wf_edge_scratch edges;
    wf_packet_order order;
    wf_error_sum error;
};

/* A tile that is being sampled. */
typedef struct wf_tile {
    const wf_sampling *s;
    wf_sampling_scratch *c;
    int x0, x1;
    const wf_receiver *receiver;
    bool timeless; /* all of its window shows the same */
    int64_t time;  /* of its cells: the unit, or that of all tiles that are still */
} wf_tile;

/* A place in a cell, 0 <= v < 1, on the raster; rounding does not take it into the next cell.
 */
static inline float wf_in_cell(float v, int cell) {
    float at = (float)cell + v, end = (float)(cell + 1);
    return at < end ? at : nextafterf(end, 0);
}

/* Times are whole millionths (2^-20) of a field, so that a float holds them whichever field
 * they are counted from. */
static inline double wf_on_time_grid(double t) {
    double whole = (double)(int64_t)(t * 0x1p20);
    return (whole - (whole > t * 0x1p20)) * 0x1p-20;
}

#endif
