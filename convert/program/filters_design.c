/* Part of weft filters: what a designed aperture was wished to be, how it came out, and the
 * proof that nothing does better, as text and as JSON. */
#include <math.h>
#include <stdio.h>

#include "convert/program/filters_print.h"
#include "filters/aperture/flicker.h"

static void print_wish(const wf_design_wish *w) {
    printf("\nDesigned: %g lines to each side, %g px wide; overshoot at most %.4g %%, "
           "aliases at most %g;\n",
           w->support, w->width, 100 * w->overshoot, w->alias);
    if (w->flicker > 0)
        printf("flicker at most %g; the sharpest at %g cycles/line\n\n", w->flicker, w->at[0]);
    for (int i = 0; i < w->sharps; i++)
        printf("%sat least %g at %g cycles/line", i ? ", " : "", w->sharp[i], w->at[i]);
    if (w->sharps) printf("; the least flicker\n\n");
}

static void print_row(const char *what, double value, const char *note) {
    printf("%-48s %9.5f%s\n", what, fabs(value) < 5e-6 ? 0 : value, note);
}

/* What the duality gap proves depends on the kind of wish (filters/aperture/design.h). */
static void print_proof(const wf_filters_query *q) {
    const wf_design *d = &q->design;
    double least = sqrt(fmax(d->flicker * d->flicker - d->gap - d->slack, 0));
    double at = q->wish.at[0], most = wf_stairs_response(&d->stairs, at) + d->gap + d->slack;
    printf("\nNothing within these limits ");
    if (d->sharpest)
        printf("that flickers no more responds by more than %.5f at %g cycles/line\n"
               "(that flickers as much as was wished: %.5f)",
               most, at, most + d->spare);
    else if (!q->wish.sharps)
        printf("that is as sharp at %g cycles/line flickers less than %.6f\n", at, least);
    else
        printf("flickers less than %.6f\n", least);
    printf("%sand passes less than twice the noise:\nthe duality gap is %.1e of %s, after %d "
           "iterations in %d quadratic program%s.\n",
           d->sharpest ? " " : "", d->gap, d->sharpest ? "response" : "flicker squared",
           d->iterations, d->programs, d->programs > 1 ? "s" : "");
}

void wf_filters_print_design(const wf_filters_query *q) {
    const wf_design *d = &q->design;
    print_wish(&q->wish);
    print_row("response at 0.125 cycles/line", wf_stairs_response(&d->stairs, 0.125), "");
    print_row("response at 0.25", wf_stairs_response(&d->stairs, 0.25), "");
    for (int i = 0; i < q->wish.sharps || i == 0; i++) {
        char what[64];
        snprintf(what, sizeof what, "response at %g", q->wish.at[i]);
        if (q->wish.at[i] != 0.25 && q->wish.at[i] != 0.125)
            print_row(what, wf_stairs_response(&d->stairs, q->wish.at[i]), "");
    }
    print_row("least response beyond 0.25", d->least, "");
    print_row("response at 0.5, either sign", d->zero, "");
    print_row("largest response beyond 0.5, either sign", d->alias, "");
    print_row("overshoot of a step", d->overshoot, "");
    print_row("noise that passes, the line's being 1",
              wf_stairs_power(&d->stairs) / q->wish.width, "");
    print_row("flicker of the still zone plate, RMS", d->flicker, "");
    print_proof(q);
}
