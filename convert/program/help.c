/* Prints what COMMAND --help says, from the tables that the arguments are read by. */
#include <stdio.h>
#include <string.h>

#include "convert/program/cmd.h"

#define HELP_COLUMNS 80
#define HELP_INDENT  34

/* Prints text wrapped between HELP_INDENT and HELP_COLUMNS; the cursor is at HELP_INDENT. */
static void wrap(const char *text) {
    size_t at = HELP_INDENT;
    while (*text) {
        size_t word = strcspn(text, " ");
        if (at > HELP_INDENT && at + 1 + word > HELP_COLUMNS) {
            printf("\n%*s", HELP_INDENT, "");
            at = HELP_INDENT;
        }
        at += (size_t)printf("%s%.*s", at > HELP_INDENT ? " " : "", (int)word, text);
        text += word + strspn(text + word, " ");
    }
    putchar('\n');
}

static void help_option(const weft_option *option, char letter) {
    char dash[8] = "    ", left[96], right[256];
    if (letter) snprintf(dash, sizeof dash, "-%c, ", letter);
    int used = snprintf(left, sizeof left, "  %s--%s%s%s", dash, option->name,
                        option->takes ? " " : "", option->takes ? option->takes : "");
    snprintf(right, sizeof right, option->preset ? "%s [%s]" : "%s", option->help,
             option->preset);
    if (used < HELP_INDENT - 1)
        printf("%-*s", HELP_INDENT, left);
    else
        printf("%s\n%*s", left, HELP_INDENT, "");
    wrap(right);
}

void wf_cmd_help(const wf_cmd *cmd) {
    static const weft_option help = {"help", NULL, NULL, "Show this.", ""};
    printf("usage: weft %s %s\n\n%s", cmd->name, cmd->operands, cmd->text);
    weft_option option;
    char letter;
    const char *group = "";
    for (size_t i = 0; wf_cmd_option_at(cmd, i, &option, &letter); i++) {
        if (strcmp(group, option.group)) printf("\n%s:\n", option.group);
        group = option.group;
        help_option(&option, letter);
    }
    help_option(&help, 'h');
    if (cmd->notes) printf("\n%s", cmd->notes);
}
