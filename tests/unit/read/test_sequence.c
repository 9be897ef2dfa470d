/* What inputs mean: patterns, ranges, directories, lists. Files here are empty: only names
 * count. */
#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/base/names.h"
#include "convert/base/range.h"
#include "convert/read/selection.h"
#include "convert/read/sequence.h"
#include "tests/unit/support/exr_write.h"

#define LENGTH(array) (sizeof(array) / sizeof *(array))

/* ---- A place to work ---- */

static char root[PATH_MAX];

static void touch(const char *name) {
    FILE *file = fopen(name, "w");
    if (!file) fail_msg("%s: %s", name, strerror(errno));
    fclose(file);
}

static void touch_range(const char *format, int first, int last) {
    for (int i = first; i <= last; i++) {
        char name[128];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
        snprintf(name, sizeof name, format, i);
#pragma GCC diagnostic pop
        touch(name);
    }
}

/* Every test has an empty directory of its own. */
static int enter(void **state) {
    (void)state;
    const char *tmp = getenv("TMPDIR");
    snprintf(root, sizeof root, "%s/sequence.XXXXXX", tmp ? tmp : "/tmp");
    return !mkdtemp(root) || chdir(root);
}

static int leave(void **state) {
    (void)state;
    char command[PATH_MAX + 32];
    snprintf(command, sizeof command, "rm -rf '%s'", root);
    return chdir("/") || system(command);
}

static wf_sequence expand_all(char *const *inputs, size_t count, const char *frames) {
    wf_sequence sequence;
    weft_error err = {""};
    weft_status status = wf_sequence_expand(inputs, count, frames, &sequence, &err);
    if (status) fail_msg("%s: %s", inputs[0], err.text);
    return sequence;
}

static wf_sequence expand(const char *input, const char *frames) {
    char *inputs[] = {(char *)(uintptr_t)input};
    return expand_all(inputs, 1, frames);
}

/* The message of what must fail, which has the words given with '|' between them. */
static void refused_all(char *const *inputs, size_t count, const char *frames,
                        weft_status wanted, const char *words) {
    wf_sequence sequence;
    weft_error err = {""};
    char word[128];
    weft_status status = wf_sequence_expand(inputs, count, frames, &sequence, &err);
    if (status != wanted) fail_msg("%s: status %d: %s", inputs[0], status, err.text);
    assert_null(sequence.refs);
    assert_int_equal(sequence.count, 0);
    for (const char *at = words; *at; at += strcspn(at, "|"), at += *at == '|') {
        snprintf(word, sizeof word, "%.*s", (int)strcspn(at, "|"), at);
        if (!strstr(err.text, word)) fail_msg("no '%s' in: %s", word, err.text);
    }
    assert_null(strchr(err.text, '\n'));
}

static void refused(const char *input, const char *frames, weft_status wanted,
                    const char *words) {
    char *inputs[] = {(char *)(uintptr_t)input};
    refused_all(inputs, 1, frames, wanted, words);
}

/* The sequence as text: "1:a.1.exr 2:- 3:a.3.exr /step". Frees it. */
static void check(wf_sequence sequence, const char *wanted) {
    char text[4096], number[48];
    size_t used = 0, missing = 0;
    for (size_t k = 0; k < sequence.count; k++) {
        const wf_subframe_ref *ref = &sequence.refs[k];
        if (!ref->path) missing++;
        used += (size_t)snprintf(text + used, sizeof text - used, "%s:%s ",
                                 wf_number_text(ref->number, number, sizeof number),
                                 ref->path ? ref->path : "-");
    }
    snprintf(text + used, sizeof text - used, "/%s",
             wf_number_text(sequence.step, number, sizeof number));
    assert_string_equal(text, wanted);
    assert_int_equal(sequence.missing, missing);
    wf_sequence_free(&sequence);
}

/* ---- Patterns ---- */

static void output_names(void **state) {
    (void)state;
    const struct {
        const char *pattern;
        int64_t frame;
        const char *path; /* NULL: no pattern to write with */
    } cases[] = {
        {"out.####.png", 12, "out.0012.png"},
        {"out.#.png", 12, "out.0012.png"},
        {"out.##.png", 7, "out.07.png"},
        {"out.#####.png", 7, "out.00007.png"},
        {"out.@@@.png", 7, "out.007.png"},
        {"out.@.png", 7, "out.7.png"},
        {"out.%04d.png", 12, "out.0012.png"},
        {"out.%d.png", 12, "out.12.png"},
        {"out.%00d.png", 12, "out.12.png"},
        {"out.####.png", 123456, "out.123456.png"},
        {"d#/o.####.png", 1, "d#/o.0001.png"},
        {"a%%b.%02d.png", 1, "a%b.01.png"},
        {"me@x.####.png", 1, "me@x.0001.png"},
        {"####", 1, "0001"},
        {"/a/b.####", -3, "/a/b.-003"},
        {"out.png", 1, NULL},
        {"out.%4d.png", 1, NULL},
        {"out.%04i.png", 1, NULL},
        {"out.%s.png", 1, NULL},
        {"out.%", 1, NULL},
        {"out.##.##.png", 1, NULL},
        {"o#ut.##.png", 1, NULL},
        {"d.####/out.png", 1, NULL},
        {"", 1, NULL},
        {"out.%%.png", 1, NULL},
        {"out.%0999d.png", 1, NULL},
        {"out.%99999999999999999999d", 1, NULL},
        {"a@b@c.png", 1, NULL},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        char path[64] = "";
        bool made = wf_pattern_path(cases[i].pattern, cases[i].frame, path, sizeof path);
        if (made != (cases[i].path != NULL)) fail_msg("%s gives %s", cases[i].pattern, path);
        if (made) assert_string_equal(path, cases[i].path);
        if (made) assert_true(wf_pattern_is(cases[i].pattern));
    }
    char small[12];
    assert_false(wf_pattern_path("out.####.png", 1, small, sizeof small));
    assert_true(wf_pattern_is("shot.#.#.exr"));
    assert_false(wf_pattern_is("shot.exr"));
}

