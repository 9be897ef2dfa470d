/* The option table, row by row: what each takes, what it refuses and how it says so; and what
 * cannot stand together. */
#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/base/values.h"
#include "convert/job/job.h"
#include "convert/job/options.h"
#include "filters/base/spelling.h"

/* Any text will do for these: what it names is looked for when the job runs. */
static const char *const texts[] = {"layer",   "part", "ocio", "from", "to",
                                    "display", "view", "look", "key",  "refine"};

static bool takes_any_text(const char *name) {
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (!strcmp(texts[i], name)) return true;
    return false;
}

static weft_job *new_job(void) {
    weft_job *job = weft_job_new();
    assert_non_null(job);
    return job;
}

static void take(weft_job *job, const char *name, const char *value) {
    weft_error err = {""};
    weft_status status = weft_job_set(job, name, value, &err);
    if (status) fail_msg("--%s %s: %s", name, value ? value : "", err.text);
}

/* Refused, named in the message, and the job as it was. */
static void refuse(weft_job *job, const char *name, const char *value) {
    weft_error err = {""};
    weft_job before;
    memcpy(&before, job, sizeof before);
    char option[64];
    snprintf(option, sizeof option, "--%s", name);
    if (weft_job_set(job, name, value, &err) != WEFT_USAGE)
        fail_msg("--%s took '%s'", name, value ? value : "");
    if (strncmp(err.text, option, strlen(option)))
        fail_msg("--%s '%s': %s", name, value ? value : "", err.text);
    if (memcmp(&before, job, sizeof before))
        fail_msg("--%s '%s' changed the job", name, value ? value : "");
    assert_int_equal(weft_job_set(job, name, value, NULL), WEFT_USAGE);
}

static void rows_are_complete(void **state) {
    (void)state;
    weft_option a, b;
    size_t count = 0;
    for (; weft_option_at(count, &a); count++) {
        assert_true(a.help && a.help[strlen(a.help) - 1] == '.' &&
                    isupper((unsigned char)*a.help));
        assert_true(a.group && *a.group);
        assert_true(wf_option_commands(count));
        for (const char *c = a.name; *c; c++)
            assert_true(islower((unsigned char)*c) || *c == '-');
        for (size_t i = 0; i < count; i++)
            assert_true(weft_option_at(i, &b) && strcmp(a.name, b.name));
        /* Help prints a heading whenever the group changes: a group stands together. */
        bool seen = false, ended = false;
        for (size_t i = 0; i < count && weft_option_at(i, &b); i++) {
            bool same = !strcmp(a.group, b.group);
            ended = ended || (seen && !same);
            seen = seen || same;
        }
        assert_false(seen && ended);
    }
    assert_true(count > 30);
    assert_false(weft_option_at(count, &a));
    assert_int_equal(wf_option_commands(count), 0);
}

/* A preset that is a value, and not a saying for people, changes nothing in a new job. */
static void presets_are_what_a_new_job_has(void **state) {
    (void)state;
    static const char *const sayings[] = {"from the files",
                                          "the aperture's",
                                          "all",
                                          "the output's",
                                          "the container's",
                                          "the input's, or 00:00:00:00",
                                          "one a channel",
                                          "not said",
                                          "shaped; line where flicker is held",
                                          "6, of more than 608 lines 3",
                                          "100, of PQ and HLG 203"};
    weft_option option;
    weft_job *fresh = new_job(), *job = new_job();
    for (size_t i = 0; weft_option_at(i, &option); i++) {
        bool saying = !option.preset || takes_any_text(option.name);
        for (size_t s = 0; s < sizeof sayings / sizeof *sayings && !saying; s++)
            saying = !strcmp(option.preset, sayings[s]);
        if (saying && strcmp(option.name, "threads")) continue;
        take(job, option.name, option.preset);
    }
    assert_memory_equal(job, fresh, sizeof *job);
    assert_string_equal(job->raster.name, "525i");
    assert_string_equal(job->aperture.kind->name, "shaped");
    assert_true(job->skip && job->max_memory_bytes == (size_t)2 << 30 && !job->threads &&
                !job->bits);
    weft_job_free(fresh);
    weft_job_free(job);
}

