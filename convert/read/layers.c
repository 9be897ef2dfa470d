/* Chooses the channels of an EXR that are the picture. */
#include "convert/read/layers.h"

#include <stdio.h>
#include <string.h>

typedef struct channels {
    const char *const *name;
    int count;
} channels;

/* Length of the layer part of a channel name: 7 of "diffuse.R", 0 of "R". */
static size_t layer_length(const char *name) {
    const char *dot = strrchr(name, '.');
    return dot ? (size_t)(dot - name) : 0;
}

static const char *base_of(const char *name) {
    const char *dot = strrchr(name, '.');
    return dot ? dot + 1 : name;
}

static int find(const channels *c, const char *layer, size_t length, const char *base) {
    for (int i = 0; i < c->count; i++)
        if (layer_length(c->name[i]) == length && !strncmp(c->name[i], layer, length) &&
            !strcmp(base_of(c->name[i]), base))
            return i;
    return -1;
}

/* R G B, or Y alone, of one layer. */
static bool pick_layer(const channels *c, const char *layer, size_t length, bool want_alpha,
                       wf_pick *out) {
    static const char *const base[4] = {"R", "G", "B", "A"};
    int gray = find(c, layer, length, "Y");
    *out = (wf_pick){.count = 3};
    for (int i = 0; i < 4; i++) out->channel[i] = find(c, layer, length, base[i]);
    if (out->channel[0] < 0 && out->channel[1] < 0 && out->channel[2] < 0 && gray >= 0)
        for (int i = 0; i < 3; i++) out->channel[i] = gray;
    if (want_alpha && out->channel[3] >= 0) out->count = 4;
    return out->channel[0] >= 0 && out->channel[1] >= 0 && out->channel[2] >= 0;
}

static bool has_luminance_chroma(const channels *c, const char *layer, size_t length) {
    return find(c, layer, length, "RY") >= 0 || find(c, layer, length, "BY") >= 0;
}

/* Whether channel i is the first of its layer. */
static bool leads(const channels *c, int i) {
    size_t length = layer_length(c->name[i]);
    for (int j = 0; j < i; j++)
        if (layer_length(c->name[j]) == length && !strncmp(c->name[j], c->name[i], length))
            return false;
    return true;
}

static bool is_combined(const char *name, size_t length) {
    static const char word[] = "Combined";
    size_t size = sizeof word - 1;
    return length >= size && !strncmp(name + length - size, word, size) &&
           (length == size || name[length - size - 1] == '.');
}

/* The only layer that is a picture, or the only such layer called Combined; -1 if there is
 * none. */
static int only_layer(const channels *c) {
    int layers = 0, combined = 0, a_layer = -1, a_combined = -1;
    wf_pick pick;
    for (int i = 0; i < c->count; i++) {
        size_t length = layer_length(c->name[i]);
        if (!length || !leads(c, i) || !pick_layer(c, c->name[i], length, false, &pick))
            continue;
        layers++, a_layer = i;
        if (is_combined(c->name[i], length)) combined++, a_combined = i;
    }
    return layers == 1 ? a_layer : combined == 1 ? a_combined : -1;
}

static void append(char *text, size_t size, size_t *used, const char *word, size_t length) {
    if (*used + length + 3 >= size) return;
    *used += (size_t)snprintf(text + *used, size - *used, "%s%.*s", *used ? ", " : "",
                              (int)length, word);
}

static void list_layers(const channels *c, char *text, size_t size) {
    size_t used = 0;
    wf_pick pick;
    for (int i = 0; i < c->count; i++) {
        size_t length = layer_length(c->name[i]);
        if (length && leads(c, i) && pick_layer(c, c->name[i], length, false, &pick))
            append(text, size, &used, c->name[i], length);
    }
}

static void list_channels(const channels *c, char *text, size_t size) {
    size_t used = 0;
    for (int i = 0; i < c->count; i++)
        append(text, size, &used, c->name[i], strlen(c->name[i]));
}

static bool complain(const channels *c, const char *layer, char *why, size_t why_size) {
    char list[256] = "";
    if (!why) return false;
    list_layers(c, list, sizeof list);
    if (*list && layer)
        snprintf(why, why_size, "no layer '%s'; the layers with R G B are %s", layer, list);
    else if (*list)
        snprintf(why, why_size, "no R G B of its own, but layers %s; choose one with --layer",
                 list);
    else {
        list_channels(c, list, sizeof list);
        snprintf(why, why_size, "no channels R G B or Y%s%s; its channels are %s",
                 layer ? " in layer " : "", layer ? layer : "", list);
    }
    return false;
}

bool wf_pick_channels(const char *const *name, int count, const char *layer, bool want_alpha,
                      wf_pick *out, char *why, size_t why_size) {
    const channels c = {name, count};
    size_t length = layer ? strlen(layer) : 0;
    const char *prefix = layer ? layer : "";
    bool found = pick_layer(&c, prefix, length, want_alpha, out);
    int only = found || layer ? -1 : only_layer(&c);
    if (only >= 0) {
        prefix = name[only];
        length = layer_length(prefix);
        found = pick_layer(&c, prefix, length, want_alpha, out);
    }
    if (!found) return complain(&c, layer, why, why_size);
    if (out->channel[0] == out->channel[1] && has_luminance_chroma(&c, prefix, length)) {
        if (why)
            snprintf(why, why_size,
                     "luminance and chroma (Y RY BY), which weft does not read; convert "
                     "it to R G B first (oiiotool IN -o OUT does)");
        return false;
    }
    return true;
}
