/* Runs an operation at every level of the processor on random and extreme input, and compares.
 */
#include "tests/unit/support/levels.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "filters/base/half.h"

enum { BUFFERS = 24, PAGES = 64, FRONT = 64, MOST_RESULTS = 1 << 17 };

/* ---- Memory ---- */

static struct {
    uint8_t *end[BUFFERS], *given[BUFFERS];
    double result[MOST_RESULTS];
} memory;

static void make_memory(void) {
    size_t page = (size_t)sysconf(_SC_PAGESIZE), bytes = PAGES * page;
    for (int i = 0; i < BUFFERS; i++) {
        uint8_t *all = mmap(NULL, bytes + page, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (all == MAP_FAILED || mprotect(all + bytes, page, PROT_NONE)) abort();
        memory.end[i] = all + bytes;
    }
}

void level_begin(level_run *run) {
    if (!memory.end[0]) make_memory();
    run->buffers = 0;
    run->result = memory.result;
    run->results = 0;
}

void *level_buffer(level_run *run, size_t bytes) {
    if (run->buffers == BUFFERS || bytes + FRONT > PAGES * 4096) abort();
    uint8_t *buffer = memory.end[run->buffers] - bytes;
    memset(buffer - FRONT, 0xa5, FRONT + bytes);
    memory.given[run->buffers++] = buffer;
    return buffer;
}

bool level_end(const level_run *run) {
    for (int i = 0; i < run->buffers; i++)
        for (int k = 1; k <= FRONT; k++)
            if (memory.given[i][-k] != 0xa5) return false;
    return true;
}

/* ---- Input ---- */

uint32_t level_draw(level_run *run) {
    uint32_t v = run->draws += 0x9e3779b9u;
    v = (v ^ v >> 16) * 0x21f0aaadu;
    v = (v ^ v >> 15) * 0x735a2d97u;
    return v ^ v >> 15;
}

double level_uniform(level_run *run, double low, double high) {
    return low + (high - low) * level_draw(run) / 4294967296.0;
}

double level_number(level_run *run) {
    static const double odd[] = {
        NAN,     -NAN, INFINITY, -INFINITY, 0,       -0.0,    0x1p-149, -0x1p-1074,
        0x1p-24, 1,    65504,    -65504,    FLT_MAX, FLT_MIN, 1e300,    -1e-300,
    };
    uint32_t which = level_draw(run) % 64;
    return run->wild && which < sizeof odd / sizeof *odd ? odd[which]
                                                         : level_uniform(run, -2, 2);
}

double *level_doubles(level_run *run, size_t count) {
    double *out = level_buffer(run, count * sizeof *out);
    for (size_t i = 0; i < count; i++) out[i] = level_number(run);
    return out;
}

float *level_floats(level_run *run, size_t count) {
    float *out = level_buffer(run, count * sizeof *out);
    for (size_t i = 0; i < count; i++) {
        double value = level_number(run);
        out[i] = fabs(value) > FLT_MAX ? copysignf(INFINITY, (float)copysign(1, value))
                                       : (float)value;
    }
    return out;
}

/* Every half there is comes up in time; runs that are not wild have small ones. */
uint16_t *level_halves(level_run *run, size_t count) {
    uint16_t *out = level_buffer(run, count * sizeof *out);
    for (size_t i = 0; i < count; i++) {
        uint32_t bits = level_draw(run);
        out[i] = (uint16_t)(run->wild ? bits : bits & 0xbfff);
    }
    return out;
}

uint8_t *level_bytes(level_run *run, size_t count) {
    uint8_t *out = level_buffer(run, count);
    for (size_t i = 0; i < count; i++) out[i] = (uint8_t)level_draw(run);
    return out;
}

/* ---- Result ---- */

/* Every NaN counts as one: which of two NaNs a sum takes is the compiler's choice. */
static void keep(level_run *run, double value) {
    if (run->results == MOST_RESULTS) abort();
    run->result[run->results++] = isnan(value) ? (double)NAN : value;
}

void level_keep_doubles(level_run *run, const double *value, size_t count) {
    for (size_t i = 0; i < count; i++) keep(run, value[i]);
}

void level_keep_floats(level_run *run, const float *value, size_t count) {
    for (size_t i = 0; i < count; i++) keep(run, (double)value[i]);
}

void level_keep_codes(level_run *run, const uint16_t *value, size_t count) {
    for (size_t i = 0; i < count; i++) keep(run, value[i]);
}

void level_keep_bytes(level_run *run, const uint8_t *value, size_t count) {
    for (size_t i = 0; i < count; i++) keep(run, value[i]);
}

void level_keep_integers(level_run *run, const int64_t *value, size_t count) {
    for (size_t i = 0; i < count; i++) keep(run, (double)value[i]);
}
