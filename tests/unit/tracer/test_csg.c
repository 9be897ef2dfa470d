/* Programs of solids along rays: the nearest surface against walking along the ray, and the
 * identities of set algebra. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tracer/rays/csg.h"

#define MOST 8

static uint32_t draw(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* Runs with ends at whole numbers from -8 to 24, so that many coincide; some empty, some
 * endless. */
static void make_runs(wf_runs *runs, uint32_t *seed) {
    for (int i = 0; i < WF_PACKET; i++) {
        double at = (double)(draw(seed) % 12) - 8;
        for (int run = 0; run < 2; run++) {
            double in = at + draw(seed) % 6, out = in + 1 + draw(seed) % 8;
            bool none = draw(seed) % 4 == 0, endless = run == 1 && draw(seed) % 8 == 0;
            runs->in[run][i] = none ? HUGE_VAL : in;
            runs->out[run][i] = none ? -HUGE_VAL : endless ? HUGE_VAL : out;
            at = out + 1;
        }
    }
}

static bool holds(const wf_runs *r, int i, double s) {
    return (s > r->in[0][i] && s < r->out[0][i]) || (s > r->in[1][i] && s < r->out[1][i]);
}

/* The same program, one ray at one place, on a stack of bools. */
static bool whole_holds(const wf_csg *c, int i, double s) {
    bool stack[64];
    int top = 0;
    for (int k = 0; k < c->step_count; k++) {
        const wf_step *step = &c->steps[k];
        if (step->kind == WF_STEP_SOLID) {
            stack[top++] = holds(&c->runs[step->count], i, s);
            continue;
        }
        top -= step->count;
        for (int n = 1; n < step->count; n++) {
            bool with = stack[top + n];
            if (step->kind == WF_STEP_UNION) stack[top] |= with;
            if (step->kind == WF_STEP_INTERSECTION) stack[top] &= with;
            if (step->kind == WF_STEP_DIFFERENCE) stack[top] &= !with;
        }
        top++;
    }
    return stack[0];
}

typedef struct program {
    wf_step steps[64];
    wf_runs runs[MOST];
    int name[MOST];
    wf_csg csg;
} program;

/* A random tree in postfix order over `solids` solids. */
static void make_tree(program *p, int solids, uint32_t *seed) {
    int waiting = 0, used = 0, steps = 0;
    while (used < solids || waiting > 1) {
        bool push = used < solids && (waiting < 2 || draw(seed) % 2);
        if (push) {
            p->steps[steps++] = (wf_step){WF_STEP_SOLID, used++};
            waiting++;
        } else {
            int count = 2 + (int)(draw(seed) % (uint32_t)(waiting - 1));
            p->steps[steps++] =
                (wf_step){(wf_step_kind)(WF_STEP_UNION + draw(seed) % 3), count};
            waiting -= count - 1;
        }
    }
    for (int k = 0; k < solids; k++) make_runs(&p->runs[k], seed), p->name[k] = 100 + k;
    p->csg = (wf_csg){p->steps, steps, p->runs, p->name, solids, WF_PACKET};
}

static void nearest(const wf_csg *c, wf_hits *hits) {
    static wf_csg_entry stack[64];
    double rounding[WF_PACKET];
    for (int i = 0; i < WF_PACKET; i++) rounding[i] = 1e-9;
    wf_hits_clear(hits);
    wf_csg_ops_best()->nearest(c, rounding, stack, hits);
}

/* Where the whole first changes, walking from whole number to whole number. */
static double walk(const wf_csg *c, int i, bool *entering) {
    for (int at = 1; at < 40; at++) {
        bool before = whole_holds(c, i, at - 0.5), after = whole_holds(c, i, at + 0.5);
        *entering = after;
        if (before != after) return at;
    }
    *entering = false;
    return HUGE_VAL;
}

static void the_nearest_change(void **state) {
    (void)state;
    uint32_t seed = 1;
    for (int n = 0; n < 400; n++) {
        program p;
        wf_hits hits;
        make_tree(&p, 1 + n % MOST, &seed);
        nearest(&p.csg, &hits);
        for (int i = 0; i < WF_PACKET; i++) {
            bool entering;
            double should = walk(&p.csg, i, &entering);
            if (hits.s[i] != should)
                fail_msg("program %d, ray %d: %g, should be %g", n, i, hits.s[i], should);
            if (isinf(should)) continue;
            assert_int_equal(hits.entering[i], entering);
            const wf_runs *r = &p.runs[hits.solid[i] - 100];
            assert_true(r->in[0][i] == should || r->out[0][i] == should ||
                        r->in[1][i] == should || r->out[1][i] == should);
        }
    }
}

