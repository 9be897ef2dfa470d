/* Builds the JSON of reports and of --json with jansson, and keeps the first error. */
#include "convert/base/json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REPLACEMENT "\xEF\xBF\xBD" /* U+FFFD */

/* Adds value (which may be NULL where memory is out) and takes it over. */
static void add(wf_json *json, const char *key, json_t *value) {
    json_t *in = json->depth > 0 ? json->open[json->depth - 1] : NULL;
    int failure = value ? 0 : -1;
    if (json->depth == 0)
        json->root = value;
    else if (key)
        failure = json_object_set_new_nocheck(in, key, value);
    else
        failure = json_array_append_new(in, value);
    json->failed = json->failed || failure;
}

void wf_json_open(wf_json *json, const char *key, char bracket) {
    json_t *value = json->failed ? NULL : bracket == '{' ? json_object() : json_array();
    add(json, key, value);
    json->open[json->depth++] = json->failed ? NULL : value;
}

void wf_json_close(wf_json *json) {
    json->depth--;
}

/* Length of the UTF-8 sequence that starts at s; 0 if it is not one (RFC 3629). */
static size_t utf8_length(const unsigned char *s) {
    if (s[0] < 0x80) return 1;
    size_t length = s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : 2;
    if (s[0] < 0xC2 || s[0] > 0xF4) return 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xC0) != 0x80) return 0;
    bool overlong = (s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xF0 && s[1] < 0x90);
    bool beyond = (s[0] == 0xED && s[1] > 0x9F) || (s[0] == 0xF4 && s[1] > 0x8F);
    return overlong || beyond ? 0 : length;
}

/* jansson takes UTF-8 only. */
static json_t *text_of_any_bytes(const char *bytes) {
    const size_t replacement = strlen(REPLACEMENT);
    char *clean = malloc(replacement * strlen(bytes) + 1), *to = clean;
    if (!clean) return NULL;
    for (const char *s = bytes; *s;) {
        size_t length = utf8_length((const unsigned char *)s);
        memcpy(to, length ? s : REPLACEMENT, length ? length : replacement);
        to += length ? length : replacement;
        s += length ? length : 1;
    }
    json_t *value = json_stringn_nocheck(clean, (size_t)(to - clean));
    free(clean);
    return value;
}

void wf_json_text(wf_json *json, const char *key, const char *value) {
    add(json, key, value ? text_of_any_bytes(value) : json_null());
}

void wf_json_int(wf_json *json, const char *key, int64_t value) {
    add(json, key, json_integer(value));
}

void wf_json_real(wf_json *json, const char *key, double value) {
    char digits[32];
    snprintf(digits, sizeof digits, "%.9g", value);
    bool whole = !digits[strspn(digits, "-0123456789")];
    add(json, key,
        !isfinite(value) ? json_null()
        : whole          ? json_integer(strtoll(digits, NULL, 10))
                         : json_real(value));
}

void wf_json_bool(wf_json *json, const char *key, bool value) {
    add(json, key, json_boolean(value));
}

void wf_json_document(wf_json *json, const char *key, const char *text) {
    if (!json->failed) add(json, key, json_loads(text, JSON_DECODE_ANY, NULL));
}

char *wf_json_finish(wf_json *json) {
    char *line =
        json->failed ? NULL : json_dumps(json->root, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    char *text = NULL;
    if (line && asprintf(&text, "%s\n", line) < 0) text = NULL;
    free(line);
    json_decref(json->root);
    *json = (wf_json){0};
    return text;
}
