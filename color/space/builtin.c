/* The shipped spaces without OpenColorIO: a matrix and a curve. */
#include "color/space/builtin.h"

#include <stdio.h>
#include <stdlib.h>

#include "color/line/line.h"
#include "color/space/space.h"

typedef struct builtin {
    const wf_line_ops *ops;
    const wf_curve *curve; /* NULL: the result is linear */
    bool mixes;            /* false: the primaries are the same */
    wf_mix mix;
} builtin;

static wf_mix mix_of(wf_primaries from, wf_primaries to) {
    double m[3][3];
    wf_rgb_to_rgb(from, to, m);
    return (wf_mix){.of_red = {m[0][1], m[0][2]},
                    .of_green = {m[1][0], m[1][2]},
                    .of_blue = {m[2][0], m[2][1]}};
}

static void apply_builtin(const void *self, float *r, float *g, float *b, size_t width_px) {
    const builtin *t = self;
    if (t->mixes) t->ops->mix(&t->mix, r, g, b, width_px);
    if (!t->curve) return;
    float *plane[3] = {r, g, b};
    for (int c = 0; c < 3; c++) t->ops->curve[t->curve->kind](t->curve, plane[c], width_px);
}

static void list_linear(char *text, size_t size) {
    const wf_space *space;
    size_t used = 0;
    for (size_t i = 0; (space = wf_space_at(i)) && used < size; i++)
        if (!space->curve)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     space->name);
}

static const wf_space *find_input(const char *name, char *why, size_t why_size) {
    const wf_space *space = wf_space_find(name, why, why_size);
    if (!space || !space->curve) return space;
    char linear[256];
    list_linear(linear, sizeof linear);
    snprintf(
        why, why_size,
        "the input cannot be in %s, which is encoded: what comes in is averaged as light and "
        "must be linear; take one of %s",
        space->name, linear);
    return NULL;
}

bool wf_builtin_transform(const char *from, const char *to, wf_transform *out, char *why,
                          size_t why_size) {
    *out = (wf_transform){0};
    const wf_space *input = find_input(from, why, why_size);
    const wf_space *output = input ? wf_space_find(to, why, why_size) : NULL;
    if (!output) return false;
    builtin *t = malloc(sizeof *t);
    if (!t) {
        snprintf(why, why_size, "no memory for the color transform");
        return false;
    }
    *t = (builtin){.ops = wf_line_ops_best(),
                   .curve = output->curve,
                   .mixes = input->primaries != output->primaries,
                   .mix = mix_of(input->primaries, output->primaries)};
    *out = (wf_transform){apply_builtin, free, t};
    return true;
}
