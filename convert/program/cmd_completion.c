/* weft completion: what shells complete, from the tables of commands and options. */
#include <stdio.h>
#include <string.h>

#include "convert/ask/asking.h"
#include "convert/base/fail.h"
#include "convert/job/delivery.h"
#include "convert/program/cmd.h"

/* ---- What a value can be ---- */

typedef enum value_kind { FLAG, ANYTHING, FILES, WORDS } value_kind;

typedef const char *name_fn(size_t i, weft_raster *raster);

static const char *raster_name(size_t i, weft_raster *raster) {
    return weft_raster_at(i, raster) ? raster->name : NULL;
}

static const char *aperture_name(size_t i, weft_raster *raster) {
    (void)raster;
    return weft_aperture_name(i);
}

/* Whether an earlier row has the same name: a codec that goes into several containers has a row
 * for each, and is completed once. */
static bool is_repeated(size_t i) {
    for (size_t j = 0; j < i; j++)
        if (!strcmp(wf_delivery_at(j)->kind.name, wf_delivery_at(i)->kind.name)) return true;
    return false;
}

static const char *codec_name(size_t i, weft_raster *raster) {
    (void)raster;
    size_t row = 0;
    for (; wf_delivery_at(row); row++)
        if (!is_repeated(row) && !i--) break;
    return wf_delivery_at(row) ? wf_delivery_at(row)->kind.name : NULL;
}

/* Options and commands whose values are names of a table, and what lists that table. */
static const struct {
    const char *taker;
    name_fn *name;
} named[] = {{"raster", raster_name},
             {"rasters", raster_name},
             {"aperture", aperture_name},
             {"filters", aperture_name},
             {"codec", codec_name}};

static name_fn *names_of(const char *taker) {
    for (size_t i = 0; i < sizeof named / sizeof *named; i++)
        if (!strcmp(named[i].taker, taker)) return named[i].name;
    return NULL;
}

static bool holds_word(const char *text, const char *const *words) {
    for (; *words; words++)
        if (strstr(text, *words)) return true;
    return false;
}

/* The kind of value that an option takes, or a command as its operands. */
static value_kind kind_of(const char *taker, const char *takes) {
    static const char *const files[] = {"FILE", "OUTPUT", "INPUT", "SCENE", "IN ", "REF", NULL};
    if (!takes) return FLAG;
    if (names_of(taker) || strchr(takes, '|')) return WORDS;
    return holds_word(takes, files) ? FILES : ANYTHING;
}

/* Prints the words that can be completed: the names of the taker's table, or the fixed parts of
 * what it takes ("a b silent:" of "a|b|silent:N"). */
static void put_words(const char *taker, const char *takes) {
    weft_raster raster;
    const char *between = "";
    name_fn *name = names_of(taker);
    for (size_t i = 0; name && name(i, &raster); i++, between = " ")
        printf("%s%s", between, name(i, &raster));
    for (const char *at = name ? "" : takes; *at; at += strspn(at, "|")) {
        size_t length = strcspn(at, "|"), fixed = strcspn(at, "|ABCDEFGHIJKLMNOPQRSTUVWXYZ");
        if (fixed) printf("%s%.*s", between, (int)fixed, at), between = " ";
        at += length;
    }
}

/* Prints text that stands within single quotes; characters that are special to the shell's
 * completion get a backslash. */
static void put_quoted(const char *text, const char *special) {
    for (; *text; text++) {
        if (*text == '\'') {
            fputs("'\\''", stdout);
            continue;
        }
        if (strchr(special, *text)) putchar('\\');
        putchar(*text);
    }
}

/* Prints text that stands within single quotes of fish, where a backslash is special as well.
 */
static void put_fish_text(const char *text) {
    for (; *text; text++) {
        if (*text == '\'' || *text == '\\') putchar('\\');
        putchar(*text);
    }
}

static const weft_option help = {"help", NULL, NULL, "Show what it takes.", ""};

