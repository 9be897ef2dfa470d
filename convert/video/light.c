/* Rows of light from the codes of a picture. */
#include "convert/video/light.h"

#include <stdlib.h>
#include <string.h>

#include "color/codes/levels.h"
#include "color/codes/upsample.h"

struct wf_light {
    wf_meaning meaning;
    int width_px, lines;
    int chroma_width_px, chroma_lines;
    bool has_chroma; /* false: a lone Y */
    size_t code_bytes;
    double zero[3]; /* the code of 0 */
    double scale;   /* of codes of R'G'B'; that of Y'CbCr is in the matrix */
    wf_upsampler across, down;
    wf_rgb_of_chroma matrix;
    const wf_signal_loops *loops;
    wf_transform decode; /* apply is NULL where R'G'B' is light */
    bool owns_decode;
};

static int parts(int size, int by) {
    return (size + by - 1) / by;
}

/* The range is in the matrix, so that what is made of codes by then is exact or nearly so. */
static wf_rgb_of_chroma matrix_of(const wf_meaning *m, double luma, double chroma) {
    double kg = 1 - m->kr - m->kb, of_cr = 2 * (1 - m->kr) * chroma,
           of_cb = 2 * (1 - m->kb) * chroma;
    return (wf_rgb_of_chroma){luma, of_cr, of_cb, m->kb * of_cb / kg, m->kr * of_cr / kg};
}

static void settle_codes(wf_light *l, const wf_encoding *encoding) {
    double per_code[3];
    for (int p = 0; p < 3; p++) {
        double unit;
        wf_code_scale(encoding, p, &l->zero[p], &unit);
        per_code[p] = 1 / unit;
    }
    l->scale = l->meaning.ycbcr ? 1 : per_code[0];
    l->matrix = matrix_of(&l->meaning, per_code[0], per_code[1]);
}

/* A power makes at most two and a half times of errors at white, and of black none. */
static const wf_signal_loops *loops_for(const wf_meaning *m, const wf_transform *decode) {
    const wf_decoding *d = &m->colors.decoding;
    bool power = !d->encoded || d->curve.kind == WF_CURVE_POWER;
    const wf_upsample_ops *ops = wf_upsample_ops_best();
    return power && !decode ? &ops->quick : &ops->fine;
}

static weft_status no_memory(weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the colors of the video");
}

weft_status wf_light_new(const wf_video_info *info, const wf_meaning *meaning,
                         const wf_transform *decode, wf_light **out, weft_error *err) {
    wf_light *l = *out = calloc(1, sizeof *l);
    if (!l) return no_memory(err);
    const wf_encoding encoding = {
        .ycbcr = meaning->ycbcr, .full_range = info->full_range, .bits = info->bits};
    *l = (wf_light){.meaning = *meaning,
                    .width_px = info->width_px,
                    .lines = info->lines,
                    .chroma_width_px = parts(info->width_px, info->across),
                    .chroma_lines = parts(info->lines, info->down),
                    .has_chroma = info->planes == 3,
                    .code_bytes = wf_video_code_bytes(info),
                    .loops = loops_for(meaning, decode),
                    .owns_decode = !decode};
    if (decode) l->decode = *decode;
    settle_codes(l, &encoding);
    /* Lines of chroma lie amid two lines of luma, but for top-left. */
    wf_upsampler_init(&l->across, info->across, info->tags.siting == WF_SITING_CENTER);
    wf_upsampler_init(&l->down, info->down, info->tags.siting != WF_SITING_TOP_LEFT);
    bool made = decode || wf_decoding_transform(&meaning->colors.decoding, &l->decode);
    return made ? WEFT_OK : no_memory(err);
}

void wf_light_free(wf_light *l) {
    if (l && l->owns_decode && l->decode.free) l->decode.free(l->decode.self);
    free(l);
}

/* ---- Scratch ---- */

/* Columns are taken some at a time, which are in the nearest cache for all rows. */
#define COLUMNS   128
#define ALIGNMENT 64

