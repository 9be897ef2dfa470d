/* The broadcast rasters, by name and by description, and the order of their fields. */
#include "filters/raster/raster.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "filters/base/spelling.h"
#include "filters/raster/raster_alias.h"

/* The top picture line is field 1's when L1 < L2 - N/2; in whole numbers, twice that. */
#define TOP_FIRST(l1, l2, n) (2 * (l1) < 2 * (l2) - (n))

bool wf_raster_map_valid(int line1, int line2, int total_lines) {
    return line1 > 0 && abs(2 * line2 - total_lines - 2 * line1) == 1;
}

bool wf_raster_map_top_first(int line1, int line2, int total_lines) {
    return wf_raster_map_valid(line1, line2, total_lines) &&
           TOP_FIRST(line1, line2, total_lines);
}

/* ---- The table (filters/README.md, Rasters) ---- */

/* clang-format off */
#define RATE(num, den) {num, den}
#define MAP(l1, l2, n) .line1 = l1, .line2 = l2, .total_lines = n, .top_first = TOP_FIRST(l1, l2, n)
#define SD(name, lines, rate, par_num, par_den, matrix_, map)                                     \
    {name, 720, lines, rate, .pixel_aspect = {par_num, par_den}, .matrix = matrix_, map}
#define HD(name, rate, scan)                                                                      \
    {name, 1920, 1080, rate, scan, .pixel_aspect = {1, 1}, .matrix = WF_709, MAP(21, 584, 1125)}
#define PROGRESSIVE(name, width, lines, rate, matrix_)                                            \
    {name, width, lines, rate, WF_PROGRESSIVE, .pixel_aspect = {1, 1}, .matrix = matrix_}
#define EVERY_RATE(size, width, lines, matrix)                                                    \
    PROGRESSIVE(size "p23.976", width, lines, RATE(24000, 1001), matrix),                         \
    PROGRESSIVE(size "p24",     width, lines, RATE(24, 1),       matrix),                         \
    PROGRESSIVE(size "p25",     width, lines, RATE(25, 1),       matrix),                         \
    PROGRESSIVE(size "p29.97",  width, lines, RATE(30000, 1001), matrix),                         \
    PROGRESSIVE(size "p30",     width, lines, RATE(30, 1),       matrix),                         \
    PROGRESSIVE(size "p50",     width, lines, RATE(50, 1),       matrix),                         \
    PROGRESSIVE(size "p59.94",  width, lines, RATE(60000, 1001), matrix),                         \
    PROGRESSIVE(size "p60",     width, lines, RATE(60, 1),       matrix)

static const wf_raster rasters[] = {
    /* name        lines  frames/s          aspect  Y'CbCr         L1, L2, N */
    SD("525i",       486, RATE(30000, 1001), 10, 11, WF_601_525, MAP(21, 283, 525)),
    SD("525i-imx",   486, RATE(30000, 1001), 10, 11, WF_601_525, MAP(20, 283, 525)),
    SD("525i-dv",    480, RATE(30000, 1001), 10, 11, WF_601_525, MAP(23, 285, 525)),
    SD("525i-rp202", 480, RATE(30000, 1001), 10, 11, WF_601_525, MAP(23, 286, 525)),
    SD("625i",       576, RATE(25, 1),       12, 11, WF_601_625, MAP(23, 336, 625)),
    SD("625i-dv",    576, RATE(25, 1),       12, 11, WF_601_625, MAP(23, 335, 625)),
    HD("1080i50",       RATE(25, 1),       WF_INTERLACED),
    HD("1080i59.94",    RATE(30000, 1001), WF_INTERLACED),
    HD("1080i60",       RATE(30, 1),       WF_INTERLACED),
    HD("1080psf23.976", RATE(24000, 1001), WF_SEGMENTED),
    HD("1080psf24",     RATE(24, 1),       WF_SEGMENTED),
    HD("1080psf25",     RATE(25, 1),       WF_SEGMENTED),
    HD("1080psf29.97",  RATE(30000, 1001), WF_SEGMENTED),
    HD("1080psf30",     RATE(30, 1),       WF_SEGMENTED),
    EVERY_RATE("1080", 1920, 1080, WF_709),
    EVERY_RATE("720",  1280,  720, WF_709),
    EVERY_RATE("2160", 3840, 2160, WF_2020),
};
/* clang-format on */

#define RASTERS (sizeof rasters / sizeof *rasters)

const wf_raster *wf_raster_at(size_t index) {
    return index < RASTERS ? &rasters[index] : NULL;
}

/* ---- Names ---- */

static const char *const matrix_names[] = {"601-525", "601-625", "709", "2020"};

const char *wf_matrix_name(wf_matrix matrix) {
    return matrix_names[matrix];
}

