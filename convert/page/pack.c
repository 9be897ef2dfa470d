/* Predicts every sample from its neighbors and the field before the last, and packs what is
 * left by range variants of asymmetric numeral systems (Duda 2009), backwards, so that
 * unpacking runs forwards. */
#include "convert/page/pack.h"

#include <stdlib.h>
#include <string.h>

#include "convert/page/model.h"

#define STATE_LOW (1u << 23) /* a state is at least this, and below 256 times it */

/* One sample that waits to be packed: its share, what lies before it, and bits behind it. */
typedef struct waiting {
    uint16_t share, before;
    uint16_t extra_bits, extra;
} waiting;

struct wf_packer {
    wf_pack_shape shape;
    int64_t fields;
    wf_model *model;                       /* [planes] */
    uint16_t *kept[4][WF_PACK_PLANES];     /* the last fields, by number % 4 */
    uint16_t *residual[4][WF_PACK_PLANES]; /* theirs */
    waiting *line;                         /* [samples of a field] */
    size_t samples;
    uint8_t *piece; /* [most bytes of a field], filled from its end */
    size_t piece_bytes;
    uint8_t *data;
    size_t bytes, capacity;
};

/* ---- Memory ---- */

static size_t plane_samples(const wf_pack_shape *shape, int p) {
    return (size_t)shape->width_px[p] * (size_t)shape->lines;
}

static bool allocate(wf_packer *k) {
    bool made = (k->model = malloc((size_t)k->shape.planes * sizeof *k->model));
    for (int p = 0; p < k->shape.planes; p++) {
        k->samples += plane_samples(&k->shape, p);
        for (int f = 0; f < 4; f++) {
            k->kept[f][p] = malloc(plane_samples(&k->shape, p) * sizeof(uint16_t));
            k->residual[f][p] = calloc(plane_samples(&k->shape, p), sizeof(uint16_t));
            made = made && k->kept[f][p] && k->residual[f][p];
        }
    }
    /* A sample takes at most 12 bits and 9 behind them. */
    k->piece_bytes = 3 * k->samples + 16;
    k->line = malloc(k->samples * sizeof *k->line);
    k->piece = malloc(k->piece_bytes);
    return made && k->line && k->piece;
}

weft_status wf_packer_new(const wf_pack_shape *shape, wf_packer **out, weft_error *err) {
    wf_packer *k = calloc(1, sizeof *k);
    if (!k) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    k->shape = *shape;
    if (!allocate(k)) {
        wf_packer_free(k);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory to pack fields of %dx%d",
                       shape->width_px[0], shape->lines);
    }
    for (int p = 0; p < shape->planes; p++) wf_model_init(&k->model[p]);
    *out = k;
    return WEFT_OK;
}

void wf_packer_free(wf_packer *k) {
    if (!k) return;
    for (int f = 0; f < 4; f++)
        for (int p = 0; p < WF_PACK_PLANES; p++) {
            free(k->kept[f][p]);
            free(k->residual[f][p]);
        }
    free(k->model);
    free(k->line);
    free(k->piece);
    free(k->data);
    free(k);
}

const uint8_t *wf_packer_data(const wf_packer *k, size_t *bytes) {
    *bytes = k->bytes;
    return k->data;
}

/* ---- What is expected of a sample ---- */

/* The lines that are looked at: of the sample, above it, and of the field before the last. */
typedef struct around {
    const uint16_t *own, *above, *old,
        *old_above; /* above NULL: the first line; old: no field */
    int width_px;
} around;

/* The gradient's guess, held between both neighbors (Martucci 1990). */
static int between(int left, int above, int corner) {
    int low = left < above ? left : above, high = left < above ? above : left;
    int guess = left + above - corner;
    return guess < low ? low : guess > high ? high : guess;
}

/* The guess for sample x, and how much varies of that by which it was made. */
static int guess(const around *n, int x, int *varies) {
    bool last = x + 1 == n->width_px;
    int left = x ? n->own[x - 1] : n->above ? n->above[x] : 128;
    int above = n->above ? n->above[x] : left;
    int corner = n->above && x ? n->above[x - 1] : above;
    int right = n->above && !last ? n->above[x + 1] : above;
    *varies = abs(left - above) + abs(above - corner) + abs(above - right);
    if (!n->old || !n->above || !x) return between(left, above, corner);
    int moves = abs(left - n->old[x - 1]) + abs(above - n->old_above[x]) +
                abs(corner - n->old_above[x - 1]) +
                (last ? 0 : abs(right - n->old_above[x + 1]));
    if (moves >= *varies) return between(left, above, corner);
    *varies = moves;
    return n->old[x];
}

