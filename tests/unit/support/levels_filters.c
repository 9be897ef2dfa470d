/* Rows of samples, apertures and irregular samples, for test_isa.c. */
#include <math.h>

#include "filters/aperture/profile.h"
#include "filters/base/half.h"
#include "filters/gather/samples_inside.h"
#include "filters/least/pack.h"
#include "filters/resample/rows.h"
#include "filters/seen/seen_ops.h"
#include "tests/unit/support/levels.h"

/* ---- Rows ---- */

static void add_half(level_run *r) {
    double *sum = level_doubles(r, r->count), weight = level_uniform(r, -1, 1);
    uint16_t *pixel = level_halves(r, r->count);
    if (!r->plain) wf_row_ops_at(r->level)->add_half(sum, pixel, weight, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++)
        sum[i] += weight * (double)wf_half_value(pixel[i]);
    level_keep_doubles(r, sum, r->count);
}

/* Every half there is. */
static void add_all_halves(level_run *r) {
    double *sum = level_buffer(r, 8192 * sizeof *sum), weight = level_uniform(r, 0, 1);
    uint16_t *half = level_buffer(r, 8192 * sizeof *half), first = level_draw(r) % 8 * 8192;
    for (int i = 0; i < 8192; i++) sum[i] = 0, half[i] = (uint16_t)(first + i);
    if (!r->plain) wf_row_ops_at(r->level)->add_half(sum, half, weight, 8192);
    for (int i = 0; r->plain && i < 8192; i++)
        sum[i] += weight * (double)wf_half_value(half[i]);
    level_keep_doubles(r, sum, 8192);
}

static void add_floats(level_run *r) {
    size_t rows = level_draw(r) % 6;
    double *sum = level_doubles(r, r->count), *weight = level_doubles(r, rows);
    const float *row[6];
    bool begins = level_draw(r) % 2;
    for (size_t n = 0; n < rows; n++) row[n] = level_floats(r, r->count);
    if (!r->plain)
        wf_row_ops_at(r->level)->add_floats(sum, begins, row, weight, rows, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        if (begins) sum[i] = 0;
        for (size_t n = 0; n < rows; n++) sum[i] += weight[n] * (double)row[n][i];
    }
    level_keep_doubles(r, sum, r->count);
}

static void quick_add_floats(level_run *r) {
    size_t rows = level_draw(r) % 6;
    float *sum = level_floats(r, r->count);
    double *weight = level_doubles(r, rows);
    const float *row[6];
    bool begins = level_draw(r) % 2;
    for (size_t n = 0; n < rows; n++) row[n] = level_floats(r, r->count);
    if (!r->plain)
        wf_row_ops_at(r->level)->quick_add_floats(sum, begins, row, weight, rows, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        if (begins) sum[i] = 0;
        for (size_t n = 0; n < rows; n++) sum[i] += (float)weight[n] * row[n][i];
    }
    level_keep_floats(r, sum, r->count);
}

static void set_rows(level_run *r) {
    double *sum = level_doubles(r, r->count);
    float *a = level_floats(r, r->count), *b = level_floats(r, r->count);
    bool two = level_draw(r) % 2;
    if (!r->plain) wf_row_ops_at(r->level)->set_rows(sum, a, two ? b : NULL, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++)
        sum[i] = two ? (double)a[i] + (double)b[i] : (double)a[i];
    level_keep_doubles(r, sum, r->count);
}

static void add_row(level_run *r) {
    double *sum = level_doubles(r, r->count);
    float *pixel = level_floats(r, r->count);
    if (!r->plain) wf_row_ops_at(r->level)->add_row(sum, pixel, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) sum[i] += (double)pixel[i];
    level_keep_doubles(r, sum, r->count);
}

static void add_tap(level_run *r) {
    double *sum = level_doubles(r, r->count), *row = level_doubles(r, r->count);
    double weight = level_uniform(r, -1, 1);
    if (!r->plain) wf_row_ops_at(r->level)->add_tap(sum, row, weight, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) sum[i] += weight * row[i];
    level_keep_doubles(r, sum, r->count);
}

