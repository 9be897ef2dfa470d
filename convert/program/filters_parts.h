/* What the parts of weft filters share. */
#ifndef WF_CONVERT_PROGRAM_CMD_FILTERS_H
#define WF_CONVERT_PROGRAM_CMD_FILTERS_H

#include "convert/base/json.h"
#include "convert/weft.h"
#include "filters/aperture/aperture.h"
#include "filters/aperture/design.h"
#include "filters/raster/raster.h"

/* What 'weft filters' was asked. */
typedef struct wf_filters_query {
    const char *name; /* of the aperture; NULL: all of them */
    wf_aperture aperture;
    double tau;       /* field periods; below 0: each aperture's own */
    int input_lines;  /* 0: closed forms only */
    wf_raster raster; /* what the input lines are stretched over */
    bool designed; /* the aperture is a design: wish and design tell what was asked and found */
    wf_design_wish wish;
    wf_design design;
} wf_filters_query;

/* An aperture of a kind, to stand for it in lists. name, of 64 bytes, gets its name. */
wf_aperture wf_filters_example(const wf_aperture_kind *kind, char *name);

/* The width of the window in time, in field periods: the query's, or the aperture's own. */
double wf_filters_tau(const wf_filters_query *query, const wf_aperture *aperture);

/* Decibels of a response. What rounding leaves of a zero (below 1e-14, -280 dB) is taken for
 * one: zero_db is returned. */
double wf_filters_db(double value, double zero_db);

/* The list of apertures, or the response of the query's, on standard output. */
void wf_filters_print(const wf_filters_query *query);
weft_status wf_filters_print_json(const wf_filters_query *query, weft_error *err);

/* Draws the vertical responses into a PNG file. */
weft_status wf_filters_plot(const wf_filters_query *query, const char *path, weft_error *err);

/* The sharpness of an aperture is its vertical response at this frequency, in cycles a line. */
#define WF_FILTERS_SHARP_AT 0.25
double wf_filters_sharpness(const wf_aperture *a);

/* Designs the query's aperture again if it is a design, for its certificate. */
bool wf_filters_design(wf_filters_query *query, char *why, size_t why_size);
void wf_filters_print_design(const wf_filters_query *query);
void wf_filters_add_design(wf_json *json, const wf_filters_query *query);

/* Draws the least flicker that there is for each sharpness into a PNG file; as_json: prints the
 * numbers too. */
weft_status wf_filters_frontier(const char *path, bool as_json, weft_error *err);

#endif
