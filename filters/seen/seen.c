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

/* In both directions. */
typedef struct blur {
    low_pass down, across;
} blur;

struct wf_seen {
    wf_viewing viewing;
    wf_eye eye;
    blur band[WF_EYE_BANDS], local;
    const float **row;                    /* what a low pass sums up */
    float *wide;                          /* [reach + width + reach], as `local` reaches */
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

static bool make_low_pass(low_pass *p, double cycles_sample) {
    double sum = 0, deviation = 1 / (2 * M_PI * cycles_sample);
    p->reach = (int)ceil(4 * deviation) + 4;
    if (p->reach > 4096) p->reach = 4096;
    p->weight = malloc((size_t)(p->reach + 1) * sizeof *p->weight);
    p->both = malloc((size_t)(2 * p->reach + 1) * sizeof *p->both);
    if (!p->weight || !p->both) return false;
    for (int k = 0; k <= p->reach; k++) {
        double gauss = exp(-0.5 * k * k / (deviation * deviation));
        double value = deviation > 2 ? gauss : tap(cycles_sample, k);
        p->weight[k] = (float)value;
        sum += k ? 2 * value : value;
    }
    for (int k = 0; k <= p->reach; k++) {
        p->weight[k] = (float)((double)p->weight[k] / sum);
        p->both[p->reach - k] = p->both[p->reach + k] = p->weight[k];
    }
    return true;
}

static bool make_blur(const wf_viewing *v, double cycles_degree, blur *b) {
    double f = cycles_degree / wf_viewing_lines_degree(v);
    return make_low_pass(&b->down, f) && make_low_pass(&b->across, f * v->pixel_aspect);
}

static bool make_blurs(wf_seen *s) {
    bool made = make_blur(&s->viewing, 1 / (2 * M_PI * LOCAL_DEGREE), &s->local);
    for (int i = 0; i < WF_EYE_BANDS && made; i++)
        made = make_blur(&s->viewing, wf_eye_width[i], &s->band[i]);
    return made;
}

/* The blur of the local luminance reaches farthest. */
static bool make_lines(wf_seen *s) {
    size_t width = (size_t)s->viewing.width_px;
    s->row = malloc((2 * (size_t)s->local.down.reach + 1) * sizeof *s->row);
    s->wide = malloc((width + 2 * (size_t)s->local.across.reach) * sizeof *s->wide);
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

/* ---- Using it ---- */

/* Line y of a picture through a blur. */
static void blur_line(wf_seen *s, const blur *b, const float *picture, int y, float *out) {
    const wf_seen_ops *ops = wf_seen_ops_best();
    size_t width = (size_t)s->viewing.width_px;
    float *middle = s->wide + s->local.across.reach;
    int down = b->down.reach, across = b->across.reach, last = s->viewing.lines - 1;
    for (int k = -down; k <= down; k++) {
        int from = y + k < 0 ? 0 : y + k < last ? y + k : last;
        s->row[k + down] = picture + (size_t)from * width;
    }
    ops->down(middle, s->row, b->down.both, (size_t)(2 * down + 1), width);
    for (int k = 1; k <= across; k++) {
        middle[-k] = middle[0];
        middle[(ptrdiff_t)width + k - 1] = middle[width - 1];
    }
    ops->across(out, middle, b->across.weight, (size_t)across, width);
}

/* The local luminance of line y, white being 1. */
static void luminance_of_line(wf_seen *s, const float *light, int y) {
    float least = (float)(LEAST_CD_M2 / s->viewing.white_cd_m2);
    blur_line(s, &s->local, light, y, s->luminance);
    for (int x = 0; x < s->viewing.width_px; x++)
        s->luminance[x] = s->luminance[x] > least ? s->luminance[x] : least;
}

/* What the eye makes of line y of a modulation at s->luminance. */
static void weigh_line(wf_seen *s, const float *modulation, int y, float *sum) {
    size_t width = (size_t)s->viewing.width_px;
    float white = (float)s->viewing.white_cd_m2;
    memset(sum, 0, width * sizeof *sum);
    for (int band = 0; band < WF_EYE_BANDS; band++) {
        blur_line(s, &s->band[band], modulation, y, s->part);
        wf_seen_ops_best()->add_band(sum, s->part, s->luminance, &s->eye, band, white, width);
    }
}

void wf_seen_jnd(wf_seen *s, const float *real, const float *imaginary, const float *mean,
                 float *jnd) {
    size_t width = (size_t)s->viewing.width_px;
    for (int y = 0; y < s->viewing.lines; y++, jnd += width) {
        luminance_of_line(s, mean, y);
        weigh_line(s, real, y, s->sum);
        if (imaginary) weigh_line(s, imaginary, y, s->turn);
        for (size_t x = 0; x < width; x++) {
            float seen = imaginary ? hypotf(s->sum[x], s->turn[x]) : fabsf(s->sum[x]);
            jnd[x] = seen / s->luminance[x];
        }
    }
}

/* Where nothing is seen of any modulation it is not bounded, to speak of. */
#define LEAST_SENSITIVITY 1e-6

void wf_seen_bound(wf_seen *s, const float *light, double jnd, float *bound) {
    size_t width = (size_t)s->viewing.width_px;
    for (int y = 0; y < s->viewing.lines; y++, bound += width) {
        luminance_of_line(s, light, y);
        for (size_t x = 0; x < width; x++) {
            double mean = (double)s->luminance[x];
            double whole = wf_eye_sensitivity(&s->eye, 0, mean * s->viewing.white_cd_m2);
            bound[x] = (float)(jnd * mean / fmax(whole, LEAST_SENSITIVITY));
        }
    }
}
