/* Patterns of sequences, and the numbers in names of files. */
#include "convert/base/pattern.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define MOST_FIELDS 8
#define MOST_DIGITS 18

const char *wf_base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* ---- Numbers ---- */

static size_t count_digits(const char *text) {
    return strspn(text, "0123456789");
}

/* The sign, digits and, where decimals is not 0, '.' and decimals at text, exactly but for what
 * follows WF_DECIMALS_KEPT. False where that does not fit. */
static bool number_value(const char *text, size_t digits, size_t decimals, wf_rational *out) {
    bool negative = *text == '-';
    int64_t num = 0, den = 1;
    text += negative;
    while (decimals && text[digits + decimals] == '0') decimals--;
    if (decimals > WF_DECIMALS_KEPT) decimals = WF_DECIMALS_KEPT;
    for (size_t i = 0; i < digits + decimals; i++) {
        char digit = text[i < digits ? i : i + 1];
        if (__builtin_mul_overflow(num, 10, &num) ||
            __builtin_add_overflow(num, digit - '0', &num))
            return false;
        if (i >= digits) den *= 10;
    }
    *out = wf_ratio(negative ? -num : num, den);
    return true;
}

/* ---- Fields of patterns ---- */

typedef struct field {
    size_t start, end;
    int digits, fewest;
    bool weak; /* it is of '@' only, which is no field where the name has another one */
} field;

static void read_marks(const char *name, field *out) {
    size_t hashes = 0, ats = 0, end = out->start;
    for (; name[end] == '#' || name[end] == '@'; end++) name[end] == '#' ? hashes++ : ats++;
    out->end = end;
    out->fewest = (int)(hashes + ats);
    out->digits = (int)((hashes == 1 ? 4 : hashes) + ats);
    out->weak = !hashes;
}

/* %d or %0Nd at out->start. */
static bool read_printf(const char *name, field *out) {
    const char *at = name + out->start + 1;
    size_t length = count_digits(at);
    if (at[length] != 'd' || (length && at[0] != '0') || length > 3) return false;
    out->fewest = 0;
    for (size_t i = 0; i < length; i++) out->fewest = 10 * out->fewest + (at[i] - '0');
    if (!out->fewest) out->fewest = 1;
    out->digits = out->fewest;
    out->weak = false;
    out->end = out->start + length + 2;
    return true;
}

static size_t next_mark(const char *name, size_t at) {
    for (at += strcspn(name + at, "#@%"); name[at] == '%' && name[at + 1] == '%';)
        at += 2 + strcspn(name + at + 2, "#@%");
    return at;
}

/* How many fields name has; -1 with a reason if one makes no sense. */
static int find_fields(const char *name, field *fields, char *why, size_t why_size) {
    int count = 0;
    for (size_t at = next_mark(name, 0); name[at]; at = next_mark(name, fields[count++].end)) {
        field *f = &fields[count];
        f->start = at;
        if (name[at] != '%') {
            read_marks(name, f);
        } else if (!read_printf(name, f)) {
            snprintf(why, why_size,
                     "after %% comes d or 0Nd, as in %%04d; a %% that is just that is %%%%");
            return -1;
        }
        if (f->digits > MOST_DIGITS || count == MOST_FIELDS - 1) {
            snprintf(why, why_size, "a frame field has at most %d digits, and a name one field",
                     MOST_DIGITS);
            return -1;
        }
    }
    return count;
}

/* ---- Patterns ---- */

static void copy_text(const char *name, size_t start, size_t end, char *out) {
    for (size_t i = start; i < end; i++) {
        *out++ = name[i];
        if (name[i] == '%') i++; /* %% */
    }
    *out = '\0';
}

static void settle(const char *name, const field *number, const field *fraction,
                   wf_pattern *out) {
    copy_text(name, 0, number->start, out->prefix);
    copy_text(name, fraction ? fraction->end : number->end, strlen(name), out->suffix);
    out->digits = number->digits;
    out->fewest = number->fewest;
    out->fewest_decimals = fraction ? fraction->fewest : 0;
}

