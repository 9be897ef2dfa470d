/* Job files: JSON to options. */
#include "convert/job/jobfile.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "convert/base/fail.h"
#include "convert/job/joblist.h"
#include "filters/base/spelling.h"

/* The file, and the member in hand. */
typedef struct loading {
    weft_job *job;
    const wf_jobfile_text *text;
    const wf_jobfile_taker *taker;
    size_t member; /* from 0 */
    const char *key;
    weft_option option; /* that it names */
    bool repeats;
} loading;

/* ---- Where a member is ---- */

typedef struct place {
    int line, column;
} place;

/* Where key `member` of the outermost object begins, in text that is good JSON: jansson keeps
 * the members' order but not their places. */
static place place_of(const loading *l) {
    place at = {l->text->line + 1, l->text->column};
    size_t left = l->member + 1;
    int depth = 0;
    bool key_next = false;
    for (size_t i = 0; i < l->text->size; i++) {
        char c = l->text->bytes[i];
        if ((c & 0xC0) != 0x80) at.column++;
        if (c == '\n') at.line++, at.column = 0;
        if (c == '{' || c == '[') key_next = ++depth == 1;
        if (c == '}' || c == ']') depth--;
        if (c == ',' && depth == 1) key_next = true;
        if (c != '"') continue;
        if (depth == 1 && key_next && !--left) return at;
        key_next = false;
        while (++i < l->text->size && l->text->bytes[i] != '"') {
            at.column += (l->text->bytes[i] & 0xC0) != 0x80;
            if (l->text->bytes[i] == '\\') i++, at.column++;
        }
        at.column++;
    }
    return at;
}