static void weave(level_run *r) {
    size_t strands = level_draw(r) % 8;
    double *sum = level_doubles(r, r->count), *row = level_doubles(r, r->count + strands);
    wf_strand strand[8];
    for (size_t t = 0; t < strands; t++)
        strand[t] = (wf_strand){row + (t * 3) % (strands + 1), level_number(r)};
    if (!r->plain) wf_row_ops_at(r->level)->weave(sum, strand, strands, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        sum[i] = 0;
        for (size_t t = 0; t < strands; t++) sum[i] += strand[t].weight * strand[t].row[i];
    }
    level_keep_doubles(r, sum, r->count);
}

static void quick_weave(level_run *r) {
    size_t strands = level_draw(r) % 8;
    float *out = level_floats(r, r->count), *row = level_floats(r, r->count + strands);
    float *scale = level_floats(r, r->count);
    wf_quick_strand strand[8];
    for (size_t t = 0; t < strands; t++)
        strand[t] = (wf_quick_strand){row + (t * 3) % (strands + 1), (float)level_number(r)};
    if (!r->plain) wf_row_ops_at(r->level)->quick_weave(out, strand, strands, scale, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        float sum = 0;
        for (size_t t = 0; t < strands; t++) sum += strand[t].weight * strand[t].row[i];
        out[i] = sum * scale[i];
    }
    level_keep_floats(r, out, r->count);
}

/* Onto itself too. */
static void quick_set_rows(level_run *r) {
    float *sum = level_floats(r, r->count);
    float *a = level_draw(r) % 2 ? sum : level_floats(r, r->count);
    float *b = level_floats(r, r->count);
    if (!r->plain) wf_row_ops_at(r->level)->quick_set_rows(sum, a, b, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) sum[i] = a[i] + b[i];
    level_keep_floats(r, sum, r->count);
}

static void invert(level_run *r) {
    double *row = level_doubles(r, r->count);
    if (!r->plain) wf_row_ops_at(r->level)->invert(row, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) row[i] = 1 / row[i];
    level_keep_doubles(r, row, r->count);
}

static void multiply(level_run *r) {
    double *a = level_doubles(r, r->count), *b = level_doubles(r, r->count);
    float *out = level_floats(r, r->count);
    if (!r->plain) wf_row_ops_at(r->level)->multiply(out, a, b, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) out[i] = (float)(a[i] * b[i]);
    level_keep_floats(r, out, r->count);
}

static void split_either(level_run *r, bool quick) {
    size_t lanes = 1 + level_draw(r) % 5, length = (r->count + lanes - 1) / lanes;
    length += level_draw(r) % 3;
    double *row = level_doubles(r, r->count);
    float *quick_row = level_floats(r, r->count);
    float *lane = level_buffer(r, lanes * length * sizeof *lane);
    const wf_row_ops *ops = wf_row_ops_at(r->level);
    if (!r->plain && quick) ops->quick_split(lane, quick_row, lanes, length, r->count);
    if (!r->plain && !quick) ops->split(lane, row, lanes, length, r->count);
    for (size_t n = 0; r->plain && n < lanes * length; n++) {
        size_t at = n % length * lanes + n / length;
        lane[n] = at >= r->count ? 0 : quick ? quick_row[at] : (float)row[at];
    }
    level_keep_floats(r, lane, lanes * length);
}

static void split(level_run *r) {
    split_either(r, false);
}

static void quick_split(level_run *r) {
    split_either(r, true);
}

static const level_row rows[] = {
    {"rows.add_half", add_half, true, 0},
    {"rows.add_half of all", add_all_halves, true, 0},
    {"rows.add_floats", add_floats, true, 0},
    {"rows.set_rows", set_rows, true, 0},
    {"rows.add_row", add_row, true, 0},
    {"rows.add_tap", add_tap, true, 0},
    {"rows.invert", invert, true, 0},
    {"rows.multiply", multiply, true, 0},
    {"rows.split", split, true, 0},
    {"rows.weave", weave, true, 0},
    {"rows.quick_weave", quick_weave, true, 0},
    {"rows.quick_set_rows", quick_set_rows, true, 0},
    {"rows.quick_add_floats", quick_add_floats, true, 0},
    {"rows.quick_split", quick_split, true, 0},
};

