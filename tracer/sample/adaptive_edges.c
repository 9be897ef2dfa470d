/* Cells that one edge crosses. Where a cell shows two colors, and what parts them in x, y and
 * time is nearly a plane, rays that close in on that plane say far more than others: it is
 * looked for near the cell's own edges and in the middle between. The two sides are then
 * integrated over lines (adaptive_lines.c). Whatever does not fit, a third color, a corner or a
 * curve, leaves the cell to points. */
#include "tracer/sample/adaptive_edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/sample/adaptive_lines.h"
#include "tracer/sample/adaptive_packets.h"
#include "tracer/sample/adaptive_points.h"
#include "tracer/sample/adaptive_sides.h"

/* How far on the wrong side of the plane a sample may lie: edges are curved. */
#define BENT 0.05

/* How far the sides may overlap before anything is known but the samples. */
#define OVERLAP 0.5

/* How far from the plane an edge is looked for at first, and once it was found. */
#define WIDE   0.4
#define NARROW 0.06

/* How small the stretch in which it is known to lie has to become at first, and at best. */
#define ROUGH  0.1
#define FINEST 0x1p-11

/* How far supports are drawn in towards the middle: at its very ends an edge may have left the
 * cell. */
#define DRAWN_IN 0.15

#define FIRST_LINES 16

/* What the lines that a cell is integrated over may add, of the error it may have. */
#define LINES_SHARE 0.125

/* The stretch in which an edge is known to lie is cut into so many parts at once, so that
 * packets are filled. */
#define PARTS 4

/* ---- The plane ---- */

/* Fisher's discriminant of the samples of both sides. */
static void find_normal(wf_seeker *e) {
    wf_side_sums side[2];
    double m[3][3];
    for (int k = 0; k < 2; k++) wf_sum_side(e, k, &side[k]);
    double all = side[0].count + side[1].count;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++)
            m[r][c] =
                (side[0].count * side[0].pp[r][c] + side[1].count * side[1].pp[r][c]) / all;
        m[r][r] += WF_FLAT;
        e->n[r] = side[1].p[r] - side[0].p[r];
    }
    wf_solve(m, e->n);
    double size = sqrt(wf_dot(e->n, e->n));
    e->lost |= !(size > 0);
    for (int k = 0; k < 3 && !e->lost; k++) e->n[k] /= size;
}

/* Between the last sample of the first side and the first one of the second, which may overlap
 * by no more than a curve explains. */
static void find_offset(wf_seeker *e) {
    double low = -HUGE_VAL, high = HUGE_VAL;
    for (const wf_seen *v = e->first; v < e->end; v++) {
        double along = wf_dot(e->n, v->p);
        if (v->side)
            high = fmin(high, along);
        else
            low = fmax(low, along);
    }
    e->d = (low + high) / 2;
    e->lost |= low - high > OVERLAP;
}

/* Where the plane meets the edges of the cell. */
static void find_vertices(const wf_seeking *s, wf_seeker *e) {
    e->supports = 0;
    for (int axis = 0; axis < s->dims; axis++)
        for (int corner = 0; corner < 1 << (s->dims - 1); corner++) {
            double p[3] = {0};
            for (int k = 0, bit = 0; k < s->dims; k++)
                if (k != axis) p[k] = corner >> bit++ & 1;
            p[axis] = (e->d - wf_dot(e->n, p)) / e->n[axis];
            if (p[axis] >= 0 && p[axis] <= 1) memcpy(e->support[e->supports++].at, p, sizeof p);
        }
    e->lost |= e->supports < s->dims;
}

static void find_supports(const wf_seeking *s, wf_seeker *e) {
    double middle[3] = {0};
    e->axis = wf_axis_across(e->n);
    find_vertices(s, e);
    for (int n = 0; n < e->supports; n++)
        for (int k = 0; k < 3; k++) middle[k] += e->support[n].at[k] / e->supports;
    for (int n = 0; n < e->supports; n++)
        for (int k = 0; k < 3; k++)
            e->support[n].at[k] += DRAWN_IN * (middle[k] - e->support[n].at[k]);
    memcpy(e->support[e->supports++].at, middle, sizeof middle);
}

static double found_at(const wf_support *f) {
    return (f->low + f->high) / 2;
}

/* Whether there are enough supports to fit a plane, and whether that without the middle. */
static bool enough(const wf_seeking *s, const wf_seeker *e, bool *spare) {
    int found = 0;
    for (int n = 0; n < e->supports - 1; n++) found += e->support[n].found;
    *spare = found >= s->dims;
    return found + e->support[e->supports - 1].found >= s->dims;
}

