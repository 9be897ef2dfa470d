/* Names of files: listing a directory, and the sequences that its names form. */
#include "convert/base/names.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <xxhash.h>

#include "convert/base/range.h"

/* ---- Listing ---- */

bool wf_names_add(wf_names *names, const char *name) {
    size_t length = strlen(name) + 1;
    if (names->capacity - names->bytes < length) {
        size_t capacity = 2 * names->capacity + length + 4096;
        char *grown = realloc(names->text, capacity);
        if (!grown) return false;
        names->text = grown;
        names->capacity = capacity;
    }
    memcpy(names->text + names->bytes, name, length);
    names->bytes += length;
    names->count++;
    return true;
}

void wf_names_free(wf_names *names) {
    free(names->text);
    *names = (wf_names){0};
}

const char *wf_names_next(const wf_names *names, const char *name) {
    if (!names->count) return NULL;
    const char *next = name ? name + strlen(name) + 1 : names->text;
    return next < names->text + names->bytes ? next : NULL;
}

/* Some file systems do not tell what an entry is. Links are not followed: there may be a
 * million. */
static bool is_folder(DIR *dir, const struct dirent *entry) {
    struct stat about;
    if (entry->d_type != DT_UNKNOWN) return entry->d_type == DT_DIR;
    return !fstatat(dirfd(dir), entry->d_name, &about, 0) && S_ISDIR(about.st_mode);
}

weft_status wf_names_read(const char *directory, wf_names *out, weft_error *err) {
    DIR *dir = opendir(directory);
    if (!dir)
        return wf_fail(err, WEFT_FAILED, "%.300s: the directory cannot be read: %s", directory,
                       strerror(errno));
    weft_status status = WEFT_OK;
    const struct dirent *entry;
    for (errno = 0; !status && (entry = readdir(dir)); errno = 0) {
        if (!is_folder(dir, entry) && !wf_names_add(out, entry->d_name))
            status = wf_fail(err, WEFT_NO_MEMORY, "%.300s: out of memory after %zu names",
                             directory, out->count);
    }
    if (!status && errno)
        status = wf_fail(err, WEFT_FAILED, "%.300s: the directory cannot be read: %s",
                         directory, strerror(errno));
    closedir(dir);
    return status;
}

/* ---- Numbers ---- */

bool wf_name_is_picture(const char *name) {
    static const char *const endings[] = {
        "exr", "dpx",  "cin", "tif",  "tiff", "png", "jpg", "jpeg",  "jp2",  "j2c",  "j2k",
        "tga", "bmp",  "hdr", "rgbe", "pic",  "pbm", "pgm", "ppm",   "pnm",  "pfm",  "sgi",
        "rgb", "rgba", "bw",  "iff",  "rla",  "psd", "gif", "webp",  "heic", "avif", "fits",
        "ico", "dds",  "tx",  "env",  "sm",   "vdb", "ptx", "zfile", "sxr",  "mxr"};
    const char *dot = strrchr(name, '.');
    if (!dot || *name == '.') return false;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (!strcasecmp(dot + 1, endings[i])) return true;
    return false;
}

static uint64_t group_of(const char *name, size_t start, size_t end) {
    uint64_t prefix = XXH3_64bits(name, start);
    return XXH3_64bits_withSeed(name + end, strlen(name + end), prefix);
}

bool wf_name_number_of(const char *name, int way, wf_numbered *out) {
    wf_name_number found;
    if (strlen(name) >= WF_NAME_SIZE || !wf_name_find_number(name, way, &found)) return false;
    *out = (wf_numbered){.number = found.value,
                         .group = group_of(name, found.start, found.end),
                         .name = name,
                         .part = -1,
                         .start = (uint16_t)found.start,
                         .end = (uint16_t)found.end};
    return true;
}

static int order(const void *a, const void *b) {
    const wf_numbered *left = a, *right = b;
    if (left->group != right->group) return left->group < right->group ? -1 : 1;
    int by_number = wf_number_order(left->number, right->number);
    return by_number ? by_number : strcmp(left->name, right->name);
}

static weft_status allocate(const wf_names *names, wf_numbered_list *out, weft_error *err) {
    *out = (wf_numbered_list){.entry = malloc((names->count + 1) * sizeof *out->entry)};
    return out->entry ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "out of memory");
}

weft_status wf_names_match(const wf_names *names, const wf_pattern *pattern,
                           wf_numbered_list *out, weft_error *err) {
    weft_status status = allocate(names, out, err);
    if (status) return status;
    for (const char *name = NULL; (name = wf_names_next(names, name));) {
        wf_numbered found = {.name = name,
                             .part = -1,
                             .start = (uint16_t)strlen(pattern->prefix),
                             .end = (uint16_t)(strlen(name) - strlen(pattern->suffix))};
        if (wf_pattern_match(pattern, name, &found.number)) out->entry[out->count++] = found;
    }
    qsort(out->entry, out->count, sizeof *out->entry, order);
    return WEFT_OK;
}

weft_status wf_names_group(const wf_names *names, int way, wf_numbered_list *out,
                           weft_error *err) {
    weft_status status = allocate(names, out, err);
    if (status) return status;
    for (const char *name = NULL; (name = wf_names_next(names, name));)
        if (wf_name_is_picture(name) && wf_name_number_of(name, way, &out->entry[out->count]))
            out->count++;
    qsort(out->entry, out->count, sizeof *out->entry, order);
    return WEFT_OK;
}

