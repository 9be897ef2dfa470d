/* Part of weft filters: the list of apertures and the response of one, as tables and as JSON.
 */
#include <math.h>
#include <stdio.h>

#include "convert/base/json.h"
#include "convert/program/cmd.h"
#include "convert/program/filters_parts.h"
#include "filters/aperture/flicker.h"
#include "filters/aperture/residue.h"

#define STEPS   20   /* rows of the table, from 0 to 1 cycle, less one */
#define FLICKER 0.5  /* cycles a line; what has it alternates from field to field */
#define ZERO_DB -400 /* what JSON, which has no infinity, gives for a response of zero */

static double residue(const wf_filters_query *q, const wf_aperture *a, double f) {
    return q->input_lines ? wf_line_residue(a, q->input_lines, q->raster.lines, f) : 0;
}

/* A row of the table: responses at f cycles a line, f cycles a pixel and f cycles a field
 * period. */
typedef struct response {
    double f, vertical, horizontal, temporal, weights;
} response;

static response respond(const wf_filters_query *q, int step) {
    const wf_aperture *a = &q->aperture;
    double f = (double)step / STEPS, tau = wf_filters_tau(q, a);
    return (response){f, wf_response(a, tau, 0, f, 0), wf_response(a, tau, f, 0, 0),
                      wf_response(a, tau, 0, 0, f), residue(q, a, f)};
}

/* ---- For people ---- */

static double people_db(double value) {
    return wf_filters_db(value, -INFINITY);
}

/* Prints a response and its decibels. What rounds to zero is printed without a sign. */
static void print_pair(double value) {
    printf("   %8.5f %8.2f", fabs(value) < 5e-6 ? 0 : value, people_db(value));
}

static void print_header(const wf_filters_query *q) {
    const wf_aperture_kind *kind = q->aperture.kind;
    printf("%s: %s%s%s; temporal width %g field periods; reaches %g px, %g lines\n\n", q->name,
           kind->shape, *kind->paper ? "; the paper's " : "", kind->paper,
           wf_filters_tau(q, &q->aperture), q->aperture.reach_u, q->aperture.reach_v);
    printf("%5s   %-17s   %-17s   %-17s", "", "cycles/line", "cycles/pixel", "cycles/field");
    if (q->input_lines) printf("   %d to %d lines", q->input_lines, q->raster.lines);
    printf("\n%5s", "f");
    for (int column = 0; column < (q->input_lines ? 4 : 3); column++)
        printf("   %8s %8s", "response", "dB");
    putchar('\n');
}

static double flicker_response(const wf_filters_query *q, const wf_aperture *a) {
    return wf_response(a, wf_filters_tau(q, a), 0, FLICKER, 0);
}

static void print_response(const wf_filters_query *q) {
    const wf_aperture *a = &q->aperture;
    print_header(q);
    for (int step = 0; step <= STEPS; step++) {
        response r = respond(q, step);
        printf("%5.2f", r.f);
        print_pair(r.vertical);
        print_pair(r.horizontal);
        print_pair(r.temporal);
        if (q->input_lines) print_pair(r.weights);
        putchar('\n');
    }
    if (q->input_lines)
        printf("\n%s at %.1f cycles/line: closed form %.2f dB, %d lines to %d leave %.2f dB\n",
               q->name, FLICKER, people_db(flicker_response(q, a)), q->input_lines,
               q->raster.lines, people_db(residue(q, a, FLICKER)));
    if (q->designed)
        wf_filters_print_design(q);
    else
        printf("\nflicker of the still zone plate: %.4f RMS\n", wf_aperture_flicker(a));
}

static void print_residues(const wf_filters_query *q) {
    const wf_aperture_kind *kind;
    printf("\nAt %.1f cycles/line, %d lines to the %d of %s:\n\n%-22s %14s %14s\n", FLICKER,
           q->input_lines, q->raster.lines, q->raster.name, "name", "closed form dB",
           "weights dB");
    for (size_t i = 0; (kind = wf_aperture_at(i)); i++) {
        char name[64];
        wf_aperture a = wf_filters_example(kind, name);
        printf("%-22s %14.2f %14.2f\n", name, people_db(flicker_response(q, &a)),
               people_db(residue(q, &a, FLICKER)));
    }
}

static void print_list(const wf_filters_query *q) {
    const wf_aperture_kind *kind;
    printf("%-20s %-5s %-10s %s\n", "name", "width", "reach",
           "shape, and where the paper has it");
    for (size_t i = 0; (kind = wf_aperture_at(i)); i++) {
        char name[64], reach[48];
        snprintf(name, sizeof name, "%s%s%s", kind->name, kind->follows ? ":" : "",
                 kind->follows ? kind->follows : "");
        snprintf(reach, sizeof reach, "%gpx x %gl", kind->reach_u, kind->reach_v);
        printf("%-20s %-5g %-10s %s%s%s\n", name, wf_ratio_value(kind->default_width), reach,
               kind->shape, *kind->paper ? ", " : "", kind->paper);
    }
    puts("\nwidth: of the window in time unless --temporal-width says otherwise, in field "
         "periods.\n"
         "reach: to each side, in pixels and frame lines. 'weft filters NAME' shows the "
         "frequency\n"
         "response of one.");
    if (q->input_lines) print_residues(q);
}

void wf_filters_print(const wf_filters_query *query) {
    (query->name ? print_response : print_list)(query);
}

/* ---- For programs ---- */

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
    wf_json_real(json, "frequency", FLICKER);
    add_pair(json, "closed_form", flicker_response(q, a));
    add_pair(json, "weights", residue(q, a, FLICKER));
    wf_json_close(json);
}

static void add_response(wf_json *json, const wf_filters_query *q) {
    add_aperture(json, q, q->name, &q->aperture);
    if (q->designed) wf_filters_add_design(json, q);
    wf_json_open(json, "response", '[');
    for (int step = 0; step <= STEPS; step++) {
        response r = respond(q, step);
        wf_json_open(json, NULL, '{');
        wf_json_real(json, "frequency", r.f);
        add_pair(json, "vertical", r.vertical);
        add_pair(json, "horizontal", r.horizontal);
        add_pair(json, "temporal", r.temporal);
        if (q->input_lines) add_pair(json, "weights", r.weights);
        wf_json_close(json);
    }
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
}

weft_status wf_filters_print_json(const wf_filters_query *query, weft_error *err) {
    wf_json json = {0};
    wf_json_open(&json, NULL, '{');
    (query->name ? add_response : add_list)(&json, query);
    return wf_cmd_print_json(wf_json_finish(&json), err);
}