static void names_that_patterns_match(void **state) {
    (void)state;
    const struct {
        const char *pattern, *name;
        wf_rational number; /* {0, 0}: no match */
    } cases[] = {
        {"s.####.exr", "s.0007.exr", {7, 1}},
        {"s.####.exr", "s.10007.exr", {10007, 1}},
        {"s.####.exr", "s.007.exr", {0, 0}},
        {"s.#.exr", "s.7.exr", {7, 1}},
        {"s.#.exr", "s.0007.exr", {7, 1}},
        {"s.@@.exr", "s.7.exr", {0, 0}},
        {"s.%d.exr", "s.7.exr", {7, 1}},
        {"s.%04d.exr", "s.-003.exr", {-3, 1}},
        {"s.####.exr", "s.-0003.exr", {-3, 1}},
        {"s.####.exr", "s.--003.exr", {0, 0}},
        {"s.####.exr", "s.1001.25.exr", {0, 0}},
        {"s.#.#.exr", "s.1001.25.exr", {4005, 4}},
        {"s.#.#.exr", "s.1001.exr", {1001, 1}},
        {"s.#.#.exr", "s.1001..exr", {0, 0}},
        {"s.#.##.exr", "s.1001.5.exr", {0, 0}},
        {"s.#.#.exr", "s.-1.5.exr", {-3, 2}},
        {"s.%04d.%02d.exr", "s.0001.50.exr", {3, 2}},
        {"s.####.exr", "s.0007.exr.bak", {0, 0}},
        {"s.####.exr", "t.0007.exr", {0, 0}},
        {"s.####.exr", "s..exr", {0, 0}},
        {"####", "0007", {7, 1}},
        {"s####", "s0007", {7, 1}},
        {"s.#.exr", "s.9223372036854775807.exr", {INT64_MAX, 1}},
        {"s.#.exr", "s.9223372036854775808.exr", {0, 0}},
        {"s.#.#.exr", "s.1.000000001.exr", {1000000001, 1000000000}},
        {"s.#.#.exr", "s.1.000000000001.exr", {1000000000001, 1000000000000}},
        {"s.#.#.exr", "s.1.0000000000019.exr", {1000000000001, 1000000000000}},
        {"s.#.#.exr", "s.1.5000000000.exr", {3, 2}},
        {"s.#.#.exr", "s.9999999999999.999999999.exr", {0, 0}},
        {"s.#.#.exr", "s.9223372036.854775807.exr", {INT64_MAX, 1000000000}},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        wf_pattern pattern;
        wf_rational number = {0, 0};
        char why[256];
        assert_int_equal(wf_pattern_parse(cases[i].pattern, &pattern, why, sizeof why),
                         WF_PATTERN_OK);
        bool matched = wf_pattern_match(&pattern, cases[i].name, &number);
        if (matched != (cases[i].number.den != 0) || !wf_ratio_equal(number, cases[i].number))
            fail_msg("%s and %s: %" PRId64 "/%" PRId64, cases[i].pattern, cases[i].name,
                     number.num, number.den);
    }
}

static void a_pattern(void **state) {
    (void)state;
    touch_range("a.%04d.exr", 1, 3);
    touch("a.0005.exr");
    touch("b.0004.exr");
    touch("a.exr");
    assert_int_equal(mkdir("a.0009.exr", 0777), 0);
    const char *all = "1:a.0001.exr 2:a.0002.exr 3:a.0003.exr 4:- 5:a.0005.exr /1";
    check(expand("a.####.exr", NULL), all);
    check(expand("a.@@@@.exr", NULL), all);
    check(expand("a.%04d.exr", NULL), all);
    check(expand("a.#.exr", NULL), all);
    check(expand("./a.####.exr", "2"), "2:./a.0002.exr /1");
    check(expand("a.####.exr", "1-5x2"), "1:a.0001.exr 3:a.0003.exr 5:a.0005.exr /2");
    check(expand("a.####.exr", "2-6x2"), "2:a.0002.exr 4:- 6:- /2");
    check(expand("a.####.exr", "-1-1"), "-1:- 0:- 1:a.0001.exr /1");
    check(expand("a.####.exr", "5,1-2"), "1:a.0001.exr 2:a.0002.exr 5:a.0005.exr /1");
    check(expand("a.####.exr", "1-3x0.5"),
          "1:a.0001.exr 1.5:- 2:a.0002.exr 2.5:- 3:a.0003.exr /0.5");
    char path[PATH_MAX + 32], wanted[PATH_MAX + 64];
    snprintf(path, sizeof path, "%s/b.####.exr", root);
    snprintf(wanted, sizeof wanted, "4:%s/b.0004.exr /1", root);
    check(expand(path, NULL), wanted);
}

