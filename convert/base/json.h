#ifndef WF_CONVERT_BASE_JSON_H
#define WF_CONVERT_BASE_JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define WF_JSON_DEPTH 8

/* A JSON document being written into a growing string. Start with {0}. Members of the outermost
 * object and objects in arrays get a line each; everything else stays on its line. Keys are
 * NULL inside arrays. What is written after memory ran out is dropped; wf_json_finish tells. */
typedef struct wf_json {
    char *text;
    size_t length, room;
    int depth;
    char closer[WF_JSON_DEPTH]; /* '}' or ']' for each container that is open */
    bool filled[WF_JSON_DEPTH]; /* it has a member already */
    bool failed;
} wf_json;

void wf_json_open(wf_json *json, const char *key, char bracket); /* '{' or '[' */
void wf_json_close(wf_json *json);

void wf_json_text(wf_json *json, const char *key, const char *value); /* NULL: null */
void wf_json_int(wf_json *json, const char *key, int64_t value);
void wf_json_real(wf_json *json, const char *key, double value); /* not finite: null */
void wf_json_bool(wf_json *json, const char *key, bool value);

/* Closes what is open, ends the line and hands the string over (free it); NULL: memory is out.
 */
char *wf_json_finish(wf_json *json);

#endif
