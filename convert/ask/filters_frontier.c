/* Apertures drawn: --frontier, the least flicker that there is for each sharpness, and
 * where the named apertures lie. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/ask/draw.h"
#include "convert/ask/filters.h"
#include "convert/plot/plot.h"
#include "filters/aperture/flicker.h"
#include "filters/base/sinc.h"

#define POINTS     49
#define CURVES     4
#define MOST_MARKS 32

/* The limits within which a curve shows the least flicker for each sharpness. */
typedef struct curve_row {
    double support, overshoot, width; /* lines to each side; pixels */
} curve_row;

typedef struct curve {
    char name[96];
    const curve_row *row;
    size_t points;
    double flicker[POINTS], sharpness[POINTS];
} curve;

/* A named aperture, or several that lie in the same place. */
typedef struct mark {
    char name[96];
    double flicker, sharpness;
    bool peer; /* a filter of another program */
} mark;

typedef struct frontier {
    curve curve[CURVES];
    mark mark[MOST_MARKS];
    size_t marks;
} frontier;

static const curve_row rows[CURVES] = {{4, 0, 1}, {4, 0.05, 1}, {4, 0.08, 1}, {4, 0.08, 1.6}};

/* ---- Named apertures ---- */

/* A filter over progressive lines, each of which is a box one line high: what ffmpeg's filter
 * 'interlace' weighs around every second line. */
typedef struct fir {
    const char *name;
    double
        tap[3]; /* weights of the line itself, and of the lines one and two away on each side */
} fir;

static const fir peers[] = {{"ffmpeg linear", {0.5, 0.25, 0}},
                            {"ffmpeg complex", {0.75, 0.25, -0.125}}};

static double fir_response(const void *user, double fx, double fy) {
    const fir *f = user;
    double sum = f->tap[0];
    for (int k = 1; k < 3; k++) sum += 2 * f->tap[k] * cos(2 * M_PI * fy * k);
    return sum * wf_sinc(fx) * wf_sinc(fy);
}

/* Adds a dot for an aperture, or its name to the dot of one that lies in the same place. */
static void add_mark(frontier *f, const char *name, double flicker, double sharpness,
                     bool peer) {
    for (size_t m = 0; m < f->marks; m++) {
        mark *known = &f->mark[m];
        if (fabs(known->flicker - flicker) > 1e-6 || fabs(known->sharpness - sharpness) > 1e-6)
            continue;
        size_t used = strlen(known->name);
        snprintf(known->name + used, sizeof known->name - used, ", %s", name);
        return;
    }
    if (f->marks == MOST_MARKS) return;
    mark *added = &f->mark[f->marks++];
    *added = (mark){.flicker = flicker, .sharpness = sharpness, .peer = peer};
    snprintf(added->name, sizeof added->name, "%s", name);
}

static void add_marks(frontier *f) {
    const wf_aperture_kind *kind;
    for (size_t i = 0; (kind = wf_aperture_at(i)); i++) {
        char name[64];
        wf_aperture a = wf_filters_example(kind, name);
        if (kind->follows && kind->profile == WF_PROFILE_DESIGN) continue;
        add_mark(f, name, wf_aperture_flicker(&a), wf_filters_sharpness(&a), false);
    }
    for (size_t i = 0; i < sizeof peers / sizeof *peers; i++)
        add_mark(f, peers[i].name, wf_flicker(fir_response, &peers[i]),
                 fir_response(&peers[i], 0, WF_FILTERS_SHARP_AT), true);
}

/* ---- Curves ---- */

