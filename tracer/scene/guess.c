/* Words that other programs have for what a scene can say. */
#include "tracer/scene/guess.h"

#include <stdbool.h>
#include <string.h>
#include <strings.h>

/* What was said, one or more words, and what is meant where that is a candidate. */
static const struct {
    const char *said, *meant;
    const char *told; /* NULL: as meant */
} meanings[] = {
    /* Solids and sets. */
    {"cube block brick cuboid rect rectangle slab square", "box", NULL},
    {"ball globe orb circle", "sphere", NULL},
    {"disc disk tube pipe rod pole", "cylinder", NULL},
    {"donut doughnut ring", "torus", NULL},
    {"plane floor ground wall", "halfspace", NULL},
    {"pyramid prism mesh tetrahedron triangle hull convex", "polyhedron", NULL},
    {"egg oval", "ellipsoid", NULL},
    {"frustum spike", "cone", NULL},
    {"merge group join combine csg_union", "union", NULL},
    {"subtract minus cut carve sub", "difference", NULL},
    {"intersect common clip", "intersection", NULL},

    /* What else is said by itself. */
    {"sky backdrop bg", "background", NULL},
    {"show draw render object place scene", "add", NULL},
    {"lamp sun bulb spot spotlight pointlight point_light", "light", NULL},
    {"viewer view eye", "camera", NULL},
    {"seconds time frames length", "duration", NULL},
    {"require dofile import load loadfile", "include", NULL},
    {"bounces max_depth recursion", "depth", NULL},
    {"arg args params parameters set", "param", NULL},
    {"log echo puts printf write", "print", NULL},
    {"text letters lettering label font title", "image",
     "texture=image{file=..}, a picture of the text"},
    {"picture photo bitmap texture", "image", NULL},
    {"chequer checkerboard chess checkers", "checker", NULL},
    {"stripes bars lines", "stripe", NULL},

    /* Keys. */
    {"rgb albedo col tint intensity power brightness", "color", NULL},
    {"pos position location origin at middle pivot", "center", NULL},
    {"pos position location origin at from", "eye", NULL},
    {"pos position location origin at eye", "point", NULL},
    {"pos position location origin at", "from", NULL},
    {"r size rad", "radius", NULL},
    {"diameter", "radius", "radius, half of it"},
    {"radius r size", "radii", NULL},
    {"radius R", "major", NULL},
    {"r tube", "minor", NULL},
    {"target aim to lookat", "look_at", NULL},
    {"dir toward", "direction", NULL},
    {"attenuation decay", "fall_off", NULL},
    {"angle zoom field_of_view", "fov", NULL},
    {"size height zoom", "ortho_height", NULL},
    {"angle deg", "degrees", NULL},
    {"speed rate velocity", "rpm", NULL},
    {"ior n", "index", "index (with refract=)"},
    {"matte cutout", "holdout", NULL},
    {"transparency transparent transmission opacity alpha glass", "refract", NULL},
    {"mirror reflection reflectivity metal reflectance", "reflect", NULL},
    {"gloss glossiness roughness shiny", "shininess", NULL},
    {"highlight spec", "specular", NULL},
    {"emissive emission emit glow", "unlit", NULL},
    {"map tex pattern checker image stripe", "texture", NULL},
    {"base start bottom p1", "from", NULL},
    {"top tip apex p2", "to", NULL},
    {"up dir direction axis", "normal", NULL},
    {"d distance dist", "offset", NULL},
    {"lower corner from", "min", NULL},
    {"upper to size", "max", NULL},
    {"src path filename name", "file", NULL},
    {"wrap tile", "repeats", NULL},

    /* Methods. */
    {"move shift position at", "translate", NULL},
    {"turn orient", "rotate", NULL},
    {"resize size", "scale", NULL},
    {"revolve rotation angular_velocity rotational_velocity", "spin", NULL},
    {"speed drift", "velocity", NULL},
    {"color colo"
     "ur paint texture look",
     "material", "material{color=..}"},
    {"animate keys path", "keyframes", NULL},
    {"transform", "matrix", NULL},
    {"blur motion_blur shutter", "temporal_width", NULL},
};

#define MEANINGS ((int)(sizeof meanings / sizeof *meanings))

/* Whether a word is one of a list with spaces between them. */
static bool is_among(const char *list, const char *word) {
    size_t length = strlen(word);
    for (const char *at = list; length; at++) {
        size_t here = strcspn(at, " ");
        if (here == length && !strncasecmp(at, word, length)) return true;
        at += here;
        if (!*at) break;
    }
    return false;
}

wf_guess wf_guess_of(const char *text) {
    return (wf_guess){.spelling = {.text = text}, .row = MEANINGS};
}

static bool begins_alike(const char *a, const char *b) {
    size_t length = strlen(a) < strlen(b) ? strlen(a) : strlen(b);
    return length >= 3 && !strncasecmp(a, b, length);
}

void wf_guess_offer(wf_guess *g, const char *candidate) {
    const char *text = g->spelling.text;
    wf_spelling_offer(&g->spelling, candidate);
    if (begins_alike(text, candidate)) g->begins = candidate;
    for (int row = 0; row < g->row; row++) {
        if (strcmp(meanings[row].meant, candidate) || !is_among(meanings[row].said, text))
            continue;
        g->row = row;
        g->meant = meanings[row].told ? meanings[row].told : candidate;
    }
}

const char *wf_guess_found(const wf_guess *g) {
    size_t length = strlen(g->spelling.text);
    const char *alike = g->spelling.distance < length ? g->spelling.best : NULL;
    if (alike && g->spelling.distance <= 1 && length > 4) return alike;
    if (g->meant) return g->meant;
    return alike ? alike : g->begins;
}
