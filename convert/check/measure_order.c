/* Field order from pixels: fields are in the order of time in which each differs least from the
 * next. Luma is compared and not light, in which the bright spokes of a wheel that aliases
 * would outvote what is seen. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/check/measurement.h"

#define MOVES       0.02f /* of luma: a pixel that changes by more between frames moves */
#define STILL_SHARE 2e-6  /* of the pixels may move in a still */
#define WEAVES      0.6  /* fields of one instant differ by less than this times those of two */
#define EVEN        0.8  /* distances before and after whose ratio is above this are the same */
#define SLOW        0.02 /* of all change: smaller distances only tell of details */
#define LEAN        0.005 /* a mean lean of less is none */
#define LEAN_ALONE  0.05  /* the same of one or two pairs of frames, which cannot agree */
#define SURE        1.5   /* the mean's own deviations that a lean has to exceed */
#define REPEATED    0.1 /* a field that changes by less than this times the other is repeated */
#define CADENCE     5   /* frames in which 2:3 repeats one field of each parity */
#define PAIRS_LEAST 5   /* of frames, for a cadence to show */
#define LINES_LEAST 4   /* of a picture: each line is compared with the two about it */
#define IN_STEP     0.8 /* of the repeats are at the same place of their five */

/* Distances between fields, summed over pixels that move: within a frame, between its two
 * fields; from a bottom field to the next frame's top field, which follows it where top
 * is first; and from a top field to the next frame's bottom field. */
typedef struct distances {
    double within, bottom_top, top_bottom;
} distances;

/* How a pixel differs from the lines above and below it: `outside` is how far it is from what
 * lies between them, so that level edges, which two fields show at different heights, count for
 * nothing; `beside` how far from their mean, for what moves by less than a line. */
typedef struct order {
    distances outside, beside;
    double leans, leans_squared;  /* sums over pairs of frames; see note_lean */
    double change, moved, pixels; /* luma's change in all, pixels that move, pixels seen */
    int64_t pairs;                /* of frames between which something moves */
    int64_t repeats[2][CADENCE];  /* [parity][place in the five] */
    int64_t frame;
    bool fields; /* the label says that there are fields */
} order;

static void *order_begin(const wf_video_info *info, const wf_measure_options *options) {
    (void)options;
    order *o = calloc(1, sizeof *o);
    if (o) o->fields = info->scan_known && info->raster.scan != WF_PROGRESSIVE;
    return o;
}

static float outside(float v, float above, float below) {
    float low = fminf(above, below), high = fmaxf(above, below);
    return v < low ? low - v : v > high ? v - high : 0;
}

static float beside(float v, float above, float below) {
    return fabsf(v - 0.5f * (above + below));
}

/* For a line of frame a and the same line of the next frame, b: how far a's is from the other
 * field of a (within) and of b (ahead), and how far b's is from the other field of a (behind).
 */
typedef struct steps {
    double within, ahead, behind;
} steps;

typedef float distance_fn(float v, float above, float below);

static void add_step(steps *s, distance_fn *distance, const float *p, const float *q,
                     ptrdiff_t width) {
    s->within += (double)distance(p[0], p[-width], p[width]);
    s->ahead += (double)distance(p[0], q[-width], q[width]);
    s->behind += (double)distance(q[0], p[-width], p[width]);
}

static void add_steps(distances *d, const steps *s, bool top) {
    d->within += s->within;
    d->top_bottom += top ? s->ahead : s->behind;
    d->bottom_top += top ? s->behind : s->ahead;
}

/* Adds line y of both frames; returns how much its luma changes. */
static double add_line(order *o, const wf_signal *a, const wf_signal *b, int y) {
    ptrdiff_t width = a->width_px;
    const float *p = a->ycbcr[0] + y * width, *q = b->ycbcr[0] + y * width;
    steps out = {0}, mean = {0};
    double changes = 0;
    for (ptrdiff_t x = 0; x < width; x++) {
        float change = fabsf(p[x] - q[x]);
        if (change <= MOVES && fabsf(p[x - width] - q[x - width]) <= MOVES) continue;
        changes += change > MOVES ? (double)change : 0;
        o->moved++;
        add_step(&out, outside, p + x, q + x, width);
        add_step(&mean, beside, p + x, q + x, width);
    }
    add_steps(&o->outside, &out, y % 2 == 0);
    add_steps(&o->beside, &mean, y % 2 == 0);
    return changes;
}

