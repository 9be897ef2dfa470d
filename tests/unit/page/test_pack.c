/* Packed fields, unpacked again by a plain reading of convert/page/README.md. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "convert/page/model.h"
#include "convert/page/pack.h"
#include "tests/unit/support/dice.h"

enum { MOST_SAMPLES = 64 * 64, FIELDS = 5 };

typedef uint16_t field[WF_PACK_PLANES][MOST_SAMPLES];

/* ---- Unpacking, by the rules ---- */

typedef struct unpacking {
    wf_pack_shape shape;
    const uint8_t *data;
    uint32_t state;
    field code[FIELDS], residual[FIELDS];
    int n; /* the field in hand */
    wf_model *model;
} unpacking;

static void refill(unpacking *u) {
    while (u->state < 1u << 23) u->state = u->state << 8 | *u->data++;
}

static int next_residual(unpacking *u, int p, int context) {
    wf_model *m = &u->model[p];
    uint32_t slot = u->state % 4096;
    int s = 0;
    while (m->before[context][s] + m->share[context][s] <= (int)slot) s++;
    m->seen[context][s]++;
    u->state = m->share[context][s] * (u->state / 4096) + slot - m->before[context][s];
    refill(u);
    int bits = wf_model_extra_bits(s), residual = wf_model_base(s);
    if (!bits) return residual;
    residual += (int)(u->state & ((1u << bits) - 1));
    u->state >>= bits;
    refill(u);
    return residual;
}

/* Sample x of line y of a plane of a field, or `otherwise` where there is none. */
static int at(const unpacking *u, const field f, int p, int x, int y, int otherwise) {
    int width = u->shape.width_px[p];
    return x < 0 || y < 0 || x >= width ? otherwise : f[p][y * width + x];
}

static int expected(const unpacking *u, int p, int x, int y, int *varies) {
    const uint16_t(*now)[MOST_SAMPLES] = u->code[u->n];
    int first = x ? 0 : at(u, now, p, 0, y - 1, 128);
    int left = at(u, now, p, x - 1, y, first), above = at(u, now, p, x, y - 1, left);
    int corner = at(u, now, p, x - 1, y - 1, above), right = at(u, now, p, x + 1, y - 1, above);
    *varies = abs(left - above) + abs(above - corner) + abs(above - right);
    if (u->n > 1 && x && y) {
        const uint16_t(*old)[MOST_SAMPLES] = u->code[u->n - 2];
        int moves = abs(left - at(u, old, p, x - 1, y, 0)) +
                    abs(above - at(u, old, p, x, y - 1, 0)) +
                    abs(corner - at(u, old, p, x - 1, y - 1, 0)) +
                    abs(right - at(u, old, p, x + 1, y - 1, right));
        if (moves < *varies) {
            *varies = moves;
            return at(u, old, p, x, y, 0);
        }
    }
    int low = left < above ? left : above, high = left + above - low;
    int guess = left + above - corner;
    return guess < low ? low : guess > high ? high : guess;
}

static int alike(const unpacking *u, int p, int x, int y) {
    const uint16_t(*now)[MOST_SAMPLES] = u->residual[u->n];
    int fine = p ? x * (u->shape.width_px[0] / u->shape.width_px[p]) : x;
    int last = u->shape.width_px[0] - 1, next = fine < last ? fine + 1 : fine;
    if (p == 1) return at(u, now, 0, fine, y, 0) + at(u, now, 0, next, y, 0);
    if (p == 2) return 2 * at(u, now, 1, x, y, 0) + at(u, now, 0, fine, y, 0) / 2;
    if (u->n < 2) return 0;
    const uint16_t(*old)[MOST_SAMPLES] = u->residual[u->n - 2];
    return at(u, old, 0, x, y, 0) + at(u, old, 0, x + 1, y, 0);
}

static void unpack_sample(unpacking *u, int p, int x, int y) {
    uint16_t(*residual)[MOST_SAMPLES] = u->residual[u->n];
    int varies, guess = expected(u, p, x, y, &varies), width = u->shape.width_px[p];
    int beside = at(u, (const uint16_t(*)[MOST_SAMPLES])residual, p, x - 1, y, 0) +
                 at(u, (const uint16_t(*)[MOST_SAMPLES])residual, p, x, y - 1, 0);
    int r = next_residual(u, p, wf_model_context(varies, beside, alike(u, p, x, y)));
    residual[p][y * width + x] = (uint16_t)r;
    u->code[u->n][p][y * width + x] = (uint16_t)(guess + (r % 2 ? -(r + 1) / 2 : r / 2));
}

static void unpack_field(unpacking *u) {
    for (int i = 0; i < 4; i++) u->state = u->state << 8 | *u->data++;
    for (int p = 0; p < u->shape.planes; p++)
        for (int y = 0; y < u->shape.lines; y++)
            for (int x = 0; x < u->shape.width_px[p]; x++) unpack_sample(u, p, x, y);
    for (int p = 0; p < u->shape.planes; p++) wf_model_learn(&u->model[p]);
    u->n++;
}

/* ---- What is packed ---- */

