/* Patterns, ranges and names from anywhere. Lines: a pattern, a range, then the names of a
 * directory (none: those below). Whatever is selected must be what was asked for. */
#include <stdlib.h>
#include <string.h>

#include "convert/base/range.h"
#include "convert/read/selection.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define MOST 5000 /* numbers: the limit is what is tried here, not the memory */

static const char usual[] =
    "shot.0001.exr\nshot.0002.exr\nshot.0004.exr\nshot.1.exr\nshot.-0003.exr\n"
    "shot.1001.25.exr\nshot.1001.5.exr\nshot.1002.00.exr\na_v2.0010.dpx\n"
    "a_v2.0011.dpx\n0001.png\nslate.exr\n.hidden.0001.exr\n";

static void require(bool holds) {
    if (!holds) abort();
}

static void check_sequence(const wf_sequence *s) {
    size_t missing = 0;
    require(s->count > 0 && s->count <= MOST && wf_ratio_given(s->step) && s->step.num > 0);
    for (size_t k = 0; k < s->count; k++) {
        missing += !s->refs[k].path;
        require(wf_ratio_given(s->refs[k].number));
        if (k) require(wf_number_order(s->refs[k - 1].number, s->refs[k].number) < 0);
    }
    require(missing == s->missing && missing < s->count);
}

static void select_from(const wf_numbered *entry, size_t count, const char *frames) {
    const wf_candidates from = {entry, count, "d/", "d/input", MOST};
    wf_sequence sequence;
    weft_error err = {""};
    weft_status status = wf_select(&from, frames, &sequence, &err);
    require(status ? *err.text && !sequence.refs : !*err.text);
    if (!status) check_sequence(&sequence);
    wf_sequence_free(&sequence);
}

/* A name that a pattern gives is one it reads, with the number it was given. */
static void check_output(const char *text, const wf_pattern *pattern) {
    static const int64_t frames[] = {0, 7, 123456789, -5};
    char path[1024];
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        wf_rational number;
        if (!wf_pattern_path(text, frames[i], path, sizeof path)) continue;
        const char *name = path + pattern->directory_length;
        if (strlen(name) >= WF_NAME_SIZE) continue;
        require(wf_pattern_match(pattern, name, &number));
        require(number.num == frames[i] && number.den == 1);
    }
}

static void try_pattern(const char *text, const char *frames, const wf_names *names) {
    wf_pattern pattern;
    wf_numbered_list list;
    char why[256] = "";
    wf_pattern_kind kind = wf_pattern_parse(text, &pattern, why, sizeof why);
    require(kind != WF_PATTERN_BAD || *why);
    if (kind != WF_PATTERN_OK) return;
    check_output(text, &pattern);
    if (wf_names_match(names, &pattern, &list, NULL)) return;
    if (list.count) select_from(list.entry, list.count, NULL);
    if (list.count) select_from(list.entry, list.count, frames);
    free(list.entry);
}

static void try_groups(const char *frames, const wf_names *names, int way) {
    wf_numbered_list list;
    char text[300];
    if (wf_names_group(names, way, &list, NULL)) return;
    wf_groups_text(&list, text, sizeof text);
    require(strlen(text) < sizeof text);
    for (size_t i = 0, end; i < list.count; i = end) {
        end = wf_group_end(&list, i);
        require(end > i && end <= list.count);
        select_from(list.entry + i, end - i, frames);
    }
    free(list.entry);
}

static void add_names(char *text, wf_names *names) {
    for (const char *name; (name = strsep(&text, "\n"));)
        if (*name) wf_names_add(names, name);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = calloc(1, size + sizeof usual), *rest = text;
    wf_names names = {0};
    if (!text) return 0;
    memcpy(text, data, size);
    const char *pattern = strsep(&rest, "\n"), *frames = rest ? strsep(&rest, "\n") : "1-9";
    char *own = rest && *rest ? NULL : strdup(usual);
    add_names(own ? own : rest, &names);
    try_pattern(pattern, frames, &names);
    for (int way = 0; way < WF_NUMBER_WAYS; way++) try_groups(frames, &names, way);
    wf_names_free(&names);
    free(own);
    free(text);
    return 0;
}
