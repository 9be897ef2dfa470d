/* A coder: the raster that it codes, and the tables that encoding and decoding share. */
#include "color/composite/composite.h"

#include <math.h>
#include <stdlib.h>

#include "color/composite/coder.h"

/* The band stop of the filtered encoder is one less a band pass, and that is the luma low-pass
 * g moved to the subcarrier: 2 g[k] cos(2 pi k fsc). It passes the subcarrier whole because g
 * is 0 at 2 fsc, and nothing at 0 Hz because g is 0 at fsc. */
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

size_t wf_composite_scratch_line(const wf_composite *c) {
    return c->row + 2 * WF_FIR_MOST;
}

size_t wf_composite_scratch(const wf_composite *c) {
    return WF_COMPOSITE_SCRATCH_LINES * wf_composite_scratch_line(c);
}
