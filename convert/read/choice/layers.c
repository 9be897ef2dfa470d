/* Layers of the parts of a file: their channels, what their names mean, and lists of them. */
#include "convert/read/choice/layers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- Names ---- */

size_t wf_layer_length(const char *name) {
    const char *dot = strrchr(name, '.');
    return dot ? (size_t)(dot - name) : 0;
}

const char *wf_layer_base(const char *name) {
    const char *dot = strrchr(name, '.');
    return dot ? dot + 1 : name;
}

static bool same_word(const char *text, size_t length, const char *word) {
    return strlen(word) == length && !strncasecmp(text, word, length);
}

/* The last name of a path of names: "Depth" of "ViewLayer.Depth", with its length. */
static const char *last_name(const char *name, size_t *length) {
    const char *at = name + *length;
    while (at > name && at[-1] != '.') at--;
    *length -= (size_t)(at - name);
    return at;
}

/* Names that renderers give to the beauty, in the order in which they are looked for. */
static const char *const beauties[] = {"rgba", "beauty", "ci", "c", "combined", "default"};
_Static_assert(sizeof beauties / sizeof *beauties == WF_BEAUTIES, "all have a place");

/* Which of them a layer or a part is called; WF_BEAUTIES: none. Blender's Combined has the name
 * of its view layer before it. */
size_t wf_beauty_of(const char *name, size_t length) {
    size_t last = length, b = 0;
    const char *tail = last_name(name, &last);
    if (same_word(tail, last, "combined")) name = tail, length = last;
    while (b < WF_BEAUTIES && !same_word(name, length, beauties[b])) b++;
    return b;
}

static bool is_one_of(const char *name, size_t length, const char *const *words, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (same_word(name, length, words[i])) return true;
    return false;
}

static bool is_letter(char c) {
    return ((c | 32) >= 'a') & ((c | 32) <= 'z');
}

/* Length of the word at name: letters, up to a capital that follows a small one. */
static size_t word_length(const char *name, size_t length) {
    size_t end = 0;
    while (end < length && is_letter(name[end]) &&
           !(end && (name[end - 1] & 32) && !(name[end] & 32)))
        end++;
    return end;
}

/* Names of what is data and no picture, though some renderers store it as R G B or Y: some
 * alone, others of layers as one of several words too ("world_normal", "ObjectID"). */
static bool is_data_name(const char *name, size_t length, bool words) {
    static const char *const alone[] = {
        "n",      "p",    "z",    "st",   "indexob", "indexma", "speed",     "pworld",
        "nworld", "pref", "nref", "pcam", "ncam",    "matid",   "objectids", "puzzlematte"};
    static const char *const within[] = {
        "normal",   "normals",    "position", "positions", "zdepth",       "depth",
        "uv",       "uvs",        "vector",   "vectors",   "velocity",     "motion",
        "objectid", "materialid", "id",       "ids",       "motionvector", "motionvectors",
    };
    const char *word = last_name(name, &length);
    if (is_one_of(word, length, alone, sizeof alone / sizeof *alone)) return true;
    for (size_t at = 0, step; words && at < length; at += step ? step : 1) {
        step = word_length(word + at, length - at);
        if (is_one_of(word + at, step, within, sizeof within / sizeof *within)) return true;
    }
    return is_one_of(word, length, within, sizeof within / sizeof *within);
}

/* CryptoObject00, crypto_material .. */
static bool is_cryptomatte(const char *name, size_t length) {
    static const char word[] = "crypto";
    for (size_t i = 0; i + sizeof word - 1 <= length; i++)
        if (!strncasecmp(name + i, word, sizeof word - 1)) return true;
    return false;
}

/* ---- Layers of a part ---- */

static bool in_layer(const wf_layer *l, const char *name) {
    return wf_layer_length(name) == l->length && !strncmp(name, l->name, l->length);
}

/* The channel of a layer by its name without the prefix, as it is written or in any case. */
static int find(const wf_layer *l, const char *base) {
    int any_case = -1;
    for (int i = 0; i < l->part->count; i++) {
        const char *name = l->part->channel[i].name;
        if (!in_layer(l, name)) continue;
        if (!strcmp(wf_layer_base(name), base)) return i;
        if (any_case < 0 && !strcasecmp(wf_layer_base(name), base)) any_case = i;
    }
    return any_case;
}

static bool is_level(const wf_layer *l, int channel) {
    return channel >= 0 && !l->part->channel[channel].whole_numbers;
}

static bool find_rgb(const wf_layer *l, int channel[3]) {
    static const char *const spelling[][3] = {{"R", "G", "B"}, {"red", "green", "blue"}};
    for (size_t s = 0; s < sizeof spelling / sizeof *spelling; s++) {
        bool found = true;
        for (int c = 0; c < 3; c++) {
            channel[c] = find(l, spelling[s][c]);
            found &= is_level(l, channel[c]);
        }
        if (found) return true;
    }
    return false;
}

static bool has_chroma(const wf_layer *l) {
    return find(l, "RY") >= 0 || find(l, "BY") >= 0;
}

