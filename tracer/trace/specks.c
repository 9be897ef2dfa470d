/* What is smaller than cells are, or thinner: where in the picture it may be seen, and how much
 * of it. Rays that look for it may all miss it; the scene knows that it is there. */
#include "tracer/trace/specks.h"

#include <math.h>

#include "tracer/trace/tracer_inside.h"

/* What covers more cells than this is seen by some of the first samples, unless it is so much
 * narrower than a cell. It is then cut into lengths of so many cells, at most so many. */
#define SMALL_AREA   2.0
#define NARROW       0.5
#define PIECE_LENGTH 2.0
#define MOST_PIECES  32

/* The part of the shadow of a box that a round solid in it covers. */
#define OF_BOX 0.6

/* A box in the picture at one instant: its middle and what halves of its edges become. */
typedef struct outline {
    double middle[2], edge[3][2];
} outline;

#define MOST_INSTANTS 3

/* ---- Projection ---- */

static double time_of(const wf_tracer *t, const wf_op *op, double f) {
    const wf_window_of_time *w = &t->window;
    double width = op->own_width ? op->width_fields : w->width_fields;
    return (f - w->anchor) * width * t->view.field_period_s + f * w->late_s;
}

/* From a solid's canonical space to that of the camera, at fraction f of the window. */
static wf_affine to_camera(const wf_tracer *t, const wf_solid *solid, double f) {
    wf_affine out = solid->place, back = wf_identity();
    for (int op = solid->op; op >= 0; op = t->scene->ops[op].outer) {
        wf_affine map = wf_op_at(&t->ops[op], time_of(t, &t->scene->ops[op], f));
        out = wf_compose(&map, &out);
    }
    for (int op = t->scene->camera.op; op >= 0; op = t->scene->ops[op].outer) {
        wf_affine map = wf_op_inverse_at(&t->ops[op], time_of(t, &t->scene->ops[op], f));
        back = wf_compose(&back, &map);
    }
    return wf_compose(&back, &out);
}

