/* What least.c shares with its loops: segments of columns side by side, each in a lane. */
#ifndef WF_FILTERS_LEAST_PACK_H
#define WF_FILTERS_LEAST_PACK_H

#include <stdbool.h>
#include <stddef.h>

#include "filters/base/isa.h"

enum {
    WF_LEAST_LANES = 8,    /* segments that are solved at once */
    WF_LEAST_COLUMNS = 32, /* of a tile */
    WF_LEAST_GUARD = 2,    /* rows of zeros before and after those of a pack */
    WF_LEAST_STEPS = 60,   /* most of the interior point; 14 are usual */
};

/* The arrays of a pack, each [guard + rows + guard][WF_LEAST_LANES]. */
typedef enum wf_least_array {
    /* Given. The quadratic form is a matrix of five diagonals, row j of it m2[j - 2], m1[j -
     * 1], m0[j], m1[j], m2[j]. b of row j is above[j] L[j - 1] + L[j] / 2 + below[j] L[j + 1],
     * which counts where `bound` is 1 and not where it is 0; a row is one of its lane's where
     * `own` is 1. */
    WF_LEAST_BASE, /* what L is without bounds */
    WF_LEAST_M0,
    WF_LEAST_M1,
    WF_LEAST_M2,
    WF_LEAST_ABOVE,
    WF_LEAST_BELOW,
    WF_LEAST_BOUND,
    WF_LEAST_OWN,
    WF_LEAST_LIMIT, /* of |b|; 1 where it does not count */
    /* Solved: L, and the multipliers of b <= limit, b >= -limit, L >= 0 and L <= most. */
    WF_LEAST_L,
    WF_LEAST_Z, /* four of them */
    /* Scratch: the best multipliers and L so far, the four slacks, 1 over them, the sums of
     * multipliers over slacks, the factors, the steps, and those of the multipliers. */
    WF_LEAST_BEST = WF_LEAST_Z + 4,
    WF_LEAST_S = WF_LEAST_BEST + 5,
    WF_LEAST_INVERSE = WF_LEAST_S + 4,
    WF_LEAST_W = WF_LEAST_INVERSE + 4,
    WF_LEAST_W_BOX,
    WF_LEAST_F1,
    WF_LEAST_F2,
    WF_LEAST_PIVOT,
    WF_LEAST_FORCE,   /* the gradient without multipliers */
    WF_LEAST_TENSION, /* what b's multipliers pull with */
    WF_LEAST_STEP_0,
    WF_LEAST_STEP,
    WF_LEAST_DZ,
    WF_LEAST_ARRAYS = WF_LEAST_DZ + 4,
} wf_least_array;

typedef struct wf_least_pack {
    int rows, capacity; /* of the longest lane; what there is space for */
    bool boxed;         /* bounds on L count: without them it would come near them */
    double most[WF_LEAST_LANES];
    /* Of twice the sum of slack times multiplier and the gradient squared: a lane below it is
     * done. */
    double tolerance[WF_LEAST_LANES];
    double *arrays; /* [WF_LEAST_ARRAYS][guard + capacity + guard][lanes] */
} wf_least_pack;

static inline double *wf_least_rows(const wf_least_pack *pack, int array) {
    size_t rows = (size_t)pack->capacity + 2 * WF_LEAST_GUARD;
    return pack->arrays + ((size_t)array * rows + WF_LEAST_GUARD) * WF_LEAST_LANES;
}

/* I + MU B'B as F D F', F of unit diagonal; row j of F is f2[j], f1[j], 1. */
typedef struct wf_least_factor {
    const double *f1, *f2, *inverse; /* [lines]; inverse: 1 / D */
    int lines;
} wf_least_factor;

/* A tile, [lines][WF_LEAST_COLUMNS] each, and what is to be proved of it. */
typedef struct wf_least_claim {
    const double *s, *l, *tension, *press;
    int lines;
    double weight, most;
    const double *limit; /* of |b|: line j has limit[j * limit_step + column] */
    ptrdiff_t limit_step;
} wf_least_claim;

typedef struct wf_least_ops {
    /* Solves F D F' x = x in place, [lines][WF_LEAST_COLUMNS]. */
    void (*smooth)(const wf_least_factor *factor, double *x);
    /* By how much |b| of a claim's l exceeds its limit, or l leaves 0 .. most, at most in each
     * column; <= 0 where it does not. */
    void (*look)(const wf_least_claim *claim, double *excess);
    /* How much more than the least sum each column of l may cost, by its multipliers: the sums
     * of slack times multiplier, twice, and of what is left of the gradient, squared. */
    void (*prove)(const wf_least_claim *claim, double *gap);
    /* Solves a pack that holds L within all bounds. Returns how many steps that took. */
    int (*solve)(wf_least_pack *pack);
} wf_least_ops;

WF_ISA_DECLARE(wf_least_ops);

#endif
