/* Apertures drawn: the curves of --plot, for the plot module to draw. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "convert/ask/draw.h"
#include "convert/ask/filters.h"
#include "convert/plot/plot.h"
#include "filters/aperture/residue.h"

#define POINTS      1001 /* an odd number, so that one of them is at FLICKER */
#define FLICKER     0.5  /* cycles a line; what has it alternates from field to field */
#define MOST_CURVES 16

typedef struct curves {
    char name[MOST_CURVES][96];
    bool dashed[MOST_CURVES];
    double frequency[POINTS], value[MOST_CURVES][POINTS], decibels[MOST_CURVES][POINTS];
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

static void keep_curve(curves *c, const char *name, bool dashed) {
    snprintf(c->name[c->count], sizeof c->name[0], "%s", name);
    c->dashed[c->count++] = dashed;
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
    keep_curve(c, name, false);
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
    keep_curve(c, name, true);
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

/* ---- The picture ---- */

static void tell_points(curves *c) {
    for (int i = 0; i < POINTS; i++) c->frequency[i] = frequency(i);
    for (size_t k = 0; k < c->count; k++)
        for (int i = 0; i < POINTS; i++)
            c->decibels[k][i] = 20 * log10(fmax(fabs(c->value[k][i]), 1e-12));
}

/* Widens an axis by whole steps to what the curves reach, but not beyond 80 to either side. */
static void widen(wf_plot_axis *axis, const curves *c, double (*value)[POINTS]) {
    for (size_t k = 0; k < c->count; k++)
        for (int i = 0; i < POINTS; i++) {
            double y = value[k][i];
            while (axis->low > -80 && y < axis->low - 0.01 * axis->step)
                axis->low -= axis->step;
            while (axis->high < 80 && y > axis->high + 0.01 * axis->step)
                axis->high += axis->step;
        }
}

/* A panel: where it flickers, the curves, and (dots) where those of the weights meet that.
 * Returns how many items there are, at most 1 + 2 MOST_CURVES. */
static size_t fill_panel(const curves *c, const double (*value)[POINTS], bool named, bool dots,
                         wf_plot_item *item) {
    static const double flicker = FLICKER;
    const int at = (int)(FLICKER * (POINTS - 1));
    size_t count = 0;
    item[count++] = (wf_plot_item){
        .kind = WF_ITEM_RULE,
        .x = &flicker,
        .points = 1,
        .text = named ? "0.5: alternate lines, flicker at the frame rate" : NULL};
    for (size_t k = 0; k < c->count; k++)
        item[count++] = (wf_plot_item){.kind = WF_ITEM_LINE,
                                       .series = (int)k % WF_PLOT_SERIES + 1,
                                       .name = named ? c->name[k] : NULL,
                                       .x = c->frequency,
                                       .y = value[k],
                                       .points = POINTS,
                                       .dashed = c->dashed[k]};
    for (size_t k = 0; k < c->count && dots; k++)
        if (c->dashed[k])
            item[count++] = (wf_plot_item){.kind = WF_ITEM_POINTS,
                                           .series = (int)k % WF_PLOT_SERIES + 1,
                                           .x = &c->frequency[at],
                                           .y = &value[k][at],
                                           .points = 1};
    return count;
}

weft_status wf_filters_plot(const wf_filters_query *query, const char *path, weft_error *err) {
    curves c = {.count = 0};
    wf_plot_item values[2 * MOST_CURVES + 1], decibels[2 * MOST_CURVES + 1];
    char title[128] = "Apertures";
    collect(query, &c);
    tell_points(&c);
    if (query->name) snprintf(title, sizeof title, "Aperture %s", query->name);
    wf_plot_panel panels[] = {{.heading = "Response",
                               .y = {.low = -0.2, .high = 1, .step = 0.2, .digits = 1},
                               .item = values,
                               .items = fill_panel(&c, c.value, true, false, values)},
                              {.heading = "Response, dB",
                               .y = {.low = -80, .high = 0, .step = 10, .digits = 0},
                               .item = decibels,
                               .items = fill_panel(&c, c.decibels, false, true, decibels)}};
    widen(&panels[0].y, &c, c.value);
    widen(&panels[1].y, &c, c.decibels);
    const wf_plot plot = {
        .look = WF_LOOK_PANELS,
        .title = title,
        .subtitle = "Vertical frequency response, at 0 cycles/pixel and 0 cycles/field",
        .x = {.label = "Vertical frequency, cycles per frame line",
              .low = 0,
              .high = 1,
              .step = 0.1,
              .digits = 1},
        .panel = panels,
        .panels = 2,
    };
    return wf_draw("wf_plot_draw", &plot, path, err);
}
