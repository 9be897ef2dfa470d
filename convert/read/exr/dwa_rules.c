/* Rules by which DWA tells what a channel holds: the part of its name after the last dot, and
 * its type. */
#include "convert/read/exr/dwa_rules.h"

#include <string.h>
#include <strings.h>

#include "convert/read/choice/layers.h"

#define MOST_SUFFIX 128
#define MOST_RULES  256 /* writers store at most fifteen */

typedef struct rule {
    const char *suffix;
    wf_dwa_way way;
    int color; /* 0 red, 1 green, 2 blue; -1: it is none of a color */
    bool any_case;
    int type; /* -1: every one */
} rule;

/* What the first versions meant; of whole numbers alone alpha is more than deflated. */
static const rule first_rules[] = {
    {"r", WF_DWA_LOSSY, 0, true, -1},     {"red", WF_DWA_LOSSY, 0, true, -1},
    {"g", WF_DWA_LOSSY, 1, true, -1},     {"grn", WF_DWA_LOSSY, 1, true, -1},
    {"green", WF_DWA_LOSSY, 1, true, -1}, {"b", WF_DWA_LOSSY, 2, true, -1},
    {"blu", WF_DWA_LOSSY, 2, true, -1},   {"blue", WF_DWA_LOSSY, 2, true, -1},
    {"y", WF_DWA_LOSSY, -1, true, -1},    {"by", WF_DWA_LOSSY, -1, true, -1},
    {"ry", WF_DWA_LOSSY, -1, true, -1},   {"a", WF_DWA_RUNS, -1, true, -1},
};

static bool matches(const rule *r, const wf_exr_channel *c) {
    const char *suffix = wf_layer_base(c->name);
    if (r->type < 0 && r->way == WF_DWA_LOSSY && c->type == WF_EXR_UINT) return false;
    if (r->type >= 0 && r->type != (int)c->type) return false;
    return !(r->any_case ? strcasecmp : strcmp)(suffix, r->suffix);
}

/* ---- Channels of a color ---- */

/* The three channels that are parts of a color have the same name before the last dot. part_of
 * is 0 for none, 1 for red and so on; of two the later counts. */
static int find_part(const wf_exr_shape *shape, const uint8_t *part_of, int like, int part) {
    int found = -1;
    size_t length = wf_layer_length(shape->channel[like].name);
    for (int i = 0; i < shape->channels; i++)
        if (part_of[i] == part && wf_layer_length(shape->channel[i].name) == length &&
            !memcmp(shape->channel[i].name, shape->channel[like].name, length))
            found = i;
    return found;
}

static bool sampled_alike(const wf_exr_channel *a, const wf_exr_channel *b) {
    return a->across == b->across && a->down == b->down;
}

static const char *add_color(wf_dwa_plan *plan, const wf_exr_shape *shape,
                             const uint8_t *part_of, int red) {
    const wf_exr_channel *c = shape->channel;
    int *color = plan->color[plan->colors];
    for (int p = 0; p < 3; p++) color[p] = find_part(shape, part_of, red, p + 1);
    if (color[0] != red || color[1] < 0 || color[2] < 0) return NULL;
    if (!sampled_alike(&c[red], &c[color[1]]) || !sampled_alike(&c[red], &c[color[2]]))
        return NULL;
    for (int p = 0; p < 3; p++) {
        if (plan->way[color[p]] != WF_DWA_LOSSY) return "its rules for colors contradict";
        plan->colored[color[p]] = true;
    }
    plan->colors++;
    return NULL;
}

/* As text: a name that another begins with comes before it. */
static bool comes_before(const wf_exr_shape *shape, const int *a, const int *b) {
    const char *x = shape->channel[*a].name, *y = shape->channel[*b].name;
    size_t left = wf_layer_length(x), right = wf_layer_length(y);
    int order = memcmp(x, y, left < right ? left : right);
    return order ? order < 0 : left < right;
}

/* Colors are in the order of their names, which is not that of their channels. */
static const char *find_colors(wf_dwa_plan *plan, const wf_exr_shape *shape,
                               const uint8_t *part_of) {
    for (int i = 0; i < shape->channels; i++) {
        const char *wrong = part_of[i] == 1 ? add_color(plan, shape, part_of, i) : NULL;
        if (wrong) return wrong;
    }
    for (int i = 1; i < plan->colors; i++)
        for (int k = i; k && comes_before(shape, plan->color[k], plan->color[k - 1]); k--) {
            int swap[3];
            memcpy(swap, plan->color[k], sizeof swap);
            memcpy(plan->color[k], plan->color[k - 1], sizeof swap);
            memcpy(plan->color[k - 1], swap, sizeof swap);
        }
    return NULL;
}

/* ---- Rules ---- */

/* Of several rules that match the last counts. */
static void apply(wf_dwa_plan *plan, const wf_exr_shape *shape, uint8_t *part_of,
                  const rule *r) {
    for (int i = 0; i < shape->channels; i++)
        if (matches(r, &shape->channel[i])) {
            plan->way[i] = r->way;
            if (r->color >= 0) part_of[i] = (uint8_t)(r->color + 1);
        }
}

/* A rule's suffix, then a byte of color, way and case, then one of its type. */
static const char *read_rule(const uint8_t **next, const uint8_t *end, rule *r) {
    size_t left = (size_t)(end - *next);
    const uint8_t *zero = memchr(*next, 0, left < MOST_SUFFIX + 1 ? left : MOST_SUFFIX + 1);
    if (!zero || end - zero < 3) return "its rules are cut off";
    unsigned value = zero[1], type = zero[2];
    *r = (rule){(const char *)*next, (wf_dwa_way)(value >> 2 & 3), (int)(value >> 4) - 1,
                value & 1, (int)type};
    *next = zero + 3;
    if ((value >> 2 & 3) > WF_DWA_RUNS || r->color > 2 || type > WF_EXR_FLOAT)
        return "a rule of it says what cannot be";
    return NULL;
}

size_t wf_dwa_plan_bytes(int channels) {
    size_t each = sizeof(wf_dwa_way) + sizeof(int[3]) + sizeof(bool) + sizeof(uint8_t);
    return (size_t)channels * each;
}

static uint8_t *lay_out(wf_dwa_plan *plan, void *memory, int channels) {
    size_t count = (size_t)channels;
    memset(memory, 0, wf_dwa_plan_bytes(channels));
    plan->colors = 0;
    plan->way = memory;
    plan->color = (int(*)[3])(plan->way + count);
    plan->colored = (bool *)(plan->color + count);
    return (uint8_t *)(plan->colored + count);
}

const char *wf_dwa_plan_make(wf_dwa_plan *plan, void *memory, const wf_exr_shape *shape,
                             const uint8_t *rules, size_t size) {
    uint8_t *part_of = lay_out(plan, memory, shape->channels);
    const uint8_t *next = rules, *end = rules ? rules + size : NULL;
    for (size_t i = 0; !rules && i < sizeof first_rules / sizeof *first_rules; i++)
        apply(plan, shape, part_of, &first_rules[i]);
    for (int count = 0; next < end; count++) {
        rule r;
        const char *wrong =
            count < MOST_RULES ? read_rule(&next, end, &r) : "it has too many rules";
        if (wrong) return wrong;
        apply(plan, shape, part_of, &r);
    }
    for (int i = 0; i < shape->channels; i++)
        if (plan->way[i] == WF_DWA_LOSSY && shape->channel[i].type == WF_EXR_UINT)
            return "whole numbers cannot have been rounded";
    return find_colors(plan, shape, part_of);
}
