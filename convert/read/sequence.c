/* Turns what was typed into files: patterns, directories, lists, and one file with many
 * parts. */
#include "convert/read/sequence.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "convert/base/range.h"
#include "convert/base/numbers.h"
#include "convert/read/selection.h"
#include "convert/read/source.h"

/* ---- Names ---- */

/* The first length bytes of text; NULL when memory is out. "" stands for "." where it is
 * opened. */
static char *directory_of(const char *text, size_t length, weft_error *err) {
    char *directory = strndup(text, length);
    if (!directory) wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", wf_path_tail(text));
    return directory;
}

static const char *openable(const char *directory) {
    return *directory ? directory : ".";
}

static wf_candidates candidates_of(const wf_numbered_list *list, const char *directory,
                                   const char *input) {
    return (wf_candidates){list->entry, list->count, directory, input, WF_RANGE_MOST};
}

/* What stands where an input was looked for, for a message: "; beside it there are
 * beauty.####.exr 1-48". */
static void tell_what_is_there(const wf_names *names, char *text, size_t size) {
    static const char before[] = "; beside it there are ";
    wf_numbered_list groups;
    *text = '\0';
    if (wf_names_group(names, 0, &groups, NULL)) return;
    memcpy(text, before, sizeof before);
    if (groups.count)
        wf_groups_text(&groups, text + sizeof before - 1, size - sizeof before);
    else
        snprintf(text, size, "; beside it there are no numbered pictures");
    free(groups.entry);
}

/* ---- One file ---- */

typedef struct timed_parts {
    int count, *part;
    wf_rational *time;
} timed_parts;

/* Parts are numbered from 0 in steps of the time they have in common, so that a gap is seen. */
static weft_status number_parts(const char *path, const timed_parts *parts, wf_numbered *entry,
                                weft_error *err) {
    size_t count = (size_t)parts->count;
    for (size_t i = 0; i < count; i++)
        entry[i] =
            (wf_numbered){.number = parts->time[i], .name = path, .part = parts->part[i]};
    wf_rational step = {0, 1};
    for (size_t i = 1; i < count; i++) {
        wf_rational way = wf_number_minus(parts->time[i], parts->time[i - 1]);
        if (wf_ratio_given(way) && way.num <= 0)
            return wf_fail(err, WEFT_FAILED, "%s: parts %d and %d have the same weft:time",
                           wf_path_tail(path), parts->part[i - 1], parts->part[i]);
        step = wf_number_common_step(step, way);
    }
    if (count == 1) step = wf_ratio(1, 1);
    for (size_t i = 0; i < count; i++) {
        wf_rational since = wf_number_minus(parts->time[i], parts->time[0]);
        entry[i].number = wf_ratio_div(since, step);
        if (!wf_ratio_given(entry[i].number))
            return wf_fail(
                err, WEFT_FAILED,
                "%s: the parts' weft:time have no step in common; give them as whole "
                "multiples of one over the rate",
                wf_path_tail(path));
    }
    return WEFT_OK;
}

static weft_status expand_parts(const char *path, const timed_parts *parts, const char *frames,
                                wf_sequence *out, weft_error *err) {
    wf_numbered_list list = {malloc((size_t)parts->count * sizeof *list.entry),
                             (size_t)parts->count};
    if (!list.entry)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", wf_path_tail(path));
    weft_status status = number_parts(path, parts, list.entry, err);
    wf_candidates from = candidates_of(&list, "", path);
    if (!status) status = wf_select(&from, frames, out, err);
    free(list.entry);
    return status;
}

/* A picture alone has the number of its name, or 0. */
static weft_status expand_picture(const char *path, const char *frames, wf_sequence *out,
                                  weft_error *err) {
    wf_numbered entry;
    if (!wf_name_number_of(wf_base_name(path), 0, &entry)) entry.number = wf_ratio(0, 1);
    entry.name = path;
    entry.part = -1;
    const wf_numbered_list list = {&entry, 1};
    wf_candidates from = candidates_of(&list, "", path);
    return wf_select(&from, frames, out, err);
}

static weft_status expand_file(const char *path, const char *frames, wf_sequence *out,
                               weft_error *err) {
    timed_parts parts = {0};
    weft_status status =
        wf_source_timed_parts(path, &parts.count, &parts.part, &parts.time, err);
    if (status) return status;
    status = parts.count > 0 ? expand_parts(path, &parts, frames, out, err)
                             : expand_picture(path, frames, out, err);
    free(parts.part);
    free(parts.time);
    return status;
}

/* ---- A pattern ---- */

/* Where names cut fractions short, numbers are what was meant, but not for a range, which is
 * written as the names are. */