static void negative_numbers(void **state) {
    (void)state;
    touch("n.-0002.exr");
    touch("n.-001.exr");
    touch("n.0000.exr");
    touch("n.0001.exr");
    const char *all = "-2:n.-0002.exr -1:n.-001.exr 0:n.0000.exr 1:n.0001.exr /1";
    check(expand("n.####.exr", NULL), all);
    check(expand("n.####.exr", "-2-1"), all);
    check(expand("n.####.exr", "-2--1"), "-2:n.-0002.exr -1:n.-001.exr /1");
    check(expand(".", NULL),
          "-2:./n.-0002.exr -1:./n.-001.exr 0:./n.0000.exr 1:./n.0001.exr /1");
}

/* The step is told in the files' own: what the rate they state is divided by. */
static void subframes(void **state) {
    (void)state;
    const char *names[] = {"s.1001.exr",    "s.1001.25.exr", "s.1001.5.exr",
                           "s.1001.75.exr", "s.1002.00.exr", "s.1002.5.exr"};
    for (size_t i = 0; i < LENGTH(names); i++) touch(names[i]);
    const char *all =
        "1001:s.1001.exr 1001.25:s.1001.25.exr 1001.5:s.1001.5.exr "
        "1001.75:s.1001.75.exr 1002:s.1002.00.exr 1002.25:- 1002.5:s.1002.5.exr /1";
    check(expand("s.#.#.exr", NULL), all);
    check(expand("s.####.#.exr", "1001-1002.5x0.25"), all);
    check(expand("s.#.#.exr", "1001-1001.75x1/4"),
          "1001:s.1001.exr 1001.25:s.1001.25.exr 1001.5:s.1001.5.exr 1001.75:s.1001.75.exr /1");
    check(expand("s.#.#.exr", "1001-1002x0.5"),
          "1001:s.1001.exr 1001.5:s.1001.5.exr 1002:s.1002.00.exr /2");
    check(expand("s.#.#.exr", "1001-1002"), "1001:s.1001.exr 1002:s.1002.00.exr /4");
    check(expand("s.####.exr", NULL), "1001:s.1001.exr /1");
    refused("s.#.#.exr", "1001-1002x8270111995715736914", WEFT_USAGE, "too long or too fine");
    touch("s.1001.0.exr");
    refused("s.#.#.exr", NULL, WEFT_FAILED, "1001 is there twice|s.1001.exr|s.1001.0.exr");
}

/* As far from each other as numbers can be. */
static void far_subframes(void **state) {
    (void)state;
    touch("s.0.000000001.exr");
    touch("s.9223172036.999999999.exr");
    wf_sequence s = expand("s.#.#.exr", NULL);
    assert_int_equal(s.count, 2);
    assert_int_equal(s.missing, 0);
    wf_sequence_free(&s);
    touch("s.0.000000002.exr");
    refused("s.#.#.exr", NULL, WEFT_FAILED, "0.000000001 to 9223172036.999999999|--frames");
}

static void signs_that_are_names(void **state) {
    (void)state;
    touch("odd.####.exr");
    touch("odd.0001.exr");
    touch("100%.exr");
    check(expand("odd.####.exr", NULL), "0:odd.####.exr /1");
    check(expand("100%.exr", NULL), "100:100%.exr /1");
    touch("line\nbreak.0001.exr");
    touch("line\nbreak.0002.exr");
    check(expand("line\nbreak.####.exr", NULL),
          "1:line\nbreak.0001.exr 2:line\nbreak.0002.exr /1");
    refused("line\nbroken.####.exr", NULL, WEFT_FAILED, "line?broken.####.exr|matches no file");
    refused("50%.exr", NULL, WEFT_USAGE, "50%.exr|%04d|%%");
    refused("a.%s.exr", NULL, WEFT_USAGE, "%04d");
    refused("a##b##.exr", NULL, WEFT_USAGE, "more than one frame field");
}

/* ---- What is wrong ---- */

static void nothing_there(void **state) {
    (void)state;
    touch_range("beauty.%04d.exr", 1, 48);
    touch_range("depth.%d.exr", 9, 12);
    touch("notes.txt");
    refused("shot.####.exr", NULL, WEFT_FAILED,
            "shot.####.exr matches no file|beauty.####.exr 1-48|depth.#.exr 9-12");
    refused("shot.exr", NULL, WEFT_FAILED, "shot.exr: No such file|beauty.####.exr 1-48");
    refused("none/shot.####.exr", NULL, WEFT_FAILED, "none/|No such file");
    refused("notes.txt/shot.####.exr", NULL, WEFT_FAILED, "Not a directory");
    refused("beauty.####.exr", "60-70", WEFT_FAILED, "--frames 60-70|1 to 48");
    refused("", NULL, WEFT_USAGE, "empty");
    refused_all((char *[]){""}, 0, NULL, WEFT_USAGE, "no input");
    assert_int_equal(mkdir("empty", 0777), 0);
    refused("empty", NULL, WEFT_FAILED, "no numbered pictures");
    refused("empty/x.####.exr", NULL, WEFT_FAILED, "no numbered pictures");
}