static weft_status solve(const curve *c, double sharp, double flicker, wf_design *design,
                         weft_error *err) {
    const wf_design_wish wish = {.support = c->row->support,
                                 .overshoot = c->row->overshoot,
                                 .alias = WF_DESIGN_ALIAS,
                                 .width = c->row->width,
                                 .flicker = flicker,
                                 .sharps = flicker > 0 ? 0 : 1,
                                 .sharp = {sharp},
                                 .at = {WF_FILTERS_SHARP_AT}};
    char why[512];
    if (wf_design_solve(&wish, design, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, design->no_memory ? WEFT_NO_MEMORY : WEFT_FAILED, "%s", why);
}

static double sharpness_of(const wf_design *design) {
    return wf_stairs_response(&design->stairs, WF_FILTERS_SHARP_AT);
}

/* Solves for sharpnesses from 0.1 to the largest that the limits allow. */
static weft_status trace(curve *c, weft_error *err) {
    wf_design design;
    weft_status status = solve(c, 0, 1, &design, err);
    if (status) return status;
    double most = sharpness_of(&design), least = 0.1;
    c->points = POINTS;
    c->flicker[POINTS - 1] = design.flicker;
    c->sharpness[POINTS - 1] = most;
    for (int i = 0; i < POINTS - 1; i++) {
        status = solve(c, least + (most - least) * i / (POINTS - 1), 0, &design, err);
        if (status) return status;
        c->flicker[i] = design.flicker;
        c->sharpness[i] = sharpness_of(&design);
    }
    return WEFT_OK;
}

static weft_status find(frontier *f, weft_error *err) {
    for (size_t i = 0; i < CURVES; i++) {
        curve *c = &f->curve[i];
        c->row = &rows[i];
        int used = snprintf(c->name, sizeof c->name, "least flicker, overshoot at most %g %%",
                            100 * c->row->overshoot);
        if (c->row->width > 1)
            snprintf(c->name + used, sizeof c->name - (size_t)used, ", %g pixels wide",
                     c->row->width);
        weft_status status = trace(c, err);
        if (status) return status;
    }
    add_marks(f);
    return WEFT_OK;
}

/* ---- What it looks like ---- */

/* Where an axis begins and ends: on its grid, a third of a step beyond what is drawn. */
static void widen(wf_plot_axis *axis, double value) {
    axis->low = fmin(axis->low, floor(value / axis->step - 0.3) * axis->step);
    axis->high = fmax(axis->high, ceil(value / axis->step + 0.3) * axis->step);
}

static void fit(const frontier *f, wf_plot_axis *flicker, wf_plot_axis *sharpness) {
    flicker->low = sharpness->low = INFINITY;
    flicker->high = sharpness->high = -INFINITY;
    for (size_t i = 0; i < CURVES; i++)
        for (size_t k = 0; k < f->curve[i].points; k++) {
            widen(flicker, f->curve[i].flicker[k]);
            widen(sharpness, f->curve[i].sharpness[k]);
        }
    for (size_t m = 0; m < f->marks; m++) {
        widen(flicker, f->mark[m].flicker);
        widen(sharpness, f->mark[m].sharpness);
    }
}

static size_t fill_items(const frontier *f, wf_plot_item *item) {
    size_t count = 0;
    for (size_t i = 0; i < CURVES; i++) {
        const curve *c = &f->curve[i];
        item[count++] = (wf_plot_item){.kind = WF_ITEM_LINE,
                                       .series = (int)i + 1,
                                       .name = c->name,
                                       .x = c->flicker,
                                       .y = c->sharpness,
                                       .points = c->points,
                                       .dashed = c->row->width > 1};
    }
    for (size_t m = 0; m < f->marks; m++) {
        const mark *k = &f->mark[m];
        item[count++] = (wf_plot_item){.kind = WF_ITEM_LABEL,
                                       .text = k->name,
                                       .x = &k->flicker,
                                       .y = &k->sharpness,
                                       .points = 1,
                                       .marked = k->peer};
    }
    return count;
}

static weft_status draw(const frontier *f, const char *path, weft_error *err) {
    char subtitle[128];
    wf_plot_item items[CURVES + MOST_MARKS];
    wf_plot_panel panel = {
        .y = {.label = "Vertical response at 0.25 cycles/line", .step = 0.1, .digits = 1},
        .item = items,
        .items = fill_items(f, items)};
    wf_plot plot = {
        .look = WF_LOOK_WIDE,
        .title = "Flicker and sharpness",
        .subtitle = subtitle,
        .x = {.label = "Interline flicker, RMS (white = 1)", .step = 0.02, .digits = 2},
        .panel = &panel,
        .panels = 1};
    fit(f, &plot.x, &panel.y);
    snprintf(subtitle, sizeof subtitle,
             "Still zone plate on 525i; designs of %g lines to each side, aliases at most %g",
             rows[0].support, WF_DESIGN_ALIAS);
    return wf_draw("wf_plot_draw", &plot, path, err);
}

/* ---- Numbers ---- */

static void add_numbers(wf_json *json, const char *key, const double *value, size_t count) {
    wf_json_open(json, key, '[');
    for (size_t i = 0; i < count; i++) wf_json_real(json, NULL, value[i]);
    wf_json_close(json);
}

static void add_frontier(wf_json *json, const frontier *f) {
    wf_json_real(json, "sharp_at", WF_FILTERS_SHARP_AT);
    wf_json_open(json, "curves", '[');
    for (size_t i = 0; i < CURVES; i++) {
        const curve *c = &f->curve[i];
        wf_json_open(json, NULL, '{');
        wf_json_real(json, "support", c->row->support);
        wf_json_real(json, "overshoot", c->row->overshoot);
        wf_json_real(json, "width", c->row->width);
        add_numbers(json, "flicker", c->flicker, c->points);
        add_numbers(json, "sharpness", c->sharpness, c->points);
        wf_json_close(json);
    }
    wf_json_close(json);
    wf_json_open(json, "points", '[');
    for (size_t m = 0; m < f->marks; m++) {
        wf_json_open(json, NULL, '{');
        wf_json_text(json, "name", f->mark[m].name);
        wf_json_real(json, "flicker", f->mark[m].flicker);
        wf_json_real(json, "sharpness", f->mark[m].sharpness);
        wf_json_close(json);
    }
    wf_json_close(json);
}

weft_status wf_filters_frontier(const char *path, wf_json *json, weft_error *err) {
    frontier *f = calloc(1, sizeof *f);
    if (!f) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = find(f, err);
    if (!status) status = draw(f, path, err);
    if (!status && json) add_frontier(json, f);
    free(f);
    return status;
}