/* Where the edge crosses its supports, as a plane over the other axes: least squares. The
 * middle has no part in it if there are enough others: how far it lies off tells the curve,
 * which adds two thirds of that over the cell. */
static void fit(const wf_seeking *s, wf_seeker *e) {
    const wf_support *middle = &e->support[e->supports - 1];
    double m[3][3] = {{0}}, b[3] = {0};
    int i = e->axis == 0, j = e->axis == 2 ? 1 : 2;
    bool spare;
    if (!enough(s, e, &spare)) {
        e->lost = true;
        return;
    }
    for (int n = 0; n < e->supports - spare; n++) {
        const wf_support *f = &e->support[n];
        double row[3] = {1, f->at[i] - middle->at[i], f->at[j] - middle->at[j]};
        for (int r = 0; r < 3 && f->found; r++) {
            for (int c = 0; c < 3; c++) m[r][c] += row[r] * row[c];
            b[r] += row[r] * found_at(f);
        }
    }
    for (int k = 1; k < 3; k++) m[k][k] += WF_FLAT * WF_FLAT;
    wf_solve(m, b);
    e->bend = spare && middle->found ? found_at(middle) - b[0] : 0;
    double sign = e->n[e->axis] < 0 ? -1 : 1;
    e->n[e->axis] = sign;
    e->n[i] = -sign * b[1];
    e->n[j] = -sign * b[2];
    e->d = sign * (b[0] + e->bend * 2 / 3 - b[1] * middle->at[i] - b[2] * middle->at[j]);
}

/* ---- Looking for it ---- */

/* The stretch of a support's line that lies within the cell and within reach. */
static void find_stretch(const wf_seeker *e, double reach, wf_support *f) {
    f->low = fmax(f->at[e->axis] - reach, 0);
    f->high = fmin(f->at[e->axis] + reach, 1);
    f->found = f->low < f->high;
}

/* Which supports rays are sent along: all, or those on which too little is known. Whether there
 * is any. */
static bool aim(wf_seeking *s, bool all) {
    bool any = false;
    for (int n = 0; n < s->count; n++) {
        wf_seeker *e = &s->seekers[n];
        for (wf_support *f = e->support; f < e->support + e->supports; f++) {
            f->asked = f->found && !e->lost && (all || f->high - f->low > e->narrow);
            any |= f->asked;
        }
    }
    return any;
}

static double cut_at(const wf_support *f, int part) {
    return f->low + (f->high - f->low) * part / PARTS;
}

/* Rays between the parts, and at both ends if these are not known yet. */
static bool place_rays(wf_seeking *s, bool ends) {
    wf_adaptive_samples *k = &s->a->c->probes;
    k->count = 0;
    for (int n = 0; n < s->count; n++) {
        const wf_seeker *e = &s->seekers[n];
        if (!wf_points_reserve(k, WF_MOST_SUPPORTS * (PARTS + 1))) return false;
        for (const wf_support *f = e->support; f < e->support + e->supports; f++) {
            double p[3] = {f->at[0], f->at[1], s->dims < 3 ? 0.5 : f->at[2]};
            for (int part = !ends; f->asked && part < PARTS + ends; part++) {
                p[e->axis] = cut_at(f, part);
                wf_points_place(s->a, k, e->at, p);
            }
        }
    }
    return true;
}

/* The ends of a stretch have to be of the sides that the plane says; the edge lies between the
 * last ray that saw the one and the first that saw the other. A third color, or one side behind
 * the other, and the cell is lost. */
static void learn(wf_seeker *e, wf_support *f, bool ends, const wf_adaptive_samples *k,
                  size_t first) {
    int from = !ends, to = PARTS + ends, beyond = to;
    for (int part = to - 1; part >= from; part--) {
        size_t n = first + (size_t)(part - from);
        int side = wf_side_of(
            e, (double[3]){(double)k->rgb[0][n], (double)k->rgb[1][n], (double)k->rgb[2][n]});
        bool over = side == (e->n[e->axis] > 0);
        e->lost |= side < 0 || (over && beyond != part + 1);
        if (over) beyond = part;
    }
    f->found = !ends || (beyond > 0 && beyond <= PARTS);
    double low = cut_at(f, beyond - 1), high = cut_at(f, beyond);
    f->low = low;
    f->high = high;
}