static void one_number_twice(void **state) {
    (void)state;
    touch("a.1.exr");
    touch("a.0001.exr");
    touch("a.0002.exr");
    refused("a.#.exr", NULL, WEFT_FAILED, "1 is there twice|a.1.exr|a.0001.exr");
    refused(".", NULL, WEFT_FAILED, "1 is there twice|a.1.exr|a.0001.exr");
    check(expand("a.####.exr", NULL), "1:a.0001.exr 2:a.0002.exr /1");
}

static void ranges_that_will_not_do(void **state) {
    (void)state;
    touch_range("a.%04d.exr", 1, 9);
    const struct {
        const char *frames, *words;
    } cases[] = {
        {"1-10:2", "1-10x2"},
        {"1:10", "write 1-10"},
        {"1-4,5-9:2", "1-4,5-9x2"},
        {"9-1", "backwards|1-9"},
        {"", "will not do"},
        {"x", "will not do"},
        {"1-", "will not do"},
        {"-", "will not do"},
        {"1-9x", "will not do"},
        {"1-9x0", "will not do"},
        {"1-9x-1", "will not do"},
        {"1,", "will not do"},
        {",1", "will not do"},
        {"1,,2", "will not do"},
        {"1 - 9", "will not do"},
        {"1-9y2", "will not do"},
        {"1..9", "will not do"},
        {"1-9x2x2", "will not do"},
        {"1,1", "1 twice"},
        {"1-5,5-9", "5 twice"},
        {"1-9,2.0", "2 twice"},
        {"0-10000000", "more than 10000000"},
        {"1-9223372036854775807", "more than 10000000"},
        {"-9223372036854775807-9223372036854775807", "more than 10000000"},
        {"99999999999999999999", "will not do"},
        {"0-9999999,20000000", "more than 10000000"},
        {"1-5,6-9x3", "different steps"},
    };
    for (size_t i = 0; i < LENGTH(cases); i++)
        refused("a.####.exr", cases[i].frames, WEFT_USAGE, cases[i].words);
    touch("a.99999999.exr");
    refused("a.####.exr", NULL, WEFT_FAILED, "--frames|99999999");
}

static void steps_of_ranges(void **state) {
    (void)state;
    touch_range("a.%04d.exr", 1, 20);
    const struct {
        const char *frames;
        size_t count;
        wf_rational step;
    } cases[] = {
        {"1-20", 20, {1, 1}},         {"1-20x2", 10, {2, 1}},
        {"1,3,5", 3, {2, 1}},         {"4", 1, {1, 1}},
        {"4-5x2", 1, {2, 1}},         {"1-19x2,2-20x2", 20, {1, 1}},
        {"1-5x2,11-15x2", 6, {2, 1}}, {"1-20x20", 1, {20, 1}},
        {"11-20,1-10", 20, {1, 1}},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        wf_sequence s = expand("a.####.exr", cases[i].frames);
        assert_int_equal(s.count, cases[i].count);
        assert_true(wf_ratio_equal(s.step, cases[i].step));
        for (size_t k = 1; k < s.count; k++)
            assert_true(wf_number_order(s.refs[k - 1].number, s.refs[k].number) < 0);
        wf_sequence_free(&s);
    }
    refused("a.####.exr", "1-20x3,20", WEFT_USAGE, "different steps");
}

/* ---- Directories ---- */

static void a_directory(void **state) {
    (void)state;
    assert_int_equal(mkdir("d", 0777), 0);
    touch_range("d/a_v2.%04d.exr", 1, 2);
    touch("d/.a_v2.0003.exr");
    touch("d/slate.exr");
    touch("d/render.0001.log");
    touch("d/render.0002.log");
    touch("d/Thumbs.db");
    check(expand("d", NULL), "1:d/a_v2.0001.exr 2:d/a_v2.0002.exr /1");
    check(expand("d/", "2-3"), "2:d/a_v2.0002.exr 3:- /1");
    touch_range("d/a_v3.%04d.exr", 1, 3);
    refused("d", NULL, WEFT_FAILED, "a_v2.####.exr 1-2|a_v3.####.exr 1-3");
    for (int i = 0; i < 10; i++) {
        char format[32];
        snprintf(format, sizeof format, "d/%c.%%d.png", 'a' + i);
        touch_range(format, 1, 2);
    }
    refused("d", NULL, WEFT_FAILED, "a_v3.####.exr 1-3|f.#.png 1-2|, ..");
}

