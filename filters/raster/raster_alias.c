/* What rasters are called elsewhere: other names of one, and names that say too little. */
#include "filters/raster/raster_alias.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(list) (sizeof(list) / sizeof *(list))

/* clang-format off */
static const wf_raster_other_name aliases[] = {
    {"ntsc",        "525i"},        {"ntsc-dv",     "525i-dv"},     {"ntsc-wide",   "525i-wide"},
    {"486i",        "525i"},        {"486i29.97",   "525i"},        {"486i59.94",   "525i"},
    {"525i29.97",   "525i"},        {"525i59.94",   "525i"},
    {"pal",         "625i"},        {"pal-dv",      "625i-dv"},     {"pal-wide",    "625i-wide"},
    {"secam",       "625i"},        {"576i",        "625i"},        {"576i25",      "625i"},
    {"576i50",      "625i"},        {"625i25",      "625i"},        {"625i50",      "625i"},
    {"1080i25",     "1080i50"},     {"1080i29.97",  "1080i59.94"},  {"1080i30",     "1080i60"},
    {"1080i2997",   "1080i59.94"},  {"1080i5994",   "1080i59.94"},
    {"1080psf2398", "1080psf23.976"},               {"1080psf23.98", "1080psf23.976"},
    {"1080psf2997", "1080psf29.97"},
    {"1080p2398",   "1080p23.976"}, {"1080p23.98",  "1080p23.976"}, {"1080p2997",   "1080p29.97"},
    {"1080p5994",   "1080p59.94"},
    {"720p2398",    "720p23.976"},  {"720p23.98",   "720p23.976"},  {"720p2997",    "720p29.97"},
    {"720p5994",    "720p59.94"},
    {"2160p2398",   "2160p23.976"}, {"2160p23.98",  "2160p23.976"}, {"2160p2997",   "2160p29.97"},
    {"2160p5994",   "2160p59.94"},
};

#define OF_480 \
    "480 of 525 lines are 525i-dv (bottom field first: DV) or 525i-rp202 (top field first); "      \
    "525i has 486"
#define NOMINAL \
    "525 lines have 59.94 fields a second: 525i, or 525i-dv and 525i-rp202 of 480 lines"
#define PROGRESSIVE_SD \
    "describe it, such as 720x576@50p,par=12:11,601-625 or 720x480@59.94p,par=10:11,601-525"
#define RATE_MISSING "its rate is missing: "

static const struct {
    const char *text, *advice;
} advices[] = {
    {"480i", OF_480}, {"480i29.97", OF_480}, {"480i59.94", OF_480}, {"480i2997", OF_480},
    {"480i5994", OF_480}, {"480i30", OF_480}, {"480i60", OF_480},
    {"525i30", NOMINAL}, {"525i60", NOMINAL}, {"486i30", NOMINAL}, {"486i60", NOMINAL},
    {"480p", PROGRESSIVE_SD}, {"576p", PROGRESSIVE_SD}, {"576p25", PROGRESSIVE_SD},
    {"576p50", PROGRESSIVE_SD}, {"480p59.94", PROGRESSIVE_SD}, {"480p29.97", PROGRESSIVE_SD},
    {"1080i", RATE_MISSING "1080i50, 1080i59.94 or 1080i60"},
    {"hd", RATE_MISSING "1080i50 and 1080i59.94 are interlaced, 1080p25 .. and 720p50 .. are not"},
    {"1080i24", "fields of 24 frames a second are segmented: 1080psf24"},
    {"1080i23.976", "fields of 23.976 frames a second are segmented: 1080psf23.976"},
    {"1080p", RATE_MISSING "1080p25, 1080p29.97, 1080p50, 1080p59.94 .."},
    {"1080psf", RATE_MISSING "1080psf23.976, 1080psf24, 1080psf25, 1080psf29.97 or 1080psf30"},
    {"720p", RATE_MISSING "720p50, 720p59.94 .."},
    {"2160p", RATE_MISSING "2160p25, 2160p50, 2160p59.94 .."},
    {"uhd", RATE_MISSING "2160p25, 2160p50, 2160p59.94 .."},
    {"4k", RATE_MISSING "2160p25, 2160p50, 2160p59.94 .."},
};
/* clang-format on */

/* Whether text is word but for case, blanks and slashes ("1080i/25", "PAL"). */
static bool is_word(const char *text, const char *word) {
    for (; *text; text++) {
        if (*text == ' ' || *text == '/') continue;
        if (tolower((unsigned char)*text) != *word++) return false;
    }
    return !*word;
}

const wf_raster_other_name *wf_raster_alias_at(size_t index) {
    return index < COUNT(aliases) ? &aliases[index] : NULL;
}

const char *wf_raster_own_name(const char *text) {
    for (size_t i = 0; i < COUNT(aliases); i++)
        if (is_word(text, aliases[i].alias)) return aliases[i].name;
    return text;
}

const char *wf_raster_advice(const char *text) {
    for (size_t i = 0; i < COUNT(advices); i++)
        if (is_word(text, advices[i].text)) return advices[i].advice;
    return NULL;
}

/* ---- Suggestions ---- */

/* 'i', 'p' or 's' (psf), which follows the lines that a name begins with; 0: none does. */
static int scan_letter(const char *name) {
    size_t digits = strspn(name, "0123456789");
    int letter = digits ? tolower((unsigned char)name[digits]) : 0;
    if (letter == 'p' && !strncmp(name + digits, "psf", 3)) return 's';
    return letter == 'i' || letter == 'p' ? letter : 0;
}

/* The lines of a system, by its own number or that of the lines one sees; 0: of none. */
static int system_lines(const char *name) {
    static const int lines[][2] = {{480, 525}, {486, 525}, {525, 525},   {576, 625},
                                   {625, 625}, {720, 720}, {1080, 1080}, {2160, 2160}};
    long said = strtol(name, NULL, 10);
    for (size_t i = 0; i < COUNT(lines); i++)
        if (said == lines[i][0]) return lines[i][1];
    return 0;
}

bool wf_raster_may_mean(const char *text, const char *name) {
    int scan = scan_letter(text), lines = system_lines(text);
    if (scan && scan != scan_letter(name)) return false;
    return !lines || lines == system_lines(name);
}
