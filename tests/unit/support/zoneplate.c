/* The zone plate in closed form, as apertures see it. */
#include "tests/unit/support/zoneplate.h"

#include <complex.h>
#include <math.h>
#include <string.h>

/* cos(a (x^2 + y^2)) is the real part of a product of Fresnel integrals, one along x and one
 * along y; the shaped aperture needs both at once. Integrals by Gauss and Legendre's rule, far
 * within double's reach on pieces this short. */

/* ---- Integrals ---- */

#define NODES 10
static const double node[NODES / 2] = {0.1488743389816312, 0.4333953941292472,
                                       0.6794095682990244, 0.8650633666889845,
                                       0.9739065285171717};
static const double weight[NODES / 2] = {0.2955242247147529, 0.2692667193099963,
                                         0.2190863625159820, 0.1494513491505806,
                                         0.0666713443086881};

typedef double complex wave_fn(double z, const void *user);

static double complex integral(wave_fn *fn, const void *user, double from, double to) {
    double complex sum = 0;
    double middle = (from + to) / 2, half = (to - from) / 2;
    for (int k = 0; k < NODES / 2; k++)
        sum +=
            weight[k] * (fn(middle - half * node[k], user) + fn(middle + half * node[k], user));
    return sum * half;
}

typedef struct pixel {
    const zoneplate *plate;
    double x, y; /* its middle */
} pixel;

static double complex wave(const zoneplate *plate, double r) {
    return cexp(I * M_PI / plate->lines * r * r);
}

static double complex wave_x(double x, const void *user) {
    const pixel *p = user;
    return wave(p->plate, (x - p->plate->width / 2.0) * p->plate->aspect);
}

static double f(double v) {
    double s = fabs(v);
    return s < 1 ? 0.5 - s * s / 4 : s < 2 ? s * s / 4 - s + 1 : 0;
}

/* ---- Apertures ---- */

static double complex plain(double v, const void *user) {
    const pixel *p = user;
    return wave(p->plate, p->y + v - p->plate->lines / 2.0);
}

static double complex notched(double v, const void *user) {
    return f(v) * plain(v, user);
}

static double complex shaped(double v, const void *user) {
    const pixel *p = user;
    double half = 2 * f(v);
    double complex across =
        integral(wave_x, p, p->x - half, p->x) + integral(wave_x, p, p->x, p->x + half);
    return across * plain(v, user);
}

static double seen(double complex light, double area) {
    return 0.5 + 0.5 * creal(light) / area;
}

static double complex column(pixel p) {
    return integral(wave_x, &p, p.x - 0.5, p.x + 0.5);
}

static double line_truth(pixel p) {
    return seen(column(p) * integral(plain, &p, -0.5, 0.5), 1);
}

static double box_truth(pixel p) {
    return seen(column(p) * (integral(plain, &p, -1, 0) + integral(plain, &p, 0, 1)), 2);
}

static double over_pieces(wave_fn *fn, pixel p, double complex across, double area) {
    double complex sum = 0;
    for (int piece = -2; piece < 2; piece++) sum += integral(fn, &p, piece, piece + 1);
    return seen(across * sum, area);
}

static double notch_truth(pixel p) {
    return over_pieces(notched, p, column(p), 1);
}

static double shaped_truth(pixel p) {
    return over_pieces(shaped, p, 1, 4);
}

double zoneplate_truth(const zoneplate *plate, const char *aperture, double x, double y) {
    static const struct {
        const char *name;
        double (*truth)(pixel);
    } rows[] = {{"line", line_truth},
                {"box", box_truth},
                {"notch", notch_truth},
                {"shaped", shaped_truth}};
    for (size_t n = 0; n < sizeof rows / sizeof *rows; n++)
        if (!strcmp(rows[n].name, aperture)) return rows[n].truth((pixel){plate, x, y});
    return NAN;
}