static void a_directory_of_subframes(void **state) {
    (void)state;
    assert_int_equal(mkdir("d", 0777), 0);
    assert_int_equal(mkdir("one", 0777), 0);
    assert_int_equal(mkdir("scenes", 0777), 0);
    for (int i = 0; i < 8; i++) {
        char name[64];
        snprintf(name, sizeof name, "d/s.%d.%02d.exr", 1001 + i / 4, i % 4 * 25);
        touch(name);
        snprintf(name, sizeof name, "scenes/s.%d.%04d.exr", 10 + 10 * (i / 4), i % 4);
        touch(name);
        snprintf(name, sizeof name, "one/s.010.%04d.exr", i + 9);
        touch(name);
    }
    wf_sequence s = expand("d", NULL);
    assert_int_equal(s.count, 8);
    assert_int_equal(s.missing, 0);
    assert_true(wf_ratio_equal(s.refs[5].number, wf_ratio(4009, 4)));
    assert_true(wf_ratio_equal(s.step, wf_ratio(1, 1)));
    wf_sequence_free(&s);
    refused("scenes", NULL, WEFT_FAILED, "s.10.####.exr 0-3|s.20.####.exr 0-3");
    s = expand("one", NULL);
    assert_int_equal(s.count, 8);
    assert_true(wf_ratio_equal(s.refs[0].number, wf_ratio(9, 1)));
    wf_sequence_free(&s);
}

static void a_directory_of_one_file(void **state) {
    (void)state;
    assert_int_equal(mkdir("d", 0777), 0);
    touch("d/a.0007.exr");
    touch("d/notes.txt");
    check(expand("d", NULL), "7:d/a.0007.exr /1");
}

