/* The shipped spaces without OpenColorIO: a matrix and a curve. */
#include "color/space/builtin.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/line/line.h"
#include "color/space/space.h"

typedef struct builtin {
    const wf_line_ops *ops;
    const wf_curve *decodes, *encodes; /* NULL: linear */
    bool mixes;                        /* false: the primaries are the same */
    wf_mix mix;
} builtin;

static wf_mix mix_of(const wf_chromaticities *from, const wf_chromaticities *to) {
    double m[3][3];
    wf_rgb_matrix(from, to, m);
    return (wf_mix){.of_red = {m[0][1], m[0][2]},
                    .of_green = {m[1][0], m[1][2]},
                    .of_blue = {m[2][0], m[2][1]}};
}

static void apply_builtin(const void *self, float *r, float *g, float *b, size_t width_px) {
    const builtin *t = self;
    float *plane[3] = {r, g, b};
    for (int c = 0; t->decodes && c < 3; c++)
        t->ops->decode[t->decodes->kind](t->decodes, plane[c], width_px);
    if (t->mixes) t->ops->mix(&t->mix, r, g, b, width_px);
    for (int c = 0; t->encodes && c < 3; c++)
        t->ops->curve[t->encodes->kind](t->encodes, plane[c], width_px);
}

static bool same(const wf_chromaticities *a, const wf_chromaticities *b) {
    return !memcmp(a->red, b->red, sizeof a->red) &&
           !memcmp(a->green, b->green, sizeof a->green) &&
           !memcmp(a->blue, b->blue, sizeof a->blue) &&
           !memcmp(a->white, b->white, sizeof a->white);
}

static bool make(const wf_curve *decodes, const wf_chromaticities *from,
                 const wf_chromaticities *to, const wf_curve *encodes, wf_transform *out) {
    builtin *t = malloc(sizeof *t);
    *out = (wf_transform){0};
    if (!t) return false;
    *t = (builtin){.ops = wf_line_ops_best(),
                   .decodes = decodes,
                   .encodes = encodes,
                   .mixes = !same(from, to),
                   .mix = mix_of(from, to)};
    *out = (wf_transform){apply_builtin, free, t};
    return true;
}

static bool no_memory(char *why, size_t why_size) {
    snprintf(why, why_size, "no memory for the color transform");
    return false;
}

bool wf_builtin_transform(const char *from, const char *to, wf_transform *out, char *why,
                          size_t why_size) {
    *out = (wf_transform){0};
    const wf_space *input = wf_space_find(from, why, why_size);
    const wf_space *output = input ? wf_space_find(to, why, why_size) : NULL;
    if (!output) return false;
    return make(input->curve, &wf_chromaticities_of[input->primaries],
                &wf_chromaticities_of[output->primaries], output->curve, out) ||
           no_memory(why, why_size);
}

bool wf_builtin_from_light(const wf_chromaticities *from, const wf_space *to,
                           wf_transform *out) {
    return make(NULL, from, &wf_chromaticities_of[to->primaries], to->curve, out);
}

bool wf_builtin_mix(const wf_chromaticities *from, const wf_chromaticities *to,
                    wf_transform *out) {
    return make(NULL, from, to, NULL, out);
}