const char *wf_raster_order(const wf_raster *raster) {
    if (raster->scan == WF_PROGRESSIVE) return "progressive";
    if (raster->scan == WF_SEGMENTED) return "one instant";
    return raster->top_first ? "top first" : "bottom first";
}

static bool has_wide_variant(const wf_raster *raster) {
    return raster->matrix == WF_601_525 || raster->matrix == WF_601_625;
}

static void make_wide(wf_raster *raster) {
    snprintf(raster->name + strlen(raster->name), sizeof raster->name - strlen(raster->name),
             "-wide");
    raster->pixel_aspect = raster->matrix == WF_601_525 ? wf_ratio(40, 33) : wf_ratio(16, 11);
}

/* Finds each name with and without "-wide", by index < 2 * RASTERS; false where there is no
 * such variant. */
static bool variant_at(size_t index, wf_raster *out) {
    *out = rasters[index / 2];
    if (index % 2 == 0) return true;
    if (!has_wide_variant(out)) return false;
    make_wide(out);
    return true;
}

static bool find_named(const char *text, wf_raster *out) {
    wf_raster raster;
    for (size_t i = 0; i < 2 * RASTERS; i++) {
        if (!variant_at(i, &raster) || !wf_raster_is_called(text, raster.name)) continue;
        *out = raster;
        return true;
    }
    return false;
}

static bool no_such_name(const char *text, char *why, size_t why_size) {
    wf_raster variants[2 * RASTERS];
    wf_spelling spelling = {.text = text};
    for (size_t i = 0; i < 2 * RASTERS; i++)
        if (variant_at(i, &variants[i]) && wf_raster_may_mean(text, variants[i].name))
            wf_spelling_offer(&spelling, variants[i].name);
    const char *advice = wf_raster_advice(text),
               *describe =
                   "'weft rasters' lists them, or describe one as WxH@RATE(i|p|psf), such "
                   "as 1920x1080@25i";
    if (advice)
        snprintf(why, why_size, "no raster is called '%s'; %s", text, advice);
    else if (spelling.best)
        snprintf(why, why_size, "no raster is called '%s'; did you mean %s? %s", text,
                 spelling.best, describe);
    else
        snprintf(why, why_size, "no raster is called '%s'; %s", text, describe);
    return false;
}

/* ---- Descriptions: WxH@RATE(i|p|psf)[,WORD].. ---- */

#define MOST_PIXELS 32768
#define MOST_RATE   1000
#define MOST_TERM   1000000000

static bool complain(char *why, size_t why_size, const char *text, const char *about) {
    snprintf(why, why_size, "raster '%s': %s", text, about);
    return false;
}

/* Reads a size 1 .. MOST_PIXELS and moves past it. */
static bool read_size(const char **text, int *out) {
    char *end;
    if (!isdigit((unsigned char)**text)) return false;
    long value = strtol(*text, &end, 10);
    *text = end;
    *out = (int)value;
    return value >= 1 && value <= MOST_PIXELS;
}

static bool terms_fit(wf_rational r) {
    return r.num <= MOST_TERM && r.den <= MOST_TERM;
}

static bool parse_scan_rate(char *word, wf_raster *out) {
    static const struct {
        const char *name;
        wf_scan scan;
    } scans[] = {{"psf", WF_SEGMENTED}, {"p", WF_PROGRESSIVE}, {"i", WF_INTERLACED}};
    for (size_t i = 0; i < sizeof scans / sizeof *scans; i++) {
        size_t length = strlen(word), ending = strlen(scans[i].name);
        if (length <= ending || strcmp(word + length - ending, scans[i].name)) continue;
        word[length - ending] = '\0';
        out->scan = scans[i].scan;
        out->top_first = out->scan != WF_PROGRESSIVE;
        return wf_rate_parse(word, &out->frame_rate) && out->frame_rate.num > 0 &&
               wf_ratio_value(out->frame_rate) <= MOST_RATE && terms_fit(out->frame_rate);
    }
    return false;
}

/* One word after a comma; *seen holds a bit for each kind of word met, since a second one of a
 * kind is a mistake. */
static bool parse_word(const char *word, wf_raster *out, unsigned *seen) {
    unsigned kind = 0;
    if (!strcmp(word, "tff") || !strcmp(word, "bff")) {
        kind = 1;
        out->top_first = *word == 't';
        if (out->scan == WF_PROGRESSIVE) return false;
    } else if (!strncmp(word, "par=", 4)) {
        kind = 2;
        if (!wf_ratio_parse(word + 4, &out->pixel_aspect)) return false;
        double aspect = wf_ratio_value(out->pixel_aspect);
        if (aspect < 0.01 || aspect > 100 || !terms_fit(out->pixel_aspect)) return false;
    }
    for (size_t m = 0; m < sizeof matrix_names / sizeof *matrix_names; m++)
        if (!strcmp(word, matrix_names[m])) {
            kind = 4;
            out->matrix = (wf_matrix)m;
        }
    bool fresh = kind && !(*seen & kind);
    *seen |= kind;
    return fresh;
}