static void a_directory_that_cannot_be_read(void **state) {
    (void)state;
    assert_int_equal(mkdir("d", 0000), 0);
    assert_int_equal(chmod(".", 0755), 0);
    pid_t child = fork();
    if (!child) { /* root reads everything: as somebody else */
        wf_sequence sequence;
        weft_error err;
        char *input = (char *)"d";
        if (!geteuid() && setuid(65534)) _exit(77);
        if (wf_sequence_expand(&input, 1, NULL, &sequence, &err) != WEFT_FAILED) _exit(1);
        _exit(!strstr(err.text, "d/: ") || !strstr(err.text, "Permission denied"));
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    if (WEXITSTATUS(status) != 77) {
        assert_int_equal(WEXITSTATUS(status), 0);
        return;
    }
    print_message("skipped: root reads every directory, and cannot become anybody else\n");
    skip();
}

/* ---- Lists ---- */

static void lists_of_files(void **state) {
    (void)state;
    touch_range("a.%04d.exr", 1, 9);
    touch("b.exr");
    touch("c.exr");
    char *gap[] = {"a.0001.exr", "a.0002.exr", "a.0004.exr"};
    char *back[] = {"a.0002.exr", "a.0001.exr"};
    char *mixed[] = {"b.exr", "a.0002.exr", "c.exr"};
    char *twice[] = {"b.exr", "c.exr", "b.exr"};
    char *pattern[] = {"b.exr", "a.####.exr"};
    char *directory[] = {"b.exr", "."};
    char *absent[] = {"b.exr", "d.exr"};
    check(expand_all(gap, 3, NULL), "1:a.0001.exr 2:a.0002.exr 3:- 4:a.0004.exr /1");
    check(expand_all(gap, 3, "1-4x3"), "1:a.0001.exr 4:a.0004.exr /3");
    check(expand_all(back, 2, NULL), "1:a.0001.exr 2:a.0002.exr /1");
    check(expand_all(mixed, 3, NULL), "0:b.exr 1:a.0002.exr 2:c.exr /1");
    check(expand_all(mixed, 3, "1-2"), "1:a.0002.exr 2:c.exr /1");
    refused_all(twice, 3, NULL, WEFT_USAGE, "b.exr|given twice");
    refused_all(pattern, 2, NULL, WEFT_USAGE,
                "a.####.exr|one pattern, one directory, or files");
    refused_all(directory, 2, NULL, WEFT_USAGE, "a directory stands alone");
    refused_all(absent, 2, NULL, WEFT_FAILED, "d.exr: No such file|a.####.exr 1-9");
    touch("s.1.25.exr");
    touch("s.1.5.exr");
    touch("s.1.75.exr");
    char *fractions[] = {"s.1.5.exr", "s.1.75.exr", "s.1.25.exr"};
    check(expand_all(fractions, 3, NULL), "1.25:s.1.25.exr 1.5:s.1.5.exr 1.75:s.1.75.exr /1");
}

/* What a shell makes of s.*.exr. */
static void lists_in_the_order_of_a_shell(void **state) {
    (void)state;
    touch_range("s.%d.exr", 8, 11);
    char *shell[] = {"s.10.exr", "s.11.exr", "s.8.exr", "s.9.exr"};
    check(expand_all(shell, 4, NULL), "8:s.8.exr 9:s.9.exr 10:s.10.exr 11:s.11.exr /1");
    touch("t.1001.5.exr");
    touch("t.1001.exr");
    touch("t.1002.5.exr");
    touch("t.1002.exr");
    char *halves[] = {"t.1001.5.exr", "t.1001.exr", "t.1002.5.exr", "t.1002.exr"};
    check(expand_all(halves, 4, NULL),
          "1001:t.1001.exr 1001.5:t.1001.5.exr 1002:t.1002.exr 1002.5:t.1002.5.exr /1");
    char *mixed[] = {"s.9.exr", "t.1001.exr", "s.8.exr"};
    check(expand_all(mixed, 3, NULL), "0:s.9.exr 1:t.1001.exr 2:s.8.exr /1");
    touch("s.08.exr");
    char *twice[] = {"s.9.exr", "s.08.exr", "s.8.exr"};
    refused_all(twice, 3, NULL, WEFT_FAILED, "8 is there twice");
}

/* The number that names differ in counts, wherever it is. */
static void numbers_before_others(void **state) {
    (void)state;
    assert_int_equal(mkdir("v", 0777), 0);
    touch_range("v/sc01_%02d_v003.exr", 8, 11);
    touch("v/sc01_11_v004.exr");
    check(expand("v", NULL), "8:v/sc01_08_v003.exr 9:v/sc01_09_v003.exr "
                             "10:v/sc01_10_v003.exr 11:v/sc01_11_v003.exr /1");
    touch_range("s_%d_v3.exr", 9, 11);
    char *shell[] = {"s_10_v3.exr", "s_11_v3.exr", "s_9_v3.exr"};
    check(expand_all(shell, 3, NULL), "9:s_9_v3.exr 10:s_10_v3.exr 11:s_11_v3.exr /1");
    touch("s_9.5_v3.exr");
    char *half[] = {"s_10_v3.exr", "s_9.5_v3.exr", "s_9_v3.exr"};
    check(expand_all(half, 3, NULL), "9:s_9_v3.exr 9.5:s_9.5_v3.exr 10:s_10_v3.exr /1");
}

/* Thirds as programs print doubles. */
static void thirds_of_many_decimals(void **state) {
    (void)state;
    for (int decimals = 8; decimals <= 16; decimals++) {
        char directory[16], name[64];
        snprintf(directory, sizeof directory, "d%d", decimals);
        assert_int_equal(mkdir(directory, 0777), 0);
        for (int i = 0; i < 9; i++) {
            snprintf(name, sizeof name, "%s/f.%.*f.exr", directory, decimals, 1001 + i / 3.0);
            touch(name);
        }
        wf_sequence s = expand(directory, NULL);
        assert_int_equal(s.count, 9);
        assert_int_equal(s.missing, 0);
        assert_true(wf_ratio_equal(s.number_step, wf_ratio(1, 3)));
        wf_sequence_free(&s);
    }
}

/* ---- What numbers mean ---- */

static void check_told(wf_sequence sequence, const char *wanted, const char *notice) {
    if (*notice ? !strstr(sequence.notice, notice) : *sequence.notice)
        fail_msg("not '%s': %s", notice, sequence.notice);
    check(sequence, wanted);
}

static void steps_of_numbers(void **state) {
    (void)state;
    const int numbers[] = {1, 5, 9, 13};
    for (int i = 0; i < 3; i++) touch_range("a.%04d.exr", numbers[i], numbers[i]);
    check_told(expand(".", NULL),
               "1:./a.0001.exr 2:- 3:- 4:- 5:./a.0005.exr 6:- 7:- 8:- 9:./a.0009.exr /1", "");
    touch("a.0013.exr");
    wf_sequence s = expand("a.####.exr", NULL);
    assert_true(s.stepped && wf_ratio_equal(s.number_step, wf_ratio(4, 1)));
    check_told(s, "1:a.0001.exr 5:a.0005.exr 9:a.0009.exr 13:a.0013.exr /1",
               "4 apart (1, 5, 9 ..)");
    s = expand("a.####.exr", "1-5");
    assert_true(!s.stepped && wf_ratio_equal(s.number_step, wf_ratio(1, 1)));
    check_told(s, "1:a.0001.exr 2:- 3:- 4:- 5:a.0005.exr /0.25", "");
    check_told(expand("a.####.exr", "1-9x4"), "1:a.0001.exr 5:a.0005.exr 9:a.0009.exr /1", "");
    touch("a.0021.exr");
    check_told(expand(".", NULL),
               "1:./a.0001.exr 5:./a.0005.exr 9:./a.0009.exr 13:./a.0013.exr 17:- "
               "21:./a.0021.exr /1",
               "4 apart");
    touch("a.0022.exr");
    s = expand(".", NULL);
    assert_int_equal(s.missing, 16);
    wf_sequence_free(&s);
}

static void a_directory_of_half_frames(void **state) {
    (void)state;
    for (int i = 1001; i < 1003; i++)
        touch_range("h.%d.exr", i, i), touch_range("h.%d.5.exr", i, i);
    check_told(expand(".", NULL),
               "1001:./h.1001.exr 1001.5:./h.1001.5.exr 1002:./h.1002.exr "
               "1002.5:./h.1002.5.exr /1",
               "");
    touch("slate.png");
    check_told(expand(".", "1001-1002"), "1001:./h.1001.exr 1002:./h.1002.exr /2",
               "of 5 pictures 4 are taken, which are h.####.#.exr 1001-1002.5");
}

/* ---- Random sequences against a plain reference ---- */

static uint32_t random_state = 1;
static int below(int end) {
    random_state = random_state * 1664525 + 1013904223;
    return (int)((uint64_t)random_state * (uint64_t)end >> 32);
}

/* Every whole of 1/parts from first on, written with some decimals, rounded or cut off, must be
 * read as itself: in doubles, which know nothing of how it is found. */
static void fractions_of_any_kind(void **state) {
    (void)state;
    for (int trial = 0; trial < 60; trial++) {
        int parts = 2 + below(23), decimals = 1 + below(4), count = 4 + below(40);
        int first = below(3000), scale = 1;
        bool cut = below(2), bare = below(2);
        for (int d = 0; d < decimals; d++) scale *= 10;
        if (3 * parts > scale) continue;
        char directory[32], name[96];
        snprintf(directory, sizeof directory, "d%d", trial);
        assert_int_equal(mkdir(directory, 0777), 0);
        for (int i = 0; i < count; i++) {
            int n = first + i, rest = n % parts;
            int written = cut ? rest * scale / parts : (2 * rest * scale + parts) / (2 * parts);
            int whole = n / parts + written / scale;
            if (bare && !rest)
                snprintf(name, sizeof name, "%s/f.%d.exr", directory, whole);
            else
                snprintf(name, sizeof name, "%s/f.%d.%0*d.exr", directory, whole, decimals,
                         written % scale);
            touch(name);
        }
        wf_sequence s = expand(directory, NULL);
        if (s.count != (size_t)count)
            fail_msg("%s of 1/%d: %zu, not %d", name, parts, s.count, count);
        assert_int_equal(s.missing, 0);
        for (int i = 0; i < count; i++)
            if (fabs(wf_ratio_value(s.refs[i].number) - (double)(first + i) / parts) > 1e-9)
                fail_msg("%s of 1/%d: %g", s.refs[i].path, parts,
                         wf_ratio_value(s.refs[i].number));
        assert_true(fabs(wf_ratio_value(s.number_step) - 1.0 / parts) < 1e-12);
        wf_sequence_free(&s);
    }
}

/* Whole numbers with random gaps, listed in random order: the step is the common gap where
 * three and more than half are it, else 1; what is not there is missing. */
static void random_gaps_and_orders(void **state) {
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        int count = 2 + below(12), step = 1 + below(5), wide = below(4), equal = 0, common = 0;
        int64_t number[16] = {below(100)};
        char name[16][32], *list[16];
        for (int i = 1; i < count; i++)
            number[i] = number[i - 1] + step * (below(4) < wide ? 1 + below(3) : 1);
        for (int i = 1; i < count; i++)
            for (int a = (int)(number[i] - number[i - 1]), b = common; a; common = b)
                if (b > a)
                    b -= a;
                else if (!b)
                    b = a, a = 0;
                else
                    a -= b;
        for (int i = 1; i < count; i++) equal += number[i] - number[i - 1] == common;
        int wanted = equal >= 3 && 2 * equal > count - 1 ? common : 1;
        for (int i = 0; i < count; i++) {
            snprintf(name[i], sizeof name[i], "r%d.%d.exr", trial, (int)number[i]);
            touch(name[i]);
            list[i] = name[i];
        }
        for (int i = count - 1; i > 0; i--) {
            int j = below(i + 1);
            char *other = list[i];
            list[i] = list[j];
            list[j] = other;
        }
        wf_sequence s = expand_all(list, (size_t)count, NULL);
        assert_true(wf_ratio_equal(s.number_step, wf_ratio(wanted, 1)));
        assert_int_equal(s.count, (number[count - 1] - number[0]) / wanted + 1);
        assert_int_equal(s.missing, s.count - (size_t)count);
        for (size_t k = 0, i = 0; k < s.count; k++) {
            assert_int_equal(s.refs[k].number.num, number[0] + (int64_t)k * wanted);
            bool there = number[i] == s.refs[k].number.num;
            if (there)
                assert_string_equal(s.refs[k].path, name[i++]);
            else
                assert_null(s.refs[k].path);
        }
        wf_sequence_free(&s);
    }
}

