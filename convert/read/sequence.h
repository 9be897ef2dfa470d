#ifndef WF_CONVERT_READ_SEQUENCE_H
#define WF_CONVERT_READ_SEQUENCE_H

#include "convert/base/fail.h"
#include "filters/base/rational.h"

/* One subframe of a sequence: a file, or one part of a multi-part file. A missing one has no
 * path. */
typedef struct wf_subframe_ref {
    char *path;         /* NULL: the number is absent from the selected range */
    int part;           /* -1: the part --part names, or the first one with a picture */
    wf_rational number; /* frame number; "12.25" is 49/4 */
} wf_subframe_ref;

/* An ordered list of the subframes selected, missing ones included. Owned by the caller; freed
 * by wf_sequence_free. Not shared between threads while it is built; read-only afterwards. */
typedef struct wf_sequence {
    wf_subframe_ref *refs;
    size_t count;
    size_t missing; /* how many refs have no path */
    /* From one of the selection to the next: in the files' own steps (1, or 2 after "x2" or
     * after x0.5 of quarters), by which a rate of subframes is divided; and in numbers, by
     * which a rate of frames is. */
    wf_rational step, number_step;
    bool ranged;      /* a range says which numbers are selected */
    bool stepped;     /* the numbers between are taken to be left out on purpose */
    char notice[700]; /* what people should know of how the inputs were read; "": nothing */
} wf_sequence;

/* Adds to the notice. */
void wf_sequence_tell(wf_sequence *sequence, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Expands inputs (patterns "shot.####.exr", "shot.@@@@.exr", "shot.%04d.exr", "shot.#.#.exr",
 * a directory, or an explicit list of files) and the range frames ("1-10", "1-10x2",
 * "1001-1066x0.25", or NULL for all that exist) into *out. Numbers between the first and the
 * last selected that have no file are refs without a path; without a range, numbers in even
 * steps are a sequence of that step, and ".333" may be a third (numbers.h). Files of a list
 * whose names differ in their numbers alone are taken by number, in whatever order they come;
 * of any other list they keep its order and are numbered from 0. Parts with weft:time of a
 * single file are a sequence numbered from 0. Duplicate numbers ("a.1.exr" beside
 * "a.0001.exr"), an empty match, a directory that holds two sequences, ':' steps and malformed
 * ranges are errors that name what is there and what would be right. */
weft_status wf_sequence_expand(char *const *inputs, size_t input_count, const char *frames,
                               wf_sequence *out, weft_error *err);

void wf_sequence_free(wf_sequence *sequence);

#endif
