/* How small a modulation of light the eye sees, by its frequencies in space and time. */
#ifndef WF_FILTERS_SEEN_SENSITIVITY_H
#define WF_FILTERS_SEEN_SENSITIVITY_H

/* Contrast sensitivity of the fovea to luminance: 1 over the contrast (the amplitude of the
 * modulation over its mean) that is just seen. castleCSF of Ashraf, Mantiuk, Chapiro and
 * Wuerger, "castleCSF - A contrast sensitivity function of color, area, spatiotemporal
 * frequency, luminance and eccentricity", Journal of Vision 24(4), 2024, article 5: its
 * achromatic mechanisms, with the parameters that its authors published in version 0.2.4 of
 * their program. */

/* Of a grating of so many cycles a degree, above 0, whose contrast changes hz times a second,
 * over a mean of cd_m2, above 0, and an area in square degrees. */
double wf_sensitivity(double cycles_degree, double hz, double cd_m2, double area_degree2);

/* Of a disk that as a whole grows brighter and darker, so many degrees in radius: that of the
 * grating which is seen best over 2.42437 square degrees, times radius^(1/3.01142) (Ashraf,
 * Mantiuk and Chapiro, "Modelling contrast sensitivity of discs", Electronic Imaging 35, 2023,
 * HVEI-246). */
double wf_sensitivity_disk(double hz, double cd_m2, double radius_degree);

#endif
