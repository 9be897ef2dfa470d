/* Decides what a file's samples are by what the file says of its colors. */
#include "convert/read/file_colors.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Names of spaces ---- */

static void take_space(const wf_space *space, wf_file_colors *out) {
    out->primaries = wf_chromaticities_of[space->primaries];
    out->decoding = wf_decoding_of(space->curve);
    out->primaries_said = out->transfer_said = true;
}

static bool by_name(const char *name, wf_file_colors *out) {
    char ignored[1024];
    const wf_space *space = *name ? wf_space_find(name, ignored, sizeof ignored) : NULL;
    if (space) take_space(space, out);
    return space;
}

/* weft:colorSpace of whoever wrote it. */
static bool by_space(const wf_color_said *said, wf_file_colors *out) {
    return by_name(said->space, out);
}

/* Identifiers of the Color Interop Forum: a curve, primaries and whether it is a scene's or a
 * display's, such as "lin_ap1_scene". */
static const struct {
    const char *name;
    double gamma;          /* 0: the curve counts */
    const wf_curve *curve; /* NULL: linear */
} interop_curves[] = {
    {"lin", 0, NULL},   {"srgb", 0, &wf_curve_srgb}, {"srgbe", 0, &wf_curve_srgb},
    {"g18", 1.8, NULL}, {"g22", 2.2, NULL},          {"g24", 0, &wf_curve_bt1886},
    {"g26", 2.6, NULL}, {"pq", 0, &wf_curve_pq},     {"hlg", 0, &wf_curve_hlg}};

static const wf_chromaticities adobe_rgb = {"Adobe RGB",  "Adobe RGB (1998)", {0.64, 0.33},
                                            {0.21, 0.71}, {0.15, 0.06},       {0.3127, 0.3290}};
static const wf_chromaticities xyz_d65 = {"CIE XYZ D65", "CIE 1931", {1, 0},
                                          {0, 1},        {0, 0},     {0.3127, 0.3290}};

static const struct {
    const char *name;
    const wf_chromaticities *primaries;
} interop_primaries[] = {{"rec709", &wf_chromaticities_of[WF_PRIMARIES_709]},
                         {"ap0", &wf_chromaticities_of[WF_PRIMARIES_AP0]},
                         {"ap1", &wf_chromaticities_of[WF_PRIMARIES_AP1]},
                         {"p3d65", &wf_chromaticities_of[WF_PRIMARIES_P3]},
                         {"rec2020", &wf_chromaticities_of[WF_PRIMARIES_2020]},
                         {"adobergb", &adobe_rgb},
                         {"ciexyzd65", &xyz_d65}};

static bool by_interop(const wf_color_said *said, wf_file_colors *out) {
    char curve[16], primaries[16], state[16];
    if (sscanf(said->interop, "%15[^_]_%15[^_]_%15s", curve, primaries, state) != 3)
        return by_name(said->interop, out); /* "ACEScg", as some write there */
    size_t c = 0, p = 0, curves = sizeof interop_curves / sizeof *interop_curves,
           all = sizeof interop_primaries / sizeof *interop_primaries;
    while (c < curves && strcmp(interop_curves[c].name, curve)) c++;
    while (p < all && strcmp(interop_primaries[p].name, primaries)) p++;
    if (c == curves || p == all) return false;
    const wf_curve gamma =
        wf_curve_gamma(interop_curves[c].gamma > 0 ? interop_curves[c].gamma : 1, 1);
    out->primaries = *interop_primaries[p].primaries;
    out->decoding =
        wf_decoding_of(interop_curves[c].gamma > 0 ? &gamma : interop_curves[c].curve);
    out->primaries_said = out->transfer_said = true;
    return true;
}

/* ---- Primaries ---- */

static void warn(wf_file_colors *out, const char *what, const char *name, const char *taken) {
    snprintf(out->warning, sizeof out->warning,
             "%s%s%.80s%s: it is taken as %s; --from names what it is", what,
             *name ? " \"" : "", name, *name ? "\"" : "", taken);
}

static void take_primaries(const wf_chromaticities *primaries, wf_file_colors *out) {
    wf_primaries like = wf_primaries_like(primaries);
    out->primaries = like == WF_PRIMARIES_COUNT ? *primaries : wf_chromaticities_of[like];
    out->primaries_said = true;
}

