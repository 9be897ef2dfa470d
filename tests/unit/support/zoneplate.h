#ifndef WF_TESTS_UNIT_SUPPORT_ZONEPLATE_H
#define WF_TESTS_UNIT_SUPPORT_ZONEPLATE_H

/* examples/scenes/zoneplate.lua at rest on a raster of so many pixels, lines, and so wide
 * pixels. */
typedef struct zoneplate {
    int width, lines;
    double aspect;
} zoneplate;

/* What a pixel with its middle at x, y sees through an aperture: line, box, notch or shaped;
 * NAN for others. Closed forms of whole apertures: pixels at the picture's edge see less. */
double zoneplate_truth(const zoneplate *plate, const char *aperture, double x, double y);

#endif
