/* Reads apertures by name, with what follows the name. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "filters/aperture/aperture.h"
#include "filters/aperture/design.h"
#include "filters/base/fraction.h"

static bool list_names(char *why, size_t why_size, const char *text) {
    const wf_aperture_kind *kind;
    int used = snprintf(why, why_size, "no aperture is called '%s'; there are", text);
    for (size_t i = 0; (kind = wf_aperture_at(i)); i++) {
        if (used < 0 || (size_t)used >= why_size) break;
        used +=
            snprintf(why + used, why_size - (size_t)used, "%s %s%s%s", i ? "," : "", kind->name,
                     kind->follows ? ":" : "", kind->follows ? kind->follows : "");
    }
    return false;
}

/* Reads "B,C" after the colon. */
static bool parse_parameters(const char *text, wf_aperture *out) {
    for (int p = 0; p < out->kind->parameters; p++) {
        const char *end;
        double value = wf_fraction_read(text, &end);
        char follows = p + 1 < out->kind->parameters ? ',' : '\0';
        if (end == text || *end != follows ||
            !(value >= out->kind->low && value <= out->kind->high))
            return false;
        out->parameter[p] = value;
        text = end + 1;
    }
    return true;
}

static bool parse_design(const char *text, wf_aperture *out, char *why, size_t why_size) {
    wf_design_wish wish;
    wf_design design;
    if (!wf_design_parse(text, &wish, why, why_size)) return false;
    out->half_u = wish.width / 2;
    out->reach_u = ceil(wish.width) / 2;
    out->reach_v = wish.support;
    if (!out->kind->comb && !wf_design_solve(&wish, &design, why, why_size)) return false;
    wf_stairs_init(&out->stairs, wish.support, out->kind->comb ? out->kind->comb : design.comb);
    return true;
}

/* Whether something follows the name just where something should. */
static bool well_formed(const wf_aperture_kind *kind, const char *colon, char *why,
                        size_t why_size) {
    if (kind->follows ? *colon && colon[1] : !*colon) return true;
    if (kind->follows)
        snprintf(why, why_size, "aperture '%s': write it %s:%s, such as %s:%s", kind->name,
                 kind->name, kind->follows, kind->name, kind->example);
    else
        snprintf(why, why_size, "aperture '%s%s': %s takes no parameters", kind->name, colon,
                 kind->name);
    return false;
}

static bool parse_as(const wf_aperture_kind *kind, const char *text, wf_aperture *out,
                     char *why, size_t why_size) {
    const char *colon = text + strlen(kind->name), *wish = wf_aperture_wish(kind, text);
    wf_aperture found = {
        .kind = kind, .reach_u = kind->reach_u, .reach_v = kind->reach_v, .half_u = 0.5};
    if (!well_formed(kind, colon, why, why_size)) return false;
    if (wish && !parse_design(wish, &found, why, why_size)) return false;
    if (kind->parameters && !parse_parameters(colon + 1, &found)) {
        snprintf(why, why_size,
                 "aperture '%s': write it %s:%s with %s from %g to %g, such as %s:%s", text,
                 kind->name, kind->follows, kind->parameters == 1 ? "a number" : "two numbers",
                 kind->low, kind->high, kind->name, kind->example);
        return false;
    }
    *out = found;
    return true;
}

const char *wf_aperture_wish(const wf_aperture_kind *kind, const char *name) {
    if (kind->profile != WF_PROFILE_DESIGN || kind->design) return kind->design;
    const char *colon = strchr(name, ':');
    return colon ? colon + 1 : "";
}

bool wf_aperture_parse(const char *text, wf_aperture *out, char *why, size_t why_size) {
    const wf_aperture_kind *kind;
    size_t length = strcspn(text, ":");
    for (size_t i = 0; (kind = wf_aperture_at(i)); i++)
        if (strlen(kind->name) == length && !strncmp(kind->name, text, length))
            return parse_as(kind, text, out, why, why_size);
    return list_names(why, why_size, text);
}