/* ---- Apertures ---- */

static wf_aperture aperture_of(const char *name) {
    wf_aperture a = {0};
    char why[256];
    wf_aperture_parse(name, &a, why, sizeof why);
    return a;
}

static double notch_at(double v) {
    v = fabs(v);
    return v < 1 ? 0.5 - v * v / 4 : v < 2 ? v * v / 4 - v + 1 : 0;
}

static double mitchell_at(const wf_aperture *a, double v) {
    double b = a->parameter[0], c = a->parameter[1], s = fabs(v), s2 = s * s, s3 = s2 * s;
    if (s < 1) return ((12 - 9 * b - 6 * c) * s3 + (-18 + 12 * b + 6 * c) * s2 + 6 - 2 * b) / 6;
    if (!(s < 2)) return 0;
    return ((-b - 6 * c) * s3 + (6 * b + 30 * c) * s2 + (-12 * b - 48 * c) * s + 8 * b +
            24 * c) /
           6;
}

/* The table of filters/README.md, Apertures. */
static double height_at(const wf_aperture *a, double tau, double v, double q) {
    switch (a->kind->profile) {
    case WF_PROFILE_LINE:
        return fabs(v) <= 0.5;
    case WF_PROFILE_BOX:
        return fabs(v) <= 1;
    case WF_PROFILE_NOTCH:
        return notch_at(v);
    case WF_PROFILE_SHAPED:
        return notch_at(v) > 0;
    case WF_PROFILE_DIAMOND:
        return fabs(v) + fabs(2 * q / tau) <= 1;
    case WF_PROFILE_MITCHELL:
        return mitchell_at(a, v);
    default:
        return fabs(v) < a->reach_v ? a->stairs.height[(int)(fabs(v) * 8)] : 0;
    }
}

static void profile(level_run *r, const char *name) {
    wf_aperture a = aperture_of(name);
    double tau = level_uniform(r, 0.1, 3), *v = level_doubles(r, r->count);
    double *q = level_doubles(r, r->count), *height = level_doubles(r, r->count);
    double *half_u = level_doubles(r, r->count);
    wf_profile which = a.kind->profile;
    int count = (int)r->count;
    if (!r->plain) wf_profile_ops_at(r->level)->of[which](&a, tau, count, v, q, height, half_u);
    for (int i = 0; r->plain && i < count; i++) {
        height[i] = height_at(&a, tau, v[i], q[i]);
        half_u[i] = which == WF_PROFILE_SHAPED ? 2 * notch_at(v[i]) : a.half_u;
    }
    level_keep_doubles(r, height, r->count);
    level_keep_doubles(r, half_u, r->count);
}

#define PROFILE(name, words)                                                                   \
    static void name(level_run *r) {                                                           \
        profile(r, words);                                                                     \
    }
PROFILE(line, "line")
PROFILE(box, "box")
PROFILE(notch, "notch")
PROFILE(shaped, "shaped")
PROFILE(diamond, "diamond")
PROFILE(mitchell, "mitchell:1/3,1/3")
PROFILE(crisp, "crisp")

static const level_row profiles[] = {
    {"profile.line", line, true, 0},       {"profile.box", box, true, 0},
    {"profile.notch", notch, true, 1e-15}, {"profile.shaped", shaped, true, 1e-15},
    {"profile.diamond", diamond, true, 0}, {"profile.mitchell", mitchell, true, 1e-14},
    {"profile.design", crisp, true, 0},
};

/* ---- Gathering ---- */

