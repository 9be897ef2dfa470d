#ifndef WF_CONVERT_BASE_NAMES_H
#define WF_CONVERT_BASE_NAMES_H

#include "convert/base/fail.h"
#include "convert/base/pattern.h"

/* The names of a directory's files (no directories, no "." and ".."), one '\0'-ended after the
 * other: a million of them take one listing and one block. */
typedef struct wf_names {
    char *text;
    size_t bytes, capacity, count;
} wf_names;

/* Zeroed names are empty. wf_names_free releases what either has made, whatever the status. */
weft_status wf_names_read(const char *directory, wf_names *out, weft_error *err);
bool wf_names_add(wf_names *names, const char *name); /* false: out of memory */
void wf_names_free(wf_names *names);

/* The name after `name`; the first after NULL, and NULL after the last. */
const char *wf_names_next(const wf_names *names, const char *name);

/* A file that has a number. The name is borrowed from the wf_names. */
typedef struct wf_numbered {
    wf_rational number;
    uint64_t group; /* equal for names that differ in their number only */
    const char *name;
    int part;            /* of a multi-part file, else -1 */
    uint16_t start, end; /* where name has its number */
} wf_numbered;

typedef struct wf_numbered_list {
    wf_numbered *entry;
    size_t count;
} wf_numbered_list;

/* The names that pattern matches, by number. The list's entries are the caller's, free(). */
weft_status wf_names_match(const wf_names *names, const wf_pattern *pattern,
                           wf_numbered_list *out, weft_error *err);

/* The pictures (by their endings) that have a number, by group and number; dot files are none.
 * How a name is read is wf_name_find_number's. */
weft_status wf_names_group(const wf_names *names, int way, wf_numbered_list *out,
                           weft_error *err);
bool wf_name_is_picture(const char *name);

/* Whether what follows its last dot is ending (".dpx"), in either case. */
bool wf_name_ends_in(const char *name, const char *ending);

/* The file at path, of a sequence that of frame 0, by its folder as the system knows it; the
 * path itself where there is no such folder. Two names of one place give equal text. free().
 * NULL: no memory. */
char *wf_name_place(const char *path);

/* Whether a file that is written at path would take the place of another: both are one file, or
 * will have one name, or the other is a sequence ("shot.####.png") that has a file so called.
 */
bool wf_name_replaces(const char *path, const char *other);

/* Reads the number of one name; false if it has none. */
bool wf_name_number_of(const char *name, int way, wf_numbered *out);

/* The end of the group that starts at entry `start`. */
size_t wf_group_end(const wf_numbered_list *list, size_t start);

/* Entries first .. end - 1, one group by number, as a pattern with its range:
 * "beauty.####.exr 1-48". Returns the length of the text, cut off where it does not fit. */
size_t wf_group_text(const wf_numbered_list *list, size_t first, size_t end, char *text,
                     size_t size);

/* The largest groups as texts with commas, most files first; at most eight. */
void wf_groups_text(const wf_numbered_list *list, char *text, size_t size);

/* The step between the numbers of `count` entries by number: 1 for whole numbers, else the
 * largest that meets them all. {0, 0} where it does not fit. */
wf_rational wf_natural_step(const wf_numbered *entry, size_t count);

#endif
