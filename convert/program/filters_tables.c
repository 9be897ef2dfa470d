/* Part of weft filters: the list of apertures and the response of one, as tables. */
#include <math.h>
#include <stdio.h>

#include "convert/program/filters_print.h"
#include "filters/aperture/flicker.h"

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

static void print_response(const wf_filters_query *q) {
    const wf_aperture *a = &q->aperture;
    print_header(q);
    for (int step = 0; step <= WF_FILTERS_STEPS; step++) {
        wf_filters_row r = wf_filters_respond(q, step);
        printf("%5.2f", r.f);
        print_pair(r.vertical);
        print_pair(r.horizontal);
        print_pair(r.temporal);
        if (q->input_lines) print_pair(r.weights);
        putchar('\n');
    }
    if (q->input_lines)
        printf("\n%s at %.1f cycles/line: closed form %.2f dB, %d lines to %d leave %.2f dB\n",
               q->name, WF_FILTERS_FLICKER, people_db(wf_filters_flicker(q, a)), q->input_lines,
               q->raster.lines, people_db(wf_filters_residue(q, a, WF_FILTERS_FLICKER)));
    if (q->designed)
        wf_filters_print_design(q);
    else
        printf("\nflicker of the still zone plate: %.4f RMS\n", wf_aperture_flicker(a));
}

static void print_residues(const wf_filters_query *q) {
    const wf_aperture_kind *kind;
    printf("\nAt %.1f cycles/line, %d lines to the %d of %s:\n\n%-22s %14s %14s\n",
           WF_FILTERS_FLICKER, q->input_lines, q->raster.lines, q->raster.name, "name",
           "closed form dB", "weights dB");
    for (size_t i = 0; (kind = wf_aperture_at(i)); i++) {
        char name[64];
        wf_aperture a = wf_filters_example(kind, name);
        printf("%-22s %14.2f %14.2f\n", name, people_db(wf_filters_flicker(q, &a)),
               people_db(wf_filters_residue(q, &a, WF_FILTERS_FLICKER)));
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