/* Finds option i of a command; the one after the last is --help. */
static bool option_or_help(const wf_cmd *cmd, size_t i, weft_option *out, char *letter) {
    if (wf_cmd_option_at(cmd, i, out, letter)) return true;
    *out = help;
    *letter = 'h';
    return i == 0 || wf_cmd_option_at(cmd, i - 1, &(weft_option){0}, &(char){0});
}

/* ---- bash ---- */

static void bash_value(const char *taker, const char *takes) {
    static const char *const does[] = {
        [FLAG] = "", [ANYTHING] = "words=''", [FILES] = "files=yes", [WORDS] = "words='"};
    value_kind kind = kind_of(taker, takes);
    fputs(does[kind], stdout);
    if (kind != WORDS) return;
    put_words(taker, takes);
    putchar('\'');
}

static void bash_command(const wf_cmd *cmd) {
    weft_option option;
    char letter;
    printf("        %s)\n            case $prev in\n", cmd->name);
    for (size_t i = 0; option_or_help(cmd, i, &option, &letter); i++) {
        if (!option.takes) continue;
        printf("                --%s", option.name);
        if (letter) printf("|-%c", letter);
        fputs(") ", stdout);
        bash_value(option.name, option.takes);
        puts(" ;;");
    }
    fputs("                *) ", stdout);
    bash_value(cmd->name, cmd->operands);
    fputs("\n                    options='", stdout);
    for (size_t i = 0; option_or_help(cmd, i, &option, &letter); i++)
        printf("%s--%s", i ? " " : "", option.name);
    puts("' ;;\n            esac ;;");
}

static void put_bash(void) {
    puts("# bash completion for weft, made by 'weft completion bash'.\n"
         "_weft()\n"
         "{\n"
         "    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}\n"
         "    local words='' options='' files=''\n"
         "    # --name=value comes in three words.\n"
         "    if [ \"$cur\" = = ]; then\n"
         "        cur=''\n"
         "    elif [ \"$prev\" = = ]; then\n"
         "        prev=${COMP_WORDS[COMP_CWORD-2]}\n"
         "    fi\n"
         "    COMPREPLY=()");
    fputs("    if [ \"$COMP_CWORD\" = 1 ]; then\n"
          "        words='--help --version",
          stdout);
    for (size_t i = 0; wf_cmd_at(i); i++) printf(" %s", wf_cmd_at(i)->name);
    puts("'\n    else\n    case ${COMP_WORDS[1]} in");
    for (size_t i = 0; wf_cmd_at(i); i++) bash_command(wf_cmd_at(i));
    puts("    esac\n"
         "    fi\n"
         "    case $cur in\n"
         "        -*) words=$options files='' ;;\n"
         "    esac\n"
         "    if [ -n \"$files\" ]; then\n"
         "        compopt -o filenames 2>/dev/null\n"
         "        mapfile -t COMPREPLY < <(compgen -f -- \"$cur\")\n"
         "    else\n"
         "        mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$cur\")\n"
         "    fi\n"
         "}\n"
         "complete -F _weft weft");
}

/* ---- zsh ---- */

/* Prints ":what:action", by which zsh completes a value. */
static void zsh_value(const char *taker, const char *takes) {
    value_kind kind = kind_of(taker, takes);
    if (kind == FLAG) return;
    putchar(':');
    put_quoted(*takes ? takes : "nothing", ":\\");
    putchar(':');
    if (kind == FILES) fputs("_files", stdout);
    if (kind != WORDS) return;
    putchar('(');
    put_words(taker, takes);
    putchar(')');
}

static void zsh_option(const weft_option *option, char letter) {
    for (int form = letter ? 0 : 1; form < 2; form++) {
        fputs("            '*", stdout);
        if (form)
            printf("--%s%s[", option->name, option->takes ? "=" : "");
        else
            printf("-%c%s[", letter, option->takes ? "+" : "");
        put_quoted(option->help, "[]:\\");
        putchar(']');
        zsh_value(option->name, option->takes);
        puts("' \\");
    }
}

