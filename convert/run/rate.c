/* The rate of a sequence, from what its files say and how they are numbered. */
#include "convert/run/rate.h"

#include <inttypes.h>
#include <stdio.h>

#include "convert/read/selection.h"

#define LOWEST_RATE  1e-3
#define HIGHEST_RATE 1e6

static weft_status refuse(const char *input, const char *says, weft_error *err) {
    return wf_fail(err, WEFT_FAILED,
                   "%s: the files say %s, which is no rate of pictures; give --subframe-rate, "
                   "such as --subframe-rate 240 or 480000/1001",
                   wf_path_tail(input), says);
}

weft_status wf_rate_of_files(const char *input, const wf_image_info *first,
                             const wf_sequence *sequence, wf_rational *rate, weft_error *err) {
    char text[48], says[160];
    if (*first->no_rate && !first->counts_files) return refuse(input, first->no_rate, err);
    if (!wf_ratio_given(first->rate))
        return wf_fail(err, WEFT_USAGE,
                       "%s: the files do not say how many subframes a second they are; give "
                       "--subframe-rate, such as --subframe-rate 240 or 480000/1001",
                       wf_path_tail(input));
    *rate =
        wf_ratio_div(first->rate, first->counts_files ? sequence->step : sequence->number_step);
    bool given = wf_ratio_given(*rate);
    double value = given ? wf_ratio_value(*rate) : 0;
    if (value >= LOWEST_RATE && value <= HIGHEST_RATE) return WEFT_OK;
    snprintf(says, sizeof says, "%s a second in steps of %.9g", wf_rate_text(first->rate, text),
             wf_ratio_value(first->counts_files ? sequence->step : sequence->number_step));
    return refuse(input, says, err);
}

const char *wf_rate_text(wf_rational rate, char text[48]) {
    int used = snprintf(text, 48, "%" PRId64, rate.num);
    if (rate.den != 1) snprintf(text + used, 48 - (size_t)used, "/%" PRId64, rate.den);
    return text;
}
