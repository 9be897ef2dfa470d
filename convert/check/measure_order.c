/* Field order from pixels: fields are in the order of time in which each differs least from the
 * next. Luma is compared and not light, in which the bright spokes of a wheel that aliases
 * would outvote what is seen. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/check/measurement.h"
#include "convert/check/order_votes.h"

#define MOVES       0.02f /* of luma: a pixel that changes by more between frames moves */
#define STILL_SHARE 2e-6  /* of the pixels may move in a still */
#define WEAVES      0.6  /* fields of one instant differ by less than this times those of two */
#define EVEN        0.8  /* distances before and after whose ratio is above this are the same */
#define SLOW        0.02 /* of all change: smaller distances only tell of details */
#define LEAN        0.005     /* a mean lean of less is none */
#define LEAN_ALONE  0.05      /* the same of one or two pairs of frames, which cannot agree */
#define SURE        1.5       /* the mean's own deviations that a lean has to exceed */
#define NEAR        0.04      /* of 1: ratios nearer to it tell no order */
#define AGREE       (2.0 / 3) /* of the votes are for one order, or it is open */
#define ONE_INSTANT                                                                            \
    0.5 /* fields of a frame that differ by less than this times those of two are of one */
#define DIVIDED     0.1 /* of all distances: so many votes show that there is an order */
#define REPEATED    0.1 /* a field that changes by less than this times the other is repeated */
#define CADENCE     5   /* frames in which 2:3 repeats one field of each parity */
#define PAIRS_LEAST 5   /* of frames, for a cadence to show */
#define LINES_LEAST 4   /* of a picture: each line is compared with the two about it */
#define IN_STEP     0.8 /* of the repeats are at the same place of their five */

/* How a pixel differs from the lines above and below it: `outside` is how far it is from what
 * lies between them, so that level edges, which two fields show at different heights, count for
 * nothing; `beside` how far from their mean, for what moves by less than a line. */
typedef struct order {
    wf_distances outside, beside;
    wf_order_votes *votes[2];     /* by the same two */
    double leans, leans_squared;  /* sums over pairs of frames; see note_lean */
    double change, moved, pixels; /* luma's change in all, pixels that move, pixels seen */
    int64_t pairs;                /* of frames between which something moves */
    int64_t repeats[2][CADENCE];  /* [parity][place in the five] */
    int64_t frame;
    bool fields; /* the label says that there are fields */
} order;

static void order_free(void *state) {
    order *o = state;
    for (int i = 0; o && i < 2; i++) wf_order_votes_free(o->votes[i]);
    free(o);
}

