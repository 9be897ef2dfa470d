/* The truth about zoneplate.lua, in closed form: bench-zoneplate WIDTH LINES ASPECT APERTURE
 * PICTURE.exr. What lies at the edge, where apertures are cut, is -1. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/zoneplate.h"

#define EDGE 2

typedef struct truth {
    zoneplate plate;
    const char *aperture;
} truth;

static float value(const void *user, int channel, int x, int y) {
    const truth *t = user;
    bool edge =
        x < EDGE || y < EDGE || x >= t->plate.width - EDGE || y >= t->plate.lines - EDGE;
    (void)channel;
    return edge ? -1 : (float)zoneplate_truth(&t->plate, t->aperture, x + 0.5, y + 0.5);
}

int main(int argc, char **argv) {
    if (argc != 6) {
        fprintf(stderr, "usage: bench-zoneplate WIDTH LINES ASPECT APERTURE PICTURE.exr\n");
        return 2;
    }
    const truth t = {{atoi(argv[1]), atoi(argv[2]), atof(argv[3])}, argv[4]};
    const wf_box box = {0, 0, t.plate.width, t.plate.lines};
    const exr_part part = {.display = box,
                           .data = box,
                           .channels = "B G R",
                           .type = EXR_PIXEL_FLOAT,
                           .compression = EXR_COMPRESSION_NONE,
                           .value = value,
                           .user = &t};
    if (exr_write(argv[5], &part, 1)) return 0;
    fprintf(stderr, "bench-zoneplate: %s cannot be written\n", argv[5]);
    return 1;
}