/* What a thread makes rows in, all of it floats. */
typedef struct rows_made {
    int y0, y1;
    float *held;    /* [held_lines][COLUMNS]: some columns of one plane of chroma, from line */
    int held_first; /* held_first on, those beyond the picture's ends included */
    float *brought[3]; /* [WF_LIGHT_ROWS][brought_stride]: chroma at every row, with margins */
    float *spare;      /* [width] */
} rows_made;

static size_t held_lines(const wf_light *l) {
    return (size_t)(parts(WF_LIGHT_ROWS, l->down.factor) + 1 + l->down.before + l->down.after);
}

static size_t brought_stride(const wf_light *l) {
    return (size_t)l->chroma_width_px + 2 * WF_UPSAMPLE_MARGIN;
}

size_t wf_light_scratch(const wf_light *l) {
    return (held_lines(l) * COLUMNS + 2 * WF_LIGHT_ROWS * brought_stride(l) +
            (size_t)l->width_px) *
               sizeof(float) +
           ALIGNMENT;
}

/* Held columns lie where vectors do. */
static rows_made lay_out(const wf_light *l, int y0, int y1, void *unaligned) {
    uintptr_t at = (uintptr_t)unaligned;
    float *scratch = (float *)((char *)unaligned + (ALIGNMENT - at % ALIGNMENT) % ALIGNMENT);
    rows_made m = {.y0 = y0, .y1 = y1, .held = scratch};
    m.held_first = y0 / l->down.factor - l->down.before;
    m.brought[1] = scratch + held_lines(l) * COLUMNS;
    m.brought[2] = m.brought[1] + WF_LIGHT_ROWS * brought_stride(l);
    m.spare = m.brought[2] + WF_LIGHT_ROWS * brought_stride(l);
    return m;
}

static float *brought_row(const wf_light *l, const rows_made *m, int p, int y) {
    return m->brought[p] + (size_t)(y - m->y0) * brought_stride(l) + WF_UPSAMPLE_MARGIN;
}

/* ---- Chroma at every row ---- */

/* Codes `at` and on of plane p. */
static void take_signals(const wf_light *l, float *to, const void *plane, int p, size_t at,
                         size_t count) {
    if (l->code_bytes == 1)
        l->loops->of_bytes(to, (const uint8_t *)plane + at, l->zero[p], l->scale, count);
    else
        l->loops->signals(to, (const uint16_t *)plane + at, l->zero[p], l->scale, count);
}

/* Columns x and on of the lines of chroma that the rows see. */
static void hold_lines(const wf_light *l, const rows_made *m, int p, const void *plane, int x,
                       size_t count) {
    int end = (m->y1 - 1) / l->down.factor + l->down.after + 1;
    float *to = m->held;
    for (int i = m->held_first; i < end; i++, to += COLUMNS) {
        int line = wf_upsample_reflected(&l->down, i, l->chroma_lines, l->lines);
        size_t at = (size_t)line * (size_t)l->chroma_width_px + (size_t)x;
        /* What the next columns begin with: no processor expects steps from line to line. */
        __builtin_prefetch((const char *)plane + (at + COLUMNS) * l->code_bytes);
        __builtin_prefetch((const char *)plane + (at + COLUMNS) * l->code_bytes + 64);
        take_signals(l, to, plane, p, at, count);
    }
}

static void weigh_columns(const wf_light *l, const rows_made *m, int p, int x, size_t count) {
    int factor = l->down.factor;
    for (int y = m->y0; y < m->y1; y++) {
        const float *held = m->held + (y / factor - m->held_first) * COLUMNS;
        float *to = brought_row(l, m, p, y) + x;
        if (wf_upsample_pairs(&l->down) && y % 2 == 0 && y + 1 < m->y1) {
            l->loops->weigh_pair((float *[2]){to, brought_row(l, m, p, ++y) + x}, held, COLUMNS,
                                 l->down.phase, count);
            continue;
        }
        l->loops->weigh(to, held, COLUMNS, &l->down.phase[y % factor], count);
    }
}