static void put_zsh(void) {
    weft_option option;
    char letter;
    puts("#compdef weft\n"
         "# zsh completion for weft, made by 'weft completion zsh'.\n"
         "_weft() {\n"
         "    local -a commands\n"
         "    commands=(");
    for (size_t i = 0; wf_cmd_at(i); i++) {
        printf("        '%s:", wf_cmd_at(i)->name);
        put_quoted(wf_cmd_at(i)->summary, "");
        puts("'");
    }
    puts("    )\n"
         "    if (( CURRENT == 2 )); then\n"
         "        _describe command commands\n"
         "        return\n"
         "    fi\n"
         "    local command=$words[2]\n"
         "    shift words\n"
         "    (( CURRENT-- ))\n"
         "    case $command in");
    for (size_t i = 0; wf_cmd_at(i); i++) {
        const wf_cmd *cmd = wf_cmd_at(i);
        printf("        %s) _arguments -s -S \\\n", cmd->name);
        for (size_t o = 0; option_or_help(cmd, o, &option, &letter); o++)
            zsh_option(&option, letter);
        fputs("            '*", stdout);
        zsh_value(cmd->name, cmd->operands);
        puts("' ;;");
    }
    puts("    esac\n"
         "}\n"
         "if [ \"$funcstack[1]\" = _weft ]; then _weft \"$@\"; else compdef _weft weft; fi");
}

/* ---- fish ---- */

static void fish_value(const char *taker, const char *takes) {
    value_kind kind = kind_of(taker, takes);
    if (kind == FILES) fputs(" -r -F", stdout);
    if (kind == ANYTHING) fputs(" -x", stdout);
    if (kind != WORDS) return;
    fputs(" -x -a '", stdout);
    put_words(taker, takes);
    putchar('\'');
}

static void fish_command(const wf_cmd *cmd) {
    weft_option option;
    char letter, when[96];
    snprintf(when, sizeof when, "complete -c weft -n '__fish_seen_subcommand_from %s'",
             cmd->name);
    value_kind kind = kind_of(cmd->name, cmd->operands);
    if (kind == FILES) printf("%s -F\n", when);
    if (kind == WORDS) {
        printf("%s -a '", when);
        put_words(cmd->name, cmd->operands);
        puts("'");
    }
    for (size_t i = 0; option_or_help(cmd, i, &option, &letter); i++) {
        printf("%s -l %s", when, option.name);
        if (letter) printf(" -s %c", letter);
        fish_value(option.name, option.takes);
        fputs(" -d '", stdout);
        put_fish_text(option.help);
        puts("'");
    }
}

static void put_fish(void) {
    puts("# fish completion for weft, made by 'weft completion fish'.\n"
         "complete -c weft -f");
    for (size_t i = 0; wf_cmd_at(i); i++) {
        printf("complete -c weft -n __fish_use_subcommand -a %s -d '", wf_cmd_at(i)->name);
        put_fish_text(wf_cmd_at(i)->summary);
        puts("'");
    }
    for (size_t i = 0; wf_cmd_at(i); i++) fish_command(wf_cmd_at(i));
}

/* ---- The command ---- */

#define SHELLS "bash|zsh|fish"

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    static void (*const put[])(void) = {put_bash, put_zsh, put_fish};
    int operands, shell = -1;
    weft_status status = wf_cmd_parse(cmd, argc, argv, NULL, NULL, &operands, err);
    if (status) return status;
    if (operands != 1)
        return wf_fail(err, WEFT_USAGE, "completion takes the name of one shell: " SHELLS);
    if (wf_ask_choose("completion", SHELLS, argv[0], &shell, NULL))
        return wf_fail(err, WEFT_USAGE,
                       "'%.200s': no shell that weft knows; completion takes one of " SHELLS,
                       argv[0]);
    put[shell]();
    return WEFT_OK;
}

const wf_cmd wf_cmd_completion = {
    .name = "completion",
    .operands = SHELLS,
    .summary = "what a shell completes",
    .text = "Prints a script that has a shell complete commands, options and their values.\n"
            "\n"
            "  source <(weft completion bash)\n",
    .run = run,
};
