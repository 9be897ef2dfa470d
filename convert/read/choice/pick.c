/* Chooses which channels of which part of a file are the picture, and says why none is. */
#include "convert/read/choice/pick.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* One question to all layers. */
typedef struct choice {
    const wf_part *parts;
    int part_count;
    wf_layers all;
    const wf_wish *wish;
    int part; /* the only one that is looked at; -1: all */
    wf_pick *out;
    char *why;
    size_t why_size;
} choice;

__attribute__((format(printf, 2, 3))) static bool refuse(const choice *c, const char *format,
                                                         ...) {
    char list[640], says[256];
    va_list args;
    va_start(args, format);
    vsnprintf(says, sizeof says, format, args);
    va_end(args);
    wf_list_layers(c->parts, c->part_count, list, sizeof list);
    snprintf(c->why, c->why_size, "%s; it has %s", says, *list ? list : "no channels");
    return false;
}

static bool take(const choice *c, const wf_layer *l, wf_picture_kind kind, wf_reason reason) {
    wf_pick *out = c->out;
    *out = (wf_pick){.part = l->number, .count = 3, .kind = kind, .layer_reason = reason};
    wf_layer_channels(l, kind, out->channel);
    out->channel[3] = wf_layer_alpha(l);
    if (out->channel[3] >= 0) out->count = 4;
    out->part_reason = c->wish->part       ? WF_REASON_OPTION
                       : c->part_count > 1 ? WF_REASON_FILE
                                           : WF_REASON_DEFAULT;
    snprintf(out->layer, sizeof out->layer, "%.*s", (int)l->length, l->name);
    return true;
}

static bool is_open_to(const choice *c, const wf_layer *l, wf_picture_kind kind) {
    int channel[3];
    return l->part->flat && (c->part < 0 || l->number == c->part) && !wf_layer_holds_ids(l) &&
           wf_layer_channels(l, kind, channel);
}

/* Layers of a kind that may be taken unasked. */
static bool is_candidate(const choice *c, const wf_layer *l, wf_picture_kind kind) {
    bool named = c->wish->part && !l->length;
    return is_open_to(c, l, kind) && (named || !wf_layer_is_data(l));
}

/* How many candidates there are: with a prefix or without, by the name of the beauty that the
 * layer (without a prefix: its part) has, or any. *found is the last of them. */
static int count_candidates(const choice *c, wf_picture_kind kind, bool bare, size_t beauty,
                            const wf_layer **found) {
    int count = 0;
    for (int i = 0; i < c->all.count; i++) {
        const wf_layer *l = &c->all.of[i];
        if (bare != !l->length || !is_candidate(c, l, kind)) continue;
        const char *name = bare ? l->part->name : l->name;
        size_t length = bare ? strlen(name) : l->length;
        if (beauty < WF_BEAUTIES && wf_beauty_of(name, length) != beauty) continue;
        *found = l;
        count++;
    }
    return count;
}

/* Of several, the one named as the beauty: 1; 0 if none is, more if it cannot be told. *also is
 * one with a less likely name, NULL if there is none. */
static int count_beauties(const choice *c, wf_picture_kind kind, bool bare,
                          const wf_layer **found, const wf_layer **also) {
    int count = 0;
    *also = NULL;
    for (size_t b = 0; !*also && b < WF_BEAUTIES; b++) {
        if (count)
            count_candidates(c, kind, bare, b, also);
        else
            count = count_candidates(c, kind, bare, b, found);
    }
    return count;
}

static void take_beauty(const choice *c, const wf_layer *l, wf_picture_kind kind,
                        const wf_layer *also) {
    take(c, l, kind, WF_REASON_FILE);
    if (!also) return;
    bool bare = !also->length;
    snprintf(c->out->also, sizeof c->out->also, "%.*s",
             bare ? (int)strlen(also->part->name) : (int)also->length,
             bare ? also->part->name : also->name);
}

typedef enum answer { NONE, TAKEN, REFUSED } answer;

static answer choose_bare(const choice *c, wf_picture_kind kind) {
    const wf_layer *l = NULL, *also;
    int count = count_candidates(c, kind, true, WF_BEAUTIES, &l);
    if (!count) return NONE;
    if (count == 1) return take(c, l, kind, WF_REASON_DEFAULT), TAKEN;
    if (count_beauties(c, kind, true, &l, &also) == 1)
        return take_beauty(c, l, kind, also), TAKEN;
    refuse(c,
           "%d parts hold a picture and no one of them is named as the beauty; choose one "
           "with --part",
           count);
    return REFUSED;
}