/* Words separated by '|': each is taken, nothing like it is. */
static void choices_are_the_words_shown(void **state) {
    (void)state;
    weft_option option;
    int choices = 0;
    for (size_t i = 0; weft_option_at(i, &option); i++) {
        if (!option.takes || !strchr(option.takes, '|')) continue;
        char words[128], wrong[132], *rest = words;
        snprintf(words, sizeof words, "%s", option.takes);
        weft_job *job = new_job();
        for (char *word; (word = strsep(&rest, "|")); choices++) {
            if (isupper((unsigned char)*word)) continue; /* it stands for any file */
            char *number = strstr(word, ":N");
            if (number) number[1] = '8';
            take(job, option.name, word);
            snprintf(wrong, sizeof wrong, "%sx", word);
            refuse(job, option.name, wrong);
            snprintf(wrong, sizeof wrong, "%.*s", (int)strlen(word) - 1, word);
            refuse(job, option.name, wrong);
            snprintf(wrong, sizeof wrong, "%s|", word);
            refuse(job, option.name, wrong);
        }
        weft_error err;
        weft_job_set(job, option.name, "nonsense", &err);
        if (!strstr(err.text, option.takes))
            fail_msg("--%s does not list its words: %s", option.name, err.text);
        weft_job_free(job);
    }
    assert_true(choices > 20);
}

static void garbage_is_refused(void **state) {
    (void)state;
    static char longest[5000];
    memset(longest, 'x', sizeof longest - 1);
    const char *const garbage[] = {"nonsense",
                                   " ",
                                   "-",
                                   "--",
                                   "\xff\xfe",
                                   "1e400",
                                   "nan",
                                   "1 2",
                                   "0x",
                                   ":",
                                   ",",
                                   "%s%n",
                                   "99999999999999999999999",
                                   "1/0",
                                   "-1e9",
                                   longest};
    weft_option option;
    for (size_t i = 0; weft_option_at(i, &option); i++) {
        weft_job *job = new_job();
        for (size_t g = 0; g < sizeof garbage / sizeof *garbage; g++)
            if (!takes_any_text(option.name)) refuse(job, option.name, garbage[g]);
        if (option.takes) {
            refuse(job, option.name, "");
            refuse(job, option.name, NULL);
        } else {
            take(job, option.name, NULL);
            take(job, option.name, "");
        }
        weft_job_free(job);
    }
}