/* Which aperture, window and skew; several samples a cell, as renderers send them. */
static wf_gather_desc drawn_desc(level_run *r, wf_raster *raster) {
    static const char *const names[] = {
        "line",    "box",  "ccd",   "notch",   "shaped",
        "diamond", "calm", "crisp", "rotated", "mitchell:3/2,-1/4"};
    char why[256];
    wf_raster_parse("24x16@30i,tff,par=1:1", raster, why, sizeof why);
    wf_gather_desc d = {.raster = raster, .aperture = aperture_of(names[level_draw(r) % 10])};
    d.width = wf_ratio(level_draw(r) % 5, 2);
    d.position = (wf_position)(level_draw(r) % 3);
    d.skew = wf_ratio(level_draw(r) % 2, 2);
    d.alpha = level_draw(r) % 2;
    return d;
}

static float *cells(level_run *r, int most) {
    float *at = level_floats(r, r->count);
    for (size_t i = 0; i < r->count; i++) {
        bool odd = r->wild && !(fabsf(at[i]) <= 2);
        int cell = (int)((i / 13 * 2654435761u >> 7) % (unsigned)most);
        if (!odd) at[i] = (float)(level_uniform(r, -1, 1) + cell);
    }
    return at;
}

static void add_plainly(const wf_gather *g, const wf_samples *s, double apart) {
    const wf_gather_desc *d = &g->desc;
    bool instant = !(g->tau > 0);
    double tau = instant ? 1 : g->tau,
           middle = g->tau * (0.5 - wf_position_anchor(d->position));
    for (int line = 0; line < 8; line++)
        for (size_t k = 0; k < s->count; k++) {
            int row = g->parity + line * 2;
            double v = (double)s->y[k] - (row + 0.5);
            double q = (double)s->t[k] - apart - middle - wf_ratio_value(d->skew) * row / 16;
            bool seen = fabs(q) <= (instant ? 0x1p-12 : tau / 2);
            for (int i = 0; seen && i < 24; i++) {
                double u = (double)s->x[k] - (i + 0.5);
                double h = wf_aperture_value(&d->aperture, tau, u, v, instant ? 0 : q);
                if (instant && d->aperture.kind->couples_vq) h *= 1 - fabs(v);
                wf_pixel_sum *sum = wf_gather_sums(g, line) + i;
                h *= (double)s->weight[k];
                sum->r += h * (double)s->rgb[0][k];
                sum->g += h * (double)s->rgb[1][k];
                sum->b += h * (double)s->rgb[2][k];
                sum->weight += h;
                if (g->alpha) wf_gather_alphas(g, line)[i] += h * (double)s->alpha[k];
            }
        }
}

static void gather(level_run *r) {
    wf_raster raster;
    wf_gather_desc d = drawn_desc(r, &raster);
    wf_gather *g = wf_gather_new(&d, 2, 0, 8);
    if (!g) return;
    float *x = cells(r, 24), *y = cells(r, 16), *t = level_floats(r, r->count);
    float *red = level_floats(r, r->count), *green = level_floats(r, r->count);
    float *blue = level_floats(r, r->count), *weight = level_floats(r, r->count);
    if (wf_ratio_value(d.width) <= 0)
        for (size_t i = 0; i < r->count; i++) t[i] *= 0x1p-13f;
    float *alpha = level_floats(r, r->count);
    const wf_samples s = {r->count, x, y, t, 2, {red, green, blue}, weight, alpha, NULL};
    if (r->plain)
        add_plainly(g, &s, 0);
    else
        wf_gather_ops_at(r->level)->add(g, &s, 0);
    for (int line = 0; line < 8; line++)
        level_keep_doubles(r, &wf_gather_sums(g, line)->r, (size_t)4 * 24);
    for (int line = 0; d.alpha && line < 8; line++)
        level_keep_doubles(r, wf_gather_alphas(g, line), 24);
    wf_gather_free(g);
}

static const level_row gathering[] = {{"gather.add", gather, true, 1e-13}};

/* ---- What is seen ---- */

static void down(level_run *r) {
    enum { MOST_ROWS = 7 };
    size_t taps = 1 + level_draw(r) % MOST_ROWS, x = level_draw(r) % 3;
    const float *row[MOST_ROWS];
    float *weight = level_floats(r, taps), *out = level_floats(r, r->count);
    for (size_t k = 0; k < taps; k++) row[k] = level_floats(r, r->count + x);
    if (!r->plain) wf_seen_ops_at(r->level)->down(out, row, x, weight, taps, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        out[i] = 0;
        for (size_t k = 0; k < taps; k++) out[i] += weight[k] * row[k][x + i];
    }
    level_keep_floats(r, out, r->count);
}