static answer choose_layer(const choice *c, wf_picture_kind kind) {
    const wf_layer *l = NULL, *also;
    int named = count_beauties(c, kind, false, &l, &also);
    if (named == 1) return take_beauty(c, l, kind, also), TAKEN;
    int count = count_candidates(c, kind, false, WF_BEAUTIES, &l);
    if (!count) return NONE;
    if (count == 1) return take(c, l, kind, WF_REASON_FILE), TAKEN;
    refuse(c,
           "%d layers hold a picture and no one of them is named as the beauty; choose one "
           "with --layer%s",
           count, c->part_count > 1 ? " or --part" : "");
    return REFUSED;
}

static bool choose_unasked(const choice *c) {
    for (wf_picture_kind kind = 0; kind < WF_PICTURE_KINDS; kind++) {
        answer got = choose_bare(c, kind);
        if (got == NONE) got = choose_layer(c, kind);
        if (got != NONE) return got == TAKEN;
    }
    return refuse(c, "there is no picture in it (R G B or Y; vectors, depth and ids are none; "
                     "--layer and --part name one)");
}

static bool is_called(const wf_layer *l, const char *wanted, bool exactly) {
    const char *name = l->length ? l->name : l->part->name;
    size_t length = l->length ? l->length : strlen(name);
    bool alike = strlen(wanted) == length && !strncasecmp(name, wanted, length);
    return alike && (!exactly || !strncmp(name, wanted, length));
}

/* Parts may be layers: one called like the layer is taken with its own R G B. */
static answer choose_called(const choice *c, bool exactly) {
    const char *wanted = c->wish->layer;
    bool there = false;
    for (wf_picture_kind kind = 0; kind < WF_PICTURE_KINDS; kind++) {
        const wf_layer *found = NULL;
        int count = 0;
        for (int i = 0; i < c->all.count; i++) {
            const wf_layer *l = &c->all.of[i];
            if (!is_called(l, wanted, exactly) || (c->part >= 0 && l->number != c->part))
                continue;
            there = true;
            if (is_open_to(c, l, kind)) found = l, count++;
        }
        if (count == 1) return take(c, found, kind, WF_REASON_OPTION), TAKEN;
        if (count) {
            refuse(c, "%d parts have a layer '%.80s'; choose one with --part", count, wanted);
            return REFUSED;
        }
    }
    if (!there) return NONE;
    refuse(c,
           "layer '%.80s' is no picture (R G B or Y; vectors, ids and whole numbers are "
           "none)",
           wanted);
    return REFUSED;
}

static bool choose_asked(const choice *c) {
    answer got = choose_called(c, true);
    if (got == NONE) got = choose_called(c, false);
    if (got != NONE) return got == TAKEN;
    return refuse(c, "no layer '%.80s'", c->wish->layer);
}

/* The part that the wish names, by its name, its number, or its name in any case if just one
 * has it; -1: there is none. */
static int part_called(const choice *c, const char *wanted) {
    char *end;
    int found = -1, count = 0;
    long number = strtol(wanted, &end, 10);
    for (int p = 0; p < c->part_count; p++) {
        if (*wanted && !strcmp(c->parts[p].name, wanted)) return p;
        if (*wanted && !strcasecmp(c->parts[p].name, wanted)) found = p, count++;
    }
    bool is_number = *wanted && !*end && number >= 0 && number < c->part_count;
    return is_number ? (int)number : count == 1 ? found : -1;
}

static bool any_flat(const choice *c) {
    for (int p = 0; p < c->part_count; p++)
        if (c->parts[p].flat) return true;
    return false;
}

static bool choose(choice *c) {
    const wf_wish *wish = c->wish;
    if (!any_flat(c)) return refuse(c, "no flat picture, only deep ones");
    c->part = wish->only_part;
    if (c->part < 0 && wish->part && (c->part = part_called(c, wish->part)) < 0)
        return refuse(c, "no part '%.80s'", wish->part);
    if (c->part >= c->part_count || (c->part >= 0 && !c->parts[c->part].flat))
        return refuse(c, "part %d is not a flat picture", c->part);
    return wish->layer ? choose_asked(c) : choose_unasked(c);
}

bool wf_pick_picture(const wf_part *parts, int count, const wf_wish *wish, wf_pick *out,
                     char *why, size_t why_size) {
    choice c = {.parts = parts,
                .part_count = count,
                .wish = wish,
                .out = out,
                .why = why,
                .why_size = why_size};
    if (!wf_layers_find(parts, count, &c.all)) {
        snprintf(why, why_size, "no memory for its layers");
        return false;
    }
    bool chosen = choose(&c);
    free(c.all.of);
    return chosen;
}

const char *wf_reason_name(wf_reason reason) {
    static const char *const name[] = {"default", "file", "option"};
    return name[reason];
}
