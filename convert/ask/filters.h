/* Apertures and their responses: what is asked of them, and what the parts that tell share. */
#ifndef WF_CONVERT_ASK_FILTERS_H
#define WF_CONVERT_ASK_FILTERS_H

#include "convert/base/json.h"
#include "convert/job/job.h"
#include "filters/aperture/aperture.h"
#include "filters/aperture/design.h"
#include "filters/raster/raster.h"

/* What is asked of apertures. */
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

#define WF_FILTERS_STEPS   20  /* rows of the table, from 0 to 1 cycle, less one */
#define WF_FILTERS_FLICKER 0.5 /* cycles a line; what has it alternates from field to field */

/* A row of the table: responses at f cycles a line, f cycles a pixel and f cycles a field
 * period. */
typedef struct wf_filters_row {
    double f, vertical, horizontal, temporal, weights;
} wf_filters_row;
wf_filters_row wf_filters_respond(const wf_filters_query *query, int step);

/* What the weights for the query's input lines leave of f cycles a line; 0 without those. */
double wf_filters_residue(const wf_filters_query *query, const wf_aperture *a, double f);

/* The vertical response where it flickers. */
double wf_filters_flicker(const wf_filters_query *query, const wf_aperture *a);

/* Adds the members of the list of apertures, or of the response of the query's. */
void wf_filters_json(wf_json *json, const wf_filters_query *query);

/* weft_job_filters; query gets what was asked, for those who tell it in words. Without report
 * the job's is not made. */
weft_status wf_ask_filters(weft_job *job, const weft_filters *asked, bool report,
                           wf_filters_query *query, weft_error *err);

/* Draws the vertical responses into a PNG file. */
weft_status wf_filters_plot(const wf_filters_query *query, const char *path, weft_error *err);

/* The sharpness of an aperture is its vertical response at this frequency, in cycles a line. */
#define WF_FILTERS_SHARP_AT 0.25
double wf_filters_sharpness(const wf_aperture *a);

/* Designs the query's aperture again if it is a design, for its certificate. */
bool wf_filters_design(wf_filters_query *query, char *why, size_t why_size);

/* Draws the least flicker that there is for each sharpness into a PNG file; json: gets the
 * numbers too, NULL: nothing does. */
weft_status wf_filters_frontier(const char *path, wf_json *json, weft_error *err);

#endif