static void across(level_run *r) {
    size_t reach = level_draw(r) % 6;
    float *weight = level_floats(r, reach + 1), *out = level_floats(r, r->count);
    float *in = level_floats(r, r->count + 2 * reach);
    in += reach;
    if (!r->plain) wf_seen_ops_at(r->level)->across(out, in, weight, reach, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        out[i] = weight[0] * in[i];
        for (size_t k = 1; k <= reach; k++) out[i] += weight[k] * (*(in + i - k) + in[i + k]);
    }
    level_keep_floats(r, out, r->count);
}

static void stretch(level_run *r) {
    static const size_t steps[] = {1, 2, 4, 6, 8, 16, 32};
    size_t step = steps[level_draw(r) % 7], means = 1 + r->count / step;
    size_t count = step == 1 ? means + 1 : (means + 1) * step;
    float *in = level_floats(r, means + 2), *out = level_floats(r, count);
    in++;
    if (!r->plain) wf_seen_ops_at(r->level)->stretch(out, in, step, means);
    for (size_t i = 0; r->plain && i < count; i++) {
        const float *before = in + i / step - 1;
        float share = ((float)(i % step) + 0.5f) / (float)step;
        out[i] = step == 1 ? in[i] : before[0] + share * (before[1] - before[0]);
    }
    level_keep_floats(r, out, count);
}

static double weight_of(const wf_eye *eye, int band, double cd_m2) {
    cd_m2 = fmin(fmax(cd_m2, 0x1p-7), 16383);
    int octave = (int)floor(log2(cd_m2));
    double at = 4 * (octave - WF_EYE_LOW) + 4 * (cd_m2 / exp2(octave) - 1);
    int knot = (int)at;
    double a = (double)eye->weight[knot][band], b = (double)eye->weight[knot + 1][band];
    return a + (at - knot) * (b - a);
}

/* Light over all octaves of the knots and beyond them, or all of it between two. */
static void weigh(level_run *r) {
    static wf_eye eye;
    float white = (float)level_uniform(r, 1, 300), *sum = level_floats(r, r->count);
    float *local = level_floats(r, r->count);
    const float *part[WF_EYE_BANDS];
    bool even = level_draw(r) % 2;
    double about = exp2(level_uniform(r, -20, 12));
    for (int k = 0; k < WF_EYE_KNOTS * WF_EYE_BANDS; k++)
        eye.weight[k / WF_EYE_BANDS][k % WF_EYE_BANDS] = (float)level_uniform(r, 0, 2);
    for (size_t i = 0; i < r->count; i++)
        local[i] = even ? (float)(about * level_uniform(r, 1, 1.02))
                        : local[i] * (float)exp2(level_uniform(r, -20, 12));
    for (int band = 0; band < WF_EYE_BANDS; band++) {
        const float *there = level_floats(r, r->count);
        part[band] = level_draw(r) % 4 ? there : NULL;
    }
    if (!r->plain) wf_seen_ops_at(r->level)->weigh(sum, part, local, &eye, white, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        double all = 0;
        for (int band = 0; band < WF_EYE_BANDS; band++)
            if (part[band])
                all +=
                    weight_of(&eye, band, (double)(white * local[i])) * (double)part[band][i];
        sum[i] = (float)all;
    }
    level_keep_floats(r, sum, r->count);
}

static void see(level_run *r) {
    float *jnd = level_floats(r, r->count), *real = level_floats(r, r->count);
    float *imaginary = level_floats(r, r->count), *local = level_floats(r, r->count);
    bool turns = level_draw(r) % 2;
    for (size_t i = 0; i < r->count; i++) local[i] = 0.01f + fabsf(local[i]);
    if (!r->plain)
        wf_seen_ops_at(r->level)->see(jnd, real, turns ? imaginary : NULL, local, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        double size = hypot((double)real[i], turns ? (double)imaginary[i] : 0);
        jnd[i] = (float)(size / (double)local[i]);
    }
    level_keep_floats(r, jnd, r->count);
}

