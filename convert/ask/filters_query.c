/* What is asked of apertures: by name, at frequencies, and the design behind a name. */
#include <math.h>
#include <stdio.h>

#include "convert/ask/asking.h"
#include "convert/ask/filters.h"
#include "convert/base/outfile.h"
#include "filters/aperture/residue.h"

wf_aperture wf_filters_example(const wf_aperture_kind *kind, char *name) {
    wf_aperture example = {.kind = kind};
    char why[256];
    snprintf(name, 64, "%s%s%s", kind->name, kind->follows ? ":" : "",
             kind->follows ? kind->example : "");
    wf_aperture_parse(name, &example, why, sizeof why);
    return example;
}

double wf_filters_tau(const wf_filters_query *query, const wf_aperture *aperture) {
    return query->tau < 0 ? wf_ratio_value(aperture->kind->default_width) : query->tau;
}

double wf_filters_db(double value, double zero_db) {
    return fabs(value) < 1e-14 ? zero_db : 20 * log10(fabs(value));
}

double wf_filters_sharpness(const wf_aperture *a) {
    return wf_response(a, 0, 0, WF_FILTERS_SHARP_AT, 0);
}

bool wf_filters_design(wf_filters_query *query, char *why, size_t why_size) {
    const char *wish = wf_aperture_wish(query->aperture.kind, query->name);
    query->designed = wish;
    return !wish || (wf_design_parse(wish, &query->wish, why, why_size) &&
                     wf_design_solve(&query->wish, &query->design, why, why_size));
}

double wf_filters_residue(const wf_filters_query *q, const wf_aperture *a, double f) {
    return q->input_lines ? wf_line_residue(a, q->input_lines, q->raster.lines, f) : 0;
}

wf_filters_row wf_filters_respond(const wf_filters_query *q, int step) {
    const wf_aperture *a = &q->aperture;
    double f = (double)step / WF_FILTERS_STEPS, tau = wf_filters_tau(q, a);
    return (wf_filters_row){f, wf_response(a, tau, 0, f, 0), wf_response(a, tau, f, 0, 0),
                            wf_response(a, tau, 0, 0, f), wf_filters_residue(q, a, f)};
}

double wf_filters_flicker(const wf_filters_query *q, const wf_aperture *a) {
    return wf_response(a, wf_filters_tau(q, a), 0, WF_FILTERS_FLICKER, 0);
}

/* ---- Asking ---- */

static weft_status check_alone(const weft_filters *asked, weft_error *err) {
    if (!asked->frontier || (!asked->name && !asked->plot && !asked->input_lines))
        return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--frontier shows every aperture there is; leave out %s",
                   asked->name   ? asked->name
                   : asked->plot ? "--plot"
                                 : "--input-lines");
}

static weft_status read_lines(const char *text, int *lines, weft_error *err) {
    wf_rational given = {0, 1};
    bool fits = !text || (wf_ratio_parse(text, &given) && given.den == 1 && given.num >= 1 &&
                          given.num <= 16384);
    *lines = (int)given.num;
    if (fits) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--input-lines: '%.200s' will not do; it takes a whole number from 1 to "
                   "16384, such as 1080",
                   text);
}

static weft_status read_asked(const weft_job *job, const weft_filters *asked,
                              wf_filters_query *query, weft_error *err) {
    char why[512];
    *query = (wf_filters_query){.name = asked->name, .raster = job->raster};
    query->tau = wf_ratio_given(job->temporal_width) ? wf_ratio_value(job->temporal_width) : -1;
    if (query->name && !wf_aperture_parse(query->name, &query->aperture, why, sizeof why))
        return wf_fail(err, WEFT_USAGE, "%s", why);
    if (query->name && !wf_filters_design(query, why, sizeof why))
        return wf_fail(err, query->design.no_memory ? WEFT_NO_MEMORY : WEFT_FAILED, "%s", why);
    weft_status status = check_alone(asked, err);
    return status ? status : read_lines(asked->input_lines, &query->input_lines, err);
}

weft_status wf_ask_filters(weft_job *job, const weft_filters *asked, bool report,
                           wf_filters_query *query, weft_error *err) {
    wf_json json = {0};
    weft_filters own;
    weft_status status = wf_asked(asked, "weft_filters", &own, sizeof own, err);
    if (!status) status = read_asked(job, &own, query, err);
    const char *drawn = own.frontier ? own.frontier : own.plot;
    if (!status && drawn) status = wf_outfile_check(drawn, true, err);
    if (status) return status;
    if (report) wf_json_open(&json, NULL, '{');
    if (own.frontier)
        status = wf_filters_frontier(own.frontier, report ? &json : NULL, err);
    else if (own.plot)
        status = wf_filters_plot(query, own.plot, err);
    if (report && !own.frontier) wf_filters_json(&json, query);
    if (!report) return status;
    weft_status told = wf_ask_report(job, &json, err);
    return status ? status : told;
}

weft_status weft_job_filters(weft_job *job, const weft_filters *asked, weft_error *err) {
    wf_filters_query query;
    return wf_ask_filters(job, asked, true, &query, err);
}
