/* The list of what the input is taken for, with the reasons. */
#include "convert/job/taken.h"

#include <stdio.h>
#include <string.h>

void wf_take(wf_taken_list *list, const char *key, const char *value, const char *reason) {
    int i = 0;
    while (i < list->count && strcmp(list->row[i].key, key)) i++;
    if (i == WF_TAKEN_MOST) return;
    if (i == list->count) list->count++;
    list->row[i] = (wf_taken){.key = key, .reason = reason};
    snprintf(list->row[i].value, sizeof list->row[i].value, "%s", value);
}

void wf_taken_json(wf_json *json, const wf_taken_list *list) {
    for (int i = 0; i < list->count; i++) {
        wf_json_open(json, list->row[i].key, '{');
        wf_json_text(json, "value", list->row[i].value);
        wf_json_text(json, "reason", list->row[i].reason);
        wf_json_close(json);
    }
}
