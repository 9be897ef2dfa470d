#ifndef WF_FILTERS_RESAMPLE_PLAN_H
#define WF_FILTERS_RESAMPLE_PLAN_H

#include <stdatomic.h>

#include "filters/resample/resampler.h"
#include "filters/resample/rows.h"

/* Inside the resampler. A field is summed into `sums`, rows of input columns: one for every
 * input row where the aperture couples u and v but not v and t (shaped), else one for every
 * output line that a band reaches. Terms say which rows feed which sums, taps which sums make a
 * line. */

/* Row `row` adds to sum `sum` with this weight times the weight of its instant. */
typedef struct wf_term {
    int row, line, sum;
    bool inside;           /* the row is the display window's */
    double weight, v0, v1; /* the cell's edges, seen from the line */
} wf_term;

/* What a band adds to; lines: those that reach some row of it. */
typedef struct wf_band {
    wf_span rows, terms, sums, lines;
} wf_band;

/* A line is made of sums, each through a horizontal kernel. */
typedef struct wf_tap {
    int line, sum, kernel;
} wf_tap;

/* Horizontal weights of the row of cells v0 .. v1 (both 0 where the aperture separates): `taps`
 * for each phase from the first cell a pixel reaches, and what they add up to over the cells
 * that are there (display window) and that exist (and padding), for every pixel. */
typedef struct wf_kernel {
    double v0, v1;
    double *weight;          /* [phases][taps] */
    double *inside, *exists; /* [width] */
} wf_kernel;

typedef struct wf_plan {
    int lines, first_line, line_step;
    wf_band *bands;
    wf_term *terms;
    wf_tap *taps;
    wf_span *line_taps; /* [lines] */
    int *line_bands;    /* [lines]: how many bands a line reaches */
    int term_count, tap_count, sum_count, most_sums; /* most_sums: of any band */
} wf_plan;

struct wf_resampler {
    wf_resample_desc desc;
    wf_timing timing;
    wf_axis x, y;
    wf_span columns, rows; /* reached */
    int band_count;
    wf_plan plan[2]; /* by parity */
    int plans;
    bool sums_by_row;
    int phases, taps;
    /* Polyphase layout of a finished sum: lane z holds the cells z, z + lanes, .. so that
     * pixels of one phase read neighbours. One lane where phases are too many for that to pay.
     */
    int lanes, lane_length;
    bool polyphase;
    wf_kernel *kernels;
    int kernel_count, kernel_room;
    const wf_row_ops *ops;
};

/* The kernel for the row of cells v0 .. v1, found or added (symmetric rows share one); -1: no
 * memory. */
int wf_kernel_for(wf_resampler *rs, double v0, double v1);

/* Computes the kernels that are to be kept, once the plans have asked for all of them. */
bool wf_kernels_keep(wf_resampler *rs);

/* The kernel's arrays, filled: the kept ones, or computed into scratch where keeping all of
 * them would take too much memory. */
const wf_kernel *wf_kernel_ready(const wf_resampler *rs, int kernel, wf_kernel *scratch);
bool wf_kernel_alloc(const wf_resampler *rs, wf_kernel *kernel);
void wf_kernel_release(wf_kernel *kernel);

/* How a field sees one subframe: the part of its cell inside the window. */
typedef struct wf_moment {
    double q0, q1, weight;
} wf_moment;

struct wf_field {
    const wf_resampler *rs;
    const wf_plan *plan;
    int64_t index;
    wf_window window;
    wf_moment *moments; /* [lines, or 1 without scan skew][window.count] */
    bool alone;         /* the window is one subframe, seen at an instant */
    float *done;        /* [sums][channels][lanes][lane_length], once all has been added */
    double *carry;      /* [sums][channels][columns], while more is to come */
    bool carried;       /* carry holds something */
    bool last;          /* the batch in hand completes the window */
    bool complete;
    bool *touched;          /* [sums]: some sample was added; done and carry hold no others */
    atomic_int *bands_left; /* [lines]: how many of its bands are not closed yet */
    double *inside,
        *exists; /* [sums]: weight that met the display window's rows; and padding's */
    double
        *overscan; /* [sums][columns]: weight of samples of subframes with overscan; or NULL */
};

struct wf_scratch {
    const wf_resampler *rs;
    size_t slot_samples;
    double *sums;     /* [slots][most_sums][channels][columns] */
    bool *live;       /* [slots][most_sums]: the sum has begun; others hold nothing yet */
    size_t slot_sums; /* most_sums of both parities */
    double *row;      /* [lanes][lane_length] */
    double *picture;  /* [channels][phases][run] */
    double *inside, *exists; /* [width] */
    wf_kernel kernel;
};

static inline size_t wf_columns_of(const wf_resampler *rs) {
    return (size_t)(rs->columns.end - rs->columns.first);
}

/* Samples of one sum while it is added up, and of one channel of it once it is finished. */
static inline size_t wf_sum_samples(const wf_resampler *rs) {
    return (size_t)rs->desc.channels * wf_columns_of(rs);
}

static inline size_t wf_row_samples(const wf_resampler *rs) {
    return (size_t)rs->lanes * (size_t)rs->lane_length;
}

static inline size_t wf_done_samples(const wf_resampler *rs) {
    return (size_t)rs->desc.channels * wf_row_samples(rs);
}

/* Most pixels of one phase. */
static inline size_t wf_run_length(const wf_resampler *rs) {
    return (size_t)((rs->x.pixels + rs->phases - 1) / rs->phases);
}

#endif
