/* A modulation through the eye's bank of low passes, line by line. */
#include "filters/seen/seen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

WF_ISA_DISPATCH(wf_seen_ops)

#define LEAST_CD_M2  0.01
#define LOCAL_DEGREE 0.5 /* deviation of what the eye adapts to */

/* A low pass: weight[0] in the middle and weight[k] k samples to either side. */
typedef struct low_pass {
    int reach;
    float *weight; /* [reach + 1] */
    float *both;   /* [2 * reach + 1], the same from one side to the other */
} low_pass;

/* In both directions. Wide ones are of means of `step` samples, between which lies a straight
 * line: these take and give what a Gaussian does whose variance is step^2 / 4, which the low
 * pass has less. */
typedef struct blur {
    int step_x, step_y, width, lines; /* of means */
    low_pass down, across;
    float *mean;   /* [lines][width]; NULL: it is of samples */
    float *out[2]; /* the same, blurred: of two pictures */
} blur;

struct wf_seen {
    wf_viewing viewing;
    wf_eye eye;
    blur band[WF_EYE_BANDS], local;
    const float **row;                    /* [most_rows]: what a low pass sums up */
    float *wide;                          /* [reach + width + reach], as `local` reaches */
    size_t rows, reach;                   /* the most of any blur */
    float *part, *luminance, *sum, *turn; /* [width] */
};

/* ---- Making it ---- */

/* What has the response exp(-(f / c)^2 / 2) between -1/2 and 1/2 cycles a sample: a Gaussian of
 * deviation 1 / (2 pi c) samples, or where that is less than a sample, what is left of it. */
static double tap(double c, int k) {
    enum { STEPS = 256 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        double f = 0.5 * (i + 0.5) / STEPS;
        sum += exp(-0.5 * f * f / (c * c)) * cos(2 * M_PI * f * k);
    }
    return sum / STEPS;
}

static bool make_low_pass(low_pass *p, double deviation) {
    double sum = 0;
    p->reach = (int)ceil(4 * deviation) + (deviation > 2 ? 0 : 4);
    p->weight = malloc((size_t)(p->reach + 1) * sizeof *p->weight);
    p->both = malloc((size_t)(2 * p->reach + 1) * sizeof *p->both);
    if (!p->weight || !p->both) return false;
    for (int k = 0; k <= p->reach; k++) {
        double gauss = exp(-0.5 * k * k / (deviation * deviation));
        double value = deviation > 2 ? gauss : tap(1 / (2 * M_PI * deviation), k);
        p->weight[k] = (float)value;
        sum += k ? 2 * value : value;
    }
    for (int k = 0; k <= p->reach; k++) {
        p->weight[k] = (float)((double)p->weight[k] / sum);
        p->both[p->reach - k] = p->both[p->reach + k] = p->weight[k];
    }
    return true;
}

/* The step of means, and what is left of the deviation, in such steps. */
static int step_of(double *deviation) {
    int step = 1;
    while (*deviation / (2 * step) > 2.5 && step < 1024) step *= 2;
    if (step > 1) *deviation = sqrt(*deviation * *deviation / (step * step) - 0.25);
    return step;
}

/* A blur by a Gaussian of so many degrees. */
static bool make_blur(wf_seen *s, double degrees, blur *b) {
    const wf_viewing *v = &s->viewing;
    double down = degrees * wf_viewing_lines_degree(v), across = down / v->pixel_aspect;
    b->step_y = step_of(&down);
    b->step_x = step_of(&across);
    b->lines = (v->lines + b->step_y - 1) / b->step_y;
    b->width = (v->width_px + b->step_x - 1) / b->step_x;
    if (!make_low_pass(&b->down, down) || !make_low_pass(&b->across, across)) return false;
    size_t rows = 2 * (size_t)b->down.reach + 1, reach = (size_t)b->across.reach;
    s->rows = rows > s->rows ? rows : s->rows;
    s->reach = reach > s->reach ? reach : s->reach;
    if (b->step_x == 1 && b->step_y == 1) return true;
    size_t means = (size_t)b->lines * (size_t)b->width;
    b->mean = malloc(means * sizeof *b->mean);
    for (int p = 0; p < 2; p++) b->out[p] = malloc(means * sizeof *b->out[p]);
    return b->mean && b->out[0] && b->out[1];
}

