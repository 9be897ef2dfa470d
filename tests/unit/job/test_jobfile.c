/* Job files: that they say what options say, which of two wins, and what is refused where. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/job/jobfile.h"
#include "tests/unit/support/jobs.h"

static void write_job(char path[512], const char *name, const char *bytes, size_t size) {
    job_path(path, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static weft_status load_bytes(weft_job *job, const char *bytes, size_t size, weft_error *err) {
    char path[512];
    write_job(path, "job.json", bytes, size);
    return weft_job_load(job, path, err);
}

static weft_job *loaded(const char *json) {
    weft_error err = {""};
    weft_job *job = weft_job_new();
    assert_non_null(job);
    if (load_bytes(job, json, strlen(json), &err)) fail_msg("%s: %s", json, err.text);
    return job;
}

/* Every value of a job beside its strings, and the strings. */
static void same_jobs(const weft_job *a, const weft_job *b) {
    assert_string_equal(a->raster.name, b->raster.name);
    assert_string_equal(a->frames, b->frames);
    assert_int_equal(a->temporal_width.num, b->temporal_width.num);
    assert_int_equal(a->temporal_width.den, b->temporal_width.den);
    assert_int_equal(a->subframe_rate.num, b->subframe_rate.num);
    assert_int_equal(a->subframe_rate.den, b->subframe_rate.den);
    assert_int_equal(a->samples, b->samples);
    assert_int_equal(a->bits, b->bits);
    assert_int_equal(a->fit, b->fit);
    assert_int_equal(a->skip, b->skip);
    assert_int_equal(a->overwrite, b->overwrite);
    assert_int_equal(a->max_memory_bytes, b->max_memory_bytes);
    assert_int_equal(a->param_count, b->param_count);
    for (size_t i = 0; i < a->param_count; i++) assert_string_equal(a->params[i], b->params[i]);
}

static void says_what_options_say(void **state) {
    (void)state;
    static const char *const set[][2] = {{"raster", "625i"},
                                         {"frames", "1-9x2"},
                                         {"temporal-width", "0.1"},
                                         {"subframe-rate", "59.94"},
                                         {"samples", "16"},
                                         {"bits", "12"},
                                         {"fit", "pad"},
                                         {"skip", "off"},
                                         {"overwrite", NULL},
                                         {"max-memory", "536870912"},
                                         {"set", "a=1"},
                                         {"set", "b=0.25"},
                                         {"set", "c=x y"},
                                         {"set", "d=true"}};
    weft_job *job = loaded("{\"command\": \"render\", \"inputs\": [\"a.lua\"], \"raster\": "
                           "\"625i\", \"frames\": \"1-9x2\", \"temporal-width\": 0.1, "
                           "\"subframe-rate\": 59.94, \"samples\": 16, \"bits\": 12, \"fit\": "
                           "\"pad\", \"skip\": false, \"overwrite\": true, \"max-memory\": "
                           "536870912, \"set\": {\"a\": 1, \"b\": 0.25, \"c\": \"x y\", "
                           "\"d\": true}}");
    weft_job *other = weft_job_new();
    weft_error err = {""};
    for (size_t i = 0; i < sizeof set / sizeof *set; i++)
        assert_int_equal(weft_job_set(other, set[i][0], set[i][1], &err), WEFT_OK);
    same_jobs(job, other);
    assert_int_equal(job->command, WF_RENDER);
    weft_job_free(job);
    weft_job_free(other);
    job = loaded("\xEF\xBB\xBF{\"set\": [\"a=1\", \"b=2\"], \"threads\": \"all\"}");
    assert_int_equal(job->param_count, 2);
    weft_job_free(job);
}

/* Of every option the words that it lists, or its preset, come through as they are. */
static void arrays_are_lists(void **state) {
    (void)state;
    weft_job *job = loaded("{\"background\": [0, 0.5, \"1\"]}");
    assert_true(job->background[0] == 0 && job->background[1] == 0.5f &&
                job->background[2] == 1);
    weft_job_free(job);
    static const char *const bad[] = {"[]", "[0, 1]", "[0, null, 1]", "[[0, 1, 0]]"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char json[64];
        weft_error err = {""};
        job = weft_job_new();
        int length = snprintf(json, sizeof json, "{\"background\": %s}", bad[i]);
        assert_int_equal(load_bytes(job, json, (size_t)length, &err), WEFT_USAGE);
        weft_job_free(job);
    }
}

