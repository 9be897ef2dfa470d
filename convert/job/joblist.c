/* Job files that hold several jobs: where each of them is in the text. */
#include "convert/job/joblist.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"

#define KEY "\"jobs\""

/* A walk through text that is good JSON. */
typedef struct walk {
    const wf_jobfile_text *text;
    size_t at;
    int line, column; /* from 0 */
    int depth;        /* of what is open */
    int list_depth;   /* of the array of jobs once it is open: 1 or 2 */
    bool in_list;
    const char *string; /* the last one, at its quote */
} walk;

static void step(walk *w) {
    char c = w->text->bytes[w->at++];
    if ((c & 0xC0) != 0x80) w->column++;
    if (c == '\n') w->line++, w->column = 0;
}

/* Passes over a string, which begins here. */
static void pass_string(walk *w) {
    w->string = w->text->bytes + w->at;
    for (step(w); w->at < w->text->size && w->text->bytes[w->at] != '"'; step(w))
        if (w->text->bytes[w->at] == '\\') step(w);
}

/* Whether the array that opens here is that of the jobs. */
static bool is_list(const walk *w) {
    if (w->depth == 0) return true;
    return w->depth == 1 && w->list_depth == 2 && w->string &&
           !strncmp(w->string, KEY, sizeof KEY - 1);
}

/* Takes the character here; false past the end. */
static bool take(walk *w) {
    if (w->at >= w->text->size) return false;
    char c = w->text->bytes[w->at];
    if (c == '[' && !w->in_list && is_list(w)) w->in_list = true;
    if (c == '[' || c == '{') w->depth++;
    if (c == ']' && w->in_list && w->depth == w->list_depth) w->in_list = false;
    if (c == ']' || c == '}') w->depth--;
    if (c == '"') pass_string(w);
    step(w);
    return true;
}

/* Whether a job begins here: something other than a comma or a blank in the array itself. */
static bool begins(const walk *w) {
    return w->in_list && w->depth == w->list_depth && w->at < w->text->size &&
           !strchr(", \t\r\n]", w->text->bytes[w->at]);
}

/* Goes to the next job, and over it; false: there is none. */
static bool next_job(walk *w, wf_jobfile_text *job) {
    while (!begins(w))
        if (!take(w)) return false;
    *job = (wf_jobfile_text){.path = w->text->path,
                             .bytes = w->text->bytes + w->at,
                             .line = w->line,
                             .column = w->column};
    size_t from = w->at;
    do take(w);
    while (w->depth > w->list_depth);
    job->size = w->at - from;
    return true;
}

bool wf_joblist_shares(const wf_jobfile_text *text) {
    for (size_t i = 0; i < text->size; i++)
        if (text->bytes[i] == '{' || text->bytes[i] == '[') return text->bytes[i] == '{';
    return true;
}

static weft_status fill(const wf_jobfile_text *text, const json_t *list, wf_jobfile_text *jobs,
                        weft_error *err) {
    walk w = {.text = text, .list_depth = wf_joblist_shares(text) ? 2 : 1};
    for (size_t i = 0; i < json_array_size(list); i++) {
        if (!next_job(&w, &jobs[i])) /* the key is written with escapes */
            return wf_fail(err, WEFT_USAGE, "%.300s: write the key " KEY " without escapes",
                           text->path);
        jobs[i].number = i + 1;
        if (!json_is_object(json_array_get(list, i)))
            return wf_fail(err, WEFT_USAGE,
                           "%.300s:%d:%d: job %zu: each job of a list is an object, such as "
                           "{\"inputs\": \"shot.####.exr\", \"output\": \"shot.y4m\"}",
                           text->path, jobs[i].line + 1, jobs[i].column + 1, i + 1);
    }
    return WEFT_OK;
}

static weft_status find(const wf_jobfile_text *text, const json_t *root, wf_jobfile_text **jobs,
                        size_t *count, weft_error *err) {
    const json_t *list = json_is_array(root) ? root : json_object_get(root, "jobs");
    if (!list) return WEFT_OK;
    if (!json_is_array(list) || !json_array_size(list))
        return wf_fail(err, WEFT_USAGE,
                       "%.300s: its list of jobs %s; give an array of jobs, each an object",
                       text->path, json_is_array(list) ? "is empty" : "is no list");
    *jobs = calloc(json_array_size(list), sizeof **jobs);
    if (!*jobs) return wf_fail(err, WEFT_NO_MEMORY, "%.300s: out of memory", text->path);
    *count = json_array_size(list);
    return fill(text, list, *jobs, err);
}

weft_status wf_joblist_find(const wf_jobfile_text *text, wf_jobfile_text **jobs, size_t *count,
                            weft_error *err) {
    json_t *root;
    *jobs = NULL;
    *count = 0;
    weft_status status = wf_jobfile_parse(text, &root, err);
    if (!status) status = find(text, root, jobs, count, err);
    if (status) {
        free(*jobs);
        *jobs = NULL;
        *count = 0;
    }
    json_decref(root);
    return status;
}
