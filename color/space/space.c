/* The tables of primaries and spaces, and the matrices between primaries. */
#include "color/space/space.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* ---- Primaries ---- */

#define D65                                                                                    \
    { 0.3127, 0.3290 }
#define ACES_WHITE                                                                             \
    { 0.32168, 0.33767 }

const wf_chromaticities wf_chromaticities_of[WF_PRIMARIES_COUNT] = {
    [WF_PRIMARIES_709] = {"Rec.709",
                          "Rec. ITU-R BT.709-6 item 1.3",
                          {0.640, 0.330},
                          {0.300, 0.600},
                          {0.150, 0.060},
                          D65},
    [WF_PRIMARIES_SMPTE_C] = {"SMPTE-C",
                              "SMPTE RP 145; Rec. ITU-R BT.601-7 for 525 lines",
                              {0.630, 0.340},
                              {0.310, 0.595},
                              {0.155, 0.070},
                              D65},
    [WF_PRIMARIES_EBU] = {"EBU",
                          "EBU Tech. 3213; Rec. ITU-R BT.601-7 for 625 lines",
                          {0.640, 0.330},
                          {0.290, 0.600},
                          {0.150, 0.060},
                          D65},
    [WF_PRIMARIES_2020] = {"Rec.2020",
                           "Rec. ITU-R BT.2020-2 table 3",
                           {0.708, 0.292},
                           {0.170, 0.797},
                           {0.131, 0.046},
                           D65},
    [WF_PRIMARIES_P3] = {"P3-D65",
                         "SMPTE RP 431-2, with D65 SMPTE EG 432-1",
                         {0.680, 0.320},
                         {0.265, 0.690},
                         {0.150, 0.060},
                         D65},
    [WF_PRIMARIES_AP0] =
        {"AP0", "SMPTE ST 2065-1", {0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, ACES_WHITE},
    [WF_PRIMARIES_AP1] = {"AP1",
                          "Academy S-2014-004 (ACEScg)",
                          {0.713, 0.293},
                          {0.165, 0.830},
                          {0.128, 0.044},
                          ACES_WHITE},
};

static const struct {
    int code_point;
    wf_chromaticities primaries;
} coded[] = {
    {4,
     {"BT.470 M",
      "Rec. ITU-R BT.470-6 system M",
      {0.67, 0.33},
      {0.21, 0.71},
      {0.14, 0.08},
      {0.310, 0.316}}},
    {8,
     {"film",
      "Rec. ITU-T H.273: generic film, illuminant C",
      {0.681, 0.319},
      {0.243, 0.692},
      {0.145, 0.049},
      {0.310, 0.316}}},
    {10, {"CIE XYZ", "SMPTE ST 428-1", {1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}}},
    {11,
     {"DCI-P3",
      "SMPTE RP 431-2",
      {0.680, 0.320},
      {0.265, 0.690},
      {0.150, 0.060},
      {0.314, 0.351}}},
    {22,
     {"H.273 22",
      "Rec. ITU-T H.273: no corresponding industry specification",
      {0.630, 0.340},
      {0.295, 0.605},
      {0.155, 0.077},
      D65}},
};

const wf_chromaticities *wf_chromaticities_of_code_point(int code_point) {
    static const int known[][2] = {{1, WF_PRIMARIES_709},     {5, WF_PRIMARIES_EBU},
                                   {6, WF_PRIMARIES_SMPTE_C}, {7, WF_PRIMARIES_SMPTE_C},
                                   {9, WF_PRIMARIES_2020},    {12, WF_PRIMARIES_P3}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (known[i][0] == code_point) return &wf_chromaticities_of[known[i][1]];
    for (size_t i = 0; i < sizeof coded / sizeof *coded; i++)
        if (coded[i].code_point == code_point) return &coded[i].primaries;
    return NULL;
}

/* ---- Matrices ---- */

static void xyz_of(const double xy[2], double xyz[3]) {
    xyz[0] = xy[0] / xy[1];
    xyz[1] = 1;
    xyz[2] = (1 - xy[0] - xy[1]) / xy[1];
}

static void multiply(double a[3][3], double b[3][3], double out[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
}

static void apply(double m[3][3], const double v[3], double out[3]) {
    for (int i = 0; i < 3; i++) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

/* The inverse, by cofactors. */
static void invert(double m[3][3], double out[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            out[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
        }
    double determinant = m[0][0] * out[0][0] + m[0][1] * out[1][0] + m[0][2] * out[2][0];
    for (int i = 0; i < 9; i++) out[i / 3][i % 3] /= determinant;
}

/* RGB to XYZ: the columns are the primaries, each as bright as it is in white. */
static void primaries_matrix(const wf_chromaticities *c, double out[3][3]) {
    const double *xy[3] = {c->red, c->green, c->blue};
    double columns[3][3], inverse[3][3], white[3], share[3];
    for (int j = 0; j < 3; j++) {
        double xyz[3] = {xy[j][0], xy[j][1], 1 - xy[j][0] - xy[j][1]};
        for (int i = 0; i < 3; i++) columns[i][j] = xyz[i];
    }
    xyz_of(c->white, white);
    invert(columns, inverse);
    apply(inverse, white, share);
    for (int i = 0; i < 9; i++) out[i / 3][i % 3] = columns[i / 3][i % 3] * share[i % 3];
}

/* XYZ under one white to XYZ under another, in the cone space of Lam's Bradford matrix. */
static void adapt(const double from[2], const double to[2], double out[3][3]) {
    double bradford[3][3] = {
        {0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}};
    double inverse[3][3], scaled[3][3], xyz[3], source[3], target[3];
    xyz_of(from, xyz);
    apply(bradford, xyz, source);
    xyz_of(to, xyz);
    apply(bradford, xyz, target);
    for (int i = 0; i < 9; i++)
        scaled[i / 3][i % 3] = bradford[i / 3][i % 3] * (target[i / 3] / source[i / 3]);
    invert(bradford, inverse);
    multiply(inverse, scaled, out);
}

static void to_xyz(const wf_chromaticities *c, double matrix[3][3]) {
    static const double d65[2] = D65;
    primaries_matrix(c, matrix);
    if (c->white[0] == d65[0] && c->white[1] == d65[1]) return;
    double own[3][3], to_d65[3][3];
    memcpy(own, matrix, sizeof own);
    adapt(c->white, d65, to_d65);
    multiply(to_d65, own, matrix);
}

void wf_rgb_to_xyz(wf_primaries primaries, double matrix[3][3]) {
    to_xyz(&wf_chromaticities_of[primaries], matrix);
}

void wf_rgb_matrix(const wf_chromaticities *from, const wf_chromaticities *to,
                   double matrix[3][3]) {
    double in[3][3], out[3][3], inverse[3][3];
    to_xyz(from, in);
    to_xyz(to, out);
    invert(out, inverse);
    multiply(inverse, in, matrix);
}

void wf_rgb_to_rgb(wf_primaries from, wf_primaries to, double matrix[3][3]) {
    wf_rgb_matrix(&wf_chromaticities_of[from], &wf_chromaticities_of[to], matrix);
}

bool wf_chromaticities_usable(const wf_chromaticities *c) {
    const double *xy[4] = {c->red, c->green, c->blue, c->white};
    for (int i = 0; i < 8; i++)
        if (!(fabs(xy[i / 2][i % 2]) < 100)) return false;
    double area = (c->green[0] - c->red[0]) * (c->blue[1] - c->red[1]) -
                  (c->blue[0] - c->red[0]) * (c->green[1] - c->red[1]);
    if (!(fabs(area) > 1e-4) || !(c->white[1] > 1e-3)) return false;
    double m[3][3];
    to_xyz(c, m);
    double largest = 0;
    for (int i = 0; i < 9; i++) largest = fmax(largest, fabs(m[i / 3][i % 3]));
    return isfinite(largest) && largest < 1e3 && m[1][0] != 0 && m[1][1] != 0;
}

static bool alike(const double a[2], const double b[2]) {
    return fabs(a[0] - b[0]) < 2e-4 && fabs(a[1] - b[1]) < 2e-4;
}

wf_primaries wf_primaries_like(const wf_chromaticities *c) {
    int i = 0;
    for (; i < WF_PRIMARIES_COUNT; i++) {
        const wf_chromaticities *k = &wf_chromaticities_of[i];
        if (alike(c->red, k->red) && alike(c->green, k->green) && alike(c->blue, k->blue) &&
            alike(c->white, k->white))
            break;
    }
    return (wf_primaries)i;
}

/* ---- Spaces ---- */

static const wf_space spaces[] = {
    {"lin_rec709", "lin_srgb", WF_PRIMARIES_709, NULL},
    {"ACEScg", "lin_ap1", WF_PRIMARIES_AP1, NULL},
    {"ACES2065-1", "lin_ap0", WF_PRIMARIES_AP0, NULL},
    {"lin_rec2020", NULL, WF_PRIMARIES_2020, NULL},
    {"lin_p3d65", NULL, WF_PRIMARIES_P3, NULL},
    {"lin_rec601-525", NULL, WF_PRIMARIES_SMPTE_C, NULL},
    {"lin_rec601-625", NULL, WF_PRIMARIES_EBU, NULL},
    {"rec601-525", NULL, WF_PRIMARIES_SMPTE_C, &wf_curve_bt1886},
    {"rec601-625", NULL, WF_PRIMARIES_EBU, &wf_curve_bt1886},
    {"rec709", NULL, WF_PRIMARIES_709, &wf_curve_bt1886},
    {"rec2020", NULL, WF_PRIMARIES_2020, &wf_curve_bt1886},
    {"rec601-525-camera", NULL, WF_PRIMARIES_SMPTE_C, &wf_curve_bt709},
    {"rec601-625-camera", NULL, WF_PRIMARIES_EBU, &wf_curve_bt709},
    {"rec709-camera", NULL, WF_PRIMARIES_709, &wf_curve_bt709},
    {"rec2020-camera", NULL, WF_PRIMARIES_2020, &wf_curve_bt2020},
    {"rec2100-pq", NULL, WF_PRIMARIES_2020, &wf_curve_pq},
    {"rec2100-hlg", NULL, WF_PRIMARIES_2020, &wf_curve_hlg},
    {"sRGB", "sRGB - Texture", WF_PRIMARIES_709, &wf_curve_srgb},
};

enum { SPACES = sizeof spaces / sizeof *spaces };

const wf_space *wf_space_linear(wf_primaries primaries) {
    for (size_t i = 0; i < SPACES; i++)
        if (!spaces[i].curve && spaces[i].primaries == primaries) return &spaces[i];
    return NULL;
}

const wf_space *wf_space_at(size_t index) {
    return index < SPACES ? &spaces[index] : NULL;
}

static size_t smaller(size_t a, size_t b) {
    return a < b ? a : b;
}

/* Letters to change, add or drop to make b of a, case aside (Levenshtein); both of at most 63.
 */
static size_t distance(const char *a, const char *b) {
    size_t row[64], length = strlen(b);
    for (size_t j = 0; j <= length; j++) row[j] = j;
    for (size_t i = 0; a[i]; i++) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < length; j++) {
            char pair[2][2] = {{a[i], 0}, {b[j], 0}};
            size_t change = diagonal + (strcasecmp(pair[0], pair[1]) != 0);
            diagonal = row[j + 1];
            row[j + 1] = smaller(change, smaller(row[j], diagonal) + 1);
        }
    }
    return row[length];
}

static const char *spelled_alike(const char *name) {
    const char *best = NULL;
    size_t best_distance = 1 + strlen(name) / 3;
    if (strlen(name) > 63) return NULL;
    for (size_t i = 0; i < SPACES; i++) {
        size_t d = distance(name, spaces[i].name);
        if (d <= best_distance && (!best || d < best_distance)) {
            best = spaces[i].name;
            best_distance = d;
        }
    }
    return best;
}

static void list_names(char *text, size_t size) {
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; i < SPACES && used < size; i++)
        used +=
            (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", spaces[i].name);
}

/* What spaces are called elsewhere, where their letters do not tell. */
static const char *meant_by(const char *name) {
    static const char *const rows[][2] = {
        {"pq", "rec2100-pq"},        {"st2084", "rec2100-pq"},
        {"hdr10", "rec2100-pq"},     {"hlg", "rec2100-hlg"},
        {"bt709", "rec709"},         {"bt.709", "rec709"},
        {"bt1886", "rec709"},        {"hd", "rec709"},
        {"linear", "lin_rec709"},    {"scene_linear", "lin_rec709"},
        {"lin_srgb", "lin_rec709"},  {"raw", "lin_rec709"},
        {"none", "lin_rec709"},      {"bt2020", "rec2020"},
        {"bt.2020", "rec2020"},      {"pal", "rec601-625"},
        {"ntsc", "rec601-525"},      {"bt470bg", "rec601-625"},
        {"smpte170m", "rec601-525"}, {"aces", "ACES2065-1"},
        {"ap0", "ACES2065-1"},       {"ap1", "ACEScg"},
        {"p3", "lin_p3d65"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!strcasecmp(rows[i][0], name)) return rows[i][1];
    return NULL;
}

const wf_space *wf_space_find(const char *name, char *why, size_t why_size) {
    for (size_t i = 0; i < SPACES; i++) {
        const wf_space *s = &spaces[i];
        if (!strcasecmp(s->name, name) || (s->alias && !strcasecmp(s->alias, name))) return s;
    }
    char there[512];
    list_names(there, sizeof there);
    const char *alike = meant_by(name);
    if (!alike) alike = spelled_alike(name);
    snprintf(why, why_size, "there is no color space \"%.80s\"%s%s%s; there are %s", name,
             alike ? " (did you mean " : "", alike ? alike : "", alike ? "?)" : "", there);
    return NULL;
}