static bool parse_description(const char *text, wf_raster *out, char *why, size_t why_size) {
    wf_raster raster = {.pixel_aspect = {1, 1}, .matrix = WF_709};
    const char *at = text;
    if (strlen(text) >= sizeof raster.name)
        return complain(why, why_size, text, "a description has at most 63 characters");
    memcpy(raster.name, text, strlen(text) + 1);
    bool sized =
        read_size(&at, &raster.width_px) && *at++ == 'x' && read_size(&at, &raster.lines);
    if (!sized || *at++ != '@')
        return complain(why, why_size, text,
                        "a description begins WxH@RATE, each size 1 to 32768, such as "
                        "1920x1080@25i");
    char words[sizeof raster.name], *rest = words;
    memcpy(words, at, strlen(at) + 1);
    if (!parse_scan_rate(strsep(&rest, ","), &raster))
        return complain(
            why, why_size, text,
            "after @ comes a frame rate above 0 and up to 1000 with its scan, i, p or "
            "psf, such as 25i, 29.97p or 24000/1001psf");
    unsigned seen = 0;
    for (const char *word; (word = strsep(&rest, ","));)
        if (!parse_word(word, &raster, &seen)) {
            snprintf(
                why, why_size,
                "raster '%s': '%s' cannot stand here; after the rate come, once each, tff or "
                "bff (not for p), par=N:D (1:100 to 100:1), and 601-525, 601-625, 709 or 2020",
                text, word);
            return false;
        }
    if (raster.scan != WF_PROGRESSIVE && raster.lines % 2)
        return complain(why, why_size, text,
                        "two fields need an even number of lines; make the height even, or the "
                        "scan p");
    *out = raster;
    return true;
}

bool wf_raster_parse(const char *text, wf_raster *out, char *why, size_t why_size) {
    if (find_named(wf_raster_own_name(text), out)) return true;
    if (strchr(text, '@')) return parse_description(text, out, why, why_size);
    return no_such_name(text, why, why_size);
}

/* ---- Fields ---- */

int wf_raster_fields_per_frame(const wf_raster *raster) {
    return raster->scan == WF_PROGRESSIVE || raster->whole_frames ? 1 : 2;
}

/* Fields that come in pairs of one instant. */
static bool is_paired(const wf_raster *raster) {
    return raster->scan == WF_SEGMENTED && !raster->whole_frames;
}

int64_t wf_raster_instant(const wf_raster *raster, int64_t field) {
    if (raster->pulldown) return wf_floor_div(2 * field + 1, 5);
    return is_paired(raster) ? wf_floor_div(field, 2) : field;
}

int64_t wf_raster_first_field(const wf_raster *raster, int64_t instant) {
    if (raster->pulldown) return wf_floor_div(5 * instant, 2);
    return is_paired(raster) ? 2 * instant : instant;
}

int wf_raster_parity(const wf_raster *raster, int64_t field) {
    if (wf_raster_line_step(raster) == 1) return 0;
    return (field % 2 == 0) == raster->top_first ? 0 : 1;
}

int wf_raster_line_step(const wf_raster *raster) {
    return raster->all_lines ? 1 : wf_raster_fields_per_frame(raster);
}

int wf_raster_field_lines(const wf_raster *raster, int parity) {
    int step = wf_raster_line_step(raster);
    return (raster->lines - parity + step - 1) / step;
}

wf_rational wf_raster_film_rate(const wf_raster *raster) {
    wf_rational fields =
        wf_ratio_mul(raster->frame_rate, wf_ratio(wf_raster_fields_per_frame(raster), 1));
    bool has = raster->scan != WF_SEGMENTED && (wf_ratio_equal(fields, wf_ratio(60, 1)) ||
                                                wf_ratio_equal(fields, wf_ratio(60000, 1001)));
    return has ? wf_ratio_mul(fields, wf_ratio(2, 5)) : (wf_rational){0, 0};
}

wf_rational wf_raster_field_period(const wf_raster *raster) {
    if (raster->pulldown) return wf_ratio_div(wf_ratio(1, 1), wf_raster_film_rate(raster));
    int64_t fields = raster->scan == WF_INTERLACED ? 2 : 1;
    return wf_ratio_div(wf_ratio(1, fields), raster->frame_rate);
}