static bool look(wf_seeking *s, bool ends) {
    size_t at = 0;
    if (!place_rays(s, ends) || !wf_points_trace(s->a, &s->a->c->probes, 0)) return false;
    for (int n = 0; n < s->count; n++) {
        wf_seeker *e = &s->seekers[n];
        for (wf_support *f = e->support; f < e->support + e->supports; f++) {
            if (!f->asked) continue;
            learn(e, f, ends, &s->a->c->probes, at);
            at += ends ? PARTS + 1 : PARTS - 1;
        }
    }
    return true;
}

/* Looks for the edges where the planes are, and fits these to what it finds. */
static bool search(wf_seeking *s, double reach) {
    for (int n = 0; n < s->count; n++) {
        wf_seeker *e = &s->seekers[n];
        if (!e->lost) find_supports(s, e);
        if (e->lost) e->supports = 0;
        for (int i = 0; i < e->supports; i++) find_stretch(e, reach, &e->support[i]);
    }
    if (aim(s, true) && !look(s, true)) return false;
    while (aim(s, false))
        if (!look(s, false)) return false;
    for (int n = 0; n < s->count; n++)
        if (!s->seekers[n].lost) fit(s, &s->seekers[n]);
    return true;
}

/* ---- What came of it ---- */

/* Whether no sample lies farther on the wrong side than a curve explains. */
static bool agrees(const wf_seeker *e) {
    double most = BENT * sqrt(wf_dot(e->n, e->n));
    for (const wf_seen *v = e->first; v < e->end; v++) {
        double over = wf_dot(e->n, v->p) - e->d;
        if ((v->side ? -over : over) > most) return false;
    }
    return true;
}

/* How far the sides are apart on the display, to a pixel that is nearer to the darker one:
 * there the same error of light makes more difference. Squared. */
static double contrast_to_dark(const wf_seeker *e) {
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double a = e->mean[0][k], b = e->mean[1][k];
        double d = (b - a) * wf_display_steepness(0.75 * fmin(a, b) + 0.25 * fmax(a, b));
        square += d * d / 3;
    }
    return square;
}

/* Of what an aperture sees of one side of a cell's plane, by so many lines; squared: as lines
 * and scattered points were measured to do on random edges, the latter where the edge of the
 * aperture cuts the cell, too. */
static double lines_error(const wf_seeking *s, int lines) {
    double edge = 0.3 * pow(lines, -1.1), cut = 0;
    int pieces = wf_edge_pieces(&s->a->s->desc.gather.aperture);
    if (pieces > WF_FEW_PIECES) cut = wf_points_share_error(2.0 * pieces * lines);
    return edge * edge + cut;
}

/* So many lines that what they leave uncertain of a contrast stays below an error; both
 * squared.
 */
static int lines_for(const wf_seeking *s, double contrast, double error) {
    int lines = FIRST_LINES;
    contrast *= wf_adaptive_share(s->a);
    while (lines < WF_MOST_LINES && contrast * lines_error(s, lines) > error) lines *= 2;
    return lines;
}

/* What the edge does not explain of the cell's samples says how good it is. */
static void keep(wf_seeking *s, const wf_seeker *e) {
    double most = wf_adaptive_target(s->a), contrast = contrast_to_dark(e);
    wf_adaptive_edge *edge = &s->a->edge[e->at];
    memcpy(edge->n, e->n, sizeof edge->n);
    edge->d = e->d;
    for (int side = 0; side < 2; side++) {
        wf_side_sums sums;
        wf_sum_side(e, side, &sums);
        wf_fit_color(&sums, e->mean[side], edge->rgb[side]);
    }
    edge->lines = lines_for(s, contrast, most * LINES_SHARE);
    edge->error = wf_adaptive_share(s->a) * contrast * lines_error(s, edge->lines);
    edge->found = true;
}

/* ---- All of a tile ---- */

/* The samples of each cell in question, side by side; first: where each cell's begin, and the
 * end. */
static void sort_samples(wf_seeking *s, size_t *first) {
    const wf_adaptive_samples *k = &s->a->c->kept;
    size_t next[GRID_CELLS];
    memset(first, 0, (GRID_CELLS + 1) * sizeof *first);
    for (size_t n = 0; n < k->count; n++) {
        int at = k->cell[n] / WF_QUARTERS;
        if (s->a->more[at]) first[at + 1]++;
    }
    for (int at = 0; at < GRID_CELLS; at++) first[at + 1] += first[at];
    memcpy(next, first, sizeof next);
    for (size_t n = 0; n < k->count; n++) {
        int at = k->cell[n] / WF_QUARTERS;
        if (!s->a->more[at]) continue;
        wf_seen *v = &s->seen[next[at]++];
        v->p[0] = (double)k->x[n] - wf_cell_x(s->a, at);
        v->p[1] = (double)k->y[n] - wf_cell_y(s->a, at);
        v->p[2] = s->dims > 2 ? (double)k->fraction[n] : 0;
        for (int c = 0; c < 3; c++) v->rgb[c] = (double)k->rgb[c][n];
    }
}

