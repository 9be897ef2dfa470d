#include "convert/base/json.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void append(wf_json *json, const char *bytes, size_t count) {
    if (json->failed) return;
    if (json->room - json->length <= count) {
        size_t room = 2 * (json->room + count) + 256;
        char *grown = realloc(json->text, room);
        if (!grown) {
            json->failed = true;
            return;
        }
        json->text = grown;
        json->room = room;
    }
    memcpy(json->text + json->length, bytes, count);
    json->length += count;
    json->text[json->length] = '\0';
}

static void append_word(wf_json *json, const char *word) {
    append(json, word, strlen(word));
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

/* File names may hold any bytes: those that are not UTF-8 become U+FFFD. */
static void append_quoted(wf_json *json, const char *text) {
    append_word(json, "\"");
    for (const char *s = text; *s;) {
        unsigned char c = (unsigned char)*s;
        size_t length = utf8_length((const unsigned char *)s);
        char escape[8];
        if (c < 0x20 || c == 0x7F || c == '"' || c == '\\')
            append(json, escape, (size_t)snprintf(escape, sizeof escape, "\\u%04x", c));
        else if (length)
            append(json, s, length);
        else
            append_word(json, "\xEF\xBF\xBD");
        s += length ? length : 1;
    }
    append_word(json, "\"");
}

static void break_line(wf_json *json) {
    append_word(json, "\n");
    for (int d = 0; d < json->depth; d++) append_word(json, "  ");
}

/* Whatever goes before a value: a comma, a line or a blank, and the key. */
static void begin_value(wf_json *json, const char *key, bool opens_object) {
    if (json->depth > 0) {
        bool *filled = &json->filled[json->depth - 1];
        bool in_array = json->closer[json->depth - 1] == ']';
        if (*filled) append_word(json, ",");
        if (json->depth == 1 ? !in_array || opens_object : in_array && opens_object)
            break_line(json);
        else if (*filled)
            append_word(json, " ");
        *filled = true;
    }
    if (!key) return;
    append_quoted(json, key);
    append_word(json, ": ");
}

void wf_json_open(wf_json *json, const char *key, char bracket) {
    begin_value(json, key, bracket == '{');
    append(json, &bracket, 1);
    json->closer[json->depth] = bracket == '{' ? '}' : ']';
    json->filled[json->depth++] = false;
}

void wf_json_close(wf_json *json) {
    json->depth--;
    if (json->depth == 0 && json->filled[0]) break_line(json);
    append(json, &json->closer[json->depth], 1);
}

void wf_json_text(wf_json *json, const char *key, const char *value) {
    begin_value(json, key, false);
    if (value)
        append_quoted(json, value);
    else
        append_word(json, "null");
}

void wf_json_int(wf_json *json, const char *key, int64_t value) {
    char digits[24];
    snprintf(digits, sizeof digits, "%" PRId64, value);
    begin_value(json, key, false);
    append_word(json, digits);
}

void wf_json_real(wf_json *json, const char *key, double value) {
    char digits[32];
    snprintf(digits, sizeof digits, "%.9g", value);
    char *comma = strchr(digits, ','); /* the decimal point of a locale a host may have set */
    if (comma) *comma = '.';
    begin_value(json, key, false);
    append_word(json, isfinite(value) ? digits : "null");
}

void wf_json_bool(wf_json *json, const char *key, bool value) {
    begin_value(json, key, false);
    append_word(json, value ? "true" : "false");
}

char *wf_json_finish(wf_json *json) {
    while (json->depth > 0) wf_json_close(json);
    append_word(json, "\n");
    if (!json->failed) return json->text;
    free(json->text);
    return NULL;
}