static void by_chromaticities(const wf_color_said *said, wf_file_colors *out) {
    const double *xy = said->chromaticities;
    const wf_chromaticities primaries = {"the file's",   "the file",     {xy[0], xy[1]},
                                         {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
    if (!said->has_chromaticities) return;
    if (wf_chromaticities_usable(&primaries))
        take_primaries(&primaries, out);
    else
        warn(out, "its chromaticities are no primaries", "", "Rec. 709");
}

/* ---- Light ---- */

static void of_floats(const wf_color_said *said, wf_file_colors *out) {
    if (by_space(said, out) || by_interop(said, out)) return;
    by_chromaticities(said, out);
    const char *unknown = *said->space ? said->space : said->interop;
    if (*unknown && strcmp(unknown, "unknown") && !*out->warning)
        warn(out, "the file says that its color space is", unknown,
             out->primaries_said ? "light of its chromaticities" : "linear Rec. 709");
}

/* ---- PNG ---- */

/* Samples of narrow range, 0 to 1 being all codes of so many bits. */
static void scale_narrow(int bits, wf_decoding *decoding) {
    double step = exp2(bits - 8), codes = exp2(bits) - 1;
    decoding->scale = (float)(codes / (219 * step));
    decoding->offset = -16.0f / 219;
}

static bool by_code_points(const wf_color_said *said, wf_file_colors *out) {
    const wf_chromaticities *primaries = wf_chromaticities_of_code_point(said->primaries);
    if (!said->transfer || said->transfer == 2) return false;
    if (primaries) take_primaries(primaries, out);
    if (!primaries && said->primaries != 2) {
        char code[16];
        snprintf(code, sizeof code, "%d", said->primaries);
        warn(out, "its cICP says unknown color primaries", code, "Rec. 709's");
    }
    out->transfer_said = true;
    if (!wf_decoding_of_code_point(said->transfer, &out->decoding))
        snprintf(out->trouble, sizeof out->trouble,
                 "its cICP says transfer characteristics %d, which weft does not decode; name "
                 "the space with --from",
                 said->transfer);
    else if (said->narrow && said->bits >= 8)
        scale_narrow(said->bits, &out->decoding);
    return true;
}

static void by_gamma(const wf_color_said *said, wf_file_colors *out) {
    by_chromaticities(said, out);
    if (!(said->gamma > 0.1 && said->gamma < 10)) return;
    const wf_curve curve = wf_curve_gamma(1 / said->gamma, 1);
    out->decoding = wf_decoding_of(fabs(said->gamma - 1) < 1e-4 ? NULL : &curve);
    out->transfer_said = true;
}

static bool has_other_primaries(const wf_color_said *said) {
    wf_file_colors own = {.primaries = wf_chromaticities_of[WF_PRIMARIES_709]};
    by_chromaticities(said, &own);
    return wf_primaries_like(&own.primaries) != WF_PRIMARIES_709;
}

static void of_codes(const wf_color_said *said, wf_file_colors *out) {
    out->decoding = wf_decoding_of(&wf_curve_srgb);
    if (by_code_points(said, out)) return;
    if (said->inks) {
        warn(out,
             "its colors are amounts of ink (CMYK), of which R G B are made without a profile",
             "", "sRGB");
        return;
    }
    if (*said->profile) {
        warn(out, "its ICC profile is not of sRGB, and weft does not read it:", said->profile,
             "sRGB");
        return;
    }
    out->primaries_said = out->transfer_said = said->srgb;
    if (said->bits && !said->srgb) by_gamma(said, out);
    if (!said->bits && has_other_primaries(said))
        warn(out, "its chromaticities are not those of sRGB", "", "sRGB");
}

/* ---- DPX ---- */

/* Fields of ST 268-1 table 5A and 5B. */
static const struct {
    const char *name;
    enum { LIGHT, VIDEO, GUESS, UNKNOWN } taken;
    int primaries; /* of the colorimetric field; -1: none */
} dpx_fields[] = {{"user defined", GUESS, -1},
                  {"printing density", UNKNOWN, -1},
                  {"linear", LIGHT, -1},
                  {"logarithmic", UNKNOWN, -1},
                  {"unspecified video", VIDEO, -1},
                  {"SMPTE 274M", VIDEO, WF_PRIMARIES_709},
                  {"ITU-R BT.709", VIDEO, WF_PRIMARIES_709},
                  {"ITU-R BT.601 of 625 lines", VIDEO, WF_PRIMARIES_EBU},
                  {"ITU-R BT.601 of 525 lines", VIDEO, WF_PRIMARIES_SMPTE_C},
                  {"NTSC composite video", VIDEO, WF_PRIMARIES_SMPTE_C},
                  {"PAL composite video", VIDEO, WF_PRIMARIES_EBU},
                  {"linear depth", UNKNOWN, -1},
                  {"homogeneous depth", UNKNOWN, -1}};

static void of_dpx(const wf_color_said *said, wf_file_colors *out) {
    size_t fields = sizeof dpx_fields / sizeof *dpx_fields;
    size_t transfer = (size_t)said->dpx_transfer, colors = (size_t)said->dpx_colorimetric;
    int taken = transfer < fields ? (int)dpx_fields[transfer].taken : GUESS;
    if (taken == GUESS && by_space(said, out)) return;
    out->decoding = wf_decoding_of(taken == LIGHT ? NULL : &wf_curve_bt1886);
    out->transfer_said = taken != GUESS;
    if (taken == UNKNOWN)
        snprintf(out->trouble, sizeof out->trouble,
                 "its transfer field says %s, of which weft does not know the light; name its "
                 "space with --from, in a configuration that has it (--ocio)",
                 dpx_fields[transfer].name);
    if (taken == GUESS)
        warn(out, "its transfer field does not say what its codes are", "", "video (BT.1886)");
    if (colors < fields && dpx_fields[colors].primaries >= 0)
        take_primaries(&wf_chromaticities_of[dpx_fields[colors].primaries], out);
}

/* ---- Any file ---- */

wf_file_colors wf_file_colors_of(const wf_color_said *said) {
    wf_file_colors out = {.primaries = wf_chromaticities_of[WF_PRIMARIES_709],
                          .decoding = wf_decoding_of(NULL)};
    (said->dpx ? of_dpx : said->floats ? of_floats : of_codes)(said, &out);
    return out;
}

static bool same_decoding(const wf_decoding *a, const wf_decoding *b) {
    char one[24], two[24];
    return a->scale == b->scale && a->offset == b->offset &&
           !strcmp(wf_decoding_name(a, one), wf_decoding_name(b, two));
}

void wf_file_colors_name(const wf_file_colors *colors, char *text, size_t size) {
    const wf_chromaticities *c = &colors->primaries;
    const wf_space *space;
    wf_primaries like = wf_primaries_like(c);
    wf_decoding plain = colors->decoding;
    plain.scale = 1, plain.offset = 0;
    for (size_t i = 0; (space = wf_space_at(i)); i++) {
        const wf_decoding own = wf_decoding_of(space->curve);
        if (space->primaries == like && same_decoding(&own, &plain)) {
            snprintf(text, size, "%s", space->name);
            return;
        }
    }
    if (like != WF_PRIMARIES_COUNT)
        snprintf(text, size, "%s primaries", wf_chromaticities_of[like].name);
    else
        snprintf(text, size, "primaries %.4g %.4g, %.4g %.4g, %.4g %.4g, white %.4g %.4g",
                 c->red[0], c->red[1], c->green[0], c->green[1], c->blue[0], c->blue[1],
                 c->white[0], c->white[1]);
}

void wf_file_colors_take(const wf_file_colors *colors, wf_taken_list *list) {
    char name[128], curve[24];
    wf_file_colors_name(colors, name, sizeof name);
    wf_take(list, "space", name, colors->primaries_said ? "file" : "default");
    wf_take(list, "transfer",
            *colors->trouble ? "unknown" : wf_decoding_name(&colors->decoding, curve),
            colors->transfer_said ? "file" : "default");
}

bool wf_file_colors_same(const wf_file_colors *a, const wf_file_colors *b) {
    char one[128], two[128];
    wf_file_colors_name(a, one, sizeof one);
    wf_file_colors_name(b, two, sizeof two);
    return !strcmp(one, two) && same_decoding(&a->decoding, &b->decoding);
}
