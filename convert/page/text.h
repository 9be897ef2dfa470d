/* Text that grows: pieces of HTML. */
#ifndef WF_CONVERT_PAGE_TEXT_H
#define WF_CONVERT_PAGE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Starts as {0}. After the first failed allocation nothing more is added, and failed is set. */
typedef struct wf_text {
    char *at; /* ends in '\0'; NULL where nothing was added; free() */
    size_t length, capacity;
    bool failed;
} wf_text;

void wf_text_add(wf_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds words with what HTML would take for its own replaced, and each byte that is not UTF-8
 * as U+FFFD. */
void wf_text_add_words(wf_text *text, const char *words);

#endif
