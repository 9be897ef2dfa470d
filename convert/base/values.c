/* Reads the values of options: sizes, chunks, colors, timecodes. */
#include "convert/base/values.h"

#include <stdio.h>
#include <string.h>

#include "filters/base/rational.h"

/* ---- Sizes ---- */

/* How many times 1000 or 1024 a suffix ("", "M", "MiB", "MB") multiplies; -1: it is none. */
static int read_suffix(const char *suffix, int *base) {
    static const char letters[] = "KMGT";
    *base = 1024;
    if (!*suffix) return 0;
    const char *letter = strchr(letters, *suffix);
    if (!letter) return -1;
    if (!strcmp(suffix + 1, "B"))
        *base = 1000;
    else if (suffix[1] && strcmp(suffix + 1, "iB"))
        return -1;
    return (int)(letter - letters) + 1;
}

bool wf_parse_size(const char *text, size_t *bytes) {
    char number[64];
    size_t length = strspn(text, "0123456789.");
    int base, powers = read_suffix(text + length, &base);
    if (length >= sizeof number || powers < 0) return false;
    memcpy(number, text, length);
    number[length] = '\0';
    wf_rational size;
    if (!wf_ratio_parse(number, &size)) return false;
    while (powers-- > 0) size = wf_ratio_mul(size, wf_ratio(base, 1));
    if (!wf_ratio_given(size)) return false;
    int64_t whole = wf_ratio_floor_mul(size, 1);
    if (whole < 1 << 20 || whole > (int64_t)1 << 50) return false;
    *bytes = (size_t)whole;
    return true;
}

/* ---- Numbers in a row ---- */

#define MOST_FRAMES 1000000000
#define MOST_CHUNKS 1000000

/* Reads a whole number of at most `most` and moves past its digits. */
static bool read_count(const char **text, int most, int *out) {
    const char *start = *text;
    int64_t value = 0;
    for (; **text >= '0' && **text <= '9' && value <= most; ++*text)
        value = 10 * value + (**text - '0');
    *out = (int)value;
    return *text > start && value <= most;
}

bool wf_parse_chunk(const char *text, int *chunk, int *count) {
    int i, n;
    if (!read_count(&text, MOST_CHUNKS, &i) || *text++ != '/') return false;
    if (!read_count(&text, MOST_CHUNKS, &n) || *text || i < 1 || i > n) return false;
    *chunk = i;
    *count = n;
    return true;
}

bool wf_parse_span(const char *text, int64_t *first, int64_t *end) {
    int a, z;
    if (!read_count(&text, MOST_FRAMES, &a)) return false;
    z = a;
    if (*text == '-') {
        text++;
        if (!read_count(&text, MOST_FRAMES, &z)) return false;
    }
    if (*text || z < a) return false;
    *first = a;
    *end = (int64_t)z + 1;
    return true;
}

bool wf_parse_oversample(const char *text, int *across, int *down, int *times) {
    int n[3];
    for (int k = 0; k < 3; k++) {
        if (!read_count(&text, 64, &n[k]) || n[k] < 1) return false;
        if (*text++ != (k < 2 ? 'x' : '\0')) return false;
    }
    *across = n[0];
    *down = n[1];
    *times = n[2];
    return true;
}

bool wf_parse_dimensions(const char *text, int *width, int *height) {
    int n[2];
    for (int k = 0; k < 2; k++) {
        if (!read_count(&text, 65536, &n[k]) || n[k] < 1) return false;
        if (*text++ != (k < 1 ? 'x' : '\0')) return false;
    }
    *width = n[0];
    *height = n[1];
    return true;
}

bool wf_parse_rgb(const char *text, float rgb[3]) {
    char words[128], *rest = words;
    float read[3];
    int count = 0;
    if (strlen(text) >= sizeof words) return false;
    memcpy(words, text, strlen(text) + 1);
    for (const char *word; (word = strsep(&rest, ",")); count++) {
        wf_rational number;
        if (count == 3 || !wf_ratio_parse(word, &number)) return false;
        read[count] = (float)wf_ratio_value(number);
        if (read[count] > 65504) return false;
    }
    if (count == 2) return false;
    for (int c = 0; c < 3; c++) rgb[c] = read[count == 1 ? 0 : c];
    return true;
}

/* ---- Timecode ---- */

bool wf_parse_timecode(const char *text, wf_timecode *out) {
    static const int most[4] = {23, 59, 59, 99};
    int value[4];
    if (strlen(text) != strlen("HH:MM:SS:FF")) return false;
    for (int i = 0; i < 4; i++) {
        const char *at = text + 3 * i, *end = at;
        if (!read_count(&end, most[i], &value[i]) || end != at + 2) return false;
        if (i < 3 && *end != ':' && !(i == 2 && *end == ';')) return false;
    }
    *out = (wf_timecode){value[0], value[1], value[2], value[3], .drop_frame = text[8] == ';'};
    return true;
}

static int days_of(int year, int month) {
    static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return month == 2 && year % 4 == 0 ? 29 : days[month - 1]; /* 2000 is a leap year */
}

bool wf_parse_date(const char *text, wf_date *out) {
    static const char form[] = "0000-00-00T00:00:00Z";
    const size_t day_alone = sizeof "0000-00-00" - 1;
    wf_date d = {0};
    size_t length = strlen(text);
    if (length != day_alone && length != sizeof form - 1) return false;
    for (size_t i = 0; i < length; i++) {
        bool digit = text[i] >= '0' && text[i] <= '9';
        if (form[i] == '0' ? !digit : text[i] != form[i]) return false;
    }
    sscanf(text, "%4d-%2d-%2dT%2d:%2d:%2d", &d.year, &d.month, &d.day, &d.hours, &d.minutes,
           &d.seconds);
    bool right = d.year >= 1970 && d.year <= 2099 && d.month >= 1 && d.month <= 12 &&
                 d.day >= 1 && d.day <= days_of(d.year, d.month) && d.hours < 24 &&
                 d.minutes < 60 && d.seconds < 60;
    if (right) *out = d;
    return right;
}