static bool make_blurs(wf_seen *s) {
    bool made = make_blur(s, LOCAL_DEGREE, &s->local);
    for (int i = 0; i < WF_EYE_BANDS && made; i++)
        made = make_blur(s, 1 / (2 * M_PI * wf_eye_width[i]), &s->band[i]);
    return made;
}

static bool make_lines(wf_seen *s) {
    size_t width = (size_t)s->viewing.width_px;
    s->row = malloc(s->rows * sizeof *s->row);
    s->wide = malloc((width + 2 * s->reach) * sizeof *s->wide);
    s->part = malloc(width * sizeof *s->part);
    s->luminance = malloc(width * sizeof *s->luminance);
    s->sum = malloc(width * sizeof *s->sum);
    s->turn = malloc(width * sizeof *s->turn);
    return s->row && s->wide && s->part && s->luminance && s->sum && s->turn;
}

wf_seen *wf_seen_new(const wf_viewing *viewing) {
    wf_seen *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->viewing = *viewing;
    wf_eye_init(&s->eye, viewing);
    if (make_blurs(s) && make_lines(s)) return s;
    wf_seen_free(s);
    return NULL;
}

static void free_blur(blur *b) {
    free(b->down.weight);
    free(b->down.both);
    free(b->across.weight);
    free(b->across.both);
    free(b->mean);
    for (int p = 0; p < 2; p++) free(b->out[p]);
}

void wf_seen_free(wf_seen *s) {
    if (!s) return;
    for (int i = 0; i < WF_EYE_BANDS; i++) free_blur(&s->band[i]);
    free_blur(&s->local);
    free(s->row);
    free(s->wide);
    free(s->part);
    free(s->luminance);
    free(s->sum);
    free(s->turn);
    free(s);
}

/* ---- Blurs ---- */

/* Beyond its edges a picture is as in a mirror in its last line or column, so that what
 * alternates from line to line goes on to. */
static int mirrored(int at, int count) {
    int period = 2 * (count - 1);
    if (at >= 0 && at < count) return at;
    if (period == 0) return 0;
    at = at < 0 ? -at % period : at % period;
    return at < count ? at : period - at;
}

/* Line y of a picture, or of means, through the low passes. */
static void pass_line(wf_seen *s, const blur *b, const float *picture, int y, float *out) {
    const wf_seen_ops *ops = wf_seen_ops_best();
    int width = b->width, down = b->down.reach, across = b->across.reach;
    float *middle = s->wide + s->reach;
    for (int k = -down; k <= down; k++)
        s->row[k + down] = picture + (size_t)mirrored(y + k, b->lines) * (size_t)width;
    ops->down(middle, s->row, b->down.both, (size_t)(2 * down + 1), (size_t)width);
    for (int k = 1; k <= across; k++) {
        middle[-k] = middle[mirrored(-k, width)];
        middle[width + k - 1] = middle[mirrored(width + k - 1, width)];
    }
    ops->across(out, middle, b->across.weight, (size_t)across, (size_t)width);
}

/* One line of means of a picture; at its edges they may be of fewer samples. */
static void mean_line(wf_seen *s, const blur *b, const float *picture, int line, float *out) {
    int from = line * b->step_y, lines = s->viewing.lines - from, width = s->viewing.width_px;
    if (lines > b->step_y) lines = b->step_y;
    memset(s->part, 0, (size_t)width * sizeof *s->part);
    for (int y = from; y < from + lines; y++)
        for (int x = 0; x < width; x++)
            s->part[x] += picture[(size_t)y * (size_t)width + (size_t)x];
    for (int i = 0; i < b->width; i++) {
        int first = i * b->step_x,
            count = width - first < b->step_x ? width - first : b->step_x;
        float sum = 0;
        for (int x = first; x < first + count; x++) sum += s->part[x];
        out[i] = sum / (float)(count * lines);
    }
}

/* Makes a blur that is of means ready for a picture, as number `which`. */
static void prepare(wf_seen *s, blur *b, const float *picture, int which) {
    size_t width = (size_t)b->width;
    if (!b->mean) return;
    for (int i = 0; i < b->lines; i++) mean_line(s, b, picture, i, b->mean + (size_t)i * width);
    for (int i = 0; i < b->lines; i++)
        pass_line(s, b, b->mean, i, b->out[which] + (size_t)i * width);
}

/* Where among means of `step` samples a sample lies: past mean *low by the share that is
 * returned. */
