/* The eye as a bank of filters of a picture: what sensitivity.h has, at one frequency in time.
 */
#ifndef WF_FILTERS_SEEN_EYE_H
#define WF_FILTERS_SEEN_EYE_H

#include <stdbool.h>

/* Where a picture is looked at from. */
typedef struct wf_viewing {
    double distance_heights; /* from the eye to the picture, in heights of the picture */
    double white_cd_m2;      /* the luminance of light 1 */
    double hz;               /* of the modulation */
    int width_px, lines;
    double pixel_aspect; /* width of a pixel over the distance of lines */
} wf_viewing;

double wf_viewing_lines_degree(const wf_viewing *v); /* in the middle of the picture */

/* What is usual where nothing is said: 6 heights for pictures of up to 608 lines, else 3; white
 * at 100 cd/m2, and of PQ and HLG at 203 (Report ITU-R BT.2408). */
double wf_viewing_usual_heights(int lines);
double wf_viewing_usual_white_cd_m2(bool high_dynamic_range);

enum {
    WF_EYE_BANDS = 5,
    WF_EYE_KNOTS = 85, /* four an octave, from 2^-7 to 2^14 cd/m2 */
    WF_EYE_LOW = -7
};

/* The sensitivity is the sum of WF_EYE_BANDS low passes exp(-f^2 / 2 c^2), f in cycles a degree
 * and c the band's width: none has a lobe below 0, so that what is seen of a modulation that is
 * nowhere above m is nowhere above that of a whole field of m. The weights are those nearest to
 * wf_sensitivity, relatively, from 0.7 to 32 cycles a degree, over the area of the picture, and
 * at 0 the sensitivity to a disk of that area or, where that is less, to the grating that is
 * seen best. They are within 7 % of it wherever it is above 3 % of its maximum, for 25 and 30
 * Hz and at least 0.3 cd/m2, and within 10 % for 12.5 and 15 Hz. */
typedef struct wf_eye {
    float weight[WF_EYE_KNOTS][WF_EYE_BANDS];
} wf_eye;

extern const double wf_eye_width[WF_EYE_BANDS]; /* c, cycles a degree */

void wf_eye_init(wf_eye *eye, const wf_viewing *viewing);

/* The sensitivity that the bank gives to a grating; at 0 cycles a degree, that to the whole
 * field. Luminances beyond the knots have the last knot's. */
double wf_eye_sensitivity(const wf_eye *eye, double cycles_degree, double cd_m2);

#endif
