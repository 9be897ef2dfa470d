/* Horizontal weights: the aperture's integrals over the cells of one input row. */
#include <stdlib.h>

#include "filters/resample/resampler_inside.h"

/* Kernels that would take more than this together are computed each time they are used. */
#define MOST_KEPT_BYTES ((size_t)64 << 20)

bool wf_kernel_alloc(const wf_resampler *rs, wf_kernel *kernel) {
    size_t width = (size_t)rs->x.pixels, weights = (size_t)rs->phases * (size_t)rs->taps;
    double *memory = malloc((weights + 2 * width) * sizeof *memory);
    if (!memory) return false;
    kernel->weight = memory;
    kernel->inside = memory + weights;
    kernel->exists = kernel->inside + width;
    return true;
}

void wf_kernel_release(wf_kernel *kernel) {
    free(kernel->weight);
    kernel->weight = NULL;
}

/* The aperture's integral over columns u0 .. u1 of the kernel's row of cells. */
static double cell_weight(const wf_resampler *rs, const wf_kernel *kernel, double u0,
                          double u1) {
    const wf_aperture *a = &rs->desc.aperture;
    if (!a->kind->couples_uv) return wf_cell_u(a, u0, u1);
    return a->kind->cell_uv(a, u0, u1, kernel->v0, kernel->v1);
}

static void fill_weights(const wf_resampler *rs, wf_kernel *kernel) {
    double reach = rs->desc.aperture.reach_u;
    for (int r = 0; r < rs->phases; r++) {
        wf_span span = wf_axis_reach(&rs->x, reach, r);
        for (int t = 0; t < rs->taps; t++) {
            int a = span.first + t;
            double u0 = wf_axis_edge(&rs->x, a, r), u1 = wf_axis_edge(&rs->x, a + 1, r);
            kernel->weight[r * rs->taps + t] =
                a < span.end ? cell_weight(rs, kernel, u0, u1) : 0;
        }
    }
}

static void fill_totals(const wf_resampler *rs, wf_kernel *kernel) {
    double reach = rs->desc.aperture.reach_u;
    for (int i = 0; i < rs->x.pixels; i++) {
        const double *weight = kernel->weight + (i % rs->phases) * rs->taps;
        wf_span span = wf_axis_reach(&rs->x, reach, i);
        double inside = 0, padding = 0;
        for (int a = span.first; a < span.end; a++) {
            if (wf_axis_inside(&rs->x, a))
                inside += weight[a - span.first];
            else if (rs->x.padded)
                padding += cell_weight(rs, kernel, wf_axis_edge_in_picture(&rs->x, a, i),
                                       wf_axis_edge_in_picture(&rs->x, a + 1, i));
        }
        kernel->inside[i] = inside;
        kernel->exists[i] = inside + padding;
    }
}

static void fill(const wf_resampler *rs, wf_kernel *kernel) {
    fill_weights(rs, kernel);
    fill_totals(rs, kernel);
}

const wf_kernel *wf_kernel_ready(const wf_resampler *rs, int kernel, wf_kernel *scratch) {
    const wf_kernel *kept = &rs->kernels[kernel];
    if (kept->weight) return kept;
    scratch->v0 = kept->v0;
    scratch->v1 = kept->v1;
    fill(rs, scratch);
    return scratch;
}

int wf_kernel_for(wf_resampler *rs, double v0, double v1) {
    if (!rs->desc.aperture.kind->couples_uv) v0 = v1 = 0;
    wf_kernel wanted =
        v0 + v1 < 0 ? (wf_kernel){.v0 = -v1, .v1 = -v0} : (wf_kernel){.v0 = v0, .v1 = v1};
    for (int i = rs->kernel_count; i-- > 0;)
        if (rs->kernels[i].v0 == wanted.v0 && rs->kernels[i].v1 == wanted.v1) return i;
    if (rs->kernel_count == rs->kernel_capacity) {
        int capacity = rs->kernel_capacity ? 2 * rs->kernel_capacity : 16;
        wf_kernel *grown = realloc(rs->kernels, (size_t)capacity * sizeof *grown);
        if (!grown) return -1;
        rs->kernels = grown;
        rs->kernel_capacity = capacity;
    }
    rs->kernels[rs->kernel_count] = wanted;
    return rs->kernel_count++;
}

bool wf_kernels_keep(wf_resampler *rs) {
    size_t each = (size_t)rs->phases * (size_t)rs->taps + 2 * (size_t)rs->x.pixels;
    if (each * sizeof(double) > MOST_KEPT_BYTES / (size_t)rs->kernel_count) return true;
    for (int i = 0; i < rs->kernel_count; i++) {
        if (!wf_kernel_alloc(rs, &rs->kernels[i])) return false;
        fill(rs, &rs->kernels[i]);
    }
    return true;
}

int wf_kernel_strands(const wf_resampler *rs, int kernel) {
    int most = 0;
    for (int r = 0; r < rs->phases; r++) {
        const double *weight = rs->kernels[kernel].weight + r * rs->taps;
        int strands = 0;
        for (int t = 0; t < rs->taps; t++) strands += weight[t] != 0;
        if (strands > most) most = strands;
    }
    return most;
}
