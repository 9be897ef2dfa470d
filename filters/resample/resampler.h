/* Fields from subframes: what everybody else sees of the resampler. */
#ifndef WF_FILTERS_RESAMPLE_RESAMPLER_H
#define WF_FILTERS_RESAMPLE_RESAMPLER_H

#include "filters/aperture/aperture.h"
#include "filters/raster/raster.h"
#include "filters/raster/timing.h"
#include "filters/resample/lattice.h"

/* Subframes to fields (filters/README.md, Weights), in the order that suits chunked files:
 * bands of input rows from top to bottom, and within a band the subframes in time. A band is
 * summed by one thread; different bands of a field may be summed at once. When all
 * bands have seen all the subframes of a field's window, its lines are finished, in any order,
 * by any threads. The bits of the result depend on neither threads nor batches. */

typedef struct wf_resample_desc {
    const wf_raster *raster;
    wf_aperture aperture;
    wf_timing_desc timing;
    wf_fitting x, y;
    int channels; /* 3: R G B; 4: and alpha, over the background */
    bool floats;  /* all input has float samples, of no fewer channels: fields that see few
                     samples a pixel are summed in float */
    float background[3];        /* scene-linear */
    int band_rows, band_origin; /* bands begin at rows band_origin + n band_rows */
} wf_resample_desc;

/* Geometry and weights of a job. Immutable once made; any threads. */
typedef struct wf_resampler wf_resampler;

/* False with a reason if memory is out or the ratios are too fine. desc is copied; the raster
 * it points to must outlive the resampler. */
bool wf_resampler_new(const wf_resample_desc *desc, wf_resampler **out, char *why,
                      size_t why_size);
void wf_resampler_free(wf_resampler *resampler);

/* Sets how many subframes there are, where that is found out late: before a field whose window
 * reaches beyond them is made. */
void wf_resampler_set_end(wf_resampler *resampler, int64_t subframes);

/* The same, and when they are shown, as wf_timing_set_edges has it: before a field whose window
 * reaches beyond the last but one of these edges is made. */
bool wf_resampler_set_edges(wf_resampler *resampler, const wf_rational *edges, int64_t from,
                            int64_t subframes);

/* Subframes that some line of field n needs. */
wf_window wf_resampler_window(const wf_resampler *resampler, int64_t field);

/* Bands and the lattice rows of each; rows outside the display window are reached too. */
int wf_resampler_bands(const wf_resampler *resampler);
wf_span wf_resampler_band_rows(const wf_resampler *resampler, int band);

/* What one field in flight needs at most, carried between batches or not. */
size_t wf_resampler_field_bytes(const wf_resampler *resampler, bool carried);

/* Buffers of one thread. */
typedef struct wf_scratch wf_scratch;
size_t wf_scratch_bytes(const wf_resampler *resampler, int fields_in_flight);
wf_scratch *wf_scratch_new(const wf_resampler *resampler, int fields_in_flight);
void wf_scratch_free(wf_scratch *scratch);

/* A field in flight: its sums. */
typedef struct wf_field wf_field;
wf_field *wf_field_new(const wf_resampler *resampler, int64_t index);
void wf_field_free(wf_field *field);

/* Makes a field that is done with another one: its memory, which is large, is used again. False
 * when memory is out; the field can then only be freed. */
bool wf_field_renew(wf_field *field, int64_t index);

/* Columns x0 .. x1 and rows y0 .. y1 of the lattice, half-open. */
typedef struct wf_cells {
    int x0, y0, x1, y1;
} wf_cells;

/* Where the samples of one subframe exist beside the display window. */
typedef struct wf_band_input {
    const int64_t *k; /* subframes that all show this, ascending */
    int k_count;
    wf_cells data;        /* the data window */
    wf_cells here;        /* the part of it that plane[] holds; may be empty */
    const void *plane[4]; /* channel c at (here.x0, here.y0) */
    size_t line_stride;   /* samples from line to line of a plane */
    int channels;         /* 3 or 4 */
    bool half;            /* half, or float, samples */
} wf_band_input;

/* All cells that some aperture of some field meets, of the display window or not. */
wf_cells wf_resampler_reach(const wf_resampler *resampler);

/* The part of field n's window that subframe k is shown in, of 1, on a frame line. */
double wf_resampler_share(const wf_resampler *resampler, int64_t field, int line, int64_t k);

/* Whether data reaches past the display window to where some aperture looks. */
bool wf_resampler_overscan(const wf_resampler *resampler, const wf_cells *data);

int64_t wf_field_index(const wf_field *field);

/* Before a batch, once, by one thread: allocates what the batch leaves. last: the batch
 * holds the rest of the field's window; overscan: some subframe of it has overscan. False: no
 * memory. */
bool wf_field_begin_batch(wf_field *field, bool last, bool overscan);

/* One band of one batch, by one thread: open, add in time order, close. slot < fields_in_flight
 * tells the fields summed side by side apart. Subframes outside the field's window add nothing.
 * at_once: the lines that this makes ready are finished next, with this scratch and before it
 * closes another band: what they alone need stays in it. */
void wf_band_open(const wf_field *field, int band, wf_scratch *scratch, int slot);
void wf_band_add(wf_field *field, int band, wf_scratch *scratch, int slot,
                 const wf_band_input *input);
void wf_band_close(wf_field *field, int band, wf_scratch *scratch, int slot, bool at_once);

/* Where the batch completes the field: the lines that the band just closed reaches (none
 * otherwise). Each of them is asked about once for each of its bands; when the last of these is
 * closed, wf_field_line_ready is true, and the asking thread may finish the line while its sums
 * are in the cache. */
wf_span wf_band_lines(const wf_field *field, int band);
bool wf_field_line_ready(wf_field *field, int line);

/* Whether the lines of a complete field have been ready, every one, and were taken. */
bool wf_field_lines_taken(const wf_field *field);

/* After all bands of a batch, once. */
void wf_field_end_batch(wf_field *field);

/* Whether the whole window has been added: lines can be finished, nothing more may be added. */
bool wf_field_complete(const wf_field *field);

/* Line l of a field (frame line parity + step l), ready or with its window complete:
 * scene-linear R, G, B, width_px samples each, over the background. */
void wf_field_line(const wf_field *field, int line, wf_scratch *scratch, float *const rgb[3]);

/* Alpha of the line that wf_field_line has just made with this scratch, seen through the same
 * weights: what inputs without alpha cover is 1, what nothing covers is 0. width_px samples,
 * which leave 0 .. 1 where weights are negative. */
void wf_field_alpha(const wf_field *field, const wf_scratch *scratch, float *alpha);

#endif
