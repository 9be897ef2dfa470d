/* Colors of textures at points of a packet. */
#include <math.h>

#include "filters/base/isa_file.h"
#include "tracer/rays/sincos.h"
#include "tracer/rays/texture.h"

static inline double dot(wf_vec v, const wf_points *p, int i) {
    return v.x * p->x[i] + v.y * p->y[i] + v.z * p->z[i];
}

static void plain(const wf_texture *t, int i, bool second, double *const rgb[3]) {
    for (int c = 0; c < 3; c++) rgb[c][i] = (double)t->color[second][c];
}

/* The one or the other color for each point, by which[i] = 0 or 1. */
static void mix(const wf_texture *t, const double *restrict which, int count,
                double *const rgb[3]) {
    for (int c = 0; c < 3; c++) {
        double a = (double)t->color[0][c], b = (double)t->color[1][c], *restrict out = rgb[c];
        for (int i = 0; i < count; i++) out[i] = which[i] != 0 ? b : a;
    }
}

static inline double odd(double whole) {
    return whole - 2 * floor(whole / 2);
}

/* Which cell, where faces that lie on a border of cells, as those of most boxes do, belong to
 * the cell beyond on all of their points, whatever rounding makes of them. */
static inline double cell(double v, double size) {
    return floor(v / size + 0x1p-32);
}

static void checker(const wf_scene *s, const wf_texture *t, const wf_points *p, int count,
                    double *const rgb[3]) {
    double which[WF_PACKET], size = t->size;
    (void)s;
    for (int i = 0; i < count; i++)
        which[i] = odd(cell(p->x[i], size) + cell(p->y[i], size) + cell(p->z[i], size));
    mix(t, which, count, rgb);
}

static void stripe(const wf_scene *s, const wf_texture *t, const wf_points *p, int count,
                   double *const rgb[3]) {
    double which[WF_PACKET], size = t->size;
    wf_vec axis = t->axis;
    (void)s;
    for (int i = 0; i < count; i++) which[i] = odd(cell(dot(axis, p, i), size));
    mix(t, which, count, rgb);
}

/* 1/2 + 1/2 cos(pi r^2 / H), between the first color and the second. */
static void zoneplate(const wf_scene *s, const wf_texture *t, const wf_points *p, int count,
                      double *const rgb[3]) {
    double x0 = dot(t->across, &(wf_points){{t->center.x}, {t->center.y}, {t->center.z}}, 0);
    double y0 = dot(t->down, &(wf_points){{t->center.x}, {t->center.y}, {t->center.z}}, 0);
    (void)s;
    for (int i = 0; i < count; i++) {
        double x = dot(t->across, p, i) - x0, y = dot(t->down, p, i) - y0, cosine, sine;
        wf_sincos_turns((x * x + y * y) / (2 * t->height), &cosine, &sine);
        double share = 0.5 + 0.5 * cosine;
        for (int c = 0; c < 3; c++) {
            double a = (double)t->color[0][c], b = (double)t->color[1][c];
            rgb[c][i] = b + share * (a - b);
        }
    }
}

/* ---- Pictures ---- */

static int wrap(double v, int size, bool repeat) {
    if (repeat) v -= size * floor(v / size);
    return v < 0 ? 0 : v > size - 1 ? size - 1 : (int)v;
}

/* Between the four nearest pixels. */
static void image_at(const wf_image *m, double u, double v, bool repeat, double out[3]) {
    double x = u * m->width_px - 0.5, y = v * m->height_px - 0.5;
    double x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0;
    int left = wrap(x0, m->width_px, repeat), right = wrap(x0 + 1, m->width_px, repeat);
    int top = wrap(y0, m->height_px, repeat), bottom = wrap(y0 + 1, m->height_px, repeat);
    const float *row[2] = {m->rgb + 3 * (size_t)top * (size_t)m->width_px,
                           m->rgb + 3 * (size_t)bottom * (size_t)m->width_px};
    for (int c = 0; c < 3; c++) {
        double a = (double)row[0][3 * left + c], b = (double)row[0][3 * right + c];
        double d = (double)row[1][3 * left + c], e = (double)row[1][3 * right + c];
        out[c] = (1 - fy) * (a + fx * (b - a)) + fy * (d + fx * (e - d));
    }
}

/* Beyond its picture the texture shows its second color. */
static void image(const wf_scene *s, const wf_texture *t, const wf_points *p, int count,
                  double *const rgb[3]) {
    const wf_image *picture = &s->images[t->image];
    wf_points corner = {{t->center.x}, {t->center.y}, {t->center.z}};
    double u0 = dot(t->across, &corner, 0), v0 = dot(t->down, &corner, 0);
    for (int i = 0; i < count; i++) {
        double u = (dot(t->across, p, i) - u0) / t->width, out[3];
        double v = (dot(t->down, p, i) - v0) / t->height;
        if (!t->repeat && !(u >= 0 && u <= 1 && v >= 0 && v <= 1)) {
            plain(t, i, true, rgb);
            continue;
        }
        image_at(picture, u, v, t->repeat, out);
        for (int c = 0; c < 3; c++) rgb[c][i] = out[c];
    }
}

const wf_texture_ops WF_ISA_TABLE(wf_texture_ops) = {
    .color =
        {
            [WF_TEXTURE_CHECKER] = checker,
            [WF_TEXTURE_STRIPE] = stripe,
            [WF_TEXTURE_ZONEPLATE] = zoneplate,
            [WF_TEXTURE_IMAGE] = image,
        },
};
