/* What the files of the resampler share. */
#ifndef WF_FILTERS_RESAMPLE_RESAMPLER_INSIDE_H
#define WF_FILTERS_RESAMPLE_RESAMPLER_INSIDE_H

#include <stdatomic.h>

#include "filters/resample/resampler.h"
#include "filters/resample/rows.h"

/* A field is added up in sums: rows of input columns, in double. There is one sum for each
 * input row where the aperture couples u and v but not v and t (`shaped` without scan skew),
 * else one for each output line that a band of input rows reaches. Terms say which rows add to
 * which sums; taps say which sums, each through a horizontal kernel, make which line.
 *
 * Quick fields are summed in float: those of which each sample meets so few additions on its
 * way to a pixel that these, and four roundings of products and weights, of 2^-24 each, are
 * within 1e-6 of the sum of magnitudes. */
#define WF_QUICK_ADDITIONS 12

/* Row `row` adds to sum `sum` with `weight` times the weight of its instant. */
typedef struct wf_term {
    int row, line, sum;
    bool inside;           /* the row is one of the display window's */
    double weight, v0, v1; /* v0 .. v1: the row's cell, in lines from the line's center */
} wf_term;

/* One band of input rows: half-open ranges of its rows, of the terms and sums that are its own,
 * and of the field's lines that reach some row of it. */
typedef struct wf_band {
    wf_span rows, terms, sums, lines;
} wf_band;

/* A line takes one sum through one horizontal kernel. */
typedef struct wf_tap {
    int line, sum, kernel;
} wf_tap;

/* Horizontal weights of the row of cells v0 .. v1 (both 0 where the aperture separates). Pixels
 * of one phase share `taps` weights, from the first cell that they reach; what they add up to
 * is known for each pixel, since at the picture's edges cells are missing. */
typedef struct wf_kernel {
    double v0, v1;
    double *weight; /* [phases][taps] */
    double *inside; /* [width]: sum over the cells of the display window */
    double *exists; /* [width]: and over the padding */
} wf_kernel;

/* The weights of the fields of one parity. */
typedef struct wf_weights {
    int lines, first_line, line_step; /* of a field, in frame lines */
    wf_band *bands;                   /* [band_count] */
    wf_term *terms;                   /* [term_count], by band, sum and row */
    wf_tap *taps;                     /* [tap_count], by line and then by kernel */
    wf_span *line_taps;               /* [lines] */
    int *line_bands;                  /* [lines]: how many bands a line reaches */
    bool *whole;                      /* [sum_count]: whether all lines that take the sum reach
                                         its band alone */
    int term_count, tap_count, sum_count;
    int most_sums;    /* of any one band */
    int most_terms;   /* of any one sum */
    int most_kernels; /* that any one line takes sums through */
} wf_weights;

struct wf_resampler {
    wf_resample_desc desc;
    wf_timing timing;
    wf_axis x, y;
    wf_span columns, rows; /* of the lattice, that some pixel reaches */
    int band_count;
    wf_weights weights[2]; /* by parity; progressive rasters have the first alone */
    bool sums_by_row;      /* one sum for each input row */
    int phases, taps;      /* pixels that lie differently in their cells; weights of each */
    /* Polyphase layout of a finished sum: lane z holds the cells z, z + lanes, .. so that
     * pixels of one phase read neighbors. There is one lane where phases are too many for that
     * to pay. */
    int lanes, lane_length;
    bool polyphase;
    wf_kernel *kernels;
    int kernel_count, kernel_capacity;
    int line_additions; /* of sums and strands, on the way to a pixel that has most; 0: no field
                           is quick */
    const wf_row_ops *ops;
};

/* Builds rs->weights[parity], and asks for the kernels that it uses. False: no memory. */
bool wf_weights_build(wf_resampler *rs, int parity);
void wf_weights_release(wf_weights *weights);

/* The first row of the band that holds a row. */
int wf_band_floor(const wf_resampler *rs, int row);

/* The index of the kernel of the row of cells v0 .. v1, found or added (rows that mirror each
 * other share one); -1: no memory. */
int wf_kernel_for(wf_resampler *rs, double v0, double v1);

/* Computes the kernels that are kept, once both parities have asked for all of theirs. False:
 * no memory. */
bool wf_kernels_keep(wf_resampler *rs);