static void every_option_is_a_key(void **state) {
    (void)state;
    weft_option option;
    for (size_t i = 0; weft_option_at(i, &option); i++) {
        char json[256];
        if (!option.takes)
            snprintf(json, sizeof json, "{\"%s\": true}", option.name);
        else if (strchr(option.takes, '|') && !strchr(option.takes, ':'))
            snprintf(json, sizeof json, "{\"%s\": \"%.*s\"}", option.name,
                     (int)strcspn(option.takes, "|"), option.takes);
        else
            continue;
        weft_job_free(loaded(json));
    }
}

static void paths_are_relative_to_the_file(void **state) {
    (void)state;
    char in[512], hash[520], out[512];
    weft_job *job = loaded("{\"inputs\": [\"in.####.exr\", \"/a/b.exr\"], \"output\": "
                           "\"hash:out.txt\", \"ocio\": \"show.ocio\"}");
    job_path(in, "in.####.exr");
    job_path(out, "out.txt");
    snprintf(hash, sizeof hash, "hash:%s", out);
    assert_string_equal(job->inputs[0], in);
    assert_string_equal(job->inputs[1], "/a/b.exr");
    assert_string_equal(job->output, hash);
    job_path(in, "show.ocio");
    assert_string_equal(job->ocio, in);
    weft_job_free(job);
    job = loaded("{\"output\": \"-\", \"ocio\": \"ocio://default\", \"inputs\": \"x\"}");
    assert_string_equal(job->output, "-");
    assert_string_equal(job->ocio, "ocio://default");
    weft_job_free(job);
}

static void later_ones_win(void **state) {
    (void)state;
    weft_error err = {""};
    weft_job *job = loaded("{\"inputs\": [\"/a\", \"/b\"], \"shutter-angle\": 180, \"to\": "
                           "\"x\", \"overwrite\": true, \"raster\": \"625i\", \"output\": "
                           "\"/o.y4m\"}");
    static const char next[] = "{\"inputs\": \"/c\", \"temporal-width\": 0.25, \"display\": "
                               "\"d\", \"overwrite\": false, \"resume\": true}";
    assert_int_equal(load_bytes(job, next, strlen(next), &err), WEFT_OK);
    assert_int_equal(job->input_count, 1);
    assert_string_equal(job->inputs[0], "/c");
    assert_null(job->to);
    assert_string_equal(job->display, "d");
    assert_string_equal(job->raster.name, "625i");
    assert_true(job->resume && !job->overwrite);
    assert_true(job->width_given && !job->angle_given);
    assert_int_equal(job->temporal_width.den, 4);
    if (wf_job_check(job, &err)) fail_msg("%s", err.text);
    weft_job_free(job);
    job = loaded("{\"inputs\": \"/a\", \"output\": \"/o.y4m\", \"shutter-angle\": 180, "
                 "\"temporal-width\": 1}");
    assert_int_equal(wf_job_check(job, &err), WEFT_USAGE); /* within one, a contradiction */
    weft_job_free(job);
}

/* JSON, and the place and words of what is said of it. */
static void faults_have_places(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"", "job.json:1:1: "},
        {"[]", "job.json:1:1: this is an array"},
        {"3", "one JSON object"},
        {"{\n \"raster\" \"625i\"}", "job.json:2:"},
        {"{\"raster\": \"625i\",}", "job.json:1:"},
        {"{\"raster\": \"625i\", \"raster\": \"525i\"}", "duplicate"},
        {"{\n \"bits\": 8,\n  \"rastr\": 1}", "job.json:3:3: \"rastr\": unknown key; did you "
                                              "mean \"raster\"?"},
        {"{\"\\\"{[\": \"\xC3\xA4}\", \"x\": 1}", "job.json:1:2: "},
        {"{\"look\": \"\xC3\xA4,\\\"{\", \"inptus\": 1}", "job.json:1:19: \"inptus\""},
        {"{\"set\": {\"a\": {}}}", "job.json:1:2: \"set\": \"a\" takes text or a number"},
        {"{\"set\": {\"a\": [1]}}", "not an array"},
        {"{\"set\": {\"a=\": 1}}", "name"},
        {"{\"input\": \"a\"}", "did you mean \"inputs\""},
        {"{\"qqqqqqqqqq\": 1}", "\"inputs\", \"output\""},
        {"{\"raster\": true}", "takes text or a number: NAME, not true"},
        {"{\"raster\": [\"625i\"]}", "not an array"},
        {"{\"raster\": null}", "not null"},
        {"{\"overwrite\": 1}", "takes true or false, not a number"},
        {"{\"overwrite\": \"true\"}", "takes true or false, not text"},
        {"{\"bits\": 9}", "job.json:1:2: --bits"},
        {"{\"bits\": \"\"}", "empty"},
        {"{\"inputs\": 3}", "not a number"},
        {"{\"inputs\": [[\"a\"]]}", "not an array"},
        {"{\"inputs\": \"\"}", "empty"},
        {"{\"output\": {}}", "not an object"},
        {"{\"command\": 1}", "convert, render or trace"},
        {"{\"command\": \"measure\"}", "no command of jobs"},
        {"{\"job\": \"other.json\"}", "cannot name another"},
        {"{\"look\": \"\xFF\"}", "job.json:1:"},
        {"{\"look\": \"a\\u0000b\"}", "job.json:1:"},
        {"{\"samples\": 99999999999999999999}", "job.json:1:"},
        {"{\"samples\": 1e999}", "job.json:1:"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        weft_error err = {""};
        weft_job *job = weft_job_new();
        if (load_bytes(job, cases[i][0], strlen(cases[i][0]), &err) != WEFT_USAGE)
            fail_msg("taken: %s (%s)", cases[i][0], err.text);
        if (!strstr(err.text, cases[i][1])) fail_msg("%s: %s", cases[i][0], err.text);
        weft_job_free(job);
    }
}