/* One that is not 0, or none; -0 is. */
static void any(level_run *r) {
    float *in = level_floats(r, r->count), found = 0;
    size_t at = level_draw(r) % (2 * r->count + 1);
    for (size_t i = 0; i < r->count; i++)
        in[i] = i == at ? 1e-40f : level_draw(r) % 2 ? 0.0f : -0.0f;
    if (!r->plain) found = wf_seen_ops_at(r->level)->any(in, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++)
        if (in[i] < 0 || in[i] > 0) found = 1;
    level_keep_floats(r, &found, 1);
}

static const level_row seeing[] = {
    {"seen.down", down, true, 0},       {"seen.across", across, true, 0},
    {"seen.stretch", stretch, true, 0}, {"seen.weigh", weigh, true, 1e-6},
    {"seen.see", see, true, 1e-6},      {"seen.any", any, true, 0}};

/* ---- Nearest pictures ---- */

enum { TILE = WF_LEAST_COLUMNS, LANES = WF_LEAST_LANES };

static double *tile_of(level_run *r, int lines) {
    return level_doubles(r, (size_t)lines * TILE);
}

static void smooth(level_run *r) {
    int lines = 3 + (int)(r->count % 60);
    double *x = tile_of(r, lines), *f1 = level_doubles(r, (size_t)lines);
    double *f2 = level_doubles(r, (size_t)lines), *inverse = level_doubles(r, (size_t)lines);
    const wf_least_factor f = {f1, f2, inverse, lines};
    f1[0] = f2[0] = f2[1] = 0;
    if (!r->plain) wf_least_ops_at(r->level)->smooth(&f, x);
    for (int i = 0; r->plain && i < TILE; i++) {
        for (int j = 1; j < lines; j++)
            x[j * TILE + i] = x[j * TILE + i] - f1[j] * x[(j - 1) * TILE + i] -
                              f2[j] * (j > 1 ? x[(j - 2) * TILE + i] : 0);
        for (int j = lines - 1; j >= 0; j--) {
            x[j * TILE + i] *= inverse[j];
            if (j + 1 < lines)
                x[j * TILE + i] = x[j * TILE + i] - f1[j + 1] * x[(j + 1) * TILE + i] -
                                  (j + 2 < lines ? f2[j + 2] : 0) *
                                      (j + 2 < lines ? x[(j + 2) * TILE + i] : 0);
        }
    }
    level_keep_doubles(r, x, (size_t)lines * TILE);
}

static double bob_flicker(const double *x, int lines, int j) {
    double above = x[(j ? j - 1 : 1) * TILE], below = x[(j < lines - 1 ? j + 1 : j - 1) * TILE];
    return 0.5 * x[j * TILE] - 0.25 * (above + below);
}

static double *limits_of(level_run *r, int lines) {
    double *limit = tile_of(r, lines);
    for (int n = 0; n < lines * TILE; n++) limit[n] = level_uniform(r, 0.01, 0.2);
    return limit;
}

static void look(level_run *r) {
    int lines = 3 + (int)(r->count % 60);
    double *x = tile_of(r, lines), *limit = limits_of(r, lines), excess[TILE];
    const wf_least_claim c = {
        .l = x, .lines = lines, .most = 1.5, .limit = limit, .limit_step = TILE};
    if (!r->plain) wf_least_ops_at(r->level)->look(&c, excess);
    for (int i = 0; r->plain && i < TILE; i++) {
        excess[i] = -INFINITY;
        for (int j = 0; j < lines; j++) {
            double l = x[j * TILE + i];
            double over = fabs(bob_flicker(x + i, lines, j)) - limit[j * TILE + i];
            over = over > l - 1.5 ? over : l - 1.5; /* NaN as the second of two stays */
            over = over > -l ? over : -l;
            excess[i] = excess[i] > over ? excess[i] : over;
        }
    }
    level_keep_doubles(r, excess, TILE);
}

