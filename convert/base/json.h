#ifndef WF_CONVERT_BASE_JSON_H
#define WF_CONVERT_BASE_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

/* Containers within containers. */
#define WF_JSON_DEPTH 8

/* A JSON document that is built member by member, by jansson. Start with {0}. Members keep the
 * order in which they are added; keys are NULL inside arrays. Errors stick: after the first
 * failed allocation nothing more is added, and wf_json_finish tells. */
typedef struct wf_json {
    json_t *root;
    json_t
        *open[WF_JSON_DEPTH]; /* the containers that are open, the outermost first; borrowed */
    int depth;
    bool failed;
} wf_json;

void wf_json_open(wf_json *json, const char *key, char bracket); /* '{' or '[' */
void wf_json_close(wf_json *json);

/* NULL becomes null. File names may hold any bytes: those that are not UTF-8 become U+FFFD. */
void wf_json_text(wf_json *json, const char *key, const char *value);
void wf_json_int(wf_json *json, const char *key, int64_t value);
/* Nine digits of it, without a point where they are whole; what is not finite becomes null. */
void wf_json_real(wf_json *json, const char *key, double value);
void wf_json_bool(wf_json *json, const char *key, bool value);

/* A document that wf_json_finish has made. */
void wf_json_document(wf_json *json, const char *key, const char *text);

/* The whole document as text that ends in a newline, whatever is still open (the caller's,
 * free()); NULL: memory is out. Releases the document in any case. */
char *wf_json_finish(wf_json *json);

#endif
