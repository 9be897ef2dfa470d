/* Runs the jobs of a test through the public interface, in a directory of their own. */
#include "tests/unit/support/jobs.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

char job_directory[64] = "/tmp/weft-jobs-XXXXXX";

int job_make_directory(void **state) {
    (void)state;
    return mkdtemp(job_directory) ? 0 : -1;
}

void job_clean(void) {
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s/*", job_directory);
    assert_int_equal(system(command), 0);
}

int job_remove_directory(void **state) {
    (void)state;
    job_clean();
    return rmdir(job_directory);
}

void job_path(char path[512], const char *name) {
    snprintf(path, 512, "%s/%s", job_directory, name);
}

weft_status job_set(weft_job *job, const char *options, weft_error *err) {
    char words[512], *rest = NULL;
    weft_status status = WEFT_OK;
    snprintf(words, sizeof words, "%s", options);
    for (char *word = strtok_r(words, " ", &rest); word && !status;
         word = strtok_r(NULL, " ", &rest)) {
        char *value = strchr(word, '=');
        if (value) *value++ = '\0';
        status = weft_job_set(job, word, value, err);
    }
    return status;
}

void job_oiiotool(const char *arguments) {
    char command[1024];
    if (system("command -v oiiotool >/dev/null")) {
        print_message("skipped: no oiiotool\n");
        skip();
    }
    snprintf(command, sizeof command, "cd %s && oiiotool %s >log 2>&1", job_directory,
             arguments);
    if (system(command)) fail_msg("oiiotool %s", arguments);
}

/* Runs in.####.exr -> output with the options "name=value ..". */
weft_status job_run(const char *options, const char *output, char report[JOB_REPORT],
                    weft_error *err) {
    char path[512];
    weft_job *job = weft_job_new();
    assert_non_null(job);
    job_path(path, "in.####.exr");
    assert_int_equal(weft_job_add_input(job, path, err), WEFT_OK);
    job_path(path, output);
    assert_int_equal(weft_job_set_output(job, path, err), WEFT_OK);
    weft_status status = job_set(job, options, err);
    if (!status) status = weft_job_run(job, err);
    if (report) snprintf(report, JOB_REPORT, "%s", weft_job_report(job));
    weft_job_free(job);
    if (status && err && strstr(err->text, "which this weft was built without")) {
        print_message("skipped: %s\n", err->text);
        skip();
    }
    return status;
}

void job_done(const char *options, const char *output, char report[JOB_REPORT]) {
    weft_error err = {""};
    if (job_run(options, output, report, &err))
        fail_msg("%s -> %s: %s", options, output, err.text);
}

void job_refused(const char *options, const char *output, weft_status status,
                 const char *word) {
    weft_error err = {""};
    weft_status got = job_run(options, output, NULL, &err);
    if (got != status || !strstr(err.text, word))
        fail_msg("%s -> %s: status %d, '%s'; expected %d and '%s'", options, output, (int)got,
                 err.text, (int)status, word);
}

double job_number(const char *report, const char *key) {
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\":", key);
    const char *found = strstr(report, quoted);
    if (!found) fail_msg("the report has no %s:\n%s", key, report);
    return found ? strtod(found + strlen(quoted), NULL) : 0;
}

uint8_t *job_file(const char *name, size_t *size) {
    char path[512];
    job_path(path, name);
    FILE *file = fopen(path, "rb");
    if (!file) fail_msg("%s was not written", path);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    uint8_t *bytes = malloc(*size + 1);
    assert_true(bytes && fread(bytes, 1, *size, file) == *size);
    fclose(file);
    return bytes;
}

void job_same(const char *name, const uint8_t *bytes, size_t size) {
    size_t other_size;
    uint8_t *other = job_file(name, &other_size);
    assert_int_equal(other_size, size);
    if (memcmp(bytes, other, size)) fail_msg("%s has other bytes", name);
    free(other);
}