/* ---- Parts ---- */

static float gray(const void *user, int channel, int x, int y) {
    (void)user, (void)channel, (void)x, (void)y;
    return 0.5f;
}

/* Writes parts with these weft:time (NULL: none) to p.exr. */
static void write_parts(const char *const *times, int count) {
    exr_part parts[8];
    for (int i = 0; i < count; i++)
        parts[i] = (exr_part){.display = {0, 0, 4, 4},
                              .data = {0, 0, 4, 4},
                              .channels = "B G R",
                              .type = EXR_PIXEL_HALF,
                              .compression = EXR_COMPRESSION_NONE,
                              .time = times[i],
                              .value = gray};
    assert_true(exr_write("p.exr", parts, count));
}

static void parts_of_one_file(void **state) {
    (void)state;
    write_parts((const char *[]){"2/240", "0/1", "1/240", "4/240"}, 4);
    wf_sequence s = expand("p.exr", NULL);
    const int parts[] = {1, 2, 0, -1, 3};
    assert_int_equal(s.count, 5);
    assert_int_equal(s.missing, 1);
    assert_true(wf_ratio_equal(s.step, wf_ratio(1, 1)));
    for (int k = 0; k < 5; k++) {
        assert_int_equal(s.refs[k].part, parts[k]);
        assert_true(wf_ratio_equal(s.refs[k].number, wf_ratio(k, 1)));
        assert_int_equal(s.refs[k].path == NULL, k == 3);
    }
    wf_sequence_free(&s);
    s = expand(".", "0-2x2");
    assert_int_equal(s.count, 2);
    assert_int_equal(s.refs[1].part, 0);
    assert_true(wf_ratio_equal(s.step, wf_ratio(2, 1)));
    wf_sequence_free(&s);
    write_parts((const char *[]){NULL, NULL}, 2);
    check(expand("p.exr", NULL), "0:p.exr /1");
    write_parts((const char *[]){"1/240", "1/240"}, 2);
    refused("p.exr", NULL, WEFT_FAILED, "p.exr|parts 0 and 1|same weft:time");
    char *list[] = {"p.exr", "q.exr"};
    touch("q.exr");
    check(expand_all(list, 2, NULL), "0:p.exr 1:q.exr /1");
}