static weft_status wrong(const loading *l, weft_error *err, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static weft_status wrong(const loading *l, weft_error *err, const char *format, ...) {
    char text[700], number[32] = "";
    place at = place_of(l);
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (l->text->number) snprintf(number, sizeof number, "job %zu: ", l->text->number);
    return wf_fail(err, WEFT_USAGE, "%.300s:%d:%d: %s%s", l->text->path, at.line, at.column,
                   number, text);
}

/* Puts file, line and column before the refusal of whoever takes the value. */
static weft_status placed(const loading *l, weft_status status, const weft_error *why,
                          weft_error *err) {
    if (!status) return WEFT_OK;
    if (status == WEFT_USAGE) return wrong(l, err, "%.690s", why->text);
    return wf_fail(err, status, "%.900s", why->text);
}

/* ---- Values as text ---- */

/* The shortest decimal that is this number, without an exponent. */
static void real_text(double value, char text[400]) {
    for (int decimals = 0; decimals <= 17; decimals++) {
        snprintf(text, 400, "%.*f", decimals, value);
        if (strtod(text, NULL) == value) break;
    }
    char *comma = strchr(text, ','); /* a host may have set a locale */
    if (comma) *comma = '.';
}

/* The text of a string or a number, which `digits` holds unless it is the string's own; NULL of
 * anything else. */
static const char *scalar_text(const json_t *value, char digits[400]) {
    if (json_is_string(value)) return json_string_value(value);
    if (json_is_integer(value))
        snprintf(digits, 400, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else if (json_is_real(value))
        real_text(json_real_value(value), digits);
    else
        return NULL;
    return digits;
}

static const char *type_name(const json_t *value) {
    static const char *const names[] = {
        [JSON_OBJECT] = "an object", [JSON_ARRAY] = "an array", [JSON_STRING] = "text",
        [JSON_INTEGER] = "a number", [JSON_REAL] = "a number",  [JSON_TRUE] = "true",
        [JSON_FALSE] = "false",      [JSON_NULL] = "null"};
    return names[json_typeof(value)];
}

/* Whether word is one of "a|b|c". */
static bool lists(const char *takes, const char *word) {
    size_t length = strlen(word);
    for (const char *at = takes; *at; at += strspn(at, "|")) {
        size_t here = strcspn(at, "|");
        if (here == length && !strncmp(at, word, length)) return true;
        at += here;
    }
    return false;
}

/* Returns path as seen from the job file's folder; "hash:FILE" keeps its scheme in front.
 * The caller frees it; NULL when memory is out. */
static char *from_folder(const loading *l, const char *path) {
    const char *folder = l->text->path, *slash = strrchr(folder, '/');
    size_t scheme = strncmp(path, "hash:", 5) ? 0 : 5;
    const char *name = path + scheme;
    bool stays = !slash || *name == '/' || !*name || !strcmp(path, "-") ||
                 !strncmp(path, "null:", 5) || strstr(path, "://");
    if (stays) return strdup(path);
    size_t before = (size_t)(slash - folder) + 1, size = scheme + before + strlen(name) + 1;
    char *joined = malloc(size);
    if (joined)
        snprintf(joined, size, "%.*s%.*s%s", (int)scheme, path, (int)before, folder, name);
    return joined;
}

/* ---- Members ---- */

static weft_status no_memory(const loading *l, weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "%.300s: out of memory", l->text->path);
}

static weft_status set_one(const loading *l, const char *value, bool on, weft_error *err) {
    weft_error why = {""};
    const char *takes = value ? l->option.takes : NULL;
    bool file = takes && (!strcmp(takes, "FILE") || !strcmp(takes, "OUTPUT"));
    char *own = file ? from_folder(l, value) : NULL;
    if (file && !own) return no_memory(l, err);
    weft_status status =
        value && !*value
            ? wf_fail(&why, WEFT_USAGE, "\"%s\" is empty; it takes %s", l->key, l->option.takes)
            : l->taker->set(l->taker->user, l->key, own ? own : value, on, &why);
    free(own);
    return placed(l, status, &why, err);
}

static weft_status set_pairs(const loading *l, json_t *object, weft_error *err) {
    const char *name;
    json_t *value;
    json_object_foreach(object, name, value) {
        char digits[400], *pair;
        const char *text = json_is_true(value)    ? "true"
                           : json_is_false(value) ? "false"
                                                  : scalar_text(value, digits);
        if (!text)
            return wrong(l, err, "\"%s\": \"%.100s\" takes text or a number, not %s", l->key,
                         name, type_name(value));
        if (!*name || strchr(name, '='))
            return wrong(l, err, "\"%s\": '%.100s' will not do for a name", l->key, name);
        if (asprintf(&pair, "%s=%s", name, text) < 0) return no_memory(l, err);
        weft_status status = set_one(l, pair, true, err);
        free(pair);
        if (status) return status;
    }
    return WEFT_OK;
}

static weft_status refuse_type(const loading *l, const json_t *value, weft_error *err) {
    const char *takes = l->option.takes;
    return wrong(l, err, "\"%s\" takes %s%s%s, not %s", l->key,
                 takes ? "text or a number: " : "true or false", takes ? takes : "",
                 l->repeats ? ", several as an array or, as NAME=VALUE, an object" : "",
                 type_name(value));
}

static weft_status set_scalar(const loading *l, const json_t *value, weft_error *err) {
    char digits[400];
    const char *text = scalar_text(value, digits), *takes = l->option.takes;
    if (!takes && json_is_boolean(value)) return set_one(l, NULL, json_is_true(value), err);
    if (takes && json_is_boolean(value) && lists(takes, "on") && lists(takes, "off"))
        text = json_is_true(value) ? "on" : "off";
    if (!takes || !text) return refuse_type(l, value, err);
    return set_one(l, text, true, err);
}

/* An array of numbers, [0, 0.5, 1], for an option that takes R,G,B. */
static weft_status set_list(const loading *l, const json_t *array, weft_error *err) {
    char text[1024] = "", digits[400];
    size_t used = 0;
    for (size_t i = 0; i < json_array_size(array); i++) {
        const json_t *value = json_array_get(array, i);
        const char *one = scalar_text(value, digits);
        if (!one) return refuse_type(l, value, err);
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i ? "," : "", one);
        if (used >= sizeof text) return wrong(l, err, "\"%s\": the array is too long", l->key);
    }
    return set_one(l, text, true, err);
}

static weft_status set_member(const loading *l, json_t *value, weft_error *err) {
    bool listed = !l->repeats && l->option.takes && strchr(l->option.takes, ',');
    if (listed && json_is_array(value)) return set_list(l, value, err);
    if (l->repeats && json_is_object(value)) return set_pairs(l, value, err);
    if (!l->repeats || !json_is_array(value)) return set_scalar(l, value, err);
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < json_array_size(value) && !status; i++)
        status = set_scalar(l, json_array_get(value, i), err);
    return status;
}

static weft_status add_input(const loading *l, const json_t *value, weft_error *err) {
    weft_error why = {""};
    if (!json_is_string(value))
        return wrong(l, err, "\"inputs\" takes the name of a file, or an array of them, not %s",
                     type_name(value));
    char *path = from_folder(l, json_string_value(value));
    if (!path) return no_memory(l, err);
    weft_status status = weft_job_add_input(l->job, path, &why);
    free(path);
    return placed(l, status, &why, err);
}

static weft_status set_inputs(const loading *l, const json_t *value, weft_error *err) {
    wf_job_clear_inputs(l->job);
    if (!json_is_array(value)) return add_input(l, value, err);
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < json_array_size(value) && !status; i++)
        status = add_input(l, json_array_get(value, i), err);
    return status;
}