/* Begins with the cell's own samples. */
static void begin(wf_seeker *e) {
    wf_find_colors(e);
    if (!e->lost) find_normal(e);
    if (!e->lost) find_offset(e);
}

/* Begins with the edge of a neighbor so many cells to the right and down, as it goes on. */
static void begin_with(wf_seeker *e, const wf_adaptive_edge *edge, int right, int down) {
    const double middle[3] = {0.5 - right, 0.5 - down, 0.5};
    memcpy(e->n, edge->n, sizeof e->n);
    e->d = edge->d + edge->n[0] * right + edge->n[1] * down;
    for (int side = 0; side < 2; side++)
        for (int c = 0; c < 3; c++)
            e->mean[side][c] = wf_edge_color(edge->rgb[side][c], middle);
    e->reach = wf_distance(e->mean[0], e->mean[1]);
    wf_find_sides(e);
}

/* Searches roughly at first, and then as finely as the contrast of the sides calls for. */
static bool seek(wf_seeking *s) {
    for (int n = 0; n < s->count; n++) s->seekers[n].narrow = ROUGH;
    if (!search(s, WIDE)) return false;
    for (int n = 0; n < s->count; n++) {
        wf_seeker *e = &s->seekers[n];
        double fine = 2 * s->a->s->desc.error / sqrt(contrast_to_dark(e));
        e->narrow = fmin(fmax(fine, FINEST), NARROW / 2);
    }
    if (!search(s, NARROW)) return false;
    for (int n = 0; n < s->count; n++) {
        const wf_seeker *e = &s->seekers[n];
        if (!e->lost && agrees(e)) keep(s, e);
    }
    return true;
}

void wf_edges_free(wf_edge_scratch *to) {
    free(to->seekers);
    free(to->seen);
    *to = (wf_edge_scratch){0};
}

static bool reserve_seen(wf_edge_scratch *to, size_t samples) {
    if (!to->seekers) to->seekers = malloc(GRID_CELLS * sizeof(wf_seeker));
    if (samples <= to->seen_capacity) return to->seekers;
    void *grown = realloc(to->seen, 2 * samples * sizeof(wf_seen));
    if (!grown) return false;
    to->seen = grown;
    to->seen_capacity = 2 * samples;
    return to->seekers;
}

/* A seeker for every cell in question. */
static bool begin_seeking(wf_adaptive *a, wf_seeking *s) {
    wf_edge_scratch *to = &a->c->edges;
    size_t first[GRID_CELLS + 1];
    if (!reserve_seen(to, a->c->kept.count)) return false;
    *s = (wf_seeking){
        .a = a, .dims = a->tile->timeless ? 2 : 3, .seekers = to->seekers, .seen = to->seen};
    sort_samples(s, first);
    for (int at = 0; at < GRID_CELLS; at++)
        if (a->more[at])
            s->seekers[s->count++] = (wf_seeker){
                .at = at, .first = s->seen + first[at], .end = s->seen + first[at + 1]};
    return true;
}

bool wf_edges_find(wf_adaptive *a) {
    wf_seeking s;
    if (!begin_seeking(a, &s)) return false;
    for (int n = 0; n < s.count; n++) {
        a->edge[s.seekers[n].at].tried = a->cell[s.seekers[n].at].each;
        begin(&s.seekers[n]);
    }
    return seek(&s);
}

/* Those beside a cell come before those across its corners. */
static const struct {
    int right, down;
} neighbors[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};

static void follow(wf_adaptive *a, wf_seeker *e) {
    a->edge[e->at].followed = e->lost = true;
    for (size_t k = 0; k < sizeof neighbors / sizeof *neighbors; k++) {
        int right = neighbors[k].right, down = neighbors[k].down;
        const wf_adaptive_edge *edge = wf_edge_coming(a, e->at, right, down);
        if (!edge) continue;
        e->lost = false;
        begin_with(e, edge, right, down * a->step);
        return;
    }
}

bool wf_edges_follow(wf_adaptive *a) {
    wf_seeking s;
    if (!begin_seeking(a, &s)) return false;
    for (int n = 0; n < s.count; n++) follow(a, &s.seekers[n]);
    return seek(&s);
}
