/* Programs of solids along packets of rays. */
#include <math.h>
#include <string.h>

#include "filters/base/isa_file.h"
#include "tracer/rays/csg.h"

static inline double least(double a, double b) {
    return a < b ? a : b;
}

static inline double most(double a, double b) {
    return a > b ? a : b;
}

/* ---- Programs over bytes ---- */

static void hold(const wf_runs *r, const double *s, int places, uint8_t *in) {
    for (int i = 0; i < places; i++) {
        bool first = (r->in[0][i] < s[i]) & (s[i] < r->out[0][i]);
        bool second = (r->in[1][i] < s[i]) & (s[i] < r->out[1][i]);
        in[i] = first | second;
    }
}

static void unite(uint8_t *to, const uint8_t *with, int places) {
    for (int i = 0; i < places; i++) to[i] |= with[i];
}

static void intersect(uint8_t *to, const uint8_t *with, int places) {
    for (int i = 0; i < places; i++) to[i] &= with[i];
}

static void subtract(uint8_t *to, const uint8_t *with, int places) {
    for (int i = 0; i < places; i++) to[i] &= with[i] ^ 1;
}

typedef void combine_fn(uint8_t *to, const uint8_t *with, int places);
static combine_fn *const combine[] = {[WF_STEP_UNION] = unite,
                                      [WF_STEP_INTERSECTION] = intersect,
                                      [WF_STEP_DIFFERENCE] = subtract};

/* Evaluates the program at s of each ray; the result is at the stack's bottom. */
static void evaluate(const wf_csg *c, const double *s, wf_csg_entry *stack) {
    wf_csg_entry *top = stack;
    int places = wf_places(c->count);
    for (int k = 0; k < c->step_count; k++) {
        const wf_step *step = &c->steps[k];
        if (step->kind == WF_STEP_SOLID) {
            hold(&c->runs[step->count], s, places, top++->in);
            continue;
        }
        wf_csg_entry *first = top - step->count;
        for (wf_csg_entry *next = first + 1; next < top; next++)
            combine[step->kind](first->in, next->in, places);
        top = first + 1;
    }
}

/* ---- Programs over intervals: where the whole can be at all ---- */

static void span(const wf_runs *r, int places, wf_csg_entry *e) {
    for (int i = 0; i < places; i++) {
        e->from[i] = least(r->in[0][i], r->in[1][i]);
        e->to[i] = most(r->out[0][i], r->out[1][i]);
    }
}

static void reach(wf_csg_entry *to, const wf_csg_entry *with, int places, wf_step_kind kind) {
    bool wider = kind == WF_STEP_UNION;
    for (int i = 0; i < places; i++) {
        double from[2] = {most(to->from[i], with->from[i]), least(to->from[i], with->from[i])};
        double end[2] = {least(to->to[i], with->to[i]), most(to->to[i], with->to[i])};
        to->from[i] = wider ? from[1] : from[0];
        to->to[i] = wider ? end[1] : end[0];
    }
}

static void find_span(const wf_csg *c, wf_csg_entry *stack) {
    wf_csg_entry *top = stack;
    int places = wf_places(c->count);
    for (int k = 0; k < c->step_count; k++) {
        const wf_step *step = &c->steps[k];
        if (step->kind == WF_STEP_SOLID) {
            span(&c->runs[step->count], places, top++);
            continue;
        }
        wf_csg_entry *first = top - step->count;
        for (wf_csg_entry *next = first + 1; next < top && step->kind != WF_STEP_DIFFERENCE;
             next++)
            reach(first, next, places, step->kind);
        top = first + 1;
    }
}

/* Widens the spans by what rounding may have taken, ends them where something is nearer, and
 * says whether anything is left of any. */
static bool open_spans(wf_csg_entry *e, const double *rounding, int places,
                       const wf_hits *hits) {
    double any = -1;
    for (int i = 0; i < places; i++) {
        double best = hits->s[i], from = e->from[i], to = e->to[i];
        double apart = rounding[i] + (best < HUGE_VAL ? best : 0) * WF_ROUNDING;
        bool some = from < to;
        from -= rounding[i] + fabs(from) * WF_ROUNDING;
        to += rounding[i] + fabs(to) * WF_ROUNDING;
        to = least(to, best + apart);
        some = some & (from <= to) & (to > 0);
        e->from[i] = some ? from : HUGE_VAL;
        e->to[i] = some ? to : -HUGE_VAL;
        any = some ? 1 : any;
    }
    return any > 0;
}

/* ---- Surfaces ---- */

typedef struct candidate {
    _Alignas(64) double before[WF_PACKET], after[WF_PACKET];
    _Alignas(64) uint8_t could[WF_PACKET], inside_before[WF_PACKET];
} candidate;

/* Where the end of a run of a solid could be nearest, and whether anywhere. Of ends as near as
 * rounding can tell, the solid's that comes first counts, whatever the order of asking. */
static bool could_be_nearest(const double *s, const double *rounding, const double *from,
                             const double *to, int solid, int places, const wf_hits *hits,
                             candidate *c) {
    uint8_t any = 0;
    for (int i = 0; i < places; i++) {
        double apart = rounding[i] + s[i] * WF_ROUNDING, best = hits->s[i];
        bool before = s[i] < best - apart;
        bool level = (s[i] <= best + apart) & (solid < hits->solid[i]);
        bool within = (s[i] > 0) & (s[i] < HUGE_VAL) & (s[i] >= from[i]) & (s[i] <= to[i]);
        uint8_t could = within & (before | level);
        c->could[i] = could;
        c->before[i] = s[i] - apart;
        c->after[i] = s[i] + apart;
        any |= could;
    }
    return any;
}

static void take(const double *s, int solid, int places, const candidate *c,
                 const uint8_t *after, wf_hits *hits) {
    for (int i = 0; i < places; i++) {
        bool surface = c->could[i] & (c->inside_before[i] ^ after[i]);
        hits->s[i] = surface ? s[i] : hits->s[i];
        hits->solid[i] = surface ? solid : hits->solid[i];
        hits->entering[i] = surface ? after[i] : hits->entering[i];
    }
}

static void try_end(const wf_csg *csg, int which, const double *s, const double *rounding,
                    wf_csg_entry *stack, wf_hits *hits) {
    candidate c;
    int solid = csg->solid[which], places = wf_places(csg->count);
    if (!could_be_nearest(s, rounding, stack->from, stack->to, solid, places, hits, &c)) return;
    evaluate(csg, c.before, stack);
    memcpy(c.inside_before, stack->in, (size_t)places);
    evaluate(csg, c.after, stack);
    take(s, solid, places, &c, stack->in, hits);
}

static void nearest(const wf_csg *c, const double *rounding, wf_csg_entry *stack,
                    wf_hits *hits) {
    find_span(c, stack);
    if (!open_spans(stack, rounding, wf_places(c->count), hits)) return;
    for (int which = 0; which < c->solid_count; which++)
        for (int run = 0; run < 2; run++) {
            try_end(c, which, c->runs[which].in[run], rounding, stack, hits);
            try_end(c, which, c->runs[which].out[run], rounding, stack, hits);
        }
}

static void inside(const wf_csg *c, const double *s, wf_csg_entry *stack, uint8_t *in) {
    evaluate(c, s, stack);
    memcpy(in, stack->in, (size_t)wf_places(c->count));
}

const wf_csg_ops WF_ISA_TABLE(wf_csg_ops) = {nearest, inside};