static weft_status select_from(wf_numbered_list *list, const char *directory, const char *input,
                               const char *frames, wf_sequence *out, weft_error *err) {
    int64_t parts = frames ? 0 : wf_number_parts(list->entry, list->count);
    if (parts) wf_numbers_round(list->entry, list->count, parts);
    wf_candidates from = {list->entry, list->count, directory, input, WF_RANGE_MOST};
    weft_status status = wf_select(&from, frames, out, err);
    if (!status && parts)
        wf_sequence_tell(out,
                         "%s: numbers such as %s are taken for fractions, %" PRId64
                         " from one whole number to the next",
                         wf_path_tail(input), wf_base_name(list->entry[1].name), parts);
    return status;
}

static weft_status refuse_empty(const char *text, const wf_names *names, weft_error *err) {
    char there[480];
    tell_what_is_there(names, there, sizeof there);
    return wf_fail(err, WEFT_FAILED, "%s matches no file%s", wf_path_tail(text), there);
}

static weft_status expand_matches(const char *text, const wf_pattern *pattern,
                                  const char *directory, const char *frames, wf_sequence *out,
                                  weft_error *err) {
    wf_names names = {0};
    wf_numbered_list list = {0};
    weft_status status = wf_names_read(openable(directory), &names, err);
    if (!status) status = wf_names_match(&names, pattern, &list, err);
    if (!status && !list.count) status = refuse_empty(text, &names, err);
    if (!status) status = select_from(&list, directory, text, frames, out, err);
    free(list.entry);
    wf_names_free(&names);
    return status;
}

static weft_status expand_pattern(const char *text, const wf_pattern *pattern,
                                  const char *frames, wf_sequence *out, weft_error *err) {
    char *directory = directory_of(text, pattern->directory_length, err);
    if (!directory) return WEFT_NO_MEMORY;
    weft_status status = expand_matches(text, pattern, directory, frames, out, err);
    free(directory);
    return status;
}

/* ---- A directory ---- */

/* Finds the only group of more than one file, entries *first .. *end - 1; false if there are
 * several or none. */
static bool only_group(const wf_numbered_list *list, size_t *first, size_t *end) {
    int found = 0;
    for (size_t i = 0, next; i < list->count; i = next) {
        next = wf_group_end(list, i);
        if (next - i < 2) continue;
        *first = i;
        *end = next;
        found++;
    }
    return found == 1;
}

static const char *only_picture(const wf_names *names) {
    const char *found = NULL;
    for (const char *name = NULL; (name = wf_names_next(names, name));) {
        if (!wf_name_is_picture(name)) continue;
        if (found) return NULL;
        found = name;
    }
    return found;
}

/* A directory's names, read in one way. */
typedef struct reading {
    wf_numbered_list list;
    size_t first, end; /* of the only group of several files; 0, 0: there is none */
    double density;    /* of the group */
} reading;

static weft_status read_names(const wf_names *names, int way, reading *out, weft_error *err) {
    *out = (reading){0};
    weft_status status = wf_names_group(names, way, &out->list, err);
    if (status) return status;
    if (!only_group(&out->list, &out->first, &out->end))
        out->first = out->end = 0;
    else
        out->density = wf_number_density(out->list.entry + out->first, out->end - out->first);
    return WEFT_OK;
}

/* In "shot.1001.25.exr" 25 is a sub-frame of 1001 where that leaves fewer pictures out, or
 * takes as many and makes one sequence with fewer gaps; elsewhere it is picture 25 of scene
 * 1001. So "shot.0025_v2.exr" is picture 25, unless there are more that differ in the 2. */
static bool reads_better(const reading *other, const reading *best) {
    size_t taken = other->end - other->first, before = best->end - best->first;
    if (other->density < 0.5) return false;
    return taken != before ? taken > before : other->density > best->density;
}

static weft_status read_directory(const wf_names *names, reading *out, weft_error *err) {
    weft_status status = read_names(names, 0, out, err);
    for (int way = 1; !status && way < WF_NUMBER_WAYS; way++) {
        reading other = {0};
        status = read_names(names, way, &other, err);
        bool better = !status && reads_better(&other, out);
        free(better ? out->list.entry : other.list.entry);
        if (better) *out = other;
    }
    return status;
}