static weft_status set_output(const loading *l, const json_t *value, weft_error *err) {
    weft_error why = {""};
    if (!json_is_string(value))
        return wrong(l, err, "\"output\" takes the name of a file, such as out.y4m, not %s",
                     type_name(value));
    char *path = from_folder(l, json_string_value(value));
    if (!path) return no_memory(l, err);
    weft_status status = weft_job_set_output(l->job, path, &why);
    free(path);
    return placed(l, status, &why, err);
}

static weft_status set_command(const loading *l, const json_t *value, weft_error *err) {
    weft_error why = {""};
    const char *name = json_string_value(value), *own = wf_command_name(l->job->command);
    if (!name)
        return wrong(l, err, "\"command\" takes convert, render or trace, not %s",
                     type_name(value));
    if (l->taker->keep_command && strcmp(name, own))
        return wrong(l, err, "this is a job of %.100s, and was given to weft %s", name, own);
    return placed(l, weft_job_set_command(l->job, name, &why), &why, err);
}

/* The jobs of a list are taken one by one (convert/job/joblist.h). */
static weft_status pass_jobs(const loading *l, const json_t *value, weft_error *err) {
    (void)value;
    if (l->taker->shared) return WEFT_OK;
    return wrong(l, err,
                 l->text->number ? "a job cannot hold others"
                                 : "this is a list of jobs, and one job is wanted");
}

static const struct {
    const char *key;
    weft_status (*set)(const loading *l, const json_t *value, weft_error *err);
} fixed[] = {{"inputs", set_inputs},
             {"output", set_output},
             {"command", set_command},
             {"jobs", pass_jobs}};

#define FIXED (sizeof fixed / sizeof *fixed)

static weft_status unknown_key(const loading *l, weft_error *err) {
    wf_spelling spelling = {.text = l->key};
    weft_option option;
    bool repeats;
    for (size_t i = 0; i < FIXED; i++) wf_spelling_offer(&spelling, fixed[i].key);
    for (size_t i = 0; l->taker->option_at(l->taker->user, i, &option, &repeats); i++)
        if (strcmp(option.name, "job")) wf_spelling_offer(&spelling, option.name);
    if (spelling.best)
        return wrong(l, err, "\"%.200s\": unknown key; did you mean \"%s\"?", l->key,
                     spelling.best);
    return wrong(l, err,
                 "\"%.200s\": unknown key; there are \"inputs\", \"output\", \"command\" and "
                 "the options that 'weft %s --help' lists",
                 l->key, wf_command_name(l->job->command));
}

static weft_status load_member(loading *l, json_t *value, weft_error *err) {
    for (size_t i = 0; i < FIXED; i++)
        if (!strcmp(fixed[i].key, l->key)) return fixed[i].set(l, value, err);
    if (!strcmp(l->key, "job")) return wrong(l, err, "a job file cannot name another");
    for (size_t i = 0; l->taker->option_at(l->taker->user, i, &l->option, &l->repeats); i++)
        if (!strcmp(l->option.name, l->key)) return set_member(l, value, err);
    return unknown_key(l, err);
}

/* ---- The file ---- */

static weft_status refuse_json(const wf_jobfile_text *text, const json_error_t *why,
                               weft_error *err) {
    return wf_fail(err, WEFT_USAGE, "%.300s:%d:%d: %.200s; a job file is one JSON object",
                   text->path, why->line > 0 ? why->line : 1, why->column > 0 ? why->column : 1,
                   why->text);
}

static weft_status load_members(loading *l, json_t *root, weft_error *err) {
    wf_job_layer layer;
    json_t *value;
    weft_status status = WEFT_OK;
    wf_job_layer_begin(l->job, &layer);
    json_object_foreach(root, l->key, value) {
        status = load_member(l, value, err);
        if (status) break;
        l->member++;
    }
    wf_job_layer_end(l->job, &layer);
    return status;
}

weft_status wf_jobfile_parse(const wf_jobfile_text *text, json_t **root, weft_error *err) {
    json_error_t why;
    *root = json_loadb(text->bytes, text->size, JSON_REJECT_DUPLICATES, &why);
    if (*root) return WEFT_OK;
    /* Jansson may take an allocation that fails for a fault of the text: it reads again. */
    void *room = malloc(text->size + 4096);
    if (!room) return wf_fail(err, WEFT_NO_MEMORY, "%.300s: out of memory", text->path);
    free(room);
    *root = json_loadb(text->bytes, text->size, JSON_REJECT_DUPLICATES, &why);
    return *root ? WEFT_OK : refuse_json(text, &why, err);
}

weft_status wf_jobfile_apply(weft_job *job, const wf_jobfile_text *text,
                             const wf_jobfile_taker *taker, weft_error *err) {
    json_t *root;
    loading l = {.job = job, .text = text, .taker = taker};
    weft_status status = wf_jobfile_parse(text, &root, err);
    if (status) return status;
    status = json_is_object(root)
                 ? load_members(&l, root, err)
                 : wf_fail(err, WEFT_USAGE,
                           "%.300s:1:1: this is an array; one job is a JSON object, such as "
                           "{\"inputs\": \"shot.####.exr\", \"output\": \"shot.y4m\"}",
                           text->path);
    json_decref(root);
    return status;
}

