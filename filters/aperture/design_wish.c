/* Reads what a designed aperture is wished to be: KEY=VALUE,.. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "filters/aperture/design.h"
#include "filters/base/fraction.h"
#include "filters/base/spelling.h"

typedef struct key_row {
    const char *name;
    double low, high;
    size_t offset; /* of the number in the wish, or of the first of several */
    bool halves;   /* a multiple of 1/2 */
} key_row;

#define KEY(field) offsetof(wf_design_wish, field)

/* A sharpness above 1 would be a peak. An alias below 0.04 is out of reach: the steps' own
 * images near 8 cycles a line are as large. */
enum { SHARP = 3, AT = 4 };
static const key_row keys[] = {
    {"support", 1.5, WF_STAIRS_LINES, KEY(support), true},
    {"overshoot", 0, 0.5, KEY(overshoot), false},
    {"flicker", 1e-4, 0.5, KEY(flicker), false},
    [SHARP] = {"sharp", 1e-3, 1, KEY(sharp), false},
    [AT] = {"at", 0.01, 0.49, KEY(at), false},
    {"alias", 0.04, 1, KEY(alias), false},
    {"width", 1, 4, KEY(width), false},
};
#define KEYS (sizeof keys / sizeof *keys)

/* What has been read so far. */
typedef struct reading {
    wf_design_wish *wish;
    unsigned given; /* a bit for each key that came; `at`'s is cleared by another sharp */
    bool at_first;  /* `at` came before any sharp */
    char *why;
    size_t why_size;
} reading;

static bool unknown(const char *name, char *why, size_t why_size) {
    wf_spelling spelling = {.text = name};
    if (!*name) {
        snprintf(why, why_size, "design: a comma too many; write KEY=VALUE,KEY=VALUE");
        return false;
    }
    for (size_t i = 0; i < KEYS; i++) wf_spelling_offer(&spelling, keys[i].name);
    int used = snprintf(why, why_size, "design: there is no '%s'; ", name);
    if (spelling.best)
        used +=
            snprintf(why + used, why_size - (size_t)used, "did you mean %s? ", spelling.best);
    snprintf(why + used, why_size - (size_t)used,
             "Write support, overshoot, flicker, sharp, at, alias or width, and '=' with a "
             "number");
    return false;
}

static bool refuse(const reading *r, const char *what) {
    snprintf(r->why, r->why_size, "design: %s", what);
    return false;
}

/* Whether a key may come where it does. Each further sharp may have an `at`. */
static bool in_turn(reading *r, const key_row *row) {
    wf_design_wish *wish = r->wish;
    unsigned bit = 1u << (row - keys), at_bit = 1u << AT;
    bool sharp = row == &keys[SHARP];
    if (sharp && wish->sharps == WF_DESIGN_SHARPS) return refuse(r, "sharp more than 4 times");
    if (sharp && wish->sharps && r->at_first)
        return refuse(r, "of which sharp is the 'at' before them? Write sharp=S,at=F pairs");
    if (sharp && wish->sharps) r->given &= ~(bit | at_bit);
    if (r->given & bit && row == &keys[AT])
        return refuse(r, "'at' twice; write sharp=S,at=F pairs");
    if (r->given & bit) {
        snprintf(r->why, r->why_size, "design: '%s' twice; give it once", row->name);
        return false;
    }
    r->given |= bit;
    r->at_first |= row == &keys[AT] && !wish->sharps;
    return true;
}

/* Where in the wish the number of a key goes. */
static double *place_of(const key_row *row, wf_design_wish *wish) {
    double *first = (double *)((char *)wish + row->offset);
    if (row == &keys[SHARP]) return first + wish->sharps++;
    return row == &keys[AT] && wish->sharps ? first + wish->sharps - 1 : first;
}

static bool read_number(const key_row *row, const char *text, double *value) {
    const char *end;
    *value = wf_fraction_read(text, &end);
    bool whole = !row->halves || 2 * *value == floor(2 * *value);
    return end != text && !*end && *value >= row->low && *value <= row->high && whole;
}

static bool read_pair(char *pair, reading *r) {
    char *value = strchr(pair, '=');
    if (value) *value++ = '\0';
    for (size_t i = 0; value && i < KEYS; i++) {
        const key_row *row = &keys[i];
        double number;
        if (strcmp(row->name, pair) != 0) continue;
        if (!read_number(row, value, &number)) {
            snprintf(r->why, r->why_size,
                     "design: %s='%s' will not do; it takes %s from %g to %g", pair, value,
                     row->halves ? "lines, whole or half," : "a number", row->low, row->high);
            return false;
        }
        if (!in_turn(r, row)) return false;
        *place_of(row, r->wish) = number;
        return true;
    }
    return unknown(pair, r->why, r->why_size);
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
    reading r = {.wish = wish, .why = why, .why_size = why_size};
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
        if (!read_pair(pair, &r)) return false;
    }
    return check(wish, why, why_size);
}