wf_pattern_kind wf_pattern_parse(const char *path, wf_pattern *out, char *why,
                                 size_t why_size) {
    field fields[MOST_FIELDS];
    const char *name = wf_base_name(path);
    *out = (wf_pattern){.directory_length = (size_t)(name - path)};
    int count = strlen(name) < WF_NAME_SIZE ? find_fields(name, fields, why, why_size) : 0;
    if (count <= 0) return count ? WF_PATTERN_BAD : WF_PATTERN_NONE;
    int first = 0, end = 0;
    while (first < count && fields[first].weak) first++;
    bool weak = first == count;
    if (weak) first = 0;
    const field *number = &fields[first], *fraction = NULL;
    if (first + 1 < count && fields[first + 1].start == number->end + 1 &&
        name[number->end] == '.')
        fraction = number + 1;
    for (end = first + (fraction ? 2 : 1); end < count; end++)
        if (fields[end].weak == weak) {
            snprintf(why, why_size,
                     "it has more than one frame field; one says the number, or "
                     "two as in shot.#.#.exr for sub-frames");
            return WF_PATTERN_BAD;
        }
    settle(name, number, fraction, out);
    return WF_PATTERN_OK;
}

/* Whether the whole of text (length bytes) is a number of the widths the pattern asks. */
static bool read_number(const wf_pattern *p, const char *text, size_t length,
                        wf_rational *number) {
    size_t sign = length && *text == '-', decimals = 0;
    size_t digits = count_digits(text + sign), used = sign + digits;
    if (!digits || used < (size_t)p->fewest || used > length) return false;
    if (used < length) {
        if (!p->fewest_decimals || text[used] != '.') return false;
        decimals = count_digits(text + used + 1);
        if (decimals < (size_t)p->fewest_decimals) return false;
        used += 1 + decimals;
    }
    return used == length && number_value(text, digits, decimals, number);
}

bool wf_pattern_match(const wf_pattern *p, const char *name, wf_rational *number) {
    size_t length = strlen(name), prefix = strlen(p->prefix), suffix = strlen(p->suffix);
    if (length <= prefix + suffix || length >= WF_NAME_SIZE) return false;
    if (memcmp(name, p->prefix, prefix) || strcmp(name + length - suffix, p->suffix))
        return false;
    char text[WF_NAME_SIZE];
    length -= prefix + suffix;
    memcpy(text, name + prefix, length);
    text[length] = '\0';
    return read_number(p, text, length, number);
}

/* ---- Names without a pattern ---- */

/* Where the ending begins: the last '.' with something other than a number after it. */
static size_t stem_length(const char *name) {
    const char *dot = strrchr(name, '.');
    bool ending = dot && dot[1] && dot[1 + count_digits(dot + 1)];
    return ending ? (size_t)(dot - name) : strlen(name);
}

static size_t digits_start(const char *name, size_t end) {
    while (end && is_digit(name[end - 1])) end--;
    return end;
}

static bool is_separator(char c) {
    return c == '.' || c == '_' || c == '-' || c == ' ';
}

/* The end of the last number before `end`, less `skipped` of them; 0: there is none. */
static size_t number_end(const char *name, size_t end, int skipped) {
    while (end && !is_digit(name[end - 1])) end--;
    return skipped ? number_end(name, digits_start(name, end), skipped - 1) : end;
}

bool wf_name_find_number(const char *name, int way, wf_name_number *out) {
    size_t end = number_end(name, stem_length(name), way / 2), decimals = 0;
    size_t start = digits_start(name, end), digits = end - start;
    if (!digits) return false;
    if (way % 2 && start > 1 && name[start - 1] == '.' && is_digit(name[start - 2])) {
        size_t whole = digits_start(name, start - 1);
        if (!whole || is_separator(name[whole - 1])) {
            decimals = digits;
            digits = start - 1 - whole;
            start = whole;
        }
    }
    if (start && name[start - 1] == '-' &&
        (start == 1 || name[start - 2] == '.' || name[start - 2] == '_'))
        start--;
    out->start = start;
    out->end = end;
    return number_value(name + start, digits, decimals, &out->value);
}

bool wf_pattern_is(const char *text) {
    wf_pattern pattern;
    char why[256];
    return wf_pattern_parse(text, &pattern, why, sizeof why) == WF_PATTERN_OK;
}

bool wf_pattern_path(const char *text, int64_t frame, char *path, size_t path_size) {
    wf_pattern pattern;
    char why[256];
    if (wf_pattern_parse(text, &pattern, why, sizeof why) != WF_PATTERN_OK ||
        pattern.fewest_decimals)
        return false;
    int length =
        snprintf(path, path_size, "%.*s%s%0*" PRId64 "%s", (int)pattern.directory_length, text,
                 pattern.prefix, pattern.digits, frame, pattern.suffix);
    return length >= 0 && (size_t)length < path_size;
}