/* What files are called, by their endings: "3 .mov, 1 .txt". */
static void tell_endings(const wf_names *names, char *text, size_t size) {
    const char *ending[6];
    size_t number[6] = {0}, count = 0, used = 0;
    *text = '\0';
    for (const char *name = NULL; (name = wf_names_next(names, name));) {
        const char *dot = strrchr(name, '.');
        size_t i = 0;
        if (!dot) continue;
        while (i < count && strcasecmp(ending[i], dot)) i++;
        if (i == sizeof ending / sizeof *ending) continue;
        if (i == count) ending[count++] = dot;
        number[i]++;
    }
    for (size_t i = 0; i < count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%zu %.16s", i ? ", " : " (",
                                 number[i], ending[i]);
    if (count && used < size) snprintf(text + used, size - used, ")");
}

static weft_status refuse_groups(const char *input, const wf_names *names,
                                 const wf_numbered_list *groups, weft_error *err) {
    char there[600], endings[160];
    wf_groups_text(groups, there, sizeof there);
    tell_endings(names, endings, sizeof endings);
    if (!names->count)
        return wf_fail(
            err, WEFT_FAILED,
            "%s: the directory holds no numbered pictures, and no files at all; give the "
            "one that they are in",
            wf_path_tail(input));
    if (!groups->count)
        return wf_fail(
            err, WEFT_FAILED,
            "%s: the directory holds no numbered pictures among its %zu files%s; give a "
            "pattern such as shot.####.exr, the files in order, or a video by its own name",
            wf_path_tail(input), names->count, endings);
    return wf_fail(
        err, WEFT_FAILED,
        "%s: the directory does not hold just one sequence; give the pattern of one of "
        "%s",
        wf_path_tail(input), there);
}

static void tell_left_out(const wf_names *names, const reading *r, const char *input,
                          wf_sequence *out) {
    size_t pictures = 0, taken = r->end - r->first;
    char group[300];
    for (const char *name = NULL; (name = wf_names_next(names, name));)
        pictures += wf_name_is_picture(name);
    if (pictures == taken) return;
    wf_group_text(&r->list, r->first, r->end, group, sizeof group);
    wf_sequence_tell(out, "%s: of %zu pictures %zu are taken, which are %s",
                     wf_path_tail(input), pictures, taken, group);
}

static weft_status expand_names(const char *input, const wf_names *names, const char *directory,
                                const char *frames, wf_sequence *out, weft_error *err) {
    reading r;
    weft_status status = read_directory(names, &r, err);
    if (!status && !r.end) status = refuse_groups(input, names, &r.list, err);
    if (!status) {
        wf_numbered_list group = {r.list.entry + r.first, r.end - r.first};
        status = select_from(&group, directory, input, frames, out, err);
    }
    if (!status) tell_left_out(names, &r, input, out);
    free(r.list.entry);
    return status;
}

static weft_status expand_lone(const char *directory, const char *name, const char *frames,
                               wf_sequence *out, weft_error *err) {
    char *path;
    if (asprintf(&path, "%s%s", directory, name) < 0)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", wf_path_tail(directory));
    weft_status status = expand_file(path, frames, out, err);
    free(path);
    return status;
}

static weft_status expand_directory(const char *input, const char *frames, wf_sequence *out,
                                    weft_error *err) {
    char *directory;
    const char *slash = input[strlen(input) - 1] == '/' ? "" : "/";
    if (asprintf(&directory, "%s%s", input, slash) < 0)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", wf_path_tail(input));
    wf_names names = {0};
    weft_status status = wf_names_read(directory, &names, err);
    const char *lone = status ? NULL : only_picture(&names);
    if (!status)
        status = lone ? expand_lone(directory, lone, frames, out, err)
                      : expand_names(input, &names, directory, frames, out, err);
    wf_names_free(&names);
    free(directory);
    return status;
}

/* ---- A list of files ---- */

static int order_paths(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static weft_status check_list(char *const *inputs, size_t count, weft_error *err) {
    char **sorted = malloc(count * sizeof *sorted);
    if (!sorted) return wf_fail(err, WEFT_NO_MEMORY, "out of memory for %zu inputs", count);
    memcpy(sorted, inputs, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, order_paths);
    weft_status status = WEFT_OK;
    for (size_t i = 1; i < count && !status; i++)
        if (!strcmp(sorted[i - 1], sorted[i]))
            status = wf_fail(err, WEFT_USAGE, "%s: given twice; every subframe is taken once",
                             wf_path_tail(sorted[i]));
    free(sorted);
    return status;
}

static int by_number(const void *a, const void *b) {
    const wf_numbered *left = a, *right = b;
    return wf_number_order(left->number, right->number);
}

/* Numbers a list whose names differ in their numbers alone, and puts it in their order. Returns
 * wf_number_density of it, or -1 if it is no such list. */
static double number_list(char *const *inputs, size_t count, int way, wf_numbered *entry) {
    size_t directory = (size_t)(wf_base_name(inputs[0]) - inputs[0]);
    for (size_t i = 0; i < count; i++) {
        const char *name = wf_base_name(inputs[i]);
        bool same = (size_t)(name - inputs[i]) == directory &&
                    !memcmp(inputs[i], inputs[0], directory) &&
                    wf_name_number_of(name, way, &entry[i]) && entry[i].group == entry[0].group;
        if (!same) return -1;
        entry[i].name = inputs[i];
    }
    qsort(entry, count, sizeof *entry, by_number);
    return wf_number_density(entry, count);
}

static void count_list(char *const *inputs, size_t count, wf_numbered *entry) {
    for (size_t i = 0; i < count; i++)
        entry[i] = (wf_numbered){.number = {(int64_t)i, 1}, .name = inputs[i], .part = -1};
}

static weft_status expand_list(char *const *inputs, size_t count, const char *frames,
                               wf_sequence *out, weft_error *err) {
    weft_status status = check_list(inputs, count, err);
    if (status) return status;
    wf_numbered_list list = {malloc(count * sizeof *list.entry), count};
    if (!list.entry) return wf_fail(err, WEFT_NO_MEMORY, "out of memory for %zu inputs", count);
    double best = -1;
    int best_way = 0;
    for (int way = 0; way < WF_NUMBER_WAYS; way++) {
        double density = number_list(inputs, count, way, list.entry);
        if (density > best) best = density, best_way = way;
    }
    if (best < 0)
        count_list(inputs, count, list.entry);
    else
        number_list(inputs, count, best_way, list.entry);
    status = select_from(&list, "", inputs[0], frames, out, err);
    free(list.entry);
    return status;
}

/* ---- All of it ---- */

typedef enum input_kind { FILE_INPUT, DIRECTORY_INPUT, PATTERN_INPUT } input_kind;

static weft_status refuse_absent(const char *input, int code, weft_error *err) {
    char there[480] = "";
    wf_names names = {0};
    char *directory = directory_of(input, (size_t)(wf_base_name(input) - input), err);
    if (!directory) return WEFT_NO_MEMORY;
    if (code == ENOENT && !wf_names_read(openable(directory), &names, NULL))
        tell_what_is_there(&names, there, sizeof there);
    wf_names_free(&names);
    free(directory);
    return wf_fail(err, WEFT_FAILED, "%s: %s%s", wf_path_tail(input), strerror(code), there);
}

/* A file that exists is taken as it is, whatever signs its name holds. */
static weft_status classify(const char *input, input_kind *kind, wf_pattern *pattern,
                            weft_error *err) {
    struct stat about;
    char why[256];
    *kind = PATTERN_INPUT;
    if (!*input)
        return wf_fail(err, WEFT_USAGE,
                       "an input's name is empty; give a file, a pattern such as "
                       "shot.####.exr, or a directory");
    if (!stat(input, &about)) {
        *kind = S_ISDIR(about.st_mode) ? DIRECTORY_INPUT : FILE_INPUT;
        return WEFT_OK;
    }
    int code = errno;
    wf_pattern_kind found = wf_pattern_parse(input, pattern, why, sizeof why);
    if (found == WF_PATTERN_BAD)
        return wf_fail(err, WEFT_USAGE, "%s: %s", wf_path_tail(input), why);
    return found == WF_PATTERN_OK ? WEFT_OK : refuse_absent(input, code, err);
}

static weft_status expand_one(const char *input, const char *frames, wf_sequence *out,
                              weft_error *err) {
    input_kind kind;
    wf_pattern pattern;
    weft_status status = classify(input, &kind, &pattern, err);
    if (status) return status;
    if (kind == PATTERN_INPUT) return expand_pattern(input, &pattern, frames, out, err);
    return (kind == FILE_INPUT ? expand_file : expand_directory)(input, frames, out, err);
}

static weft_status expand_many(char *const *inputs, size_t count, const char *frames,
                               wf_sequence *out, weft_error *err) {
    for (size_t i = 0; i < count; i++) {
        input_kind kind;
        wf_pattern pattern;
        weft_status status = classify(inputs[i], &kind, &pattern, err);
        if (status) return status;
        if (kind != FILE_INPUT)
            return wf_fail(
                err, WEFT_USAGE,
                "%s: %s stands alone; inputs are one pattern, one directory, or files "
                "in order",
                wf_path_tail(inputs[i]), kind == PATTERN_INPUT ? "a pattern" : "a directory");
    }
    return expand_list(inputs, count, frames, out, err);
}

weft_status wf_sequence_expand(char *const *inputs, size_t count, const char *frames,
                               wf_sequence *out, weft_error *err) {
    *out = (wf_sequence){0};
    if (!count)
        return wf_fail(err, WEFT_USAGE,
                       "no input; give a file, a pattern such as shot.####.exr, "
                       "or a directory");
    return count == 1 ? expand_one(inputs[0], frames, out, err)
                      : expand_many(inputs, count, frames, out, err);
}