/* X and Z make Y a coordinate; U and V a vector's or a video's. */
static bool find_y(const wf_layer *l, int channel[3]) {
    static const char *const others[] = {"X", "Z", "U", "V"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (find(l, others[i]) >= 0) return false;
    for (int c = 0; c < 3; c++) channel[c] = find(l, "Y");
    return is_level(l, channel[0]) && !has_chroma(l);
}

static bool find_luminance_chroma(const wf_layer *l, int channel[3]) {
    static const char *const name[] = {"Y", "RY", "BY"};
    bool found = true;
    for (int c = 0; c < 3; c++) {
        channel[c] = find(l, name[c]);
        found &= is_level(l, channel[c]);
    }
    return found;
}

/* By wf_picture_kind, in the order in which they are looked for. */
static bool (*const find_kind[])(const wf_layer *l, int channel[3]) = {
    [WF_PICTURE_RGB] = find_rgb,
    [WF_PICTURE_Y] = find_y,
    [WF_PICTURE_LUMINANCE_CHROMA] = find_luminance_chroma,
};
_Static_assert(sizeof find_kind / sizeof *find_kind == WF_PICTURE_KINDS, "all are found");

bool wf_layer_channels(const wf_layer *l, wf_picture_kind kind, int channel[3]) {
    return find_kind[kind](l, channel);
}

/* Its own alpha. RenderMan's Ci is beside an `a` without a prefix, which goes with the beauty.
 */
int wf_layer_alpha(const wf_layer *l) {
    wf_layer bare = {.part = l->part, .name = "", .length = 0};
    int channel = find(l, "A");
    if (channel < 0) channel = find(l, "alpha");
    if (channel < 0 && l->length && wf_beauty_of(l->name, l->length) < WF_BEAUTIES)
        channel = wf_layer_alpha(&bare);
    return channel;
}

bool wf_layer_holds_ids(const wf_layer *l) {
    return is_cryptomatte(l->name, l->length) || l->part->channel[l->lead].ids ||
           (!l->length && is_cryptomatte(l->part->name, strlen(l->part->name)));
}

bool wf_layer_is_data(const wf_layer *l) {
    const char *name = l->length ? l->name : l->part->name;
    size_t length = l->length ? l->length : strlen(name);
    return wf_layer_holds_ids(l) || is_data_name(name, length, l->length > 0);
}

/* ---- All layers ---- */

static bool leads(const wf_part *part, int i) {
    const char *name = part->channel[i].name;
    const wf_layer l = {.part = part, .name = name, .length = wf_layer_length(name)};
    for (int j = 0; j < i; j++)
        if (in_layer(&l, part->channel[j].name)) return false;
    return true;
}

static void add_part(wf_layers *all, const wf_part *part, int number) {
    for (int i = 0; i < part->count; i++)
        if (leads(part, i))
            all->of[all->count++] =
                (wf_layer){.part = part,
                           .number = number,
                           .lead = i,
                           .name = part->channel[i].name,
                           .length = wf_layer_length(part->channel[i].name)};
}

/* False when memory is out. */
bool wf_layers_find(const wf_part *parts, int count, wf_layers *all) {
    size_t channels = 1;
    for (int p = 0; p < count; p++) channels += (size_t)parts[p].count;
    *all = (wf_layers){.of = malloc(channels * sizeof *all->of)};
    for (int p = 0; all->of && p < count; p++) add_part(all, &parts[p], p);
    return all->of;
}

/* ---- Listing ---- */

/* Channels of a layer, colors and coordinates in the order people say them. */
static void name_channels(const wf_layer *l, char *text, size_t size) {
    static const char order[] = "RGBA";
    size_t used = 0;
    text[0] = '\0';
    for (size_t rank = 0; rank < sizeof order; rank++)
        for (int i = 0; i < l->part->count; i++) {
            const char *base = wf_layer_base(l->part->channel[i].name);
            const char *at = base[0] && !base[1] ? strchr(order, base[0] & ~32) : NULL;
            size_t place = at && *at ? (size_t)(at - order) : sizeof order - 1;
            if (place != rank || !in_layer(l, l->part->channel[i].name)) continue;
            if (used + strlen(base) + 2 >= size) return;
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " " : "", base);
        }
}

void wf_each_layer(const wf_part *parts, int count, wf_layer_fn *tell, void *user) {
    wf_layers all;
    char name[256], channels[512];
    if (!wf_layers_find(parts, count, &all)) return;
    for (int i = 0; i < all.count; i++) {
        const wf_layer *l = &all.of[i];
        snprintf(name, sizeof name, "%.*s", (int)l->length, l->name);
        name_channels(l, channels, sizeof channels);
        tell(user, l->number, l->part->name, name, channels);
    }
    free(all.of);
}

typedef struct listing {
    char *text;
    size_t size, used;
    int part, parts, left_out;
} listing;

#define LIST_END 40 /* characters kept for what is left out */

static void list_layer(void *user, int part, const char *part_name, const char *name,
                       const char *channels) {
    listing *t = user;
    char words[900], head[128] = "";
    bool first = part != t->part;
    if (first && t->parts > 1)
        snprintf(head, sizeof head, "%spart %d '%.80s': ", t->used ? "; " : "", part,
                 part_name);
    else if (t->used)
        snprintf(head, sizeof head, ", ");
    if (*name)
        snprintf(words, sizeof words, "%s%s (%.160s)", head, name, channels);
    else
        snprintf(words, sizeof words, "%s%.160s", head, channels);
    if (t->left_out || t->used + strlen(words) + LIST_END >= t->size) {
        t->left_out++;
        return;
    }
    t->part = part;
    t->used += (size_t)snprintf(t->text + t->used, t->size - t->used, "%s", words);
}

void wf_list_layers(const wf_part *parts, int count, char *text, size_t size) {
    listing list = {.text = text, .size = size, .part = -1, .parts = count};
    text[0] = '\0';
    wf_each_layer(parts, count, list_layer, &list);
    if (list.left_out)
        snprintf(text + list.used, size - list.used, ", and %d more ('weft info' lists them)",
                 list.left_out);
}

const char *wf_picture_kind_name(wf_picture_kind kind) {
    static const char *const name[] = {"R G B", "Y", "Y RY BY"};
    return name[kind];
}