static float between(int at, int step, int count, int *low, int *high) {
    int twice = 2 * at - (step - 1), below = twice < 0 ? -1 : twice / (2 * step);
    *low = below < 0 ? 0 : below < count ? below : count - 1;
    *high = below + 1 < count ? below + 1 : count - 1;
    return (float)(twice - 2 * step * below) / (float)(2 * step);
}

/* Line y of a picture that has been prepared as number `which`, through a blur. */
static void blur_line(wf_seen *s, const blur *b, const float *picture, int which, int y,
                      float *out) {
    if (!b->mean) {
        pass_line(s, b, picture, y, out);
        return;
    }
    int low, high;
    float share = between(y, b->step_y, b->lines, &low, &high), *line = s->wide;
    const float *above = b->out[which] + (size_t)low * (size_t)b->width;
    const float *below = b->out[which] + (size_t)high * (size_t)b->width;
    for (int i = 0; i < b->width; i++) line[i] = above[i] + share * (below[i] - above[i]);
    for (int x = 0; x < s->viewing.width_px; x++) {
        share = between(x, b->step_x, b->width, &low, &high);
        out[x] = line[low] + share * (line[high] - line[low]);
    }
}

/* ---- What is seen ---- */

static void prepare_bands(wf_seen *s, const float *picture, int which) {
    for (int i = 0; i < WF_EYE_BANDS; i++) prepare(s, &s->band[i], picture, which);
}

/* The local luminance of line y, white being 1. */
static void luminance_of_line(wf_seen *s, const float *light, int y) {
    float least = (float)(LEAST_CD_M2 / s->viewing.white_cd_m2);
    blur_line(s, &s->local, light, 0, y, s->luminance);
    for (int x = 0; x < s->viewing.width_px; x++)
        s->luminance[x] = s->luminance[x] > least ? s->luminance[x] : least;
}

/* What the eye makes of line y of a modulation at s->luminance. */
static void weigh_line(wf_seen *s, const float *modulation, int which, int y, float *sum) {
    size_t width = (size_t)s->viewing.width_px;
    float white = (float)s->viewing.white_cd_m2;
    memset(sum, 0, width * sizeof *sum);
    for (int band = 0; band < WF_EYE_BANDS; band++) {
        blur_line(s, &s->band[band], modulation, which, y, s->part);
        wf_seen_ops_best()->add_band(sum, s->part, s->luminance, &s->eye, band, white, width);
    }
}

void wf_seen_jnd(wf_seen *s, const float *real, const float *imaginary, const float *mean,
                 float *jnd) {
    size_t width = (size_t)s->viewing.width_px;
    prepare(s, &s->local, mean, 0);
    prepare_bands(s, real, 0);
    if (imaginary) prepare_bands(s, imaginary, 1);
    for (int y = 0; y < s->viewing.lines; y++, jnd += width) {
        luminance_of_line(s, mean, y);
        weigh_line(s, real, 0, y, s->sum);
        if (imaginary) weigh_line(s, imaginary, 1, y, s->turn);
        for (size_t x = 0; x < width; x++) {
            float seen = imaginary ? hypotf(s->sum[x], s->turn[x]) : fabsf(s->sum[x]);
            jnd[x] = seen / s->luminance[x];
        }
    }
}

/* Where nothing is seen of any modulation it is not bounded, to speak of. */
#define LEAST_SENSITIVITY 1e-6f

void wf_seen_bound(wf_seen *s, const float *light, double jnd, float *bound) {
    size_t width = (size_t)s->viewing.width_px;
    float white = (float)s->viewing.white_cd_m2, j = (float)jnd;
    prepare(s, &s->local, light, 0);
    for (size_t x = 0; x < width; x++) s->part[x] = 1;
    for (int y = 0; y < s->viewing.lines; y++, bound += width) {
        luminance_of_line(s, light, y);
        memset(s->sum, 0, width * sizeof *s->sum);
        for (int band = 0; band < WF_EYE_BANDS; band++)
            wf_seen_ops_best()->add_band(s->sum, s->part, s->luminance, &s->eye, band, white,
                                         width);
        for (size_t x = 0; x < width; x++) {
            float whole = s->sum[x] > LEAST_SENSITIVITY ? s->sum[x] : LEAST_SENSITIVITY;
            bound[x] = j * s->luminance[x] / whole;
        }
    }
}
