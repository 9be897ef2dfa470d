/* Modules: those that were built are found from where this program is, others are said to be
 * absent. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/base/module.h"

static void an_absent_module(void **state) {
    (void)state;
    void *symbol = state;
    weft_error err = {""};
    assert_int_equal(wf_module_symbol("nonesuch", "anything", "a.b: C", &symbol, &err),
                     WEFT_FAILED);
    assert_null(symbol);
    assert_int_equal(strncmp(err.text, "a.b: C needs ", 13), 0);
    assert_non_null(strstr(err.text, "built without"));
    assert_int_equal(wf_module_check("nonesuch", "a.b: C", &err), WEFT_FAILED);
    assert_int_equal(strncmp(err.text, "a.b: C needs ", 13), 0);
    assert_int_equal(wf_module_symbol("nonesuch", "anything", "it", &symbol, NULL),
                     WEFT_FAILED);
}

/* Modules are there, or what would bring them is said, whatever this build has. */
static void each_module(void **state) {
    (void)state;
    static const struct {
        const char *name, *library, *debian;
    } rows[] = {{"oiio", "OpenImageIO", "libopenimageio-dev"},
                {"ocio", "OpenColorIO", "libopencolorio-dev"},
                {"plot", "Cairo", "libcairo2-dev"},
                {"libav", "libav", "libavformat-dev"},
                {"deinterlace", "libavfilter", "libavfilter-dev"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char says[128];
        weft_error err = {""};
        if (!wf_module_check(rows[i].name, "x", &err)) continue;
        print_message("%s\n", err.text);
        snprintf(says, sizeof says, "x needs %s, which this weft was built without: install %s",
                 rows[i].library, rows[i].debian);
        assert_int_equal(strncmp(err.text, says, strlen(says)), 0);
    }
}

/* Whether the build has made the plot module; sets *known false if there is no build to look
 * at. */
static bool was_built(bool *known) {
    char command[4352];
    const char *build = getenv("WEFT_BUILD");
    *known = build && strlen(build) < 4096;
    if (!*known) return false;
    snprintf(command, sizeof command, "find '%s' -name weft-plot.so | grep -q .", build);
    return !system(command);
}

static void *find_plot(void *arg) {
    (void)arg;
    void *symbol = NULL;
    weft_error err;
    return wf_module_symbol("plot", "wf_plot_draw", "a plot", &symbol, &err) ? NULL : symbol;
}

static void modules_of_the_build(void **state) {
    (void)state;
    bool known, built = was_built(&known);
    if (!known || !built) {
        print_message("skipped: %s\n",
                      known ? "the plot module was not built" : "WEFT_BUILD is unset");
        skip();
    }
    void *symbol;
    weft_error err = {""};
    if (wf_module_symbol("plot", "wf_plot_draw", "a plot", &symbol, &err))
        fail_msg("%s", err.text);
    assert_int_equal(wf_module_symbol("plot", "wf_nonesuch", "a plot", &symbol, &err),
                     WEFT_FAILED);
    assert_non_null(strstr(err.text, "another version"));
    assert_non_null(strstr(err.text, "wf_nonesuch"));
}

/* From anywhere, and from many threads at once: one module. */
static void threads(void **state) {
    (void)state;
    enum { THREADS = 8 };
    pthread_t thread[THREADS];
    void *found, *first = find_plot(NULL);
    if (!first) skip();
    assert_int_equal(chdir("/"), 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&thread[i], NULL, find_plot, NULL), 0);
    for (int i = 0; i < THREADS; i++) {
        pthread_join(thread[i], &found);
        assert_ptr_equal(found, first);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_absent_module),
        cmocka_unit_test(each_module),
        cmocka_unit_test(modules_of_the_build),
        cmocka_unit_test(threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
