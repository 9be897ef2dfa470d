#ifndef WF_CONVERT_BASE_PATTERN_H
#define WF_CONVERT_BASE_PATTERN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "filters/base/rational.h"

#define WF_NAME_SIZE 256 /* of a file's name without its directory, with its end */

#define WF_DECIMALS_KEPT 12 /* of a number in a name; what follows them is cut off */

/* A path whose last name holds a frame field: "shot.####.exr", "shot.@@@@.exr",
 * "shot.%04d.exr", and with sub-frames "shot.#.#.exr". A lone '#' stands for four digits, of
 * several '#' and of '@' each for one; %d and %0Nd are printf's and %% is '%'. '@' is itself
 * where the name has another field. Directories are taken as they are. */
typedef struct wf_pattern {
    size_t directory_length; /* bytes of the path before its last name, the '/' included */
    char prefix[WF_NAME_SIZE], suffix[WF_NAME_SIZE];
    int digits;          /* written: numbers are padded with zeros to this width */
    int fewest;          /* read: the least width, sign included; 1 for a lone '#' */
    int fewest_decimals; /* read: the least width of a fraction; 0: there are no sub-frames */
} wf_pattern;

typedef enum wf_pattern_kind {
    WF_PATTERN_NONE, /* no frame field */
    WF_PATTERN_OK,
    WF_PATTERN_BAD /* a field that makes no sense; why says so */
} wf_pattern_kind;

wf_pattern_kind wf_pattern_parse(const char *path, wf_pattern *out, char *why, size_t why_size);

/* The path a sequence pattern gives for an output frame: "out.####.png", 12 -> "out.0012.png".
 * False if pattern holds no frame field or path does not fit. */
bool wf_pattern_path(const char *pattern, int64_t frame, char *path, size_t path_size);
bool wf_pattern_is(const char *pattern);

/* Whether name (no directory) is one of pattern's. "1001.25" is 4005/4 exactly; where there are
 * sub-frames a whole number may stand alone. */
bool wf_pattern_match(const wf_pattern *pattern, const char *name, wf_rational *number);

/* Where a name that came without a pattern has its number: the last digits before its ending
 * ("shot_v2.0001.exr", "0001_beauty.exr"), a '-' being a sign after '.' or '_' or at the start.
 * There are several ways to read a name: odd ones take two numbers with a '.' between for one
 * with sub-frames ("shot.1001.25.exr" is number 1001.25 and not number 25 of "shot.1001."), and
 * way / 2 numbers at the end are left alone ("shot.0001_v2.exr" has number 1 by way 2). */
typedef struct wf_name_number {
    size_t start, end;
    wf_rational value;
} wf_name_number;
#define WF_NUMBER_WAYS 6
bool wf_name_find_number(const char *name, int way, wf_name_number *out);

/* The part of a path after its last '/'. */
const char *wf_base_name(const char *path);

#endif
