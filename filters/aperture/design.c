/* Designs vertical apertures: the least flicker for a sharpness, or the most sharpness for a
 * flicker, as a convex quadratic program. */
#include "filters/aperture/design.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "filters/aperture/flicker.h"
#include "filters/aperture/qp.h"
#include "filters/base/sinc.h"

/* Contrast may turn over beyond a quarter of a cycle a line, but no further than this. */
#define REVERSAL 0.05

/* A response is limited at some frequencies only: POINTS_A_LINE * support of them in a cycle a
 * line, and up to STEEP cycles a line, where responses are steep, CLOSER * support. Between
 * them it goes beyond its limit by less than a fiftieth, so limits are BETWEEN of what was
 * wished; where an answer breaks one all the same, they are SURELY of it in a second attempt.
 */
#define POINTS_A_LINE 16
#define CLOSER        32
#define STEEP         2
#define BETWEEN       0.98
#define SURELY        0.9

/* What flicker squared is multiplied by, so that the program's numbers are of the order of 1.
 */
#define SCALE 400

/* The integral of m squared, times this, is added to flicker squared, so that of all kernels
 * that flicker alike one only is best, which passes the least noise. It costs less than 1e-4 of
 * flicker. */
#define NOISE 1e-6

/* The part of flicker and noise that stays in the program where the sharpest kernel is looked
 * for; the solver gets stuck on less at times, and tries more, up to ENOUGH. */
#define HARDLY 1e-3
#define ENOUGH 0.05

/* A wish for sharpness that is below the most there is by less than this gets the sharpest. */
#define NEARLY 3e-4

#define FLICKER_TOLERANCE 1e-7
#define NARROWEST         1e-12 /* range of sharpness that is not searched any more */
#define MOST_PROGRAMS     40
#define PAST_ALL          4 /* a response that no kernel has */

/* What an answer may be beyond its limits by. */
#define OFF 1e-4

/* A quadratic program whose unknowns are the comb's numbers. Its last limit is that of the last
 * sharpness. */
typedef struct program {
    const wf_design_wish *wish;
    wf_qp qp;
    wf_qp_answer answer;
    double row[WF_COMB_MOST]; /* H at the last `at` is this times the comb */
    double scanned_px;        /* mean over fx of sinc(width fx) squared */
    double between;           /* the share of a limit that a response is held to */
    double part;              /* what sharpest() left of flicker and noise */
    bool sharpest;            /* the answer is sharpest()'s */
    int iterations, solved;
} program;

/* ---- The program ---- */

/* Finds the row that, times the comb, is H(f). */
static void response_row(const program *p, double f, double *row) {
    for (int k = 0; k < p->qp.n; k++)
        row[k] = (k ? 2 : 1) * wf_sinc(2 * f) * cos(2 * M_PI * f * k / WF_STAIRS_STEPS);
}

static void limit(program *p, const double *row, double sign, double most) {
    double *to = p->qp.g + p->qp.m * p->qp.n;
    for (int k = 0; k < p->qp.n; k++) to[k] = sign * row[k];
    p->qp.h[p->qp.m++] = most;
}

/* The response to an edge is a straight line from step to step, so it is limited at each; after
 * the last one it is 1. */
static void limit_overshoot(program *p) {
    double area[WF_COMB_MOST] = {0};
    int steps = p->qp.n - 1 + WF_STAIRS_STEPS;
    for (int i = 0; i < steps - 1; i++) {
        for (int k = 0; k < p->qp.n; k++)
            area[k] += wf_comb_share(i, k) / (2 * WF_STAIRS_STEPS);
        limit(p, area, 1, 0.5 + p->wish->overshoot);
        limit(p, area, -1, 0.5 + p->wish->overshoot);
    }
}

/* Beyond half the pulses' frequency H is its own mirror image, upside down and weaker:
 * H(8 - f) = -f / (8 - f) H(f). So what is held here, up to 4 cycles a line, is held there;
 * below 1/2, where H may be what it likes, its image is limited instead. */
static void limit_response(program *p) {
    double row[WF_COMB_MOST], close = 1 / (CLOSER * p->wish->support);
    double alias = p->wish->alias, low = fmin(alias, REVERSAL);
    for (double f = close; f < WF_STAIRS_STEPS / 2;
         f += f < STEEP ? close : 1 / (POINTS_A_LINE * p->wish->support)) {
        double image = f / (WF_STAIRS_STEPS - f);
        response_row(p, f, row);
        if (f > 0.25 - close / 2) limit(p, row, -1, p->between * (f > 0.5 ? low : REVERSAL));
        if (f > 0.5)
            limit(p, row, 1, p->between * fmin(alias, low / image));
        else
            limit(p, row, image, p->between * low);
    }
}