static double dot(wf_vec a, wf_vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Where on the raster a point of the camera's space is seen; false: not before the eye. */
static bool project(const wf_tracer *t, wf_vec p, double at[2]) {
    const wf_camera *c = &t->scene->camera;
    wf_vec from = {p.x - c->eye.x, p.y - c->eye.y, p.z - c->eye.z};
    double far = c->orthographic ? 1 : dot(from, c->forward), size = c->half_height * far;
    if (!(size > 0)) return false;
    at[0] =
        (dot(from, c->right) / size * t->view.lines / t->view.pixel_aspect + t->view.width_px) /
        2;
    at[1] = (1 - dot(from, c->up) / size) * t->view.lines / 2;
    return true;
}

static bool outline_at(const wf_tracer *t, const wf_solid *solid, const wf_bounds *box,
                       double f, outline *out) {
    wf_affine map = to_camera(t, solid, f);
    double middle[3], half[3];
    for (int k = 0; k < 3; k++) {
        middle[k] = (box->low[k] + box->high[k]) / 2;
        half[k] = (box->high[k] - box->low[k]) / 2;
    }
    wf_vec center = wf_apply(&map, (wf_vec){middle[0], middle[1], middle[2]});
    if (!project(t, center, out->middle)) return false;
    for (int k = 0; k < 3; k++) {
        wf_vec end = {center.x + map.m[0][k] * half[k], center.y + map.m[1][k] * half[k],
                      center.z + map.m[2][k] * half[k]};
        if (!project(t, end, out->edge[k])) return false;
        for (int i = 0; i < 2; i++) out->edge[k][i] -= out->middle[i];
    }
    return true;
}

/* ---- Sizes ---- */

static double cross(const double a[2], const double b[2]) {
    return fabs(a[0] * b[1] - a[1] * b[0]);
}

static double area_of(const outline *o) {
    return 4 * OF_BOX *
           (cross(o->edge[0], o->edge[1]) + cross(o->edge[1], o->edge[2]) +
            cross(o->edge[2], o->edge[0]));
}

static int longest_of(const outline *o) {
    int longest = 0;
    for (int k = 1; k < 3; k++)
        if (hypot(o->edge[k][0], o->edge[k][1]) >
            hypot(o->edge[longest][0], o->edge[longest][1]))
            longest = k;
    return longest;
}

/* Into how many pieces something is cut; 0: it is not small. */
static int pieces_of(const outline *o, int longest) {
    double length = 2 * hypot(o->edge[longest][0], o->edge[longest][1]), area = area_of(o);
    bool narrow = area < NARROW * length;
    if (!(area > 0) || (area > SMALL_AREA && !narrow)) return 0;
    return (int)fmin(fmax(ceil(length / PIECE_LENGTH), 1), MOST_PIECES);
}

/* ---- Light ---- */

static double brightest(const wf_material *m) {
    double most = m->unlit ? 0 : 1;
    for (int k = 0; k < 3 && m->unlit; k++) {
        most = fmax(most, (double)m->color[k]);
        if (m->texture.kind == WF_TEXTURE_NONE) continue;
        most = fmax(most, fmax((double)m->texture.color[0][k], (double)m->texture.color[1][k]));
    }
    return most;
}

/* ---- Telling ---- */

/* The box that holds a piece of something at all instants. */
static wf_trace_speck piece_of(const outline *o, int instants, int longest, int piece,
                               int pieces) {
    wf_trace_speck s = {.x = {HUGE_VAL, -HUGE_VAL}, .y = {HUGE_VAL, -HUGE_VAL}};
    double along = (2.0 * piece + 1) / pieces - 1;
    for (int n = 0; n < instants; n++) {
        double middle[2], half[2] = {0, 0};
        for (int i = 0; i < 2; i++) {
            middle[i] = o[n].middle[i] + along * o[n].edge[longest][i];
            for (int k = 0; k < 3; k++)
                half[i] += fabs(o[n].edge[k][i]) / (k == longest ? pieces : 1);
        }
        s.x[0] = fmin(s.x[0], middle[0] - half[0]);
        s.x[1] = fmax(s.x[1], middle[0] + half[0]);
        s.y[0] = fmin(s.y[0], middle[1] - half[1]);
        s.y[1] = fmax(s.y[1], middle[1] + half[1]);
        s.area += area_of(&o[n]) / pieces / instants;
    }
    return s;
}

static void tell_solid(const wf_tracer *t, int index, wf_trace_see_speck *see, void *user) {
    const wf_solid *solid = &t->scene->solids[index];
    wf_bounds box = wf_solid_type_of(solid->kind)->bounds(solid, t->scene->planes);
    bool moves = wf_op_moves(t->scene, solid->op) || wf_op_moves(t->scene, t->scene->camera.op);
    int instants = moves ? MOST_INSTANTS : 1;
    outline o[MOST_INSTANTS];
    if (!wf_bounds_finite(&box)) return;
    for (int n = 0; n < instants; n++)
        if (!outline_at(t, solid, &box, moves ? n / (MOST_INSTANTS - 1.0) : 0.5, &o[n])) return;
    int longest = longest_of(&o[instants / 2]), pieces = pieces_of(&o[instants / 2], longest);
    for (int piece = 0; piece < pieces; piece++) {
        wf_trace_speck speck = piece_of(o, instants, longest, piece, pieces);
        speck.light = brightest(&t->scene->materials[solid->material]);
        see(user, &speck);
    }
}

void wf_trace_specks(const wf_tracer *t, const wf_trace_scratch *s, wf_trace_see_speck *see,
                     void *user) {
    if (!s->tile_few) return;
    for (size_t n = 0; n < s->tile.part_count; n++) {
        const wf_culled *part = &s->tile.part[n];
        for (int k = 0; k < part->solid_count; k++)
            tell_solid(t, s->tile.solid[part->solid + (size_t)k], see, user);
    }
}
