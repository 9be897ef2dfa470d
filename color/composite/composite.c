/* Systems, line numbers and the subcarrier's phase. */
#include "color/composite/composite.h"

#include <math.h>
#include <stdlib.h>

#include "color/composite/composite_parts.h"

/* SMPTE 170M and Rec. ITU-R BT.1700; line lengths and picture starts from Rec. ITU-R BT.601-7.
 * 709379/2160000 is 4433618.75 Hz / 13.5 MHz. */
static const wf_tv_standard standards[] = {
    [WF_NTSC] = {.name = "ntsc",
                 .total_lines = 525,
                 .line_samples = 858,
                 .first_sample = 122,
                 .cycles = {35, 132},
                 .sequence_frames = 2,
                 .burst_degrees = {180, 180},
                 .comb_lines = 1},
    [WF_PAL] = {.name = "pal",
                .total_lines = 625,
                .line_samples = 864,
                .first_sample = 132,
                .cycles = {709379, 2160000},
                .sequence_frames = 4,
                .v_switch = true,
                .burst_degrees = {135, 225},
                .comb_lines = 2},
};

const wf_tv_standard *wf_tv_standard_of(wf_tv_system system) {
    return &standards[system];
}

/* ---- Tables ---- */

/* What is left of luma by one less the band around the subcarrier: the low-pass moved there, 2
 * g[k] cos(2 pi k fsc). It is 1 at the subcarrier because the low-pass is 0 at twice its
 * frequency, and 0 at 0 Hz because that is 0 at the subcarrier's. */
static void make_stop(wf_composite *c) {
    const int64_t *cycles = c->standard->cycles;
    c->stop = *wf_fir_luma();
    for (int k = 0; k <= c->stop.reach; k++) {
        double angle = 2 * M_PI * (double)(k * cycles[0] % cycles[1]) / (double)cycles[1];
        c->stop.tap[k] = (float)((k ? 0 : 1) - 2 * cos(angle) * (double)c->stop.tap[k]);
    }
}

static void make_carriers(wf_composite *c) {
    const int64_t *cycles = c->standard->cycles;
    for (size_t i = 0; i < c->row; i++) {
        double angle =
            2 * M_PI * (double)((int64_t)i * cycles[0] % cycles[1]) / (double)cycles[1];
        c->sine[i] = (float)sin(angle);
        c->cosine[i] = (float)cos(angle);
    }
}

wf_composite *wf_composite_new(const wf_tv *tv) {
    size_t margin = (size_t)wf_fir_chroma()->reach, row = (size_t)tv->width_px + 2 * margin;
    wf_composite *c = malloc(sizeof *c);
    float *tables = malloc(2 * row * sizeof *tables);
    if (!c || !tables) {
        free(c);
        free(tables);
        return NULL;
    }
    *c = (wf_composite){.tv = *tv,
                        .standard = wf_tv_standard_of(tv->system),
                        .row = row,
                        .margin = margin,
                        .sine = tables,
                        .cosine = tables + row};
    make_stop(c);
    make_carriers(c);
    return c;
}

void wf_composite_free(wf_composite *c) {
    if (!c) return;
    free(c->sine);
    free(c);
}

size_t wf_composite_row(const wf_composite *c) {
    return c->row;
}

size_t wf_composite_margin(const wf_composite *c) {
    return c->margin;
}

size_t wf_composite_line_room(const wf_composite *c) {
    return c->row + 2 * WF_FIR_MOST;
}

size_t wf_composite_scratch(const wf_composite *c) {
    return WF_COMPOSITE_LINES_OF_SCRATCH * wf_composite_line_room(c);
}

/* ---- The subcarrier ---- */

static int line_number(const wf_tv *tv, int line) {
    bool first_field = (line % 2 == 0) == tv->top_first;
    return (first_field ? tv->line1 : tv->line2) + line / 2;
}

wf_subcarrier wf_composite_subcarrier(const wf_composite *c, int64_t frame, int line,
                                      int sample) {
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

void wf_composite_carriers(const wf_composite *c, int64_t frame, int line, float *restrict sine,
                           float *restrict cosine) {
    wf_subcarrier at = wf_composite_subcarrier(c, frame, line, -(int)c->margin);
    double angle = 2 * M_PI * (double)at.num / (double)at.den;
    float s = (float)sin(angle), k = (float)cos(angle), sign = (float)at.v_sign;
    for (size_t i = 0; i < c->row; i++) {
        sine[i] = s * c->cosine[i] + k * c->sine[i];
        cosine[i] = sign * (k * c->cosine[i] - s * c->sine[i]);
    }
}
