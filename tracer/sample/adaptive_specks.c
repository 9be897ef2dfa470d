/* Cells in which the scene says that there may be something that first samples can miss. They
 * begin with so many that it is seen, in them or in those about them. */
#include "tracer/sample/adaptive_specks.h"

#include <math.h>

#include "tracer/sample/adaptive_pool.h"
#include "tracer/trace/specks.h"

/* About how many samples of the cells about a cell are to see what is in it. */
#define SIGHTS 6

/* Where less than so many cells of it are about a cell, and it keeps to so many, that cell is
 * alone with what it holds. */
#define ALONE 0.25
#define KEPT  12.0

/* What makes no difference on the display if it is missed, of the error asked for: where cells
 * are alone, which then are too dark, and where others tell. */
#define SLIGHT_ALONE 0.03
#define SLIGHT       0.1

/* What of a cell a pixel shows. */
#define SHOWN 0.5

/* Shares of cells that small things cover, those that keep to few cells, and their light. */
typedef struct sight {
    const wf_adaptive *a;
    double share[GRID_CELLS], kept[GRID_CELLS], light[GRID_CELLS];
} sight;

/* How much of low..high lies in the unit interval at a place. */
static double overlap(const double ends[2], int at) {
    return fmax(fmin(ends[1], at + 1) - fmax(ends[0], at), 0);
}

/* Rows or columns first..last of count, counted from `from`, that low..high touches. */
static void find_touched(const double ends[2], int from, int count, int *first, int *last) {
    *first = (int)fmin(fmax(floor(ends[0]) - from, 0), count);
    *last = (int)fmax(fmin(floor(ends[1]) - from, count - 1), -1);
}

static void see(void *user, const wf_trace_speck *s) {
    sight *g = user;
    double size = fmax(s->x[1] - s->x[0], 1e-6) * fmax(s->y[1] - s->y[0], 1e-6);
    int left, right, top, bottom;
    find_touched(s->x, wf_cell_x(g->a, 0), GRID_WIDTH, &left, &right);
    find_touched(s->y, wf_cell_y(g->a, 0), GRID_ROWS, &top, &bottom);
    for (int row = top; row <= bottom; row++)
        for (int at = row * GRID_WIDTH + left; at <= row * GRID_WIDTH + right; at++) {
            double part =
                overlap(s->x, wf_cell_x(g->a, at)) * overlap(s->y, wf_cell_y(g->a, at));
            double share = fmin(s->area * part / size, 1);
            g->share[at] += share;
            g->kept[at] += size < KEPT ? share : 0;
            g->light[at] += share * s->light;
        }
}

/* All that is in the cells about one, itself included. */
static double share_about(const sight *g, int at) {
    double sum = 0;
    for (int down = -2; down <= 2; down++)
        for (int right = -2; right <= 2; right++) {
            const wf_adaptive_cell *c = wf_cell_beside(g->a, at, right, down);
            if (c) sum += g->share[c - g->a->cell];
        }
    return sum;
}

/* How far what is in a cell is from what is about it, on the display. */
static double contrast_of(const sight *g, int at) {
    const wf_adaptive_cell *c = &g->a->cell[at];
    double light = g->light[at] / g->share[at], most = 0;
    for (int k = 0; k < 3; k++) most = fmax(most, fmax(light, c->mean[k]) * c->steep[k]);
    return most;
}

/* Enough to see something of what is about the cell, and no more than it takes if samples are
 * scattered: the variance of N that see a share p is p / N. */
static int first_each(const sight *g, int at, double about, double contrast) {
    double most = g->a->s->desc.error * WF_FIRST_CAUTION;
    double needed =
        contrast * contrast * g->share[at] * wf_adaptive_share(g->a) / (most * most);
    int each = 1;
    while (each < WF_MOST_EACH / 2 && WF_QUARTERS * each < fmin(SIGHTS / about, needed))
        each *= 2;
    return each;
}

void wf_specks_find(wf_adaptive *a) {
    sight g = {.a = a};
    wf_trace_specks(a->s->tracer, a->c->trace, see, &g);
    for (int at = 0; at < GRID_CELLS; at++) {
        wf_adaptive_cell *c = &a->cell[at];
        if (!c->own || !(g.share[at] > 0)) continue;
        double about = share_about(&g, at), contrast = contrast_of(&g, at);
        double missed = g.share[at] * contrast * SHOWN / a->s->desc.error;
        c->rare = g.kept[at] > 0 && about < ALONE && missed > SLIGHT_ALONE;
        c->first = c->rare || missed > SLIGHT ? first_each(&g, at, about, contrast) : 0;
    }
}