/* How much nearer one order is than the other in this pair of frames: -1 to 1, above 0 where
 * bottom to top is the shorter way, as with top first. */
static void note_lean(order *o, const distances *earlier) {
    double down = o->outside.top_bottom - earlier->top_bottom;
    double up = o->outside.bottom_top - earlier->bottom_top;
    double lean = down + up > 0 ? (down - up) / (down + up) : 0;
    o->leans += lean;
    o->leans_squared += lean * lean;
}

static void note_repeat(order *o, const double change[2]) {
    for (int parity = 0; parity < 2; parity++)
        if (change[parity] < REPEATED * change[1 - parity])
            o->repeats[parity][o->frame % CADENCE]++;
}

static void order_add(void *state, const wf_signal *signal, const wf_signal *before) {
    order *o = state;
    if (!before) return;
    double change[2] = {0}, moved = o->moved, pixels = (double)signal->width_px * signal->lines;
    distances earlier = o->outside;
    for (int y = 1; y < signal->lines - 1; y++) change[y % 2] += add_line(o, before, signal, y);
    note_lean(o, &earlier);
    o->change += change[0] + change[1];
    o->pixels += pixels;
    o->pairs += o->moved - moved > STILL_SHARE * pixels;
    note_repeat(o, change);
    o->frame++;
}

/* ---- Verdict ---- */

static int64_t sum_of(const int64_t *count) {
    int64_t sum = 0;
    for (int i = 0; i < CADENCE; i++) sum += count[i];
    return sum;
}

static int64_t most_of(const int64_t *count) {
    int64_t most = 0;
    for (int i = 0; i < CADENCE; i++) most = count[i] > most ? count[i] : most;
    return most;
}

/* In 2:3 pulldown one field in five of each parity is the same as the one before. */
static bool is_telecined(const order *o) {
    if (o->pairs < PAIRS_LEAST) return false;
    for (int parity = 0; parity < 2; parity++) {
        double all = (double)sum_of(o->repeats[parity]);
        double expected = (double)o->pairs / CADENCE;
        if (all < floor(expected) || all > 1.5 * ceil(expected) ||
            (double)most_of(o->repeats[parity]) < IN_STEP * all)
            return false;
    }
    return true;
}

static double farther(const distances *d) {
    return fmax(d->bottom_top, d->top_bottom);
}

/* Which distances tell the order: where motion is slow, those from the mean. */
static const distances *telling(const order *o) {
    return farther(&o->outside) < SLOW * o->change ? &o->beside : &o->outside;
}

/* Grain makes all fields differ alike. What little difference is left tells an order only if it
 * leans one way again and again, so that its mean exceeds the mean's own deviation. */
static bool leans(const order *o) {
    double n = (double)o->frame, mean = o->leans / n;
    if (n < 3) return fabs(mean) > LEAN_ALONE;
    double variance = fmax(o->leans_squared / n - mean * mean, 0) * n / (n - 1);
    return fabs(mean) > LEAN && fabs(mean) > SURE * sqrt(variance / n);
}

static const char *verdict_of(const order *o, const distances *d) {
    if (!(o->moved > STILL_SHARE * o->pixels)) return "still";
    if (is_telecined(o)) return "telecined";
    double nearer = fmin(d->bottom_top, d->top_bottom);
    bool slow = d == &o->beside; /* then details hide how alike the two fields are */
    if (nearer > EVEN * farther(d) && (slow || d->within < WEAVES * nearer || !leans(o)))
        return o->fields ? "psf" : "progressive";
    return d->bottom_top < d->top_bottom ? "tff" : "bff";
}

static void order_finish(void *state, const wf_signal *last, const wf_signal *before,
                         wf_figures *figures) {
    const order *o = state;
    const distances *d = telling(o);
    if (!before || last->lines < LINES_LEAST) return;
    double top_first = d->within + d->bottom_top, bottom_first = d->within + d->top_bottom;
    figures->order_verdict = verdict_of(o, d);
    figures->order_ratio = top_first > 0      ? bottom_first / top_first
                           : bottom_first > 0 ? NAN
                                              : 1;
}

const wf_measurement wf_measure_order = {order_begin, order_add, order_finish, free};
