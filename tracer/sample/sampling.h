#ifndef WF_TRACER_SAMPLE_SAMPLING_H
#define WF_TRACER_SAMPLE_SAMPLING_H

#include "filters/gather/samples.h"
#include "tracer/sample/sampler.h"
#include "tracer/trace/tracer.h"

/* Samples of a scene where the apertures of its fields are: in their windows of time, on the
 * lines that they reach, shared by all apertures that reach them. */

typedef struct wf_sampling_desc {
    const wf_scene *scene;
    wf_gather_desc gather; /* how fields look */
    wf_sampler_kind sampler;
    int count; /* samples a pixel, frame line and field */
    uint64_t seed;
    bool skip;
    double error; /* RMS, display-encoded, to be reached with as many samples as each place
                     needs instead of count; 0: count */
} wf_sampling_desc;

/* One unit of time after another is looked at; between two looks any number of threads draws
 * bands of it. A unit is the window of one field, or, where windows are longer than a field and
 * overlap, one field period. */
typedef struct wf_sampling wf_sampling;
typedef struct wf_sampling_scratch wf_sampling_scratch;

/* desc is copied; what it points at must outlive the sampling. NULL: no memory. */
wf_sampling *wf_sampling_new(const wf_sampling_desc *desc);
void wf_sampling_free(wf_sampling *sampling);

/* Units first <= u <= *last that a field needs. */
void wf_sampling_units(const wf_sampling *sampling, int64_t field, int64_t *first,
                       int64_t *last);

wf_sampling_scratch *wf_sampling_scratch_new(const wf_sampling *sampling);
void wf_sampling_scratch_free(wf_sampling_scratch *scratch);

/* Turns to a unit; the scratch is only borrowed. False: no memory. */
bool wf_sampling_look(wf_sampling *sampling, wf_sampling_scratch *scratch, int64_t unit);

/* Whether fields that need this unit see nothing move. */
bool wf_sampling_still(const wf_sampling *sampling);

/* Whether all apertures of a field see a unit from its beginning to its end, and one moment of
 * it as well as another. */
bool wf_sampling_whole(const wf_sampling *sampling, int64_t field, int64_t unit);

/* How the raster is cut for receivers that ask. */
wf_sample_tiling wf_sampling_tiling(const wf_sampling *sampling);

/* Frame rows first <= j < end of the unit, first a multiple of the tiles' rows: hands their
 * samples over, block after block, cell by cell, rows from the top and pixels from the left
 * within blocks of rows. False: no memory. */
bool wf_sampling_rows(const wf_sampling *sampling, wf_sampling_scratch *scratch, int first,
                      int end, const wf_receiver *receiver);

wf_trace_counts wf_sampling_counted(const wf_sampling_scratch *scratch);

/* What the adaptive sampling thinks of its own error: mean square over `cells` cells, as sums;
 * and how many of these would take more than WF_MOST_SAMPLES. */
typedef struct wf_error_sum {
    double square, cells, short_of;
} wf_error_sum;

/* The most that a cell has, however small an error is asked for. */
#define WF_MOST_SAMPLES 8192

wf_error_sum wf_sampling_error(const wf_sampling_scratch *scratch);

/* One subframe: samples in a regular grid at an instant, rows first <= j < end of a picture of
 * `across` x `down` of them, scene-linear and multiplied by alpha, [end - first][across][4]. */
bool wf_sampling_subframe(wf_sampling *sampling, wf_rational time_s);
bool wf_sampling_subframe_rows(const wf_sampling *sampling, wf_sampling_scratch *scratch,
                               int across, int down, int first, int end, float *rgba);

#endif
