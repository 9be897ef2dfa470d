#include "tracer/csg.h"

#include <math.h>
#include <string.h>

void wf_hits_clear(wf_hits *hits, int count) {
    for (int i = 0; i < count; i++) {
        hits->s[i] = HUGE_VAL;
        hits->object[i] = hits->solid[i] = -1;
        hits->entering[i] = 0;
    }
}

/* ---- Programs over bytes ---- */

static void hold(const wf_runs *r, const double *s, uint8_t *in, int count) {
    for (int i = 0; i < count; i++) {
        bool first = (r->in[0][i] < s[i]) & (s[i] < r->out[0][i]);
        bool second = (r->in[1][i] < s[i]) & (s[i] < r->out[1][i]);
        in[i] = first | second;
    }
}

static void unite(uint8_t *to, const uint8_t *with) {
    for (int i = 0; i < WF_PACKET; i++) to[i] |= with[i];
}

static void intersect(uint8_t *to, const uint8_t *with) {
    for (int i = 0; i < WF_PACKET; i++) to[i] &= with[i];
}

static void subtract(uint8_t *to, const uint8_t *with) {
    for (int i = 0; i < WF_PACKET; i++) to[i] &= with[i] ^ 1;
}

typedef void combine_fn(uint8_t *to, const uint8_t *with);
static combine_fn *const combine[] = {[WF_STEP_UNION] = unite,
                                      [WF_STEP_INTERSECTION] = intersect,
                                      [WF_STEP_DIFFERENCE] = subtract};

/* Evaluates the program at s of each ray; the result is at the stack's bottom. */
static void evaluate(const wf_csg *c, const double *s, uint8_t *stack, int count) {
    uint8_t *top = stack;
    for (int k = 0; k < c->step_count; k++) {
        const wf_step *step = &c->steps[k];
        if (step->kind == WF_STEP_SOLID) {
            hold(&c->runs[step->count], s, top, count);
            top += WF_PACKET;
            continue;
        }
        uint8_t *first = top - (ptrdiff_t)step->count * WF_PACKET;
        for (uint8_t *next = first + WF_PACKET; next < top; next += WF_PACKET)
            combine[step->kind](first, next);
        top = first + WF_PACKET;
    }
}

/* ---- Surfaces ---- */

/* The end of a run as a candidate: where it could be nearest, whether anywhere. */
static bool could_be_nearest(const double *s, const double *rounding, const wf_hits *hits,
                             int count, uint8_t *could) {
    uint8_t any = 0;
    for (int i = 0; i < count; i++) {
        could[i] = (s[i] > 0) & (s[i] < hits->s[i] - rounding[i]);
        any |= could[i];
    }
    return any;
}

typedef struct sides {
    _Alignas(64) double before[WF_PACKET], after[WF_PACKET];
} sides;

static void take(const wf_csg *c, int which, const double *s, const uint8_t *could,
                 const uint8_t *before, const uint8_t *after, int count, wf_hits *hits) {
    for (int i = 0; i < count; i++) {
        if (!could[i] || before[i] == after[i]) continue;
        hits->s[i] = s[i];
        hits->object[i] = c->object;
        hits->solid[i] = c->solid[which];
        hits->entering[i] = after[i];
    }
}

static void try_end(const wf_csg *c, int which, const double *s, int count,
                    const double *rounding, uint8_t *stack, wf_hits *hits) {
    uint8_t could[WF_PACKET], before[WF_PACKET];
    sides beside;
    if (!could_be_nearest(s, rounding, hits, count, could)) return;
    for (int i = 0; i < count; i++) {
        beside.before[i] = s[i] - rounding[i];
        beside.after[i] = s[i] + rounding[i];
    }
    evaluate(c, beside.before, stack, count);
    memcpy(before, stack, sizeof before);
    evaluate(c, beside.after, stack, count);
    take(c, which, s, could, before, stack, count, hits);
}

void wf_csg_nearest(const wf_csg *c, int count, const double *rounding, uint8_t *stack,
                    wf_hits *hits) {
    for (int which = 0; which < c->solid_count; which++)
        for (int run = 0; run < 2; run++) {
            try_end(c, which, c->runs[which].in[run], count, rounding, stack, hits);
            try_end(c, which, c->runs[which].out[run], count, rounding, stack, hits);
        }
}

void wf_csg_inside(const wf_csg *c, int count, const double *s, uint8_t *stack,
                   uint8_t *inside) {
    evaluate(c, s, stack, count);
    memcpy(inside, stack, (size_t)count);
}
