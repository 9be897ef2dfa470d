/* Words of other programs lead to options and values that there are. */
#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "convert/job/job.h"
#include "convert/job/meant.h"
#include "convert/job/options.h"
#include "filters/aperture/aperture.h"

/* The commands whose options people know by other names; `plan` has a --size of its own. */
enum { MAKE = WF_TAKEN_BY_CONVERT | WF_TAKEN_BY_RENDER | WF_TAKEN_BY_TRACE };

/* An option of any of those commands. */
static bool is_option(const char *name, unsigned commands) {
    weft_option option;
    for (size_t i = 0; weft_option_at(i, &option); i++)
        if (!strcmp(option.name, name)) return wf_option_commands(i) & commands;
    return false;
}

/* The first word of a value, without a comma at its end. */
static void first_word(const char *text, char word[64]) {
    size_t length = strcspn(text, " ");
    if (length && text[length - 1] == ',') length--;
    if (length && text[length - 1] == ':') length--;
    snprintf(word, 64, "%.*s", (int)length, text);
}

static void every_row_leads_somewhere(void **state) {
    const wf_meant *m;
    (void)state;
    for (size_t i = 0; (m = wf_meant_at(i)); i++) {
        char word[64];
        weft_error err = {""};
        for (const char *c = m->said; *c; c++) assert_false(isupper((unsigned char)*c));
        assert_string_equal(wf_meant_by(m->option, m->said), m->right);
        if (!*m->option) {
            if (!is_option(m->right + 2, MAKE) || is_option(m->said, MAKE))
                fail_msg("--%s", m->said);
            continue;
        }
        assert_true(is_option(m->option, MAKE));
        weft_job *job = weft_job_new();
        assert_non_null(job);
        first_word(m->right, word);
        if (!strncmp(m->right, "Y4M into ffmpeg", 15)) word[0] = '\0';
        if (*word && !strchr(word, 'C') && weft_job_set(job, m->option, word, &err))
            fail_msg("--%s %s: %s", m->option, word, err.text);
        if (!weft_job_set(job, m->option, m->said, &err))
            fail_msg("--%s %s is one", m->option, m->said);
        if (!strstr(err.text, m->right)) fail_msg("--%s %s: %s", m->option, m->said, err.text);
        weft_job_free(job);
    }
}

static void what_is_not_known_is_left(void **state) {
    (void)state;
    assert_null(wf_meant_by("", "nonsense"));
    assert_null(wf_meant_by("dither", "nonsense"));
    assert_null(wf_meant_by("fit", "triangular"));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_row_leads_somewhere),
                                       cmocka_unit_test(what_is_not_known_is_left)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