static weft_status read_all(int fd, const char *path, char *bytes, size_t *size,
                            weft_error *err) {
    *size = 0;
    for (;;) {
        ssize_t got = read(fd, bytes + *size, WF_JOBFILE_BYTES + 1 - *size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return wf_fail(err, WEFT_FAILED, "%.300s: %s", path, strerror(errno));
        *size += (size_t)got;
        if (*size > WF_JOBFILE_BYTES)
            return wf_fail(err, WEFT_USAGE, "%.300s: a job file has at most %zu bytes", path,
                           WF_JOBFILE_BYTES);
        if (!got) return WEFT_OK;
    }
}

/* A byte order mark is no part of the text. */
static void skip_mark(wf_jobfile_text *text, char *bytes) {
    if (text->size < 3 || memcmp(bytes, "\xEF\xBB\xBF", 3) != 0) return;
    text->size -= 3;
    memmove(bytes, bytes + 3, text->size);
}

weft_status wf_jobfile_read(const char *path, wf_jobfile_text *text, weft_error *err) {
    bool standard = !strcmp(path, "-");
    char *bytes = malloc(WF_JOBFILE_BYTES + 1);
    if (!bytes) return wf_fail(err, WEFT_NO_MEMORY, "%.300s: out of memory", path);
    *text = (wf_jobfile_text){.path = standard ? "standard input" : path, .bytes = bytes};
    int fd = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    weft_status status =
        fd < 0 ? wf_fail(err, WEFT_FAILED, "%.300s: %s; --job takes a file of JSON", path,
                         strerror(errno))
               : read_all(fd, text->path, bytes, &text->size, err);
    if (fd >= 0 && !standard) close(fd);
    if (status)
        wf_jobfile_free(text);
    else
        skip_mark(text, bytes);
    return status;
}

void wf_jobfile_free(wf_jobfile_text *text) {
    free((char *)(uintptr_t)text->bytes);
    text->bytes = NULL;
}

/* ---- The public interface ---- */

static bool option_of_jobs(void *user, size_t i, weft_option *out, bool *repeats) {
    (void)user;
    *repeats = wf_option_repeats(i);
    return weft_option_at(i, out);
}

static weft_status set_of_jobs(void *user, const char *name, const char *value, bool on,
                               weft_error *err) {
    if (on) return weft_job_set(user, name, value, err);
    wf_job_clear_flag(user, name);
    return WEFT_OK;
}

/* Job `number` of a file, from 1, with what all of its jobs share; 0: the file is one job. */
static weft_status load_one(weft_job *job, const wf_jobfile_text *text, size_t number,
                            weft_error *err) {
    const wf_jobfile_taker taker = {job, option_of_jobs, set_of_jobs, false, number > 0};
    wf_jobfile_text *jobs;
    size_t count;
    if (!number) return wf_jobfile_apply(job, text, &taker, err);
    weft_status status = wf_joblist_find(text, &jobs, &count, err);
    if (!status && number > count)
        status = wf_fail(err, WEFT_USAGE, "%.300s: there is no job %zu, but %zu of them",
                         text->path, number, count);
    if (!status && wf_joblist_shares(text)) status = wf_jobfile_apply(job, text, &taker, err);
    const wf_jobfile_taker own = {job, option_of_jobs, set_of_jobs, false, false};
    if (!status) status = wf_jobfile_apply(job, &jobs[number - 1], &own, err);
    free(jobs);
    return status;
}

weft_status weft_job_load_nth(weft_job *job, const char *path, size_t number, weft_error *err) {
    wf_jobfile_text text;
    if (!path || !*path) return wf_fail(err, WEFT_USAGE, "a job file's name is empty");
    weft_status status = wf_jobfile_read(path, &text, err);
    if (status) return status;
    status = load_one(job, &text, number, err);
    wf_jobfile_free(&text);
    return status;
}

weft_status weft_job_load(weft_job *job, const char *path, weft_error *err) {
    return weft_job_load_nth(job, path, 0, err);
}

weft_status weft_jobs_in(const char *path, size_t *count, weft_error *err) {
    wf_jobfile_text text, *jobs;
    *count = 0;
    if (!path || !*path) return wf_fail(err, WEFT_USAGE, "a job file's name is empty");
    weft_status status = wf_jobfile_read(path, &text, err);
    if (status) return status;
    status = wf_joblist_find(&text, &jobs, count, err);
    free(jobs);
    wf_jobfile_free(&text);
    return status;
}
