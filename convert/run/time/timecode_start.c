/* The timecode of frame 0. */
#include "convert/run/time/timecode_start.h"

#include <stdio.h>
#include <string.h>

#define MOST_LABELS 60 /* a second: what renderers call framesPerSecond may be subframes */
#define A_FRAMES    5  /* labels from one A frame to the next */

wf_rational wf_timecode_rate(const weft_job *job, const wf_image_info *first) {
    wf_rational told = first->frames;
    if (wf_ratio_given(told) && wf_timecode_base(told) <= MOST_LABELS) return told;
    return job->raster.pulldown ? wf_raster_film_rate(&job->raster) : job->raster.frame_rate;
}

static void take_label(const weft_job *job, wf_setup *s, const wf_image_info *first) {
    wf_timecode label;
    const char *name = job->inputs[0];
    wf_rational rate = wf_timecode_rate(job, first);
    bool read = wf_parse_timecode(first->timecode, &label);
    if (read && !first->timecode_all && wf_timecode_together(rate) == 2)
        label.frames = 2 * label.frames + first->timecode_mark;
    if (!read || !wf_timecode_convert(label, rate, job->raster.frame_rate, &label)) {
        wf_job_warn(job,
                    "%s: its timecode, %s, is none at %.6g frames a second: frame 0 is "
                    "00:00:00:00",
                    name, first->timecode, wf_ratio_value(rate));
        return;
    }
    wf_timecode_text(&label, s->timecode);
    s->output_options.timecode = s->timecode;
    wf_job_warn(job, "timecode of frame 0 is %s, from %s of %s; --timecode gives another",
                s->timecode, first->timecode, name);
}

/* Editors look for A frames at labels :00 and :05; drop frame moves them about anyway. */
static void check_a_frame(const weft_job *job, const wf_setup *s) {
    wf_timecode label;
    bool film = job->raster.pulldown && job->raster.scan == WF_INTERLACED;
    if (!film || !wf_parse_timecode(s->output_options.timecode, &label)) return;
    if (!label.drop_frame && label.frames % A_FRAMES)
        wf_job_warn(job,
                    "frame 0 is an A frame (AA BB BC CD DD) and its timecode %s: by convention "
                    "A frames have frames that 5 divides",
                    s->output_options.timecode);
}

void wf_advance_timecode(const weft_job *job, wf_image_info *first, wf_rational by_s) {
    wf_timecode label;
    char why[256], text[WF_TIMECODE_SIZE];
    wf_rational rate = wf_timecode_rate(job, first);
    if (!wf_parse_timecode(first->timecode, &label) ||
        !wf_timecode_check(&label, rate, why, sizeof why))
        return;
    label = wf_timecode_add(&label, wf_ratio_floor_mul(wf_ratio_mul(by_s, rate), 1), rate);
    snprintf(first->timecode, sizeof first->timecode, "%s", wf_timecode_text(&label, text));
}

void wf_start_timecode(const weft_job *job, wf_setup *s, const wf_image_info *first) {
    if (!job->timecode && *first->timecode) take_label(job, s, first);
    check_a_frame(job, s);
}