static void bring_down(const wf_light *l, const rows_made *m, int p, const void *plane) {
    size_t width = (size_t)l->chroma_width_px;
    if (l->down.factor == 1) {
        for (int y = m->y0; y < m->y1; y++)
            take_signals(l, brought_row(l, m, p, y), plane, p, (size_t)y * width, width);
        return;
    }
    for (int x = 0; x < l->chroma_width_px; x += COLUMNS) {
        size_t left = (size_t)(l->chroma_width_px - x), count = left < COLUMNS ? left : COLUMNS;
        hold_lines(l, m, p, plane, x, count);
        weigh_columns(l, m, p, x, count);
    }
}

/* ---- Light ---- */

/* A lone Y is gray. */
static void fill_chroma(const wf_light *l, const rows_made *m, int y, float *const rgb[3]) {
    size_t bytes = (size_t)l->width_px * sizeof(float);
    for (int p = 1; p < 3; p++)
        if (l->has_chroma)
            wf_upsample_line(&l->across, l->loops, brought_row(l, m, p, y), l->chroma_width_px,
                             m->spare, rgb[p], l->width_px);
        else if (l->meaning.ycbcr)
            memset(rgb[p], 0, bytes);
        else
            memcpy(rgb[p], rgb[0], bytes);
}

/* R'G'B'. */
static void signal_row(const wf_light *l, const rows_made *m, const void *luma, int y,
                       float *const rgb[3]) {
    size_t width = (size_t)l->width_px, at = (size_t)y * width;
    bool of_bytes = l->meaning.ycbcr && l->code_bytes == 1;
    if (!of_bytes) take_signals(l, rgb[0], luma, 0, at, width);
    fill_chroma(l, m, y, rgb);
    if (of_bytes)
        l->loops->rgb_of_bytes(&l->matrix, (const uint8_t *)luma + at, l->zero[0], rgb[0],
                               rgb[1], rgb[2], width);
    else if (l->meaning.ycbcr)
        l->loops->rgb(&l->matrix, rgb[0], rgb[1], rgb[2], width);
}

/* Where there is no coverage color has nothing to be divided by. */
static void divide(float *const rgb[3], const float *alpha, size_t width) {
    for (int c = 0; c < 3; c++)
        for (size_t x = 0; x < width; x++) rgb[c][x] /= alpha[x] > 0 ? alpha[x] : 1;
}

static void multiply(float *const rgb[3], const float *alpha, size_t width) {
    for (int c = 0; c < 3; c++)
        for (size_t x = 0; x < width; x++) rgb[c][x] *= alpha[x] > 0 ? alpha[x] : 1;
}

static void decode_row(const wf_light *l, const float *alpha, float *const rgb[3]) {
    size_t width = (size_t)l->width_px;
    if (!l->decode.apply) return;
    if (alpha) divide(rgb, alpha, width);
    l->decode.apply(l->decode.self, rgb[0], rgb[1], rgb[2], width);
    if (alpha) multiply(rgb, alpha, width);
}

void wf_light_rows(const wf_light *l, const void *const plane[3], int y0, int y1, void *scratch,
                   float *const rgb[3]) {
    wf_light_rows_multiplied(l, plane, y0, y1, scratch, NULL, rgb);
}

void wf_light_rows_multiplied(const wf_light *l, const void *const plane[3], int y0, int y1,
                              void *scratch, const float *alpha, float *const rgb[3]) {
    const rows_made m = lay_out(l, y0, y1, scratch);
    for (int p = 1; l->has_chroma && p < 3; p++) bring_down(l, &m, p, plane[p]);
    for (int y = y0; y < y1; y++) {
        size_t at = (size_t)(y - y0) * (size_t)l->width_px;
        float *const row[3] = {rgb[0] + at, rgb[1] + at, rgb[2] + at};
        signal_row(l, &m, plane[0], y, row);
        decode_row(l, alpha ? alpha + at : NULL, row);
    }
}
