/* Text that grows: pieces of HTML. */
#include "convert/page/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool reserve(wf_text *text, size_t more) {
    size_t need = text->length + more + 1;
    if (text->failed) return false;
    if (need <= text->capacity) return true;
    char *at = realloc(text->at, 2 * need);
    if (!at) {
        text->failed = true;
        return false;
    }
    text->at = at;
    text->capacity = 2 * need;
    return true;
}

static void add_bytes(wf_text *text, const char *bytes, size_t count) {
    if (!reserve(text, count)) return;
    memcpy(text->at + text->length, bytes, count);
    text->length += count;
    text->at[text->length] = '\0';
}

void wf_text_add(wf_text *text, const char *format, ...) {
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int length = vsnprintf(NULL, 0, format, list);
    if (length >= 0 && reserve(text, (size_t)length)) {
        vsnprintf(text->at + text->length, (size_t)length + 1, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
    va_end(list);
}

/* How many bytes of a character of UTF-8 begin here; 0: it is none. Overlong forms, which
 * would hide what is replaced, begin with bytes below those looked at. */
static size_t character(const unsigned char *at) {
    size_t bytes = *at < 0x80                  ? 1
                   : *at >= 0xc2 && *at < 0xe0 ? 2
                   : *at > 0xe0 && *at < 0xf0  ? 3
                   : *at > 0xf0 && *at < 0xf4  ? 4
                                               : 0;
    if (*at == 0xe0 && at[1] >= 0xa0) bytes = 3;
    if (*at == 0xf0 && at[1] >= 0x90) bytes = 4;
    for (size_t i = 1; i < bytes; i++)
        if ((at[i] & 0xc0) != 0x80) return 0;
    return bytes;
}

void wf_text_add_words(wf_text *text, const char *words) {
    static const struct {
        char is;
        const char *becomes;
    } special[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    while (*words) {
        size_t bytes = character((const unsigned char *)words), i = 0;
        while (i < 4 && special[i].is != *words) i++;
        if (i < 4)
            add_bytes(text, special[i].becomes, strlen(special[i].becomes));
        else if (bytes && ((unsigned char)*words >= 0x20 || *words == '\n'))
            add_bytes(text, words, bytes);
        else
            add_bytes(text, "\xef\xbf\xbd", 3);
        words += bytes ? bytes : 1;
    }
}