wf_rational wf_natural_step(const wf_numbered *entry, size_t count) {
    bool whole = true;
    wf_rational step = {0, 1};
    for (size_t i = 0; i < count; i++) {
        if (entry[i].number.den != 1) whole = false;
        if (i)
            step = wf_number_common_step(step,
                                         wf_number_minus(entry[i].number, entry[i - 1].number));
    }
    return whole || (step.den && !step.num) ? wf_ratio(1, 1) : step;
}

/* ---- Groups ---- */

size_t wf_group_end(const wf_numbered_list *list, size_t start) {
    size_t end = start + 1;
    while (end < list->count && list->entry[end].group == list->entry[start].group) end++;
    return end;
}

/* The fewest digits before and after the '.' that the numbers of a group have; *decimals is
 * 0 for whole numbers. */
static void shortest(const wf_numbered_list *list, size_t first, size_t end, int *digits,
                     int *decimals) {
    *digits = *decimals = 0;
    for (size_t i = first; i < end; i++) {
        const wf_numbered *e = &list->entry[i];
        const char *text = e->name + e->start;
        int length = e->end - e->start, whole = (int)strcspn(text, ".");
        if (whole > length) whole = length;
        int rest = length - whole - 1;
        if (!*digits || whole < *digits) *digits = whole;
        if (rest > 0 && (!*decimals || rest < *decimals)) *decimals = rest;
    }
}

static size_t marks(char *text, int count) {
    size_t length = count > 0 ? (size_t)(count < 20 ? count : 20) : 0;
    memset(text, '#', length);
    text[length] = '\0';
    return length;
}

size_t wf_group_text(const wf_numbered_list *list, size_t first, size_t end, char *text,
                     size_t size) {
    const wf_numbered *a = &list->entry[first], *z = &list->entry[end - 1];
    char field[48], from[48], to[48];
    int digits, decimals;
    shortest(list, first, end, &digits, &decimals);
    size_t used = marks(field, digits);
    if (decimals) {
        field[used++] = '.';
        marks(field + used, decimals);
    }
    wf_number_text(a->number, from, sizeof from);
    wf_number_text(z->number, to, sizeof to);
    int length = end - first == 1 ? snprintf(text, size, "%s", a->name)
                                  : snprintf(text, size, "%.*s%s%s %s-%s", a->start, a->name,
                                             field, a->name + a->end, from, to);
    return (size_t)length < size ? (size_t)length : size - 1;
}

/* The largest group that is smaller than the one before, in the order of size and name. */
static bool next_group(const wf_numbered_list *list, size_t *first, size_t *end) {
    size_t before = *end - *first, best = 0, best_first = 0;
    for (size_t i = 0, next; i < list->count; i = next) {
        next = wf_group_end(list, i);
        size_t size = next - i;
        bool later = size < before || (size == before && i > *first);
        if (later && size > best) best = size, best_first = i;
    }
    *first = best_first;
    *end = best_first + best;
    return best > 0;
}

void wf_groups_text(const wf_numbered_list *list, char *text, size_t size) {
    size_t first = 0, end = SIZE_MAX, used = 0;
    *text = '\0';
    for (int shown = 0; next_group(list, &first, &end); shown++) {
        if (shown == 8 || size - used < 80) {
            snprintf(text + used, size - used, ", ..");
            return;
        }
        if (shown) used += (size_t)snprintf(text + used, size - used, ", ");
        used += wf_group_text(list, first, end, text + used, size - used - 8);
    }
}

bool wf_name_ends_in(const char *name, const char *ending) {
    const char *dot = strrchr(name, '.');
    return dot && !strcasecmp(dot, ending);
}

static bool are_one_file(const char *a, const char *b) {
    struct stat x, y;
    return !stat(a, &x) && !stat(b, &y) && S_ISREG(x.st_mode) && x.st_dev == y.st_dev &&
           x.st_ino == y.st_ino;
}

/* The folder that a path's last name is in; NULL: there is none. free(). */
static char *folder_of(const char *path) {
    const char *name = wf_base_name(path);
    char *folder = name > path ? strndup(path, (size_t)(name - path)) : strdup(".");
    char *real = folder ? realpath(folder, NULL) : NULL;
    free(folder);
    return real;
}

char *wf_name_place(const char *path) {
    char first[PATH_MAX], *place;
    if (wf_pattern_is(path) && wf_pattern_path(path, 0, first, sizeof first)) path = first;
    char *folder = folder_of(path);
    if (!folder) return strdup(path);
    if (asprintf(&place, "%s/%s", folder, wf_base_name(path)) < 0) place = NULL;
    free(folder);
    return place;
}

bool wf_name_replaces(const char *path, const char *other) {
    char why[256];
    wf_pattern pattern;
    wf_rational number;
    const char *name = wf_base_name(path);
    if (are_one_file(path, other)) return true;
    bool numbered = wf_pattern_parse(other, &pattern, why, sizeof why) == WF_PATTERN_OK &&
                    wf_pattern_match(&pattern, name, &number);
    if (!numbered && strcmp(name, wf_base_name(other)) != 0) return false;
    char *mine = folder_of(path), *its = folder_of(other);
    bool same = mine && its && !strcmp(mine, its);
    free(mine);
    free(its);
    return same;
}
