/* weft info: what a file or a sequence is. */
#include <stdio.h>

#include "convert/ask/info.h"
#include "convert/program/cmd.h"

typedef struct info_state {
    bool json;
} info_state;

static void print_file(void *user, const char *path) {
    (void)user;
    puts(path);
}

/* Prints "key value"; '_' is shown as a blank. */
static void print_line(void *user, const char *key, const char *value) {
    (void)user;
    printf("  ");
    for (int column = 0; column < 18; column++) {
        putchar(*key == '_' || !*key ? ' ' : *key);
        key += *key != '\0';
    }
    puts(value);
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    const wf_info_tell lines = {NULL, print_file, print_line};
    info_state state = {0};
    weft_job *job;
    weft_status status = wf_cmd_question(cmd, argc, argv, &state, &job, err);
    if (!status)
        status = wf_ask_info(job, state.json ? NULL : &lines, wf_cmd_trouble, NULL, err);
    return wf_cmd_answer(job, state.json, status);
}

static const wf_cmd_option options[] = {
    {{"json", NULL, NULL, "Print JSON.", "Options"}, .offset = offsetof(info_state, json)},
};

const wf_cmd wf_cmd_info = {
    .name = "info",
    .operands = "FILE...",
    .summary = "what a file or a sequence is",
    .text = "Tells what inputs and outputs say of themselves: pictures, sequences (with the "
            "numbers\n"
            "that are missing), Y4M, and video that libav reads (.mov, .mxf, .mkv ..).\n"
            "\n"
            "  weft info shot.####.exr out.y4m\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .run = run,
};