static void hostile_files_are_refused(void **state) {
    (void)state;
    size_t size = WF_JOBFILE_BYTES + 1;
    char *bytes = malloc(size);
    weft_error err = {""};
    weft_job *job = weft_job_new();
    assert_non_null(bytes);
    memset(bytes, '[', size);
    assert_int_equal(load_bytes(job, bytes, size, &err), WEFT_USAGE);
    assert_non_null(strstr(err.text, "at most 1048576 bytes"));
    assert_int_equal(load_bytes(job, bytes, size - 1, &err), WEFT_USAGE);
    assert_int_equal(load_bytes(job, "{\"bits\": 8}\0 ", 13, &err), WEFT_USAGE);
    memset(bytes, ' ', size);
    memcpy(bytes, "{}", 2);
    assert_int_equal(load_bytes(job, bytes, size - 1, &err), WEFT_OK);
    assert_int_equal(weft_job_load(job, "/nowhere/job.json", &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "/nowhere/job.json"));
    assert_int_equal(weft_job_load(job, job_directory, &err), WEFT_FAILED);
    assert_int_equal(weft_job_load(job, "/dev/zero", &err), WEFT_USAGE);
    assert_int_equal(weft_job_load(job, "", &err), WEFT_USAGE);
    weft_job_free(job);
    free(bytes);
}

/* Jobs of a list, in C: how many there are, each with what all share, and what is refused. */
static void lists_have_numbers(void **state) {
    (void)state;
    static const char list[] =
        "{\"raster\": \"625i\", \"bits\": 8,\n \"jobs\": [\n  {\"output\": \"a.y4m\"},\n"
        "  {\"output\": \"]{\\\"b\", \"raster\": \"525i\"}, {\"bitz\": 8}]}";
    char path[512];
    weft_error err = {""};
    size_t count;
    for (size_t number = 0; number < 5; number++) {
        weft_job *job = weft_job_new();
        write_job(path, "list.json", list, strlen(list));
        assert_int_equal(weft_jobs_in(path, &count, &err), WEFT_OK);
        assert_int_equal(count, 3);
        weft_status status = weft_job_load_nth(job, path, number, &err);
        assert_int_equal(status, number == 1 || number == 2 ? WEFT_OK : WEFT_USAGE);
        if (number == 1) assert_string_equal(job->raster.name, "625i");
        if (number == 2) assert_string_equal(job->raster.name, "525i");
        if (number == 2) assert_non_null(strstr(job->output, "]{\"b"));
        if (number == 1) assert_int_equal(job->bits, 8);
        if (number == 0) assert_non_null(strstr(err.text, "list of jobs"));
        if (number == 3) assert_non_null(strstr(err.text, "list.json:4:43: job 3: \"bitz\""));
        if (number == 4) assert_non_null(strstr(err.text, "no job 4"));
        weft_job_free(job);
    }
    write_job(path, "one.json", "{}", 2);
    assert_int_equal(weft_jobs_in(path, &count, &err), WEFT_OK);
    assert_int_equal(count, 0);
    write_job(path, "none.json", "[]", 2);
    assert_int_equal(weft_jobs_in(path, &count, &err), WEFT_USAGE);
    assert_int_equal(weft_jobs_in("", &count, &err), WEFT_USAGE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_have_numbers),
        cmocka_unit_test(says_what_options_say),
        cmocka_unit_test(arrays_are_lists),
        cmocka_unit_test(every_option_is_a_key),
        cmocka_unit_test(paths_are_relative_to_the_file),
        cmocka_unit_test(later_ones_win),
        cmocka_unit_test(faults_have_places),
        cmocka_unit_test(hostile_files_are_refused),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
