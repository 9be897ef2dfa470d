/* Samples of adaptive cells are traced in the order of where they lie, not in that in which
 * they were drawn: so packets are full, however few samples a cell has, and see little of the
 * picture each, however many. */
#include "tracer/sample/adaptive_packets.h"

#include <stdlib.h>

/* Half cells are visited along Z's in Z's (Morton 1966): 6 bits of where in x and in y. */
#define HALF_BITS  6
#define HALF_CELLS (1 << 2 * HALF_BITS)
_Static_assert(2 * GRID_WIDTH <= 1 << HALF_BITS && 2 * GRID_ROWS <= 1 << HALF_BITS,
               "every half cell of the grid has a number");

/* Four by four cells, or a half row of them: a packet goes on in the next only if it has fewer
 * samples than this. Few wide packets meet as much as more narrow ones, or more. */
#define BLOCK      (1 << HALF_BITS)
#define LEAST_FULL 32

void wf_packet_order_free(wf_packet_order *order) {
    free(order->sample);
    free(order->half);
    *order = (wf_packet_order){0};
}

static bool reserve(wf_packet_order *order, size_t count) {
    if (count <= order->capacity) return true;
    wf_packet_order_free(order);
    order->sample = malloc(2 * count * sizeof *order->sample);
    order->half = malloc(2 * count * sizeof *order->half);
    if (!order->sample || !order->half) return false;
    order->capacity = 2 * count;
    return true;
}

/* Six bits apart. */
static unsigned spread(unsigned v) {
    v = (v | v << 4) & 0x30fu;
    v = (v | v << 2) & 0x333u;
    return (v | v << 1) & 0x555u;
}

/* Rows that are not as late as each other cannot share a packet, and follow one another. */
static bool are_alike(const wf_adaptive *a) {
    for (int row = 1; row < GRID_ROWS; row++)
        if (a->time[row].late != a->time[0].late) return false;
    return true;
}

/* In which half cells samples lie, from the first on. */
static void find_half_cells(const wf_adaptive *a, const wf_adaptive_samples *k, size_t first,
                            bool alike, uint16_t *half) {
    float x0 = (float)wf_cell_x(a, 0), y0 = (float)wf_cell_y(a, 0);
    for (size_t n = first; n < k->count; n++) {
        unsigned column = (unsigned)(int)(2 * (k->x[n] - x0));
        unsigned row = (unsigned)(int)(2 * (k->y[n] - y0));
        unsigned number = alike ? spread(column) | spread(row) << 1 : row << HALF_BITS | column;
        half[n - first] = (uint16_t)number;
    }
}

/* Numbers of the samples from the first on, by half cells; where each block of these ends. */
static void sort(const wf_packet_order *order, size_t first, size_t count,
                 size_t ends[HALF_CELLS / BLOCK]) {
    uint32_t next[HALF_CELLS + 1] = {0};
    for (size_t n = 0; n < count; n++) next[order->half[n] + 1]++;
    for (int at = 0; at < HALF_CELLS; at++) next[at + 1] += next[at];
    for (int n = 0; n < HALF_CELLS / BLOCK; n++) ends[n] = next[(n + 1) * BLOCK];
    for (size_t n = 0; n < count; n++)
        order->sample[next[order->half[n]]++] = (uint32_t)(first + n);
}

static void place_rays(const wf_adaptive *a, const wf_adaptive_samples *k,
                       const uint32_t *order, size_t count, double late) {
    wf_sampling_scratch *c = a->c;
    for (size_t i = 0; i < count; i++) {
        size_t n = order[i];
        c->trace_x[i] = (double)k->x[n];
        c->trace_y[i] = (double)k->y[n];
        c->trace_f[i] = wf_window_fraction(a->s, (double)k->t[n], late, (double)k->fraction[n]);
    }
}

/* So many samples, which are as late as each other and for which the scratch has space. */
static bool trace_some(const wf_adaptive *a, wf_adaptive_samples *k, const uint32_t *order,
                       size_t count) {
    wf_sampling_scratch *c = a->c;
    double late = a->time[k->cell[order[0]] / WF_QUARTERS / GRID_WIDTH].late;
    const wf_trace_samples traced = {
        .count = count,
        .x = c->trace_x,
        .y = c->trace_y,
        .f = c->trace_f,
        .late_s = a->s->periods ? 0 : late * wf_ratio_value(wf_sampling_period(a->s)),
        .rgb = {c->rgb[0], c->rgb[1], c->rgb[2]}};
    place_rays(a, k, order, count, late);
    if (!wf_trace(a->s->tracer, c->trace, &traced)) return false;
    for (int ch = 0; ch < 3; ch++)
        for (size_t i = 0; i < count; i++) k->rgb[ch][order[i]] = c->rgb[ch][i];
    return true;
}

/* As many samples as there are. */
static bool trace(const wf_adaptive *a, wf_adaptive_samples *k, const uint32_t *order,
                  size_t count) {
    size_t most = a->c->capacity / WF_TRACE_PACKET * WF_TRACE_PACKET;
    for (size_t some; count; order += some, count -= some) {
        some = count < most ? count : most;
        if (!trace_some(a, k, order, some)) return false;
    }
    return true;
}

bool wf_points_trace(const wf_adaptive *a, wf_adaptive_samples *k, size_t first) {
    size_t ends[HALF_CELLS / BLOCK], count = k->count - first, from = 0;
    wf_packet_order *order = &a->c->order;
    bool alike = are_alike(a);
    size_t least = alike ? LEAST_FULL : 1;
    if (!reserve(order, count)) return false;
    find_half_cells(a, k, first, alike, order->half);
    sort(order, first, count, ends);
    for (int n = 0; n < HALF_CELLS / BLOCK; n++) {
        size_t left = (ends[n] - from) % WF_TRACE_PACKET;
        size_t end = left < least ? ends[n] - left : ends[n];
        if (!trace(a, k, order->sample + from, end - from)) return false;
        from = end;
    }
    return trace(a, k, order->sample + from, count - from);
}
