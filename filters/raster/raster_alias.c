/* What rasters are called elsewhere: other names of one, and names that say too little. */
#include "filters/raster/raster_alias.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define COUNT(list) (sizeof(list) / sizeof *(list))

/* clang-format off */
static const wf_raster_other_name aliases[] = {
    {"ntsc",        "525i"},        {"ntsc-dv",     "525i-dv"},     {"ntsc-wide",   "525i-wide"},
    {"486i",        "525i"},        {"486i29.97",   "525i"},        {"486i59.94",   "525i"},
    {"525i29.97",   "525i"},        {"525i59.94",   "525i"},
    {"ntsc-j",      "525i"},        {"ntsc-m",      "525i"},        {"ntsc-sd",     "525i"},
    {"sd-ntsc",     "525i"},        {"pal-m",       "525i"},        {"525i59",      "525i"},
    {"pal-sd",      "625i"},        {"sd-pal",      "625i"},        {"pal-d1",      "625i"},
    {"d1-pal",      "625i"},        {"dvd-pal",     "625i"},        {"pal-dvd",     "625i"},
    {"pal-n",       "625i"},        {"pal-b",       "625i"},        {"pal-g",       "625i"},
    {"pal-i",       "625i"},        {"secam-l",     "625i"},        {"576i25-tff",  "625i"},
    {"dv-pal",      "625i-dv"},     {"dv-ntsc",     "525i-dv"},
    {"pal16:9",     "625i-wide"},   {"ntsc16:9",    "525i-wide"},   {"480i29.97-bff", "525i-dv"},
    {"480i59.94-bff", "525i-dv"},
    {"480i29.97-tff", "525i-rp202"}, {"480i59.94-tff", "525i-rp202"},
    {"1080i59",     "1080i59.94"},  {"1080i29",     "1080i59.94"},  {"1080p29",     "1080p29.97"},
    {"1080p59",     "1080p59.94"},  {"1080p23",     "1080p23.976"}, {"720p59",      "720p59.94"},
    {"1080i60000/1001", "1080i59.94"}, {"1080i30000/1001", "1080i59.94"},
    {"1080sf25",    "1080psf25"},
    {"1080sf24",    "1080psf24"}, {"1080psf23",   "1080psf23.976"},
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
#define HD                                                                                         \
    RATE_MISSING "1080i50 and 1080i59.94 are interlaced, 1080p25 .. and 720p50 .. are not"
#define OF_50 "50 fields a second are 625i or 1080i50"
#define OF_60 "59.94 fields a second are 525i or 1080i59.94, 60 are 1080i60"
#define SD    "it is 625i (50 fields a second, PAL) or 525i (59.94, NTSC)"
#define OF_720 "720 lines are progressive only: 720p50, 720p59.94 .."

static const struct {
    const char *text, *advice;
} advices[] = {
    {"480i", OF_480}, {"480i29.97", OF_480}, {"480i59.94", OF_480}, {"480i2997", OF_480},
    {"480i5994", OF_480}, {"480i30", OF_480}, {"480i60", OF_480},
    {"525i30", NOMINAL}, {"525i60", NOMINAL}, {"486i30", NOMINAL}, {"486i60", NOMINAL},
    {"480p", PROGRESSIVE_SD}, {"576p", PROGRESSIVE_SD}, {"576p25", PROGRESSIVE_SD},
    {"576p50", PROGRESSIVE_SD}, {"480p59.94", PROGRESSIVE_SD}, {"480p29.97", PROGRESSIVE_SD},
    {"1080i", RATE_MISSING "1080i50, 1080i59.94 or 1080i60"},
    {"hd", HD}, {"hdtv", HD}, {"fhd", HD}, {"full-hd", HD}, {"fullhd", HD}, {"1080", HD},
    {"hd1080", HD}, {"2k", HD}, {"hd1080i", RATE_MISSING "1080i50, 1080i59.94 or 1080i60"},
    {"sd", SD}, {"sdtv", SD}, {"d1", SD}, {"dvd", SD}, {"betacam", SD}, {"vhs", SD}, {"bt601", SD},
    {"dv", "it is 625i-dv (PAL) or 525i-dv (NTSC)"},
    {"625", "625 lines are interlaced, 50 fields a second: 625i"}, {"576", "576 lines are 625i"},
    {"525", "525 lines are interlaced, 59.94 fields a second: 525i"}, {"480", OF_480},
    {"486", "486 lines are 525i"},
    {"dvd-ntsc", OF_480}, {"ntsc-dvd", OF_480}, {"480i59", OF_480}, {"480i29", OF_480},
    {"25i", OF_50}, {"50i", OF_50}, {"i50", OF_50}, {"i25", OF_50},
    {"29.97i", OF_60}, {"30i", OF_60}, {"59.94i", OF_60}, {"60i", OF_60}, {"i60", OF_60},
    {"i59.94", OF_60},
    {"720", OF_720}, {"720i", OF_720}, {"720i50", OF_720}, {"720i25", OF_720}, {"720i60", OF_720},
    {"720i59.94", OF_720}, {"720i29.97", OF_720},
    {"625p", PROGRESSIVE_SD}, {"625p50", PROGRESSIVE_SD}, {"625p25", PROGRESSIVE_SD},
    {"525p", PROGRESSIVE_SD}, {"480p60", PROGRESSIVE_SD}, {"480p30", PROGRESSIVE_SD},
    {"1080i24", "fields of 24 frames a second are segmented: 1080psf24"},
    {"1080i23.976", "fields of 23.976 frames a second are segmented: 1080psf23.976"},
    {"1080p", RATE_MISSING "1080p25, 1080p29.97, 1080p50, 1080p59.94 .."},
    {"1080psf", RATE_MISSING "1080psf23.976, 1080psf24, 1080psf25, 1080psf29.97 or 1080psf30"},
    {"720p", RATE_MISSING "720p50, 720p59.94 .."},
    {"2160p", RATE_MISSING "2160p25, 2160p50, 2160p59.94 .."},
    {"uhd", RATE_MISSING "2160p25, 2160p50, 2160p59.94 .."},
    {"1125i", "1125 lines have 1080 of picture: 1080i50, 1080i59.94 or 1080i60"},
    {"4k", RATE_MISSING "2160p25, 2160p50, 2160p59.94 .."},
};
/* clang-format on */

static bool is_mark(char c) {
    return c && strchr(" /-_@", c);
}

/* Whether text is word but for case, marks between and a unit at its end ("1080i/25", "PAL",
 * "1080i 50 Hz"). */
static bool is_word(const char *text, const char *word) {
    for (;;) {
        while (is_mark(*text)) text++;
        while (is_mark(*word)) word++;
        if (!*word) return !*text || !strcasecmp(text, "hz") || !strcasecmp(text, "fps");
        if (tolower((unsigned char)*text++) != *word++) return false;
    }
}

const wf_raster_other_name *wf_raster_alias_at(size_t index) {
    return index < COUNT(aliases) ? &aliases[index] : NULL;
}

bool wf_raster_is_called(const char *text, const char *name) {
    return is_word(text, name);
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

/* The rate that follows the scan, whole hundredths and thousandths without their dot too; 0:
 * none does. */
static double rate_of(const char *name) {
    const char *at = name + strspn(name, "0123456789");
    at += strspn(at, "ipsfIPSF/ @");
    double rate = strtod(at, NULL);
    for (bool dotless = rate >= 1000; dotless && rate > 130;) rate /= 10;
    return rate;
}

#define MOST_LINES_OFF 5 /* 526i is a slip of 525i; 25i is not */

static bool is_near(double a, double b) {
    return a - b <= 1 && b - a <= 1;
}

/* Interlaced rasters are named by their fields a second, and asked for by frames too. Those of
 * standard definition have their rate by their lines. */
static bool may_run_at(const char *text, const char *name) {
    double said = rate_of(text), own = rate_of(name);
    int lines = system_lines(name);
    if (own == 0) own = lines == 525 ? 59.94 : lines == 625 ? 50 : 0;
    if (said == 0 || own == 0 || !scan_letter(text)) return true;
    return is_near(said, own) || (scan_letter(name) == 'i' && is_near(2 * said, own));
}

bool wf_raster_may_mean(const char *text, const char *name) {
    int scan = scan_letter(text), lines = system_lines(text);
    if (scan && scan != scan_letter(name)) return false;
    if (lines && lines != system_lines(name)) return false;
    long said = strtol(text, NULL, 10), own = strtol(name, NULL, 10);
    if (!lines && said && labs(said - own) > MOST_LINES_OFF) return false;
    return may_run_at(text, name);
}
