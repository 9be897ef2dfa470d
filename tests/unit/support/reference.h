#ifndef WF_TESTS_UNIT_SUPPORT_REFERENCE_H
#define WF_TESTS_UNIT_SUPPORT_REFERENCE_H

#include <stdint.h>

/* The plainest reading of the resampling rules in float64: for one pixel, every cell of every
 * subframe is weighed by quadrature of h over it. Shares no code with the library. */
typedef struct reference {
    int width, lines; /* raster */
    int interlaced, psf, top_first;
    double field_period_s;
    const char *aperture; /* without parameters */
    double b, c;          /* mitchell */
    const double *steps;  /* designs: heights of the kernel's steps, an eighth of a line each */
    int step_count;       /* from the middle outward, to each side */
    double half_u;        /* and half its width in pixels */
    double tau;           /* field periods */
    double position;      /* where the window lies: 0 start, 0.5 center, 1 end */
    double skew;
    double rate; /* subframes a second */
    int center;  /* cells lie about k/R */
    int subframes;
    int cells_x, cells_y;      /* display window */
    double cell_w, cell_h;     /* pixels, lines */
    double origin_x, origin_y; /* display window's corner on the raster */
    int padded;
    float background[3];
    int data[4]; /* data window x0 y0 x1 y1 of every subframe, from the display's */
    int has_alpha;
    /* Sample of subframe k at cell (a, b) inside the data window; channel 3 is alpha. */
    float (*sample)(const void *user, int k, int a, int b, int channel);
    const void *user;
} reference;

typedef struct reference_value {
    double value;
    double scale; /* sum |W c| / sum W: what errors are measured against */
} reference_value;

reference_value reference_pixel(const reference *r, int i, int j, int64_t field, int channel);

#endif