/* Frequencies below `at` are held to H(at) or more: else the least flicker would be had by
 * leaving out all that lies between 0 and `at`. */
static void limit_sharpness(program *p, double at, double sharp) {
    double lower[WF_COMB_MOST], step = 1 / (CLOSER * p->wish->support);
    response_row(p, at, p->row);
    for (double f = step; f < at; f += step) {
        response_row(p, f, lower);
        for (int k = 0; k < p->qp.n; k++) lower[k] -= p->row[k];
        limit(p, lower, -1, 0);
    }
    limit(p, p->row, -1, -sharp);
}

static void add_square(program *p, const double *row, double weight) {
    int n = p->qp.n;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) p->qp.q[i * n + j] += 2 * weight * row[i] * row[j];
}

static double mean_across(double width) {
    double sum = 0;
    for (int i = 0; i < WF_FLICKER_POINTS; i++) {
        double seen = wf_sinc(width * wf_flicker_fx(i));
        sum += seen * seen / WF_FLICKER_POINTS;
    }
    return sum;
}

static double weight_of(const program *p, int point) {
    return p->scanned_px / 8 * pow(sin(M_PI * wf_flicker_fy(point)), 4) / WF_FLICKER_POINTS;
}

/* The program's aim is flicker squared and noise, as wf_flicker and wf_stairs_power say. */
static void aim_at_flicker(program *p) {
    double row[WF_COMB_MOST];
    for (int i = 0; i < WF_FLICKER_POINTS; i++) {
        response_row(p, wf_flicker_fy(i), row);
        add_square(p, row, SCALE * weight_of(p, i));
    }
    for (int i = 0; i < p->qp.n - 1 + WF_STAIRS_STEPS; i++) {
        for (int k = 0; k < p->qp.n; k++) row[k] = wf_comb_share(i, k) / 2;
        add_square(p, row, SCALE * NOISE * 2 / WF_STAIRS_STEPS);
    }
}

static bool make(program *p, const wf_design_wish *wish, double between) {
    int n = wf_comb_count(wish->support), points = (int)(4 * POINTS_A_LINE * wish->support);
    *p = (program){.wish = wish, .between = between, .scanned_px = mean_across(wish->width)};
    int most = 2 * (n + WF_STAIRS_STEPS) + (4 + WF_DESIGN_SHARPS) * points;
    if (!wf_qp_alloc(&p->qp, &p->answer, n, most)) return false;
    p->qp.m = 0;
    p->qp.b = 1;
    for (int k = 0; k < n; k++) p->qp.a[k] = k ? 2 : 1;
    limit_overshoot(p);
    limit_response(p);
    for (int i = 0; i < wish->sharps || i == 0; i++)
        limit_sharpness(p, wish->at[i], wish->sharp[i]);
    aim_at_flicker(p);
    return true;
}

/* ---- Its answers ---- */

/* Finds the least flicker, with the last sharpness limited or not. */
static wf_qp_end least_flicker(program *p, bool limited) {
    p->qp.m -= limited ? 0 : 1;
    wf_qp_end end = wf_qp_solve(&p->qp, &p->answer);
    p->qp.m += limited ? 0 : 1;
    p->iterations += p->answer.iterations;
    p->solved++;
    return end;
}

static double last_response(const program *p) {
    double sum = 0;
    for (int k = 0; k < p->qp.n; k++) sum += p->row[k] * p->answer.x[k];
    return sum;
}

/* Finds nearly the most that the last sharpness can be; part of flicker and noise stays in the
 * aim, so that one kernel is best. */
static wf_qp_end sharpest(program *p) {
    int n = p->qp.n;
    wf_qp_end end = WF_QP_STUCK;
    for (int k = 0; k < n; k++) p->qp.c[k] = -p->row[k];
    for (double part = HARDLY; end == WF_QP_STUCK && part < ENOUGH; part *= 4) {
        for (int i = 0; i < n * n; i++) p->qp.q[i] *= part;
        end = least_flicker(p, false);
        for (int i = 0; i < n * n; i++) p->qp.q[i] /= part;
        p->part = part;
    }
    memset(p->qp.c, 0, (size_t)n * sizeof *p->qp.c);
    return end;
}