static void *order_begin(const wf_video_info *info, const wf_measure_options *options) {
    (void)options;
    order *o = calloc(1, sizeof *o);
    if (!o) return NULL;
    o->fields = info->scan_known && info->raster.scan != WF_PROGRESSIVE;
    for (int i = 0; i < 2; i++) o->votes[i] = wf_order_votes_new(info->width_px, info->lines);
    if (o->votes[0] && o->votes[1]) return o;
    order_free(o);
    return NULL;
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

static wf_distances distances_of(const steps *s, bool top) {
    return (wf_distances){.within = s->within,
                          .bottom_top = top ? s->behind : s->ahead,
                          .top_bottom = top ? s->ahead : s->behind};
}

static void add_distances(wf_distances *sum, wf_order_votes *votes, int x, int y,
                          const steps *s) {
    wf_distances d = distances_of(s, y % 2 == 0);
    sum->within += d.within;
    sum->bottom_top += d.bottom_top;
    sum->top_bottom += d.top_bottom;
    wf_order_votes_add(votes, x, y, &d);
}

/* Adds pixels x to end of line y of both frames; returns how much their luma changes. */
static double add_pixels(order *o, const wf_signal *a, const wf_signal *b, int y, int x,
                         int end) {
    ptrdiff_t width = a->width_px;
    const float *p = a->ycbcr[0] + y * width, *q = b->ycbcr[0] + y * width;
    steps out = {0}, mean = {0};
    double changes = 0;
    for (int i = x; i < end; i++) {
        float change = fabsf(p[i] - q[i]);
        if (change <= MOVES && fabsf(p[i - width] - q[i - width]) <= MOVES) continue;
        changes += change > MOVES ? (double)change : 0;
        o->moved++;
        add_step(&out, outside, p + i, q + i, width);
        add_step(&mean, beside, p + i, q + i, width);
    }
    add_distances(&o->outside, o->votes[0], x, y, &out);
    add_distances(&o->beside, o->votes[1], x, y, &mean);
    return changes;
}

/* Adds line y of both frames, block by block. */
static double add_line(order *o, const wf_signal *a, const wf_signal *b, int y) {
    int step = wf_order_block_px(o->votes[0]), width = a->width_px;
    double changes = 0;
    for (int x = 0; x < width; x += step)
        changes += add_pixels(o, a, b, y, x, x + step < width ? x + step : width);
    return changes;
}

/* How much nearer one order is than the other in this pair of frames: -1 to 1, above 0 where
 * bottom to top is the shorter way, as with top first. */
static void note_lean(order *o, const wf_distances *earlier) {
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
    wf_distances earlier = o->outside;
    for (int y = 1; y < signal->lines - 1; y++) change[y % 2] += add_line(o, before, signal, y);
    note_lean(o, &earlier);
    o->change += change[0] + change[1];
    o->pixels += pixels;
    o->pairs += o->moved - moved > STILL_SHARE * pixels;
    note_repeat(o, change);
    for (int i = 0; i < 2; i++) wf_order_votes_pair(o->votes[i]);
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

static double farther(const wf_distances *d) {
    return fmax(d->bottom_top, d->top_bottom);
}

/* Which distances tell the order: where motion is slow, those from the mean. */
static const wf_distances *telling(const order *o) {
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

static const char *verdict_of(const order *o, const wf_distances *d) {
    if (!(o->moved > STILL_SHARE * o->pixels)) return "still";
    if (is_telecined(o)) return "telecined";
    double nearer = fmin(d->bottom_top, d->top_bottom);
    bool slow = d == &o->beside; /* then details hide how alike the two fields are */
    if (nearer > EVEN * farther(d) && (slow || d->within < WEAVES * nearer || !leans(o)))
        return o->fields ? "psf" : "progressive";
    return d->bottom_top < d->top_bottom ? "tff" : "bff";
}

/* An order stands only if it is clear and the picture's regions agree on it; that there is
 * none, only if they do not see one here and another there. */
static void confirm(const order *o, const wf_distances *d, wf_figures *figures) {
    const char *verdict = figures->order_verdict;
    bool top = !strcmp(verdict, "tff"), ordered = top || !strcmp(verdict, "bff");
    bool whole = !strcmp(verdict, "psf") || !strcmp(verdict, "progressive");
    wf_order_count votes = wf_order_votes_count(o->votes[d == &o->beside]);
    double all = votes.top + votes.bottom, nearer = fmin(d->bottom_top, d->top_bottom);
    double agreeing = (ordered ? top : votes.top > votes.bottom) ? votes.top : votes.bottom;
    bool agreed = all > 0 && agreeing >= AGREE * all;
    bool divided = whole && all > DIVIDED * votes.all && d->within >= WEAVES / 2 * nearer;
    if (!ordered && !divided) return;
    figures->order_agreement = all > 0 ? agreeing / all : NAN;
    bool of_one_instant = d->within < ONE_INSTANT * nearer; /* what leans is its detail */
    if (divided || !agreed || of_one_instant || fabs(log(figures->order_ratio)) < NEAR)
        figures->order_verdict = "open";
}

static void order_finish(void *state, const wf_signal *last, const wf_signal *before,
                         wf_figures *figures) {
    const order *o = state;
    const wf_distances *d = telling(o);
    if (!before || last->lines < LINES_LEAST) return;
    double top_first = d->within + d->bottom_top, bottom_first = d->within + d->top_bottom;
    figures->order_verdict = verdict_of(o, d);
    figures->order_ratio = top_first > 0      ? bottom_first / top_first
                           : bottom_first > 0 ? NAN
                                              : 1;
    confirm(o, d, figures);
}

const wf_measurement wf_measure_order = {order_begin, order_add, order_finish, order_free};
