/* Tests which names of files take the place of which, and errors that call one otherwise. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "convert/base/names.h"

static void test_replaces(void **unused) {
    static const struct {
        const char *path, *other;
        bool replaces;
    } rows[] = {
        {"a.png", "a.png", true},           {"./a.png", "a.png", true},
        {"a.0000.png", "a.####.png", true}, {"a.0012.png", "./a.%04d.png", true},
        {"a.png", "a.####.png", false},     {"a.0000.exr", "a.####.png", false},
        {"a.12.png", "a.####.png", false},  {"/tmp/a.png", "/a.png", false},
        {"/tmp/../a.png", "/a.png", true},  {"nowhere/a.png", "a.png", false},
        {"/dev/null", "/dev/zero", false},
    };
    (void)unused;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (wf_name_replaces(rows[i].path, rows[i].other) != rows[i].replaces)
            fail_msg("%s and %s", rows[i].path, rows[i].other);
}

/* Links are names of the file that they lead to. */
static void test_links(void **unused) {
    char folder[] = "/tmp/weft-names-XXXXXX", file[64], link_name[64];
    (void)unused;
    assert_non_null(mkdtemp(folder));
    snprintf(file, sizeof file, "%s/a", folder);
    snprintf(link_name, sizeof link_name, "%s/b", folder);
    FILE *made = fopen(file, "w");
    assert_non_null(made);
    fclose(made);
    assert_false(wf_name_replaces(link_name, file));
    assert_int_equal(symlink(file, link_name), 0);
    assert_true(wf_name_replaces(link_name, file));
    unlink(link_name);
    unlink(file);
    rmdir(folder);
}

static void test_rename(void **unused) {
    weft_error err;
    (void)unused;
    wf_fail(&err, WEFT_FAILED, "/proc/self/fd/3: cut off");
    wf_error_rename(&err, "/proc/self/fd/3", "box");
    assert_string_equal(err.text, "box: cut off");
    wf_error_rename(&err, "", "line");
    wf_error_rename(&err, "shaped", "line");
    assert_string_equal(err.text, "box: cut off");
    wf_error_rename(NULL, "box", "line");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_replaces),
                                       cmocka_unit_test(test_links),
                                       cmocka_unit_test(test_rename)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