/* Two programs over the same solids that set algebra says are one. */
typedef struct identity {
    const char *name;
    wf_step left[8], right[8];
    int left_count, right_count;
} identity;

#define S(n)                                                                                   \
    { WF_STEP_SOLID, n }
#define OR(n)                                                                                  \
    { WF_STEP_UNION, n }
#define AND(n)                                                                                 \
    { WF_STEP_INTERSECTION, n }
#define SUB(n)                                                                                 \
    { WF_STEP_DIFFERENCE, n }

static const identity identities[] = {
    {"A + A = A", {S(0), S(0), OR(2)}, {S(0)}, 3, 1},
    {"A * A = A", {S(0), S(0), AND(2)}, {S(0)}, 3, 1},
    {"A + B = B + A", {S(0), S(1), OR(2)}, {S(1), S(0), OR(2)}, 3, 3},
    {"A * B = B * A", {S(0), S(1), AND(2)}, {S(1), S(0), AND(2)}, 3, 3},
    {"A - (B + C) = (A - B) * (A - C)",
     {S(0), S(1), S(2), OR(2), SUB(2)},
     {S(0), S(1), SUB(2), S(0), S(2), SUB(2), AND(2)},
     5,
     7},
    {"A - (B * C) = (A - B) + (A - C)",
     {S(0), S(1), S(2), AND(2), SUB(2)},
     {S(0), S(1), SUB(2), S(0), S(2), SUB(2), OR(2)},
     5,
     7},
    {"A * (B + C) = A * B + A * C",
     {S(0), S(1), S(2), OR(2), AND(2)},
     {S(0), S(1), AND(2), S(0), S(2), AND(2), OR(2)},
     5,
     7},
    {"A - B - C = A - (B + C)",
     {S(0), S(1), S(2), SUB(3)},
     {S(0), S(1), S(2), OR(2), SUB(2)},
     4,
     5},
};

static void set_algebra(void **state) {
    (void)state;
    uint32_t seed = 3;
    for (size_t n = 0; n < sizeof identities / sizeof *identities; n++)
        for (int round = 0; round < 50; round++) {
            const identity *d = &identities[n];
            wf_runs runs[3];
            const int name[3] = {0, 1, 2};
            wf_hits a, b;
            for (int k = 0; k < 3; k++) make_runs(&runs[k], &seed);
            wf_csg left = {d->left, d->left_count, runs, name, 3, WF_PACKET};
            wf_csg right = {d->right, d->right_count, runs, name, 3, WF_PACKET};
            nearest(&left, &a);
            nearest(&right, &b);
            if (memcmp(a.s, b.s, sizeof a.s)) fail_msg("%s does not hold", d->name);
            assert_memory_equal(a.entering, b.entering, sizeof a.entering);
        }
}

static void a_solid_less_itself_is_nothing(void **state) {
    (void)state;
    const wf_step steps[] = {S(0), S(0), SUB(2)};
    const int name = 0;
    uint32_t seed = 8;
    wf_runs runs;
    wf_hits hits;
    make_runs(&runs, &seed);
    wf_csg c = {steps, 3, &runs, &name, 1, WF_PACKET};
    nearest(&c, &hits);
    for (int i = 0; i < WF_PACKET; i++) assert_true(isinf(hits.s[i]));
}

/* A union 100,000 deep: ((A + A) + A) + .. */
static void deep_programs(void **state) {
    (void)state;
    enum { DEPTH = 100000 };
    wf_step *steps = malloc((2 * DEPTH + 1) * sizeof *steps);
    const int name = 5;
    uint32_t seed = 2;
    wf_runs runs;
    wf_hits deep, plain;
    assert_non_null(steps);
    steps[0] = (wf_step){WF_STEP_SOLID, 0};
    for (int k = 0; k < DEPTH; k++) {
        steps[2 * k + 1] = (wf_step){WF_STEP_SOLID, 0};
        steps[2 * k + 2] = (wf_step){WF_STEP_UNION, 2};
    }
    make_runs(&runs, &seed);
    wf_csg c = {steps, 2 * DEPTH + 1, &runs, &name, 1, WF_PACKET},
           one = {steps, 1, &runs, &name, 1, WF_PACKET};
    nearest(&c, &deep);
    nearest(&one, &plain);
    assert_memory_equal(deep.s, plain.s, sizeof deep.s);
    free(steps);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_change),
        cmocka_unit_test(set_algebra),
        cmocka_unit_test(a_solid_less_itself_is_nothing),
        cmocka_unit_test(deep_programs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
