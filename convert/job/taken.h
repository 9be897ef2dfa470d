#ifndef WF_CONVERT_JOB_TAKEN_H
#define WF_CONVERT_JOB_TAKEN_H

#include "convert/base/json.h"

/* What the input is taken for, and why. `weft info`, --dry-run and the report tell the same
 * rows; whoever decides something about the input adds one. */

#define WF_TAKEN_MOST 12

typedef struct wf_taken {
    const char *key;    /* "layer": input.layer of the report; static */
    const char *reason; /* "option", "file" or "default"; static */
    char value[128];
} wf_taken;

typedef struct wf_taken_list {
    wf_taken row[WF_TAKEN_MOST];
    int count;
} wf_taken_list;

/* Adds a row; one of the same key is replaced. */
void wf_take(wf_taken_list *list, const char *key, const char *value, const char *reason);

/* Members of the object that is open: "layer": {"value": "rgba", "reason": "file"}. */
void wf_taken_json(wf_json *json, const wf_taken_list *list);

#endif
