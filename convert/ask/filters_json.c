/* The list of apertures, the response of one and the design behind it, as JSON. */
#include <math.h>
#include <stdio.h>

#include "convert/ask/filters.h"
#include "filters/aperture/flicker.h"

#define ZERO_DB -400 /* what JSON, which has no infinity, gives for a response of zero */

static void add_wish(wf_json *json, const wf_design_wish *w) {
    wf_json_open(json, "wish", '{');
    wf_json_real(json, "support", w->support);
    wf_json_real(json, "overshoot", w->overshoot);
    wf_json_real(json, "alias", w->alias);
    wf_json_real(json, "width", w->width);
    wf_json_real(json, "flicker", w->flicker > 0 ? w->flicker : NAN);
    wf_json_open(json, "sharp", '[');
    for (int i = 0; i < w->sharps; i++) wf_json_real(json, NULL, w->sharp[i]);
    wf_json_close(json);
    wf_json_open(json, "at", '[');
    for (int i = 0; i < w->sharps || i == 0; i++) wf_json_real(json, NULL, w->at[i]);
    wf_json_close(json);
    wf_json_close(json);
}

static void add_design(wf_json *json, const wf_filters_query *q) {
    const wf_design *d = &q->design;
    wf_json_open(json, "design", '{');
    add_wish(json, &q->wish);
    wf_json_real(json, "flicker", d->flicker);
    wf_json_real(json, "response_eighth", wf_stairs_response(&d->stairs, 0.125));
    wf_json_real(json, "response_quarter", wf_stairs_response(&d->stairs, 0.25));
    wf_json_open(json, "response_at", '[');
    for (int i = 0; i < q->wish.sharps || i == 0; i++)
        wf_json_real(json, NULL, wf_stairs_response(&d->stairs, q->wish.at[i]));
    wf_json_close(json);
    wf_json_real(json, "overshoot", d->overshoot);
    wf_json_real(json, "least_beyond_quarter", d->least);
    wf_json_real(json, "response_half", d->zero);
    wf_json_real(json, "largest_beyond_half", d->alias);
    wf_json_real(json, "noise", wf_stairs_power(&d->stairs) / q->wish.width);
    wf_json_real(json, "gap", d->sharpest ? NAN : d->gap);
    wf_json_real(json, "gap_response", d->sharpest ? d->gap : NAN);
    wf_json_int(json, "iterations", d->iterations);
    wf_json_int(json, "programs", d->programs);
    wf_json_real(json, "step_lines", 1.0 / WF_STAIRS_STEPS);
    wf_json_open(json, "kernel", '[');
    for (int i = 0; i < d->stairs.count; i++) wf_json_real(json, NULL, d->stairs.height[i]);
    wf_json_close(json);
    wf_json_close(json);
}

static void add_pair(wf_json *json, const char *name, double value) {
    char key[32];
    snprintf(key, sizeof key, "%s_db", name);
    wf_json_real(json, name, value);
    wf_json_real(json, key, wf_filters_db(value, ZERO_DB));
}

static void add_aperture(wf_json *json, const wf_filters_query *q, const char *name,
                         const wf_aperture *a) {
    wf_json_text(json, "name", name ? name : a->kind->name);
    wf_json_text(json, "shape", a->kind->shape);
    wf_json_text(json, "paper", a->kind->paper);
    wf_json_real(json, "temporal_width", wf_filters_tau(q, a));
    wf_json_real(json, "reach_pixels", a->reach_u);
    wf_json_real(json, "reach_lines", a->reach_v);
    wf_json_real(json, "flicker", wf_aperture_flicker(a));
    wf_json_real(json, "sharpness", wf_filters_sharpness(a));
    wf_json_open(json, "parameters", '[');
    for (int p = 0; p < a->kind->parameters; p++) wf_json_real(json, NULL, a->parameter[p]);
    wf_json_close(json);
    if (!q->input_lines) return;
    wf_json_open(json, "residue", '{');
    wf_json_int(json, "input_lines", q->input_lines);
    wf_json_int(json, "lines", q->raster.lines);
    wf_json_real(json, "frequency", WF_FILTERS_FLICKER);
    add_pair(json, "closed_form", wf_filters_flicker(q, a));
    add_pair(json, "weights", wf_filters_residue(q, a, WF_FILTERS_FLICKER));
    wf_json_close(json);
}

static void add_response(wf_json *json, const wf_filters_query *q) {
    add_aperture(json, q, q->name, &q->aperture);
    if (q->designed) add_design(json, q);
    wf_json_open(json, "response", '[');
    for (int step = 0; step <= WF_FILTERS_STEPS; step++) {
        wf_filters_row r = wf_filters_respond(q, step);
        wf_json_open(json, NULL, '{');
        wf_json_real(json, "frequency", r.f);
        add_pair(json, "vertical", r.vertical);
        add_pair(json, "horizontal", r.horizontal);
        add_pair(json, "temporal", r.temporal);
        if (q->input_lines) add_pair(json, "weights", r.weights);
        wf_json_close(json);
    }
    wf_json_close(json);
}

static void add_list(wf_json *json, const wf_filters_query *q) {
    const wf_aperture_kind *kind;
    wf_json_open(json, "apertures", '[');
    for (size_t i = 0; (kind = wf_aperture_at(i)); i++) {
        char name[64];
        wf_aperture a = wf_filters_example(kind, name);
        wf_json_open(json, NULL, '{');
        add_aperture(json, q, NULL, &a);
        if (kind->follows) wf_json_text(json, "example", name);
        wf_json_close(json);
    }
    wf_json_close(json);
}

void wf_filters_json(wf_json *json, const wf_filters_query *query) {
    (query->name ? add_response : add_list)(json, query);
}
