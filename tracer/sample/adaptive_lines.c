/* Integrates cells whose edge is known, over lines along the axis that it stands most across.
 */
#include "tracer/sample/adaptive_lines.h"

#include <math.h>

#include "tracer/sample/adaptive_points.h"

typedef struct emitter {
    const wf_adaptive *a;
    wf_adaptive_samples *to;
    int at, axis, pieces;
    double weight; /* of a line */
} emitter;

/* A sample in each of the pieces of a stretch. */
static void emit_stretch(const emitter *m, const double rgb[3][4], double *p, double from,
                         double to, double share) {
    for (int k = 0; k < m->pieces; k++) {
        p[m->axis] = from + (to - from) * (k + share) / m->pieces;
        size_t n = wf_points_place(m->a, m->to, m->at, p);
        for (int c = 0; c < 3; c++) m->to->rgb[c][n] = (float)wf_edge_color(rgb[c], p);
        m->to->weight[n] = (float)(m->weight * (to - from) / m->pieces);
    }
}

/* Along each line the color changes where the plane is. */
static void emit_line(const emitter *m, const wf_adaptive_edge *edge, double *p) {
    double share = p[m->axis], n = edge->n[m->axis];
    p[m->axis] = 0;
    double at = fmin(fmax((edge->d - wf_dot(edge->n, p)) / n, 0), 1);
    if (at > 0) emit_stretch(m, edge->rgb[n < 0], p, 0, at, share);
    if (at < 1) emit_stretch(m, edge->rgb[n > 0], p, at, 1, share);
}

static bool emit_cell(const wf_adaptive *a, int at) {
    const wf_adaptive_edge *edge = &a->edge[at];
    wf_adaptive_samples *to = &a->c->probes;
    int pieces = wf_edge_pieces(&a->s->desc.gather.aperture);
    emitter m = {a, to, at, wf_axis_across(edge->n), pieces, 1.0 / edge->lines};
    float place[3][WF_MOST_LINES];
    to->count = 0;
    if (!wf_points_reserve(to, 2 * (size_t)(pieces * edge->lines))) return false;
    wf_points_even(a, at, edge->lines, (float *[3]){place[0], place[1], place[2]});
    for (int n = 0; n < edge->lines; n++) {
        double p[3] = {(double)place[0][n], (double)place[1][n], (double)place[2][n]};
        emit_line(&m, edge, p);
    }
    wf_points_hand_over(a, to);
    return true;
}

bool wf_edges_emit(const wf_adaptive *a) {
    for (int at = 0; at < GRID_CELLS; at++)
        if (a->cell[at].own && a->edge[at].found && !emit_cell(a, at)) return false;
    return true;
}
