/* What commands are made of: their tables, and what reads, helps and prints by them. */
#ifndef WF_CONVERT_PROGRAM_CMD_H
#define WF_CONVERT_PROGRAM_CMD_H

#include "convert/job/joblist.h"
#include "convert/program/progress.h"
#include "convert/weft.h"

/* The values of an option that may be given several times, borrowed from argv. */
#define WF_CMD_MOST_VALUES 32
typedef struct wf_cmd_list {
    char *value[WF_CMD_MOST_VALUES];
    size_t count;
} wf_cmd_list;

/* An option that a command has of its own, beside those of a job. Given, it is stored in the
 * command's state: a flag as a bool, one that repeats in a wf_cmd_list, anything else as a
 * const char * that borrows from argv, of which the last of several wins. */
typedef struct wf_cmd_option {
    weft_option shown;
    char letter; /* "-o"; 0: none */
    size_t offset;
    bool repeats;
} wf_cmd_option;

/* What a command takes and says of itself: the parser and the help are made of it. */
typedef struct wf_cmd {
    const char *name;
    const char *operands; /* "INPUT... -o OUTPUT" */
    const char *summary;  /* one line */
    const char *text;     /* what it does, with examples; help prints it before the options */
    const char *notes;    /* what help prints after the options; NULL: nothing */
    const wf_cmd_option *options;
    size_t option_count;
    unsigned taken_by; /* the WF_TAKEN_BY_ bit of the job's options that it takes; 0: none */
    weft_status (*run)(const struct wf_cmd *cmd, int argc, char **argv, weft_error *err);
} wf_cmd;

extern const wf_cmd wf_cmd_convert, wf_cmd_render, wf_cmd_trace, wf_cmd_measure,
    wf_cmd_composite, wf_cmd_filters, wf_cmd_plot, wf_cmd_rasters, wf_cmd_info, wf_cmd_verify,
    wf_cmd_plan, wf_cmd_page, wf_cmd_manual, wf_cmd_completion;

/* The command of that index, in the order in which help lists them; NULL past the end. */
const wf_cmd *wf_cmd_at(size_t index);

/* Reads a command's arguments into its state (the struct its options' offsets count in) and
 * job. Operands are moved to the front of argv; *operand_count says how many. --name value,
 * --name=value, -x value and -xvalue, in any order; -- ends the options. */
weft_status wf_cmd_parse(const wf_cmd *cmd, int argc, char **argv, void *state, weft_job *job,
                         int *operand_count, weft_error *err);

/* Option i of the command: its own first, then the job's that it takes. False past the end. */
bool wf_cmd_option_at(const wf_cmd *cmd, size_t i, weft_option *out, char *letter);

/* Job files, read once. One of them may hold a list of jobs. */
typedef struct wf_cmd_jobs {
    wf_jobfile_text file[WF_CMD_MOST_VALUES];
    size_t files;
    wf_jobfile_text *job; /* of the list */
    size_t count;         /* of them; 0: there is no list, and the files say what one job is */
    size_t list;          /* which file it is in */
} wf_cmd_jobs;
weft_status wf_cmd_read_jobs(const wf_cmd_list *files, wf_cmd_jobs *jobs, weft_error *err);
void wf_cmd_free_jobs(wf_cmd_jobs *jobs);

/* Loads job files, of a list its job `index`, into job, and the command's own options that they
 * hold into its state, whose values `kept` owns until wf_cmd_forget. A later file wins. */
weft_status wf_cmd_load(const wf_cmd *cmd, const wf_cmd_jobs *jobs, size_t index, void *state,
                        weft_job *job, wf_cmd_list *kept, weft_error *err);
void wf_cmd_forget(wf_cmd_list *kept);

/* The row of the option --progress, for a command's table. */
#define WF_CMD_PROGRESS(group)                                                                 \
    {                                                                                          \
        "progress", WF_CMD_PROGRESS_STYLES, "tty on a terminal, else none",                    \
            "How to show progress, on standard error.", group                                  \
    }
#define WF_CMD_PROGRESS_STYLES "tty|plain|alf|json|none"

/* Starts a meter in the style that --progress names (NULL: chosen by wf_meter_init); when
 * quiet, one that shows nothing. WEFT_USAGE for an unknown style. */
weft_status wf_cmd_meter(wf_meter *meter, const char *style, bool quiet, weft_error *err);

/* Prints what COMMAND --help says, on standard output. */
void wf_cmd_help(const wf_cmd *cmd);

/* Prints what wf_json_finish returned, and frees it. */
weft_status wf_cmd_print_json(char *text, weft_error *err);

/* What commands that ask about files begin with: a job whose inputs are the operands. *job is
 * NULL after a failure; whatever the status, wf_cmd_answer frees it. */
weft_status wf_cmd_question(const wf_cmd *cmd, int argc, char **argv, void *state,
                            weft_job **job, weft_error *err);

/* What they end with: prints the report, if print and if there is one, and returns status. */
weft_status wf_cmd_answer(weft_job *job, bool print, weft_status status);

/* The values of an option that repeats as one text, with a character between them (free());
 * NULL: it was not given. */
weft_status wf_cmd_join(const wf_cmd_list *list, char between, char **joined, weft_error *err);

/* Says a trouble with a file after what was printed so far; a weft_warning_fn. */
void wf_cmd_trouble(const char *text, void *user);

/* "weft: " and a message on standard error, colored on a terminal unless NO_COLOR is set. */
void wf_cmd_say(const char *kind, const char *text);

/* A signal that asks the program to stop cancels the job, which is given 1.7 s for it. After
 * the job, before it is freed, signals are ignored. */
void wf_cmd_catch_signals(weft_job *job);
void wf_cmd_ignore_signals(void);

/* The number of the signal that asked the program to stop; 0 if none did. */
int wf_cmd_signal(void);

#endif