typedef int content(int p, int x, int y, int n);

static int noise(int p, int x, int y, int n) {
    (void)p, (void)x, (void)y, (void)n;
    return dice(512);
}

static int extremes(int p, int x, int y, int n) {
    return (x + y + n + p) % 2 ? 511 : 0;
}

static int still(int p, int x, int y, int n) {
    (void)n;
    return (x * x + 3 * y * y + 40 * p) / 7 % 256;
}

static int moving(int p, int x, int y, int n) {
    return still(p, x + n, y, 0);
}

static int flat(int p, int x, int y, int n) {
    (void)p, (void)x, (void)y, (void)n;
    return 77;
}

static size_t bytes_of(const wf_packer *packer) {
    size_t bytes;
    wf_packer_data(packer, &bytes);
    return bytes;
}

static void make(field f, const wf_pack_shape *shape, content *is, int n) {
    for (int p = 0; p < shape->planes; p++)
        for (int y = 0; y < shape->lines; y++)
            for (int x = 0; x < shape->width_px[p]; x++)
                f[p][y * shape->width_px[p] + x] = (uint16_t)is(p, x, y, n);
}

/* Packs fields, unpacks them, and returns how many bytes they took. */
static size_t round_trip(const wf_pack_shape *shape, content *is) {
    wf_packer *packer;
    weft_error err;
    field *made = calloc(FIELDS, sizeof *made);
    unpacking *u = calloc(1, sizeof *u);
    u->model = calloc((size_t)shape->planes, sizeof *u->model);
    u->shape = *shape;
    assert_int_equal(wf_packer_new(shape, &packer, &err), WEFT_OK);
    for (int n = 0; n < FIELDS; n++) {
        make(made[n], shape, is, n);
        const uint16_t *plane[] = {made[n][0], made[n][1], made[n][2]};
        assert_int_equal(wf_packer_add(packer, plane, &err), WEFT_OK);
    }
    size_t bytes;
    u->data = wf_packer_data(packer, &bytes);
    const uint8_t *end = u->data + bytes;
    for (int p = 0; p < shape->planes; p++) wf_model_init(&u->model[p]);
    for (int n = 0; n < FIELDS; n++) {
        unpack_field(u);
        for (int p = 0; p < shape->planes; p++)
            assert_memory_equal(u->code[n][p], made[n][p],
                                (size_t)(shape->width_px[p] * shape->lines) * 2);
    }
    assert_ptr_equal(u->data, end);
    assert_int_equal(bytes, bytes_of(packer));
    wf_packer_free(packer);
    free(u->model);
    free(u);
    free(made);
    return bytes;
}

/* ---- Tests ---- */

static content *const contents[] = {noise, extremes, still, moving, flat};

static void test_fields_come_back(void **unused) {
    static const wf_pack_shape shapes[] = {{3, {64, 32, 32}, 64}, {3, {33, 33, 33}, 17},
                                           {1, {64}, 64},         {1, {1}, 1},
                                           {3, {2, 1, 1}, 5},     {3, {1, 1, 1}, 64}};
    (void)unused;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (size_t k = 0; k < sizeof contents / sizeof *contents; k++)
            round_trip(&shapes[i], contents[k]);
}

/* What can be guessed takes next to nothing, and noise, which is learned, twice its bits at
 * most. */
static void test_sizes(void **unused) {
    const wf_pack_shape shape = {3, {64, 32, 32}, 64};
    double samples = FIELDS * 64 * 64 * 2;
    (void)unused;
    assert_true((double)round_trip(&shape, flat) < 0.03 * samples);
    assert_true((double)round_trip(&shape, noise) < 1.7 * samples);
    assert_true(round_trip(&shape, still) < round_trip(&shape, moving));
}

/* Shares are whole: none is missing, and all add up, whatever was seen. */
static void test_shares(void **unused) {
    wf_model *m = calloc(1, sizeof *m);
    (void)unused;
    wf_model_init(m);
    for (int round = 0; round < 8; round++) {
        m->seen[round][0] = 1u << (3 * round);
        for (int i = 0; i < 500; i++)
            m->seen[dice(WF_MODEL_CONTEXTS)][dice(WF_MODEL_SYMBOLS)] += 1u << (2 * round);
        wf_model_learn(m);
        for (int c = 0; c < WF_MODEL_CONTEXTS; c++) {
            int sum = 0;
            for (int s = 0; s < WF_MODEL_SYMBOLS; s++) {
                assert_int_equal(m->before[c][s], sum);
                assert_true(m->share[c][s] > 0);
                sum += m->share[c][s];
            }
            assert_int_equal(sum, 1 << WF_MODEL_BITS);
        }
    }
    free(m);
}

static void test_symbols(void **unused) {
    (void)unused;
    for (int r = 0; r < 1024; r++) {
        int s = wf_model_symbol(r), bits = wf_model_extra_bits(s);
        assert_true(s >= 0 && s < WF_MODEL_SYMBOLS);
        assert_true(r >= wf_model_base(s) && r < wf_model_base(s) + (1 << bits));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fields_come_back), cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_shares), cmocka_unit_test(test_symbols)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