static void ends_of_ranges(void **state) {
    (void)state;
    const struct {
        const char *name, *taken[4], *refused[6];
    } cases[] = {
        {"temporal-width", {"0", "64", "1/3", "0.5"}, {"64.001", "-0.1", "65"}},
        {"shutter-angle", {"0", "360", "23040", "172.8"}, {"23040.1", "-1"}},
        {"scan-skew", {"0", "1", "1/2"}, {"1.000000001", "-0", "2"}},
        {"subframe-rate",
         {"0.001", "1000000", "480000/1001", "59.94"},
         {"0", "0.0009", "1000001", "0/1"}},
        {"input-par", {"10:11", "1/100", "100"}, {"0", "0.009", "101", "10:0", "10;11"}},
        {"threads", {"1", "1024", "all"}, {"0", "1025", "1.5", "-1", "ALL"}},
        {"chunk",
         {"1/1", "3/3", "1000000/1000000"},
         {"0/1", "2/1", "1/1000001", "1", "1/", "1/2/3"}},
        {"max-memory",
         {"1M", "1048576", "1.5GiB", "1024T"},
         {"1048575", "0", "1025T", "-1G", "1g", "1Gb"}},
        {"background",
         {"0", "65504", ".1,.2,.3"},
         {"65505", "-1", "1,2", "1,2,3,4", "1,,3", "1,2,"}},
        {"timecode",
         {"00:00:00:00", "23:59:59;29", "01:02:03;04"},
         {"24:00:00:00", "00:60:00:00", "00:00:60:00", "1:2:3:4", "00:00:00:000",
          "00;00:00:00"}},
        {"frames",
         {"1-96", "1001-1066x0.25", "7,9,11", "-3-5"},
         {"1-96:2", "9-1", "1-", "x2", "1-96x0", "1-9x-1"}},
        {"raster",
         {"525i", "625i-dv-wide", "180x122@30i,tff"},
         {"525", "180x121@30i", "180x122@30i,tff,bff"}},
        {"aperture",
         {"box", "mitchell:1.5,-0.25"},
         {"boxes", "box:1", "mitchell", "mitchell:1", "mitchell:99,0"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        weft_job *job = new_job();
        for (int v = 0; v < 4 && cases[i].taken[v]; v++)
            take(job, cases[i].name, cases[i].taken[v]);
        for (int v = 0; v < 6 && cases[i].refused[v]; v++)
            refuse(job, cases[i].name, cases[i].refused[v]);
        weft_job_free(job);
    }
}

/* Programs print numbers with as many decimals as a double has, and more. */
static void decimals_of_any_length(void **state) {
    (void)state;
    static const struct {
        const char *name, *value;
    } cases[] = {
        {"flicker-limit", "0.0093324551"},
        {"flicker-limit", "visible:0.4714045207910317"},
        {"flicker-weight", "2.8284271247461903"},
        {"view-distance", "4.2426406871192848"},
        {"peak", "282.84271247461903"},
        {"temporal-width", "0.3333333333333333"},
        {"shutter-angle", "172.82827124746190"},
        {"scan-skew", "0.70710678118654752440084436210485"},
        {"subframe-rate", "479.52047952047952"},
        {"input-par", "0.9090909090909091"},
        {"exposure", "-0.57721566490153286"},
        {"error", "0.0027182818284590452"},
        {"background", "0.1000000000000000055511151231257827,0.2,0.30000000000000004"},
        {"raster", "720x486@29.97002997002997i"},
    };
    weft_job *job = new_job();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        take(job, cases[i].name, cases[i].value);
    assert_float_equal(wf_ratio_value(job->flicker_weight), 2.8284271247461903, 1e-15);
    assert_true(wf_ratio_equal(job->subframe_rate, wf_ratio(480000, 1001)));
    weft_job_free(job);
}

static void values_arrive(void **state) {
    (void)state;
    weft_job *job = new_job();
    take(job, "shutter-angle", "120");
    assert_true(wf_ratio_equal(job->temporal_width, (wf_rational){1, 3}) && job->angle_given);
    take(job, "temporal-width", "0");
    assert_true(wf_ratio_equal(job->temporal_width, (wf_rational){0, 1}) && job->width_given);
    take(job, "subframe-rate", "59.94");
    assert_true(wf_ratio_equal(job->subframe_rate, (wf_rational){60000, 1001}));
    take(job, "input-par", "10:11");
    assert_true(wf_ratio_equal(job->input_par, (wf_rational){10, 11}));
    take(job, "background", "0.5");
    assert_true(job->background[0] == 0.5f && job->background[2] == 0.5f);
    take(job, "background", "0,0.25,1");
    assert_true(job->background[0] == 0 && job->background[1] == 0.25f &&
                job->background[2] == 1);
    take(job, "shutter-position", "end");
    assert_int_equal(job->shutter_position, WF_END);
    take(job, "fix-nan", "error");
    assert_int_equal(job->nan_fix, WF_NAN_ERROR);
    take(job, "range", "full");
    assert_int_equal(job->range, WF_RANGE_FULL);
    take(job, "subframe-time", "center");
    take(job, "skip", "off");
    assert_true(job->subframe_time_center && !job->skip);
    take(job, "bits", "12");
    take(job, "threads", "3");
    take(job, "chunk", "2/4");
    assert_true(job->bits == 12 && job->threads == 3 && job->chunk == 2 &&
                job->chunk_count == 4);
    take(job, "max-memory", "500MB");
    assert_true(job->max_memory_bytes == 500000000);
    take(job, "layer", "beauty");
    take(job, "layer", "diffuse"); /* the last counts */
    assert_string_equal(job->layer, "diffuse");
    take(job, "frames", "1-9x2");
    assert_string_equal(job->frames, "1-9x2");
    weft_job_free(job);
}

/* What weft will have one day, or another program has, is not taken in silence. */
static void names_that_are_none(void **state) {
    (void)state;
    const struct {
        const char *name, *means;
    } cases[] = {{"rastr", "--raster?"},         {"temporal_width", "--temporal-width?"},
                 {"overwirte", "--overwrite?"},  {"sample", "unknown option"},
                 {"dry-walk", "unknown option"}, {"", "unknown option"},
                 {"--raster", "unknown option"}, {"RASTER", "unknown option"}};
    weft_job *job = new_job();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        weft_error err = {""};
        assert_int_equal(weft_job_set(job, cases[i].name, "1", &err), WEFT_USAGE);
        if (!strstr(err.text, cases[i].means)) fail_msg("--%s: %s", cases[i].name, err.text);
    }
    weft_job_free(job);
}

static void contradictions(void **state) {
    (void)state;
    const struct {
        const char *options[4], *output, *says;
    } cases[] = {
        {{"temporal-width=1", "shutter-angle=180"}, "a.y4m", "--shutter-angle"},
        {{"shutter-angle=180", "temporal-width=1"}, "a.y4m", "--temporal-width"},
        {{"to=rec709", "display=d"}, "a.y4m", "--display"},
        {{"to=rec709", "view=v"}, "a.y4m", "--view"},
        {{"view=v"}, "a.y4m", "--display"},
        {{"look=l"}, "a.y4m", "--look"},
        {{"overwrite", "resume"}, "a.y4m", "--resume"},
        {{"resume"}, "-", "standard output"},
        {{"audio-tracks=4"}, "a.mov", "--audio"},
        {{"timecode=00:01:00;00"}, "a.y4m", "--timecode"},
        {{"timecode=00:00:00:30"}, "a.y4m", "--timecode"},
        {{"timecode=00:00:00:25", "raster=625i"}, "a.y4m", "--timecode"},
        {{"raster=625i", "timecode=00:00:00;01"}, "a.y4m", "--timecode"},
        {{"raster=525i"}, NULL, "-o"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        weft_job *job = new_job();
        weft_error err = {""};
        assert_int_equal(wf_job_check(job, &err), WEFT_USAGE);
        assert_non_null(strstr(err.text, "shot.####.exr")); /* nothing to convert */
        assert_int_equal(weft_job_add_input(job, "in.####.exr", &err), WEFT_OK);
        if (cases[i].output)
            assert_int_equal(weft_job_set_output(job, cases[i].output, &err), WEFT_OK);
        assert_int_equal(wf_job_check(job, &err), cases[i].output ? WEFT_OK : WEFT_USAGE);
        for (int o = 0; o < 4 && cases[i].options[o]; o++) {
            char text[64], *value;
            snprintf(text, sizeof text, "%s", cases[i].options[o]);
            if ((value = strchr(text, '='))) *value++ = '\0';
            take(job, text, value);
        }
        assert_int_equal(wf_job_check(job, &err), WEFT_USAGE);
        if (!strstr(err.text, cases[i].says)) fail_msg("case %zu: %s", i, err.text);
        weft_job_free(job);
    }
}

/* Together these make sense. */
static void what_goes_together(void **state) {
    (void)state;
    const char *const options[][2] = {{"display", "d"},
                                      {"view", "v"},
                                      {"look", "l"},
                                      {"resume", NULL},
                                      {"timecode", "00:01:00;02"},
                                      {"chunk", "2/3"}};
    weft_job *job = new_job();
    weft_error err = {""};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        take(job, options[i][0], options[i][1]);
    assert_int_equal(weft_job_add_input(job, "in.####.exr", &err), WEFT_OK);
    assert_int_equal(weft_job_set_output(job, "first.y4m", &err), WEFT_OK);
    assert_int_equal(weft_job_set_output(job, "out.y4m", &err), WEFT_OK);
    assert_string_equal(job->output, "out.y4m");
    if (wf_job_check(job, &err)) fail_msg("%s", err.text);
    assert_int_equal(weft_job_add_input(job, "", &err), WEFT_USAGE);
    assert_int_equal(weft_job_set_output(job, NULL, &err), WEFT_USAGE);
    assert_string_equal(weft_job_report(job), "{}");
    weft_job_free(job);
    weft_job_free(NULL);
}

/* Sizes: the suffix multiplies, and the fraction before it counts. */
static void sizes(void **state) {
    (void)state;
    const struct {
        const char *text;
        size_t bytes;
    } cases[] = {{"1048576", 1048576},      {"1024K", 1048576},
                 {"1.5M", 1572864},         {"1500KB", 1500000},
                 {"2G", (size_t)2 << 30},   {"0.25TiB", (size_t)1 << 38},
                 {"1024T", (size_t)1 << 50}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t bytes = 0;
        assert_true(wf_parse_size(cases[i].text, &bytes));
        assert_int_equal(bytes, cases[i].bytes);
    }
}

static void spellings(void **state) {
    (void)state;
    const struct {
        const char *text, *candidates[3], *best;
    } cases[] = {
        {"aperature", {"raster", "aperture", "part"}, "aperture"},
        {"frmaes", {"frames", "from", "fit"}, "frames"}, /* swapped letters are one mistake */
        {"bits", {"fit", "bits", "bit"}, "bits"},
        {"zzz", {"frames", "from", "fit"}, NULL},
        {"", {"frames", "from", "fit"}, NULL},
        {"x", {"y", "to", "fit"}, "y"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_spelling spelling = {.text = cases[i].text};
        for (int c = 0; c < 3; c++) wf_spelling_offer(&spelling, cases[i].candidates[c]);
        if (!cases[i].best) assert_null(spelling.best);
        if (cases[i].best) assert_string_equal(spelling.best, cases[i].best);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_complete),
        cmocka_unit_test(presets_are_what_a_new_job_has),
        cmocka_unit_test(choices_are_the_words_shown),
        cmocka_unit_test(garbage_is_refused),
        cmocka_unit_test(ends_of_ranges),
        cmocka_unit_test(decimals_of_any_length),
        cmocka_unit_test(values_arrive),
        cmocka_unit_test(names_that_are_none),
        cmocka_unit_test(contradictions),
        cmocka_unit_test(what_goes_together),
        cmocka_unit_test(sizes),
        cmocka_unit_test(spellings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
