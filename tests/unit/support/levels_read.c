/* The bytes of ZIP, for test_isa.c. */
#include <math.h>

#include "convert/read/unzip.h"
#include "tests/unit/support/levels.h"

static void keep_answer(level_run *r, bool answer) {
    level_keep_bytes(r, &(uint8_t){answer}, 1);
}

/* OpenEXR's words: running sums of what was inflated, then even and odd bytes in turn. */
static bool merge_plainly(uint8_t *out, uint8_t *byte, size_t count) {
    size_t evens = (count + 1) / 2;
    bool odd = false;
    for (size_t i = 1; i < count; i++) byte[i] = (uint8_t)(byte[i] + byte[i - 1] - 128);
    for (size_t i = 0; i < count; i++) out[i] = byte[i % 2 ? evens + i / 2 : i / 2];
    for (size_t i = 1; i < count; i += 2) odd |= (out[i] & 0x7c) == 0x7c;
    return odd;
}

/* Half of the input is of finite halves, so that both answers come up. */
static void merge(level_run *r) {
    uint8_t *in = level_bytes(r, r->count), *out = level_bytes(r, r->count);
    bool tame = level_draw(r) % 2;
    for (size_t i = 0; tame && i < r->count; i++) in[i] = (uint8_t)(i ? 128 + i % 64 / 63 : 1);
    bool odd = r->plain ? merge_plainly(out, in, r->count)
                        : wf_unzip_ops_at(r->level)->merge(out, in, r->count);
    level_keep_bytes(r, out, r->count);
    keep_answer(r, odd);
}

/* At most one sample is not finite. */
static void odd_halves(level_run *r) {
    uint16_t *half = level_halves(r, r->count);
    bool odd = false, want = level_draw(r) % 2;
    size_t where = level_draw(r) % (r->count + 1);
    for (size_t i = 0; i < r->count; i++) {
        if ((half[i] & 0x7c00) == 0x7c00) half[i] = 0xfbff;
        if (want && i == where) half[i] = i % 2 ? 0xfc00 : 0x7e01;
        odd |= (half[i] & 0x7c00) == 0x7c00;
    }
    keep_answer(r, r->plain ? odd : wf_unzip_ops_at(r->level)->odd_halves(half, r->count));
}

static void odd_floats(level_run *r) {
    float *value = level_floats(r, r->count);
    bool odd = false, want = level_draw(r) % 2;
    size_t where = level_draw(r) % (r->count + 1);
    for (size_t i = 0; i < r->count; i++) {
        if (!isfinite(value[i])) value[i] = 3e38f;
        if (want && i == where) value[i] = i % 2 ? -INFINITY : NAN;
        odd |= !isfinite(value[i]);
    }
    keep_answer(r, r->plain ? odd : wf_unzip_ops_at(r->level)->odd_floats(value, r->count));
}

static const level_row rows[] = {
    {"unzip.merge", merge, true, 0},
    {"unzip.odd_halves", odd_halves, true, 0},
    {"unzip.odd_floats", odd_floats, true, 0},
};

const level_table level_read[] = {
    LEVEL_TABLE("convert/read/unzip_isa.c", wf_unzip_ops, rows),
    {.file = NULL},
};
