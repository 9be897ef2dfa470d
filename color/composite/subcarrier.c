/* The phase of the color subcarrier, in exact fractions of a cycle. */
#include "color/composite/subcarrier.h"

#include <math.h>

#include "color/composite/coder.h"

static int line_number(const wf_tv *tv, int line) {
    bool first_field = (line % 2 == 0) == tv->top_first;
    return (first_field ? tv->line1 : tv->line2) + line / 2;
}

wf_subcarrier wf_subcarrier_at(const wf_composite *c, int64_t frame, int line, int sample) {
    const wf_tv_standard *s = c->standard;
    int number = line_number(&c->tv, line);
    int64_t lines = frame % s->sequence_frames * s->total_lines + number - 1;
    int64_t samples = lines * s->line_samples + s->first_sample + sample;
    bool minus = s->v_switch && lines % 2;
    return (wf_subcarrier){.num = samples * s->cycles[0] % s->cycles[1],
                           .den = s->cycles[1],
                           .v_sign = minus ? -1 : 1,
                           .burst_degrees = s->burst_degrees[minus],
                           .line_number = number};
}

void wf_subcarrier_row(const wf_composite *c, int64_t frame, int line, float *restrict sine,
                       float *restrict cosine) {
    wf_subcarrier at = wf_subcarrier_at(c, frame, line, -(int)c->margin);
    double angle = 2 * M_PI * (double)at.num / (double)at.den;
    float s = (float)sin(angle), k = (float)cos(angle), sign = (float)at.v_sign;
    for (size_t i = 0; i < c->row; i++) {
        sine[i] = s * c->cosine[i] + k * c->sine[i];
        cosine[i] = sign * (k * c->cosine[i] - s * c->sine[i]);
    }
}
