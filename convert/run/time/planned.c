/* Files of a plan: their numbers count from 0, whichever is the first there is. */
#include "convert/run/time/planned.h"

#include <inttypes.h>
#include <stdio.h>

#include "convert/base/range.h"
#include "convert/finish/setup.h"
#include "convert/run/time/picture_rate.h"

/* The first file that is there, and the last; numbers of plans are whole. */
static bool find_ends(const wf_sequence *sequence, int64_t *first, int64_t *last) {
    bool found = false;
    for (size_t k = 0; k < sequence->count; k++) {
        const wf_subframe_ref *ref = &sequence->refs[k];
        if (!ref->path) continue;
        if (ref->number.den != 1 || ref->number.num < 0) return false;
        *last = ref->number.num;
        if (!found) *first = *last;
        found = true;
    }
    return found && *last < WF_RANGE_MOST;
}

/* How many of such numbers there would be a second. */
static wf_rational rate_of(const weft_job *job, const wf_image_info *info, int64_t first) {
    if (wf_ratio_given(job->subframe_rate)) return job->subframe_rate;
    if (wf_ratio_given(info->time_s) && info->time_s.num > 0 && first > 0)
        return wf_ratio_div(wf_ratio(first, 1), info->time_s);
    return info->rate;
}

static bool make_timing(const weft_job *job, wf_rational rate, wf_timing *timing) {
    char why[512];
    weft_job quiet = *job;
    quiet.warning = NULL;
    if (!wf_ratio_given(rate)) return false;
    if (job->raster.pulldown && wf_settle_film(&quiet, "subframes", &rate, NULL)) return false;
    const wf_timing_desc desc = {.raster = &job->raster,
                                 .subframe_rate = rate,
                                 .subframe_center = job->subframe_time_center,
                                 .subframes = INT64_C(1) << 40,
                                 .width = wf_setup_width(job),
                                 .position = job->shutter_position,
                                 .skew = wf_ratio_given(job->scan_skew) ? job->scan_skew
                                                                        : wf_ratio(0, 1)};
    return wf_timing_init(timing, &desc, why, sizeof why);
}

/* Whether every file is seen by some field; both go up. */
static bool all_are_seen(const weft_job *job, const wf_timing *timing,
                         const wf_sequence *sequence) {
    int per_frame = wf_raster_fields_per_frame(&job->raster);
    int64_t field = job->output_first * per_frame, end = job->output_end * per_frame;
    wf_window window = {0};
    for (size_t k = 0; k < sequence->count; k++) {
        const wf_subframe_ref *ref = &sequence->refs[k];
        if (!ref->path) continue;
        while (ref->number.num >= window.first + window.count && field < end)
            window = wf_timing_field(timing, field++, job->raster.lines);
        if (ref->number.num < window.first || ref->number.num >= window.first + window.count)
            return false;
    }
    return true;
}

static weft_status count_from_zero(const weft_job *job, int64_t first, int64_t last,
                                   wf_sequence *sequence, weft_error *err) {
    char frames[32];
    wf_sequence whole;
    snprintf(frames, sizeof frames, "0-%" PRId64, last);
    weft_status status = wf_sequence_expand(job->inputs, job->input_count, frames, &whole, err);
    if (status) return status;
    wf_sequence_free(sequence);
    *sequence = whole;
    wf_sequence_tell(sequence,
                     "the files are numbered %" PRId64 " to %" PRId64
                     ", and are just those that the frames see if number 0 is where the shot "
                     "begins: so they are counted; --frames says otherwise",
                     first, last);
    return WEFT_OK;
}

weft_status wf_take_planned(const weft_job *job, const wf_image_info *info,
                            wf_sequence *sequence, wf_rational *rate, weft_error *err) {
    int64_t first = 0, last = 0;
    wf_timing timing;
    if (!job->output_end || job->frames || !find_ends(sequence, &first, &last)) return WEFT_OK;
    wf_rational planned = rate_of(job, info, first);
    if ((first == 0 && !sequence->stepped) || !make_timing(job, planned, &timing) ||
        !all_are_seen(job, &timing, sequence))
        return WEFT_OK;
    *rate = planned;
    return count_from_zero(job, first, last, sequence, err);
}
