/* How much an aperture flickers. */
#ifndef WF_FILTERS_APERTURE_FLICKER_H
#define WF_FILTERS_APERTURE_FLICKER_H

#include "filters/aperture/aperture.h"

/* Interline flicker of the still zone plate, from responses alone.
 *
 * Line j of one field lies between lines j - 1 and j + 1 of the other. When each field is
 * stretched to the full raster by linear interpolation, half of what they differ by at line j
 * is half of x[j] - (x[j-1] + x[j+1]) / 2, whose response is sin^2(pi fy). The zone plate 1/2 +
 * 1/2 cos(pi r^2 / H) looks like a grating of amplitude |H(fx, fy)| / 2 wherever one looks, and
 * of frequencies that are uniform: fy = |y| / H up to 1/2 cycle a line, and fx = a^2 |x| / H up
 * to a^2 W / 2H cycles a pixel, x in pixels of aspect a. A grating's mean square is half that
 * of its amplitude, hence
 *
 *     flicker^2 = 1/8 mean over fy, fx of sin^4(pi fy) H(fx, fy)^2.
 *
 * The picture is that of 525i: 720 by 486 pixels of aspect 10/11. */

#define WF_FLICKER_POINTS 64 /* of fy, and of fx: the midpoint rule */

double wf_flicker_fy(int point); /* cycles/line */
double wf_flicker_fx(int point); /* cycles/pixel */

/* The RMS over the picture, white being 1, of a response to gratings at rest. */
typedef double wf_flicker_response(const void *user, double fx, double fy);
double wf_flicker(wf_flicker_response *response, const void *user);

double wf_aperture_flicker(const wf_aperture *a);

#endif
