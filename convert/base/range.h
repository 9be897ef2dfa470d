#ifndef WF_CONVERT_BASE_RANGE_H
#define WF_CONVERT_BASE_RANGE_H

#include "convert/base/fail.h"
#include "filters/base/rational.h"

/* Selections hold at most this many numbers. */
#define WF_RANGE_MOST 10000000

/* Frame numbers are exact ratios; these are what wf_rational has not. */
int wf_number_order(wf_rational a, wf_rational b);         /* < 0, 0, > 0 */
wf_rational wf_number_minus(wf_rational a, wf_rational b); /* {0, 0} where it does not fit */

/* The largest step that leads from 0 to both: of 1/2 and 3/4, 1/4. Neither is negative, {0, 1}
 * is neutral; {0, 0} where it does not fit. */
wf_rational wf_number_common_step(wf_rational a, wf_rational b);

/* "12", "1001.25", "-1/3". Returns text. */
const char *wf_number_text(wf_rational number, char *text, size_t size);

/* How many numbers first, first + step, .. last there are, step > 0; 0 if last < first,
 * INT64_MAX where it does not fit. */
int64_t wf_number_count(wf_rational first, wf_rational last, wf_rational step);

/* A list of runs as --frames takes them: "1-96", "1-96x2", "1001-1066x0.25", "7", "-3-5", and
 * lists of these with commas. */
typedef struct wf_range_run {
    int64_t first, step, den; /* number i is (first + i step) / den */
    int64_t count;
} wf_range_run;

typedef struct wf_frame_range {
    wf_range_run *run;
    size_t runs;
    int64_t count; /* of numbers in all runs, at most `most` */
} wf_frame_range;

/* WEFT_USAGE with a hint for what is no range, for one with more than most numbers, and for ':'
 * steps. wf_range_free releases it whatever the status. */
weft_status wf_range_parse(const char *text, int64_t most, wf_frame_range *out,
                           weft_error *err);
void wf_range_free(wf_frame_range *range);

/* All numbers in ascending order (range->count of them; the caller's, free()) and the step
 * between them: runs may leave gaps between each other, but must have one step. A number given
 * twice is WEFT_USAGE. *step is {0, 0} for a single number given as such. */
weft_status wf_range_numbers(const wf_frame_range *range, const char *text,
                             wf_rational **numbers, wf_rational *step, weft_error *err);

#endif