static double flicker_of(const program *p) {
    double row[WF_COMB_MOST], sum = 0;
    for (int i = 0; i < WF_FLICKER_POINTS; i++) {
        double seen = 0;
        response_row(p, wf_flicker_fy(i), row);
        for (int k = 0; k < p->qp.n; k++) seen += row[k] * p->answer.x[k];
        sum += weight_of(p, i) * seen * seen;
    }
    return sqrt(sum);
}

/* ---- What can be said instead ---- */

typedef struct reason {
    char *text;
    size_t size;
    bool no_memory;
} reason;

static bool say(reason *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

static bool say(reason *why, const char *format, ...) {
    va_list values;
    va_start(values, format);
    vsnprintf(why->text, why->size, format, values);
    va_end(values);
    return false;
}

static bool refuse(reason *why, wf_qp_end end, const wf_design_wish *w) {
    why->no_memory = end == WF_QP_NO_MEMORY;
    if (why->no_memory) return say(why, "out of memory");
    return say(why,
               "design: nothing that reaches %g lines keeps within overshoot=%g and alias=%g; "
               "give one of them more",
               w->support, w->overshoot, w->alias);
}

static bool lost(reason *why, const wf_design_wish *w) {
    return say(why,
               "design: rounding kept the answer from being found; support=%g a half more or "
               "less, or sharp=%g a little less, may have one",
               w->support, w->sharp[w->sharps - 1]);
}

/* Says that the last sharpness is more than the most there is. */
static bool too_sharp(reason *why, const wf_design_wish *w, double most) {
    char others[40 * WF_DESIGN_SHARPS] = "";
    int last = w->sharps - 1, used = 0;
    for (int i = 0; i < last; i++)
        used += snprintf(others + used, sizeof others - (size_t)used, "%ssharp=%g,at=%g",
                         i ? " and " : ", beside ", w->sharp[i], w->at[i]);
    return say(why,
               "design: sharp=%g,at=%g is too sharp; %.4f is the most that support=%g, "
               "overshoot=%g and alias=%g leave%s%s",
               w->sharp[last], w->at[last], floor(1e4 * most) / 1e4, w->support, w->overshoot,
               w->alias, others, last ? "; make one less sharp" : "");
}

static bool solve(program *p, const wf_design_wish *wish, reason *why);

/* The sharpnesses before the last leave no kernel: says which of them is the first that does.
 */
static bool blame(const wf_design_wish *wish, reason *why) {
    wf_design_wish fewer = *wish;
    program p;
    fewer.sharps--;
    if (!fewer.sharps) return refuse(why, WF_QP_STUCK, wish);
    if (!make(&p, &fewer, BETWEEN)) return refuse(why, WF_QP_NO_MEMORY, wish);
    bool solved = solve(&p, &fewer, why);
    wf_qp_release(&p.qp);
    return solved ? lost(why, wish) : false;
}

/* ---- The two questions ---- */

static bool solve_for_sharpness(program *p, reason *why) {
    const wf_design_wish *w = p->wish;
    wf_qp_end end = least_flicker(p, true);
    if (end == WF_QP_SOLVED) return true;
    if (end == WF_QP_STUCK) end = sharpest(p);
    if (end == WF_QP_STUCK) return blame(w, why);
    if (end != WF_QP_SOLVED) return refuse(why, end, w);
    double most = last_response(p), spare = most - w->sharp[w->sharps - 1];
    if (spare < 0) return too_sharp(why, w, most);
    /* Kernels as sharp as wished have less flicker by no more than what sharpest() proves. */
    p->answer.gap = (p->answer.gap + spare) / p->part;
    return spare < NEARLY || lost(why, w);
}

/* An answer to come back to. */
typedef struct kept {
    double x[WF_COMB_MOST], gap;
} kept;

static void keep(const program *p, kept *to) {
    memcpy(to->x, p->answer.x, (size_t)p->qp.n * sizeof *to->x);
    to->gap = p->answer.gap;
}

static void take_back(program *p, const kept *from) {
    memcpy(p->answer.x, from->x, (size_t)p->qp.n * sizeof *from->x);
    p->answer.gap = from->gap;
}

/* Searches for the sharpness low .. high whose least flicker is the one wished for. Flicker
 * squared is convex in the sharpness and the limit's multiplier is its slope, so Newton's steps
 * are taken, and halves of the range where they leave it. `best` is the answer at low, which is
 * given where rounding keeps the solver from a better one. */
static wf_qp_end approach(program *p, double low, double high, kept *best) {
    double target = p->wish->flicker - FLICKER_TOLERANCE / 2, sharp = (low + high) / 2;
    while (p->solved < MOST_PROGRAMS && high - low > NARROWEST) {
        p->qp.h[p->qp.m - 1] = -sharp;
        wf_qp_end end = least_flicker(p, true);
        if (end == WF_QP_NO_MEMORY) return end;
        double flicker = end == WF_QP_SOLVED ? flicker_of(p) : INFINITY;
        double slope = p->answer.z[p->qp.m - 1] / SCALE;
        if (fabs(flicker - target) < FLICKER_TOLERANCE / 2) return end;
        if (flicker < target) keep(p, best);
        *(flicker < target ? &low : &high) = sharp;
        sharp -= (flicker * flicker - target * target) / slope;
        if (!(sharp > low && sharp < high)) sharp = (low + high) / 2;
    }
    take_back(p, best);
    return WF_QP_SOLVED;
}

static bool solve_for_flicker(program *p, reason *why) {
    kept best;
    wf_qp_end end = least_flicker(p, false);
    if (end != WF_QP_SOLVED) return refuse(why, end, p->wish);
    double least = flicker_of(p), low = last_response(p);
    if (least > p->wish->flicker)
        return say(why, "design: flicker=%g is too little; %.4f is the least", p->wish->flicker,
                   ceil(1e4 * least) / 1e4);
    keep(p, &best);
    end = sharpest(p);
    p->sharpest = end == WF_QP_SOLVED && flicker_of(p) <= p->wish->flicker;
    if (p->sharpest) return true;
    double high = end == WF_QP_SOLVED ? last_response(p) : PAST_ALL;
    if (end != WF_QP_NO_MEMORY) end = approach(p, low, high, &best);
    return end == WF_QP_SOLVED ? true : refuse(why, end, p->wish);
}

static bool solve(program *p, const wf_design_wish *wish, reason *why) {
    return (wish->sharps ? solve_for_sharpness : solve_for_flicker)(p, why);
}

/* ---- The certificate ---- */

static void certify(const program *p, wf_design *d) {
    memcpy(d->comb, p->answer.x, (size_t)p->qp.n * sizeof *d->comb);
    wf_stairs_init(&d->stairs, p->wish->support, d->comb);
    d->flicker = flicker_of(p);
    d->sharpest = p->sharpest;
    d->gap = p->answer.gap / SCALE;
    d->slack = NOISE * wf_stairs_power(&d->stairs);
    if (d->sharpest) {
        double wished = p->wish->flicker, spare = wished * wished - d->flicker * d->flicker;
        d->gap = p->answer.gap;
        d->slack *= p->part * SCALE;
        d->spare = p->part * SCALE * spare;
    }
    d->iterations = p->iterations;
    d->programs = p->solved;
    for (int i = 1; i <= d->stairs.count; i++)
        d->overshoot = fmax(d->overshoot, fabs(d->stairs.area[i]) - 0.5);
    for (int i = 128; i <= WF_STAIRS_STEPS * 512; i++) {
        double h = wf_stairs_response(&d->stairs, i / 512.0);
        d->least = fmin(d->least, h);
        if (i >= 256) d->alias = fmax(d->alias, fabs(h));
    }
    d->zero = fabs(wf_stairs_response(&d->stairs, 0.5));
}

static bool keeps(const wf_design *d, const wf_design_wish *w) {
    bool sharp = true;
    for (int i = 0; i < w->sharps; i++)
        sharp &= wf_stairs_response(&d->stairs, w->at[i]) > w->sharp[i] - OFF;
    return sharp && d->overshoot < w->overshoot + OFF && d->alias < w->alias + OFF &&
           d->least > -REVERSAL - OFF;
}

static bool attempt(const wf_design_wish *wish, double between, wf_design *design,
                    reason *why) {
    program p;
    *design = (wf_design){0};
    if (!make(&p, wish, between)) return refuse(why, WF_QP_NO_MEMORY, wish);
    bool solved = solve(&p, wish, why);
    if (solved) certify(&p, design);
    wf_qp_release(&p.qp);
    return solved;
}

/* An answer that breaks a limit is not given. */
bool wf_design_solve(const wf_design_wish *wish, wf_design *design, char *why,
                     size_t why_size) {
    reason said = {why, why_size, false};
    bool solved = attempt(wish, BETWEEN, design, &said);
    if (solved && !keeps(design, wish)) solved = attempt(wish, SURELY, design, &said);
    if (solved && !keeps(design, wish))
        solved = say(&said,
                     "design: the answer found breaks its own limits (overshoot %.4f, alias "
                     "%.4f, least response %.4f); wish for less",
                     design->overshoot, design->alias, design->least);
    design->no_memory = said.no_memory;
    return solved;
}
