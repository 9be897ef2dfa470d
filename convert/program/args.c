/* Reads the arguments of a command by its table of options. */
#include <stdio.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/job/options.h"
#include "convert/program/cmd.h"
#include "convert/job/meant.h"
#include "filters/base/spelling.h"

/* ---- Looking options up ---- */

static const wf_cmd_option *own_option(const wf_cmd *cmd, const char *name, size_t length) {
    for (size_t i = 0; i < cmd->option_count; i++) {
        const char *own = cmd->options[i].shown.name;
        if (strlen(own) == length && !strncmp(own, name, length)) return &cmd->options[i];
    }
    return NULL;
}

static const wf_cmd_option *letter_option(const wf_cmd *cmd, char letter) {
    for (size_t i = 0; i < cmd->option_count; i++)
        if (cmd->options[i].letter == letter) return &cmd->options[i];
    return NULL;
}

bool wf_cmd_option_at(const wf_cmd *cmd, size_t i, weft_option *out, char *letter) {
    *letter = 0;
    if (i < cmd->option_count) {
        *out = cmd->options[i].shown;
        *letter = cmd->options[i].letter;
        return true;
    }
    i -= cmd->option_count;
    for (size_t j = 0; weft_option_at(j, out); j++)
        if ((wf_option_commands(j) & cmd->taken_by) && i-- == 0) return true;
    return false;
}

static bool find_option(const wf_cmd *cmd, const char *name, size_t length, weft_option *out) {
    char letter;
    for (size_t i = 0; wf_cmd_option_at(cmd, i, out, &letter); i++)
        if (strlen(out->name) == length && !strncmp(out->name, name, length)) return true;
    return false;
}

static weft_status unknown_option(const wf_cmd *cmd, const char *dashes, const char *name,
                                  weft_error *err) {
    wf_spelling spelling = {.text = name};
    weft_option option;
    char letter, means[64] = "";
    for (size_t i = 0; wf_cmd_option_at(cmd, i, &option, &letter); i++)
        wf_spelling_offer(&spelling, option.name);
    const char *meant = wf_meant_by("", name);
    if (meant)
        snprintf(means, sizeof means, "it is called %s here", meant);
    else if (spelling.best)
        snprintf(means, sizeof means, "did you mean --%s?", spelling.best);
    else
        snprintf(means, sizeof means, "'weft %s --help' lists them", cmd->name);
    return wf_fail(err, WEFT_USAGE, "%s%.200s: unknown option; %s", dashes, name, means);
}

/* ---- Reading ---- */

/* Arguments while they are read: argv[at] is the current one. Operands that have been met are
 * at the front of argv. */
typedef struct reading {
    const wf_cmd *cmd;
    int argc, at;
    char **argv;
    void *state;
    weft_job *job;
} reading;

static weft_status append(wf_cmd_list *list, const char *name, char *value, weft_error *err) {
    if (list->count == WF_CMD_MOST_VALUES)
        return wf_fail(err, WEFT_USAGE, "--%s is given more than %d times", name,
                       WF_CMD_MOST_VALUES);
    list->value[list->count++] = value;
    return WEFT_OK;
}

static weft_status store(const reading *r, const char *name, size_t length, char *value,
                         weft_error *err) {
    const wf_cmd_option *own = own_option(r->cmd, name, length);
    char word[64];
    if (own) {
        char *place = (char *)r->state + own->offset;
        if (own->repeats)
            return append((wf_cmd_list *)(void *)place, own->shown.name, value, err);
        if (own->shown.takes)
            *(char **)(void *)place = value;
        else
            *(bool *)place = true;
        return WEFT_OK;
    }
    snprintf(word, sizeof word, "%.*s", (int)length, name);
    return weft_job_set(r->job, word, value, err);
}

/* Whether an argument is an option, so that the value before it was forgotten ("-o -q"). "-" is
 * standard output, and "-3-5" is a range: neither is an option. */
static bool looks_like_option(const wf_cmd *cmd, const char *argument) {
    if (argument[0] != '-' || !argument[1]) return false;
    return argument[1] == '-' || letter_option(cmd, argument[1]);
}

/* Finds the value of an option, which stands after its '=' or is the next argument. */
static weft_status take_value(reading *r, const weft_option *option, char *attached,
                              char **value, weft_error *err) {
    *value = attached;
    if (!option->takes)
        return !attached
                   ? WEFT_OK
                   : wf_fail(err, WEFT_USAGE, "--%s takes no value, and was given '%.200s'",
                             option->name, attached);
    if (!attached && r->at + 1 < r->argc && !looks_like_option(r->cmd, r->argv[r->at + 1]))
        *value = r->argv[++r->at];
    if (*value && **value) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--%s needs a value: --%s %s", option->name, option->name,
                   option->takes);
}

static weft_status read_long(reading *r, weft_error *err) {
    char *name = r->argv[r->at] + 2, *equals = strchr(name, '='), *value;
    size_t length = equals ? (size_t)(equals - name) : strlen(name);
    weft_option option;
    if (!find_option(r->cmd, name, length, &option)) {
        r->argv[r->at][2 + length] = '\0';
        return unknown_option(r->cmd, "--", name, err);
    }
    weft_status status = take_value(r, &option, equals ? equals + 1 : NULL, &value, err);
    return status ? status : store(r, name, length, value, err);
}

static weft_status read_short(reading *r, weft_error *err) {
    char *letter = r->argv[r->at] + 1, *value;
    const wf_cmd_option *own = letter_option(r->cmd, *letter);
    if (!own) return unknown_option(r->cmd, "-", letter, err);
    weft_status status = take_value(r, &own->shown, letter[1] ? letter + 1 : NULL, &value, err);
    return status ? status : store(r, own->shown.name, strlen(own->shown.name), value, err);
}

weft_status wf_cmd_parse(const wf_cmd *cmd, int argc, char **argv, void *state, weft_job *job,
                         int *operand_count, weft_error *err) {
    reading r = {.cmd = cmd, .argc = argc, .argv = argv, .state = state, .job = job};
    int operands = 0;
    bool options_ended = false;
    for (; r.at < argc; r.at++) {
        char *argument = argv[r.at];
        weft_status status = WEFT_OK;
        if (options_ended || argument[0] != '-' || !argument[1])
            argv[operands++] = argument;
        else if (!strcmp(argument, "--"))
            options_ended = true;
        else if (argument[1] == '-')
            status = read_long(&r, err);
        else
            status = read_short(&r, err);
        if (status) return status;
    }
    *operand_count = operands;
    return WEFT_OK;
}

weft_status wf_cmd_meter(wf_meter *meter, const char *style, bool quiet, weft_error *err) {
    if (wf_meter_init(meter, quiet ? "none" : style)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--progress: '%.200s' will not do; it takes one of " WF_CMD_PROGRESS_STYLES,
                   style);
}
