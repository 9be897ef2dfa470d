/* weft manual: the manual page, made of the tables that the parser and the help are made of. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "convert/base/fail.h"
#include "convert/program/cmd.h"

/* ---- roff ---- */

/* Prints text in which roff finds no commands. It must not stand at the beginning of a line. */
static void put_inner(const char *text, size_t length) {
    static const char *const escapes[128] = {
        ['\\'] = "\\(rs", ['-'] = "\\-",   ['\''] = "\\(aq", ['`'] = "\\(ga",
        ['^'] = "\\(ha",  ['~'] = "\\(ti", ['"'] = "\\(dq"};
    for (size_t i = 0; i < length; i++) {
        const char *escape = escapes[text[i] & 127];
        if (escape)
            fputs(escape, stdout);
        else
            putchar(text[i]);
    }
}

static void put(const char *text, size_t length) {
    if (length && (*text == '.' || *text == '\'')) fputs("\\&", stdout);
    put_inner(text, length);
}

static void put_text(const char *text) {
    put(text, strlen(text));
}

/* Prints text that roff fills, in lines short enough for the checkers of manual pages. */
static void put_filled(const char *text, size_t length) {
    size_t column = 0;
    for (size_t at = 0; at < length;) {
        size_t word = 0;
        while (at + word < length && text[at + word] != ' ') word++;
        if (column) putchar(column + word > 56 ? '\n' : ' ');
        column = column && column + word <= 56 ? column + 1 + word : word;
        if (column == word)
            put(text + at, word);
        else
            put_inner(text + at, word);
        at += word;
        while (at < length && text[at] == ' ') at++;
    }
    putchar('\n');
}

/* Prints paragraphs, which empty lines part. Lines that begin with two blanks are kept as they
 * are. */
static void put_paragraphs(const char *text) {
    bool literal = false, fresh = true, first = true; /* a heading begins a paragraph */
    for (; *text; text += *text == '\n') {
        size_t length = strcspn(text, "\n");
        bool indented = length > 2 && text[0] == ' ' && text[1] == ' ';
        if (length && (fresh || indented != literal)) {
            if (literal && !indented) fputs(".fi\n.RE\n", stdout);
            if (indented && !literal) fputs(".PP\n.RS 4\n.nf\n", stdout);
            if (!indented && !first) fputs(".PP\n", stdout);
            if (indented && literal) fputs(".sp\n", stdout);
            literal = indented;
            first = false;
        }
        fresh = !length;
        if (indented) {
            put(text + 2, length - 2);
            putchar('\n');
        } else if (length) {
            put_filled(text, length);
        }
        text += length;
    }
    if (literal) fputs(".fi\n.RE\n", stdout);
}

static void put_option(const weft_option *option, char letter) {
    fputs(".TP\n", stdout);
    if (letter) printf("\\fB\\-%c\\fR, ", letter);
    fputs("\\fB\\-\\-", stdout);
    put_text(option->name);
    fputs("\\fR", stdout);
    if (option->takes) {
        fputs(" \\fI", stdout);
        put_text(option->takes);
        fputs("\\fR", stdout);
    }
    putchar('\n');
    put_filled(option->help, strlen(option->help));
    if (!option->preset) return;
    fputs("Default: ", stdout);
    put_text(option->preset);
    puts(".");
}

/* ---- Sections ---- */

static void put_synopsis(void) {
    puts(".SH SYNOPSIS");
    for (size_t i = 0; wf_cmd_at(i); i++) {
        const char *operands = wf_cmd_at(i)->operands;
        printf("%s\\fBweft %s\\fR%s", i ? ".br\n" : "", wf_cmd_at(i)->name,
               *operands ? " " : "");
        put_text(operands);
        putchar('\n');
    }
}

/* Prints a command's text, its own options, and the names of the job's options that it takes,
 * which are described once for all. */
static void put_command(const wf_cmd *cmd, const wf_cmd *before) {
    weft_option option;
    char letter;
    fputs(".SS weft ", stdout);
    put_text(cmd->name);
    putchar('\n');
    put_paragraphs(cmd->text);
    size_t i = 0;
    for (; i < cmd->option_count && wf_cmd_option_at(cmd, i, &option, &letter); i++)
        put_option(&option, letter);
    if (wf_cmd_option_at(cmd, i, &option, &letter)) puts(".PP\nAlso, as described below:");
    for (; wf_cmd_option_at(cmd, i, &option, &letter); i++) {
        fputs("\\fB\\-\\-", stdout);
        put_text(option.name);
        puts("\\fR");
    }
    if (!cmd->notes || (before && cmd->notes == before->notes)) return;
    puts(".PP");
    put_paragraphs(cmd->notes);
}

