/* Time of color alone on one core, by stage and level of the processor: a 1920x540 field from
 * scene-linear to 10-bit 4:2:2. The target for the shipped spaces is 8 ms a field. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/codes/encode.h"
#include "color/line/line.h"
#include "color/space/builtin.h"
#include "color/space/ocio/ocio.h"
#include "color/space/space.h"
#include "convert/base/module.h"
#include "convert/base/clock.h"

enum { WIDTH = 1920, LINES = 540, RUNS = 9 };

/* Smooth in places and noisy in others, a little of it out of range. */
static void fill(float *rgb) {
    unsigned seed = 1;
    for (size_t i = 0; i < (size_t)3 * WIDTH * LINES; i++) {
        seed = seed * 1664525 + 1013904223;
        rgb[i] = (float)(i % WIDTH) / WIDTH + (float)(seed >> 8) * 0x1p-24f * 0.2f - 0.05f;
    }
}

typedef struct field {
    float *light, *line, *scratch;
    uint16_t *code;
} field;

static void convert(const field *f, const wf_transform *t, const wf_encoding *e,
                    double times[2]) {
    for (int l = 0; l < LINES; l++) {
        float *rgb[3] = {f->line, f->line + WIDTH, f->line + 2 * WIDTH};
        uint16_t *code[3] = {f->code, f->code + WIDTH, f->code + 2 * WIDTH};
        memcpy(f->line, f->light + (size_t)l * 3 * WIDTH, 3 * WIDTH * sizeof(float));
        double start = wf_now_s();
        t->apply(t->self, rgb[0], rgb[1], rgb[2], WIDTH);
        double middle = wf_now_s();
        wf_encode_line(e, rgb, f->scratch, code);
        times[0] += middle - start;
        times[1] += wf_now_s() - middle;
    }
}

static void measure(const field *f, const wf_transform *t, const char *name, int runs) {
    const wf_encoding e = {.luma = WF_LUMA_709,
                           .chroma = WF_CHROMA_BT601,
                           .ycbcr = true,
                           .bits = 10,
                           .width_px = WIDTH};
    double best[2] = {1, 1};
    for (int run = 0; run < runs; run++) {
        double times[2] = {0, 0};
        convert(f, t, &e, times);
        if (times[0] + times[1] < best[0] + best[1]) memcpy(best, times, sizeof best);
    }
    t->free(t->self);
    printf("%-40s color %6.2f ms, 4:2:2 and codes %5.2f ms, together %6.2f ms\n", name,
           1e3 * best[0], 1e3 * best[1], 1e3 * (best[0] + best[1]));
}

static void measure_builtin(const field *f, const char *from, const char *to) {
    wf_transform t;
    char why[900], name[100];
    if (!wf_builtin_transform(from, to, &t, why, sizeof why)) exit(1);
    snprintf(name, sizeof name, "%s to %s", from, to);
    measure(f, &t, name, RUNS);
}

/* config NULL: the shipped one. */
static void measure_ocio(const field *f, const wf_ocio_query *query, const char *name) {
    void *symbol;
    wf_ocio_open_fn *open;
    wf_transform t;
    char why[900];
    if (wf_module_symbol("ocio", "wf_ocio_open", "a view", &symbol, NULL)) return;
    memcpy(&open, &symbol, sizeof open);
    if (open(query, &t, why, sizeof why))
        measure(f, &t, name, 3);
    else
        printf("%s\n", why);
}

static void measure_level(size_t level, const field *f, const wf_curve *curve) {
    const wf_line_ops *ops = wf_line_ops_at(level);
    double best = 1;
    for (int run = 0; run < RUNS; run++) {
        double spent = 0;
        for (int l = 0; l < LINES; l++) {
            memcpy(f->line, f->light + (size_t)l * 3 * WIDTH, 3 * WIDTH * sizeof(float));
            double start = wf_now_s();
            for (int c = 0; c < 3; c++)
                ops->curve[curve->kind](curve, f->line + c * WIDTH, WIDTH);
            spent += wf_now_s() - start;
        }
        if (spent < best) best = spent;
    }
    printf("%s: the default curve %6.2f ms\n", wf_isa_name(level), 1e3 * best);
}

static void measure_all(const field *f, const char *config) {
    const wf_space *to;
    for (size_t i = 0; (to = wf_space_at(i)); i++)
        if (to->curve) measure_builtin(f, "lin_rec709", to->name);
    measure_builtin(f, "ACEScg", "rec709");
    measure_ocio(f, &(wf_ocio_query){.to = "rec709"}, "OpenColorIO: lin_rec709 to rec709");
    if (config)
        measure_ocio(
            f, &(wf_ocio_query){.config = config, .display = "Rec.1886 Rec.709 - Display"},
            "OpenColorIO: the view of a configuration");
}

/* An argument is a foreign configuration, whose display "Rec.1886 Rec.709 - Display" is taken.
 */
int main(int argc, char **argv) {
    field f = {.light = malloc((size_t)3 * WIDTH * LINES * sizeof(float)),
               .line = malloc(3 * WIDTH * sizeof(float)),
               .scratch = malloc(4 * WIDTH * sizeof(float)),
               .code = malloc(3 * WIDTH * sizeof(uint16_t))};
    if (!f.light || !f.line || !f.scratch || !f.code) return 1;
    fill(f.light);
    measure_all(&f, argc > 1 ? argv[1] : NULL);
    for (size_t level = 0; level < wf_isa_levels(); level++)
        measure_level(level, &f, &wf_curve_bt1886);
    free(f.light);
    free(f.line);
    free(f.scratch);
    free(f.code);
    return 0;
}