/* Residuals that tell of this one: of the first plane those of the field before the last, of
 * the others those of planes before them. */
static int alike(const wf_packer *k, int p, size_t line, int x) {
    const uint16_t *const *now = (const uint16_t *const *)k->residual[k->fields % 4];
    int fine_x = p ? x * (k->shape.width_px[0] / k->shape.width_px[p]) : x;
    size_t row = line * (size_t)k->shape.width_px[0], at = row + (size_t)fine_x;
    size_t next = at + (fine_x + 1 < k->shape.width_px[0]);
    if (p == 1) return now[0][at] + now[0][next];
    if (p == 2)
        return 2 * now[1][line * (size_t)k->shape.width_px[1] + (size_t)x] + now[0][at] / 2;
    if (k->fields < 2) return 0;
    const uint16_t *old = k->residual[(k->fields - 2) % 4][0];
    return old[at] + (next > at ? old[next] : 0);
}

static void wait(wf_packer *k, int p, int context, int residual, waiting *to) {
    wf_model *m = &k->model[p];
    int s = wf_model_symbol(residual);
    m->seen[context][s]++;
    *to = (waiting){.share = m->share[context][s],
                    .before = m->before[context][s],
                    .extra_bits = (uint16_t)wf_model_extra_bits(s),
                    .extra = (uint16_t)(residual - wf_model_base(s))};
}

/* Makes residuals of a line of a plane. */
static waiting *predict_line(wf_packer *k, int p, int y, waiting *to) {
    int width = k->shape.width_px[p];
    size_t at = (size_t)y * (size_t)width;
    const uint16_t *own = k->kept[k->fields % 4][p] + at;
    const uint16_t *old = k->fields > 1 ? k->kept[(k->fields - 2) % 4][p] + at : NULL;
    uint16_t *residual = k->residual[k->fields % 4][p] + at;
    const around n = {.own = own,
                      .above = y ? own - width : NULL,
                      .old = old,
                      .old_above = old && y ? old - width : NULL,
                      .width_px = width};
    for (int x = 0; x < width; x++) {
        int varies, expected = guess(&n, x, &varies);
        int error = own[x] - expected;
        int beside = (x ? residual[x - 1] : 0) + (y ? residual[x - width] : 0);
        int context = wf_model_context(varies, beside, alike(k, p, (size_t)y, x));
        residual[x] = (uint16_t)(error < 0 ? -2 * error - 1 : 2 * error);
        wait(k, p, context, residual[x], to++);
    }
    return to;
}

/* ---- Packing ---- */

/* Packs a field's samples from the last to the first; returns where its bytes begin. */
static uint8_t *pack_waiting(wf_packer *k) {
    uint8_t *to = k->piece + k->piece_bytes;
    uint32_t state = STATE_LOW;
    for (size_t i = k->samples; i-- > 0;) {
        const waiting *w = &k->line[i];
        if (w->extra_bits) {
            uint32_t most = (STATE_LOW >> w->extra_bits) << 8;
            for (; state >= most; state >>= 8) *--to = (uint8_t)state;
            state = state << w->extra_bits | w->extra;
        }
        uint32_t most = ((STATE_LOW >> WF_MODEL_BITS) << 8) * w->share;
        for (; state >= most; state >>= 8) *--to = (uint8_t)state;
        state = (state / w->share << WF_MODEL_BITS) + state % w->share + w->before;
    }
    for (int i = 0; i < 4; i++, state >>= 8) *--to = (uint8_t)state;
    return to;
}

static bool reserve(wf_packer *k, size_t more) {
    if (k->bytes + more <= k->capacity) return true;
    size_t capacity = 2 * (k->bytes + more);
    uint8_t *data = realloc(k->data, capacity);
    if (!data) return false;
    k->data = data;
    k->capacity = capacity;
    return true;
}

weft_status wf_packer_add(wf_packer *k, const uint16_t *const plane[], weft_error *err) {
    waiting *to = k->line;
    for (int p = 0; p < k->shape.planes; p++) {
        memcpy(k->kept[k->fields % 4][p], plane[p],
               plane_samples(&k->shape, p) * sizeof(uint16_t));
        for (int y = 0; y < k->shape.lines; y++) to = predict_line(k, p, y, to);
    }
    const uint8_t *from = pack_waiting(k);
    size_t bytes = (size_t)(k->piece + k->piece_bytes - from);
    if (!reserve(k, bytes))
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for the packed fields (%zu MB)",
                       k->bytes >> 20);
    memcpy(k->data + k->bytes, from, bytes);
    k->bytes += bytes;
    for (int p = 0; p < k->shape.planes; p++) wf_model_learn(&k->model[p]);
    k->fields++;
    return WEFT_OK;
}