static void put_commands(void) {
    puts(".SH COMMANDS");
    for (size_t i = 0; wf_cmd_at(i); i++)
        put_command(wf_cmd_at(i), i ? wf_cmd_at(i - 1) : NULL);
}

static void put_job_options(void) {
    weft_option option;
    const char *group = "";
    puts(".SH OPTIONS\nEach command takes those that it names.");
    for (size_t i = 0; weft_option_at(i, &option); i++) {
        if (strcmp(group, option.group)) {
            fputs(".SS ", stdout);
            put_text(option.group);
            putchar('\n');
        }
        group = option.group;
        put_option(&option, 0);
    }
}

static void put_names(void) {
    weft_raster raster;
    puts(".SH RASTERS");
    for (size_t i = 0; weft_raster_at(i, &raster); i++) {
        put_text(raster.name);
        putchar('\n');
    }
    puts(".SH APERTURES");
    for (size_t i = 0; weft_aperture_name(i); i++) {
        put_text(weft_aperture_name(i));
        putchar('\n');
    }
}

typedef struct entry {
    const char *term, *text;
} entry;

static void put_entries(const char *section, const entry *entries, size_t count) {
    printf(".SH %s\n", section);
    for (size_t i = 0; i < count; i++) {
        fputs(".TP\n.B ", stdout);
        put_text(entries[i].term);
        putchar('\n');
        put_filled(entries[i].text, strlen(entries[i].text));
    }
}

static const entry exits[] = {
    {"0", "Done."},
    {"1", "Failed: an input or an output is at fault, or memory ran out."},
    {"2", "The request makes no sense."},
    {"3", "Done, but frames were held or samples mended."},
    {"128 + n", "Ended by signal n. On failure nothing unfinished is left."},
};

static const entry environment[] = {
    {"OCIO", "The OpenColorIO configuration, where --ocio names none."},
    {"NO_COLOR", "If set and not empty, messages have no colors."},
};

static const entry files[] = {
    {"*.json", "Job files, for --job: one object whose keys are names of options, inputs, "
               "output and command; paths are relative to the file's folder."},
    {"share/weft/weft.ocio", "The color spaces that weft knows, as an OpenColorIO "
                             "configuration; it is compiled in as well."},
    {"share/doc/weft/examples",
     "Guides, scenes and their language (scenes/README.md), and what goes "
     "with renderers, farms and programs of one's own."},
};

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* The page is dated with the day of the build, or with SOURCE_DATE_EPOCH (in seconds) if that
 * is set, so that a build can be reproduced. */
static void put_title(void) {
    const char *told = getenv("SOURCE_DATE_EPOCH");
    time_t now = told ? (time_t)strtoll(told, NULL, 10) : time(NULL);
    struct tm day;
    char date[16] = "1970-01-01";
    if (gmtime_r(&now, &day)) strftime(date, sizeof date, "%Y-%m-%d", &day);
    printf(".TH WEFT 1 %s \"weft %s\" \"User Commands\"\n", date, weft_version());
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    int operands;
    weft_status status = wf_cmd_parse(cmd, argc, argv, NULL, NULL, &operands, err);
    if (status) return status;
    if (operands)
        return wf_fail(err, WEFT_USAGE, "'%.200s': manual takes nothing; it is one page",
                       argv[0]);
    put_title();
    puts(".SH NAME\nweft \\- oversampled progressive renders to interlaced broadcast video");
    put_synopsis();
    put_commands();
    put_job_options();
    put_names();
    put_entries("EXIT STATUS", exits, COUNT(exits));
    put_entries("ENVIRONMENT", environment, COUNT(environment));
    put_entries("FILES", files, COUNT(files));
    puts(".SH SEE ALSO\n.BR ffmpeg (1),\n.BR oiiotool (1)");
    return WEFT_OK;
}

const wf_cmd wf_cmd_manual = {
    .name = "manual",
    .operands = "",
    .summary = "the manual page, for man",
    .text = "Prints the manual page of all commands.\n"
            "\n"
            "  weft manual | man -l -\n",
    .run = run,
};
