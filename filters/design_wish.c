/* What an aperture is wished to be, in words. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "filters/design.h"
#include "filters/near.h"

typedef struct key_row {
    const char *name;
    double low, high;
    size_t offset; /* of the number, the first of several, in the wish */
    bool halves;
} key_row;

#define KEY(field) offsetof(wf_design_wish, field)

/* More sharpness than 1 would be a peak. Of an alias of less than 0.04 the steps' own images,
 * near 8 cycles a line, are in the way. */
static const key_row keys[] = {
    {"support", 1.5, WF_STAIRS_LINES, KEY(support), true},
    {"overshoot", 0, 0.5, KEY(overshoot), false},
    {"flicker", 1e-4, 0.5, KEY(flicker), false},
    {"sharp", 1e-3, 1, KEY(sharp), false},
    {"at", 0.01, 0.49, KEY(at), false},
    {"alias", 0.04, 1, KEY(alias), false},
    {"width", 1, 4, KEY(width), false},
};
#define KEYS (sizeof keys / sizeof *keys)

static bool unknown(const char *name, char *why, size_t why_size) {
    wf_near near = {.text = name};
    for (size_t i = 0; i < KEYS; i++) wf_near_offer(&near, keys[i].name);
    int used = snprintf(why, why_size, "design: there is no '%s'; ", name);
    if (near.best)
        used += snprintf(why + used, why_size - (size_t)used, "did you mean %s? ", near.best);
    snprintf(why + used, why_size - (size_t)used,
             "Write support, overshoot, flicker, sharp, at, alias or width, and '=' with a "
             "number");
    return false;
}

/* The number that a key names; NULL if there are more of them than there is room for. */
static double *place_of(const key_row *row, wf_design_wish *wish) {
    double *first = (double *)((char *)wish + row->offset);
    bool sharp = first == wish->sharp, at = first == wish->at;
    if (sharp && wish->sharps == WF_DESIGN_SHARPS) return NULL;
    if (sharp) return first + wish->sharps++;
    return at && wish->sharps ? first + wish->sharps - 1 : first;
}

static bool read_number(const key_row *row, const char *text, double *value) {
    char *end;
    *value = strtod(text, &end);
    bool whole = !row->halves || 2 * *value == floor(2 * *value);
    return end != text && !*end && *value >= row->low && *value <= row->high && whole;
}

static bool read_pair(char *pair, wf_design_wish *wish, char *why, size_t why_size) {
    char *value = strchr(pair, '=');
    if (value) *value++ = '\0';
    for (size_t i = 0; value && i < KEYS; i++) {
        const key_row *row = &keys[i];
        double number;
        if (strcmp(row->name, pair) != 0) continue;
        if (!read_number(row, value, &number)) {
            snprintf(why, why_size, "design: %s='%s' will not do; it takes %s from %g to %g",
                     pair, value, row->halves ? "lines, whole or half," : "a number", row->low,
                     row->high);
            return false;
        }
        double *place = place_of(row, wish);
        if (place) *place = number;
        if (!place)
            snprintf(why, why_size, "design: sharp more than %d times", WF_DESIGN_SHARPS);
        return place;
    }
    return unknown(pair, why, why_size);
}

static bool check(const wf_design_wish *wish, char *why, size_t why_size) {
    if ((wish->flicker > 0) != (wish->sharps > 0)) return true;
    snprintf(
        why, why_size,
        "design: give either sharp=S (0 to 1, the response at 0.25 cycles/line or at "
        "at=F), for the least flicker, or flicker=F (the box's is 0.063), for the sharpest");
    return false;
}

bool wf_design_parse(const char *text, wf_design_wish *wish, char *why, size_t why_size) {
    char copy[256];
    *wish =
        (wf_design_wish){.support = 4, .overshoot = 0.05, .alias = WF_DESIGN_ALIAS, .width = 1};
    for (int i = 0; i < WF_DESIGN_SHARPS; i++) wish->at[i] = 0.25;
    if (strlen(text) >= sizeof copy) {
        snprintf(why, why_size, "design: more than %zu characters", sizeof copy - 1);
        return false;
    }
    strcpy(copy, text);
    for (char *pair = copy, *next; pair && *copy; pair = next) {
        next = strchr(pair, ',');
        if (next) *next++ = '\0';
        if (!read_pair(pair, wish, why, why_size)) return false;
    }
    return check(wish, why, why_size);
}