static double plain_gap(const wf_least_claim *c, int i) {
    double gap = 0, high, low, tension;
    for (int j = 0; j < c->lines; j++) {
        int at = j * TILE + i;
        double rest = c->l[at] - c->s[at] + c->press[at];
        for (int k = j - 1; k <= j + 1; k++) {
            if (k < 0 || k >= c->lines) continue;
            double b = k == j ? 0.5 : k == 0 || k == c->lines - 1 ? -0.5 : -0.25;
            tension = c->tension[k * TILE + i];
            rest += b * (tension + c->weight * bob_flicker(c->l + i, c->lines, k));
        }
        tension = c->tension[at];
        high = c->press[at] > 0 ? c->press[at] * (c->most - c->l[at]) : 0;
        low = c->press[at] > 0 ? 0 : -c->press[at] * c->l[at];
        gap += rest * rest +
               2 * (high + low + c->limit[j * c->limit_step + i] * fabs(tension)) -
               2 * tension * bob_flicker(c->l + i, c->lines, j);
    }
    return gap;
}

static void prove(level_run *r) {
    int lines = 3 + (int)(r->count % 60);
    const wf_least_claim c = {tile_of(r, lines),
                              tile_of(r, lines),
                              tile_of(r, lines),
                              tile_of(r, lines),
                              lines,
                              4,
                              1,
                              limits_of(r, lines),
                              TILE};
    double gap[TILE];
    if (!r->plain) wf_least_ops_at(r->level)->prove(&c, gap);
    for (int i = 0; r->plain && i < TILE; i++) gap[i] = plain_gap(&c, i);
    level_keep_doubles(r, gap, TILE);
}

/* Lanes of columns in a bound of 0.1; test_least.c holds what comes out to another solver. */
static void solve(level_run *r) {
    int height = 5 + (int)(r->count % 40);
    wf_least_pack p = {.rows = height, .capacity = height, .boxed = r->count % 2};
    size_t all = (size_t)(height + 2 * WF_LEAST_GUARD) * LANES * WF_LEAST_ARRAYS;
    p.arrays = level_buffer(r, all * sizeof *p.arrays);
    for (size_t n = 0; n < all; n++) p.arrays[n] = 0;
    for (int n = 0; n < height * LANES; n++) {
        bool inside = n >= LANES && n < (height - 1) * LANES;
        const double given[] = {level_uniform(r, 0, 1),
                                1.5,
                                -1,
                                0.25,
                                -0.25,
                                -0.25,
                                1,
                                1,
                                0.1,
                                0.5,
                                0.1,
                                0.1,
                                0.1,
                                0.1};
        for (int a = 0; a < (int)(sizeof given / sizeof *given); a++)
            wf_least_rows(&p, a)[n] = given[a];
        for (int a = WF_LEAST_ABOVE; !inside && a <= WF_LEAST_BOUND; a++)
            wf_least_rows(&p, a)[n] = 0;
    }
    for (int i = 0; i < LANES; i++) p.most[i] = 1, p.tolerance[i] = 1e-10;
    wf_least_ops_at(r->level)->solve(&p);
    level_keep_doubles(r, wf_least_rows(&p, WF_LEAST_L), (size_t)height * LANES);
}

static const level_row nearest[] = {
    {"least.smooth", smooth, true, 0},
    {"least.look", look, true, 0},
    {"least.prove", prove, true, 1e-12},
    {"least.solve", solve, false, 0},
};

const level_table level_filters[] = {
    LEVEL_TABLE("filters/least/least_isa.c", wf_least_ops, nearest),
    LEVEL_TABLE("filters/resample/rows_isa.c", wf_row_ops, rows),
    LEVEL_TABLE("filters/aperture/profile_isa.c", wf_profile_ops, profiles),
    LEVEL_TABLE("filters/gather/samples_isa.c", wf_gather_ops, gathering),
    LEVEL_TABLE("filters/seen/seen_isa.c", wf_seen_ops, seeing),
    {.file = NULL},
};
