/* What commands that ask about files have in common: a job of the operands, and its report. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/program/cmd.h"

weft_status wf_cmd_question(const wf_cmd *cmd, int argc, char **argv, void *state,
                            weft_job **job, weft_error *err) {
    int operands = 0;
    *job = weft_job_new();
    if (!*job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = wf_cmd_parse(cmd, argc, argv, state, *job, &operands, err);
    for (int i = 0; i < operands && !status; i++)
        status = weft_job_add_input(*job, argv[i], err);
    return status;
}

weft_status wf_cmd_answer(weft_job *job, bool print, weft_status status) {
    if (job && print && strcmp(weft_job_report(job), "{}") != 0)
        fputs(weft_job_report(job), stdout);
    weft_job_free(job);
    return status;
}

void wf_cmd_trouble(const char *text, void *user) {
    (void)user;
    fflush(stdout);
    wf_cmd_say("", text);
}

weft_status wf_cmd_join(const wf_cmd_list *list, char between, char **joined, weft_error *err) {
    size_t size = 1;
    *joined = NULL;
    if (!list->count) return WEFT_OK;
    for (size_t i = 0; i < list->count; i++) size += strlen(list->value[i]) + 1;
    char *end = *joined = calloc(size, 1);
    if (!end) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    for (size_t i = 0; i < list->count; i++) {
        if (i) *end++ = between;
        end = stpcpy(end, list->value[i]);
    }
    return WEFT_OK;
}
