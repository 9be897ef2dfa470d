/* Part of weft filters: what the parts ask of an aperture, and the design behind its name. */
#include <math.h>
#include <stdio.h>

#include "convert/program/filters_parts.h"

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
