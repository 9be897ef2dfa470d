/* Part of weft filters: the curves of --plot, for the plot module to draw. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "convert/plot/plot.h"
#include "convert/program/cmd.h"
#include "convert/program/filters_parts.h"
#include "filters/aperture/residue.h"

#define POINTS      1001 /* an odd number, so that one of them is at FLICKER */
#define FLICKER     0.5  /* cycles a line; what has it alternates from field to field */
#define MOST_CURVES 16

typedef struct curves {
    wf_plot_curve curve[MOST_CURVES];
    char name[MOST_CURVES][96];
    double value[MOST_CURVES][POINTS];
    size_t count;
} curves;

static double frequency(int point) {
    return (double)point / (POINTS - 1);
}

static bool same_curve(const double *a, const double *b) {
    for (int i = 0; i < POINTS; i++)
        if (fabs(a[i] - b[i]) > 1e-6) return false;
    return true;
}

static wf_plot_curve *keep_curve(curves *c, const char *name) {
    snprintf(c->name[c->count], sizeof c->name[0], "%s", name);
    c->curve[c->count] =
        (wf_plot_curve){.name = c->name[c->count], .value = c->value[c->count]};
    return &c->curve[c->count++];
}

/* Adds the curve of an aperture, or its name to an equal curve: apertures that differ across
 * the line or in time alone have the same vertical response. */
static void add_aperture(const wf_filters_query *q, const wf_aperture *a, const char *name,
                         curves *c) {
    if (c->count == MOST_CURVES) return;
    double *value = c->value[c->count];
    for (int i = 0; i < POINTS; i++)
        value[i] = wf_response(a, wf_filters_tau(q, a), 0, frequency(i), 0);
    for (size_t other = 0; other < c->count; other++)
        if (same_curve(value, c->value[other])) {
            size_t used = strlen(c->name[other]);
            snprintf(c->name[other] + used, sizeof c->name[0] - used, ", %s", name);
            return;
        }
    keep_curve(c, name);
}

static void add_weights(const wf_filters_query *q, const wf_aperture *a, curves *c) {
    double *value = c->value[c->count];
    for (int i = 0; i < POINTS; i++)
        value[i] = wf_line_residue(a, q->input_lines, q->raster.lines, frequency(i));
    char name[96], left[32] = "nothing";
    double flicker = value[(int)(FLICKER * (POINTS - 1))];
    if (flicker > 0) snprintf(left, sizeof left, "%.2f dB", wf_filters_db(flicker, 0));
    snprintf(name, sizeof name, "%d to %d lines, the worst: %s at %g", q->input_lines,
             q->raster.lines, left, FLICKER);
    keep_curve(c, name)->dashed = true;
}

static void collect(const wf_filters_query *q, curves *c) {
    const wf_aperture_kind *kind;
    if (q->name) {
        add_aperture(q, &q->aperture, q->name, c);
        if (q->input_lines) add_weights(q, &q->aperture, c);
        return;
    }
    for (size_t i = 0; (kind = wf_aperture_at(i)); i++) {
        char name[64];
        wf_aperture a = wf_filters_example(kind, name);
        add_aperture(q, &a, name, c);
    }
}

weft_status wf_filters_plot(const wf_filters_query *query, const char *path, weft_error *err) {
    curves c = {.count = 0};
    char title[128] = "Apertures", subtitle[160];
    collect(query, &c);
    if (query->name) snprintf(title, sizeof title, "Aperture %s", query->name);
    snprintf(subtitle, sizeof subtitle,
             "Vertical frequency response, at 0 cycles/pixel and 0 cycles/field");
    const wf_plot plot = {
        .title = title,
        .subtitle = subtitle,
        .x_label = "Vertical frequency, cycles per frame line",
        .x_end = 1,
        .x_mark = FLICKER,
        .mark_label = "0.5: alternate lines, flicker at the frame rate",
        .points = POINTS,
        .curve_count = c.count,
        .curves = c.curve,
    };
    return wf_cmd_draw("wf_plot_png", &plot, path, err);
}