/* Pixels of the phase that has most take so many cells of the kernel, which is kept. */
int wf_kernel_strands(const wf_resampler *rs, int kernel);

/* The kernel's arrays, filled: those that are kept, or computed into scratch where keeping all
 * of them would take too much memory. */
const wf_kernel *wf_kernel_ready(const wf_resampler *rs, int kernel, wf_kernel *scratch);
bool wf_kernel_alloc(const wf_resampler *rs, wf_kernel *kernel);
void wf_kernel_release(wf_kernel *kernel);

/* The part of a subframe's cell that lies in a line's window, in field periods from the
 * window's center, and what it weighs. */
typedef struct wf_moment {
    double q0, q1, weight;
} wf_moment;

struct wf_field {
    const wf_resampler *rs;
    const wf_weights *weights;
    int64_t index;
    wf_window window;
    wf_moment *moments; /* [lines, or 1 without scan skew][window.count] */
    float *done;        /* [sums][channels][lanes][lane_length], once all has been added */
    bool quick;         /* sums are of float */
    double *carry;      /* [sums][channels][columns], while more is to come; of floats in the
                           same places */
    bool carried;       /* carry holds something */
    bool last;          /* the batch in hand completes the window */
    bool complete;
    bool *touched;          /* [sums]: some sample was added; done and carry hold no others */
    atomic_int *bands_left; /* [lines]: how many of its bands are not closed yet */
    double *inside;         /* [sums]: weight of the rows of the display window */
    double *exists;         /* [sums]: and of the padding's */
    double *overscan; /* [sums][columns]: weight of samples of subframes with overscan; or NULL
                       */
};

/* Sums that lines were to take at once, of the band closed last: they never leave the cache. */
typedef struct wf_held {
    const wf_field *field; /* NULL: there are none */
    int64_t index;         /* of the field */
    wf_span sums;
    const float *done; /* [sums][stride], of those that are whole */
    size_t stride;     /* wf_done_samples, or as slots lie where their sums are as lines take
                          them */
    float *own;        /* [slot_sums][channels][lanes][lane_length] */
} wf_held;

/* What samples that exist weigh: of all pixels through one kernel. */
typedef struct wf_total {
    int kernel;
    double inside, exists;
} wf_total;

/* A slot is one of the fields that a thread sums side by side. */
struct wf_scratch {
    const wf_resampler *rs;
    size_t slot_sums;    /* most_sums of both parities */
    size_t slot_samples; /* of the sums of one slot */
    double *sums; /* [slots][slot_sums][channels][columns]; of floats in the same places */
    bool *live;   /* [slots][slot_sums]: the sum has begun; others hold nothing yet */
    wf_held held;
    size_t most_kernels;            /* of both parities */
    double *rows;                   /* [most_kernels][lanes][lane_length] */
    wf_strand *strands;             /* [phases][most_kernels][taps] */
    wf_quick_strand *quick_strands; /* [most_kernels][taps] */
    float *quick_exists;            /* [width]: exists in float */
    size_t *strand_counts;          /* [phases] */
    double *picture;                /* [channels][phases][run] */
    double *inside;   /* [width]: weights of the line in hand, of the display window */
    double *exists;   /* [width]: and of all that exists there, turned over */
    wf_total *totals; /* [most_kernels]: of what inside and exists are made */
    int total_count;  /* 0: they are to be made anew */
    wf_kernel kernel;
};

static inline size_t wf_columns_of(const wf_resampler *rs) {
    return (size_t)(rs->columns.end - rs->columns.first);
}

/* Samples of one sum while it is added up; of one channel of it once it is finished; of all its
 * channels then. */
static inline size_t wf_sum_samples(const wf_resampler *rs) {
    return (size_t)rs->desc.channels * wf_columns_of(rs);
}

static inline size_t wf_row_samples(const wf_resampler *rs) {
    return (size_t)rs->lanes * (size_t)rs->lane_length;
}

static inline size_t wf_done_samples(const wf_resampler *rs) {
    return (size_t)rs->desc.channels * wf_row_samples(rs);
}

/* The pixels of the phase that has most. */
static inline size_t wf_run_length(const wf_resampler *rs) {
    return (size_t)((rs->x.pixels + rs->phases - 1) / rs->phases);
}

#endif
