/* The program weft: finds the command, answers --help and --version, and turns a status into an
 * exit code. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "convert/base/fail.h"
#include "convert/program/cmd.h"
#include "filters/base/spelling.h"

static const wf_cmd *const commands[] = {
    &wf_cmd_convert,   &wf_cmd_render,  &wf_cmd_trace,  &wf_cmd_plan,      &wf_cmd_measure,
    &wf_cmd_composite, &wf_cmd_filters, &wf_cmd_plot,   &wf_cmd_rasters,   &wf_cmd_info,
    &wf_cmd_verify,    &wf_cmd_page,    &wf_cmd_manual, &wf_cmd_completion};

#define COMMANDS (sizeof commands / sizeof *commands)

const wf_cmd *wf_cmd_at(size_t index) {
    return index < COMMANDS ? commands[index] : NULL;
}

static void help(FILE *to) {
    fprintf(to,
            "weft %s: oversampled progressive renders to interlaced broadcast video\n\n"
            "usage: weft COMMAND ...\n\n",
            weft_version());
    for (size_t i = 0; i < COMMANDS; i++)
        fprintf(to, "  weft %-10s %-27s %s\n", commands[i]->name, commands[i]->operands,
                commands[i]->summary);
    fputs("\nA first conversion, of a render with eight pictures to a field, to 525-line "
          "video:\n\n"
          "  weft convert shot.####.exr --subframe-rate 480000/1001 -o shot.y4m\n\n"
          "and a first render, of a scene that comes along (of an installed weft, examples/ is "
          "in\n"
          "share/doc/weft below its prefix: of a package /usr/share/doc/weft/examples):\n\n"
          "  weft render examples/scenes/carousel.lua --frames 0-9 -o carousel.y4m\n\n"
          "'weft COMMAND --help' says what a command takes; 'weft --version' which weft this "
          "is.\n",
          to);
}

static const wf_cmd *find_command(const char *name, weft_error *err) {
    wf_spelling spelling = {.text = name};
    for (size_t i = 0; i < COMMANDS; i++) {
        if (!strcmp(commands[i]->name, name)) return commands[i];
        wf_spelling_offer(&spelling, commands[i]->name);
    }
    if (spelling.best)
        wf_fail(err, WEFT_USAGE, "%.200s: unknown command; did you mean %s?", name,
                spelling.best);
    else
        wf_fail(err, WEFT_USAGE, "%.200s: unknown command; 'weft --help' lists them", name);
    return NULL;
}

/* Whether an argument before "--" is the letter or the word of a question such as --help. */
static bool asks(int argc, char **argv, const char *letter, const char *word) {
    for (int i = 0; i < argc && strcmp(argv[i], "--"); i++)
        if (!strcmp(argv[i], letter) || !strcmp(argv[i], word)) return true;
    return false;
}

static weft_status run(int argc, char **argv, weft_error *err) {
    if (argc < 2) {
        help(stderr);
        return WEFT_USAGE;
    }
    const wf_cmd *cmd = argv[1][0] == '-' ? NULL : find_command(argv[1], err);
    if (!cmd && argv[1][0] != '-') return WEFT_USAGE;
    if (asks(argc - 1, argv + 1, "-h", "--help")) {
        if (cmd)
            wf_cmd_help(cmd);
        else
            help(stdout);
    } else if (asks(argc - 1, argv + 1, "--version", "--version")) {
        printf("weft %s\n", weft_version());
    } else if (cmd) {
        return cmd->run(cmd, argc - 2, argv + 2, err);
    } else {
        return wf_fail(err, WEFT_USAGE,
                       "%.200s: a command comes first, such as 'weft convert'; "
                       "'weft --help' lists them",
                       argv[1]);
    }
    return WEFT_OK;
}

/* Opens /dev/null in place of standard streams that are closed: their numbers would otherwise
 * go to the next files that are opened. */
static void occupy_standard_streams(void) {
    int fd = open("/dev/null", O_RDONLY);
    while (fd >= 0 && fd <= STDERR_FILENO) fd = open("/dev/null", O_RDONLY);
    if (fd >= 0) close(fd);
}

static int exit_code(weft_status status) {
    static const int codes[] = {
        [WEFT_OK] = 0,       [WEFT_FAILED] = 1,    [WEFT_USAGE] = 2,
        [WEFT_DEGRADED] = 3, [WEFT_NO_MEMORY] = 1, [WEFT_INTERRUPTED] = 1};
    int signal_number = wf_cmd_signal();
    return status == WEFT_INTERRUPTED && signal_number ? 128 + signal_number : codes[status];
}

int main(int argc, char **argv) {
    occupy_standard_streams();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe is a failed write, with its message */
    weft_error err = {""};
    weft_status status = run(argc, argv, &err);
    bool failed = status != WEFT_OK && status != WEFT_DEGRADED;
    if ((fflush(stdout) || ferror(stdout)) && !failed) {
        status = wf_fail(&err, WEFT_FAILED, "standard output: %s", strerror(errno));
        failed = true;
    }
    if (failed && *err.text) wf_cmd_say("", err.text);
    return exit_code(status);
}