/* ---- Sizes ---- */

static void long_paths(void **state) {
    (void)state;
    char path[PATH_MAX + 600], name[251];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    size_t used = (size_t)snprintf(path, sizeof path, "%s", root);
    while (used + 2 * sizeof name < PATH_MAX) {
        used += (size_t)snprintf(path + used, sizeof path - used, "/%s", name);
        assert_int_equal(mkdir(path, 0777), 0);
    }
    snprintf(path + used, sizeof path - used, "/y.0001.exr");
    touch(path);
    snprintf(path + used, sizeof path - used, "/y.####.exr");
    wf_sequence s = expand(path, NULL);
    assert_int_equal(s.count, 1);
    wf_sequence_free(&s);
    snprintf(path + used, sizeof path - used, "/z.####.exr");
    refused(path, NULL, WEFT_FAILED, "/z.####.exr matches no file|y.0001.exr");
    while (used < PATH_MAX + 100)
        used += (size_t)snprintf(path + used, sizeof path - used, "/%s", name);
    snprintf(path + used, sizeof path - used, "/z.####.exr");
    refused(path, NULL, WEFT_FAILED, "File name too long");
    snprintf(path, sizeof path, "%sxxxx.####.exr", name);
    refused(path, NULL, WEFT_FAILED, "File name too long");
}

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A million names, in no order, without the file system's own time: a few seconds would mean
 * something quadratic. */
static void a_million_files(void **state) {
    (void)state;
    enum { COUNT = 1000000 };
    wf_names names = {0};
    for (int64_t i = 0; i < COUNT; i++) {
        char name[64];
        snprintf(name, sizeof name, "shot.%07" PRId64 ".exr", i * 7919 % COUNT);
        assert_true(wf_names_add(&names, name));
    }
    wf_pattern pattern;
    wf_numbered_list list;
    wf_sequence s;
    weft_error err;
    char why[256];
    double start = seconds();
    wf_pattern_parse("shot.#.exr", &pattern, why, sizeof why);
    assert_int_equal(wf_names_match(&names, &pattern, &list, &err), WEFT_OK);
    const wf_candidates from = {list.entry, list.count, "d/", "d/shot.#.exr", WF_RANGE_MOST};
    assert_int_equal(wf_select(&from, NULL, &s, &err), WEFT_OK);
    print_message("a million names: %.2f s\n", seconds() - start);
    assert_true(seconds() - start < 20);
    assert_int_equal(s.count, COUNT);
    assert_int_equal(s.missing, 0);
    assert_string_equal(s.refs[123456].path, "d/shot.0123456.exr");
    wf_sequence_free(&s);
    free(list.entry);
    wf_names_free(&names);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(output_names),
        cmocka_unit_test(names_that_patterns_match),
        cmocka_unit_test_setup_teardown(a_pattern, enter, leave),
        cmocka_unit_test_setup_teardown(negative_numbers, enter, leave),
        cmocka_unit_test_setup_teardown(subframes, enter, leave),
        cmocka_unit_test_setup_teardown(far_subframes, enter, leave),
        cmocka_unit_test_setup_teardown(signs_that_are_names, enter, leave),
        cmocka_unit_test_setup_teardown(nothing_there, enter, leave),
        cmocka_unit_test_setup_teardown(one_number_twice, enter, leave),
        cmocka_unit_test_setup_teardown(ranges_that_will_not_do, enter, leave),
        cmocka_unit_test_setup_teardown(steps_of_ranges, enter, leave),
        cmocka_unit_test_setup_teardown(a_directory, enter, leave),
        cmocka_unit_test_setup_teardown(a_directory_of_subframes, enter, leave),
        cmocka_unit_test_setup_teardown(a_directory_of_one_file, enter, leave),
        cmocka_unit_test_setup_teardown(a_directory_that_cannot_be_read, enter, leave),
        cmocka_unit_test_setup_teardown(lists_of_files, enter, leave),
        cmocka_unit_test_setup_teardown(lists_in_the_order_of_a_shell, enter, leave),
        cmocka_unit_test_setup_teardown(numbers_before_others, enter, leave),
        cmocka_unit_test_setup_teardown(thirds_of_many_decimals, enter, leave),
        cmocka_unit_test_setup_teardown(steps_of_numbers, enter, leave),
        cmocka_unit_test_setup_teardown(a_directory_of_half_frames, enter, leave),
        cmocka_unit_test_setup_teardown(fractions_of_any_kind, enter, leave),
        cmocka_unit_test_setup_teardown(random_gaps_and_orders, enter, leave),
        cmocka_unit_test_setup_teardown(parts_of_one_file, enter, leave),
        cmocka_unit_test_setup_teardown(long_paths, enter, leave),
        cmocka_unit_test(a_million_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
