/* Halves chroma down the lines of a field or a frame, for codecs of 4:2:0. */
#include "color/codes/chroma_420.h"

#include <math.h>

#include "filters/base/sinc.h"

enum { REACH = 4, TAPS = 2 * REACH };

static double half_band(double d) {
    if (fabs(d) >= REACH) return 0;
    double window = cos(M_PI * d / (2 * REACH));
    return wf_sinc(d / 2) * window * window;
}

/* The weights of TAPS lines from `first` on, about a place between them. */
static void weigh(double place, int first, double weight[TAPS]) {
    double sum = 0;
    for (int i = 0; i < TAPS; i++) sum += weight[i] = half_band(first + i - place);
    for (int i = 0; i < TAPS; i++) weight[i] /= sum;
}

static int inside(int line, int lines) {
    return line < 0 ? 0 : line < lines ? line : lines - 1;
}

void wf_chroma_420_row(const uint16_t *rows, size_t stride, int lines, int count, int row,
                       bool woven, int least, int most, uint16_t *to) {
    int fields = woven ? 2 : 1, parity = row % fields, own = lines / fields;
    int line = 2 * (row / fields), first = line - REACH + 1;
    double place = line + (woven ? 0.25 + 0.5 * parity : 0.5), weight[TAPS];
    const uint16_t *from[TAPS];
    weigh(place, first, weight);
    for (int i = 0; i < TAPS; i++)
        from[i] = rows + (size_t)(inside(first + i, own) * fields + parity) * stride;
    for (int x = 0; x < count; x++) {
        double sum = 0;
        for (int i = 0; i < TAPS; i++) sum += weight[i] * from[i][x];
        long code = lrint(sum);
        to[x] = (uint16_t)(code < least ? least : code > most ? most : code);
    }
}
