/* What a television shows of a job's input: what is asked, and the report. */
#include "convert/ask/composite.h"

#include <stdlib.h>

#include "convert/ask/asking.h"
#include "convert/base/clock.h"
#include "convert/job/report.h"
#include "convert/run/broadcast.h"

typedef struct settled {
    wf_broadcast set;
    wf_tv_system system;
    wf_raster raster;
} settled;

static weft_status settle(const weft_job *job, const weft_composite *asked, settled *s,
                          weft_error *err) {
    int system = -1, encoder = WF_ENCODER_CHEAP, decoder = WF_DECODER_NOTCH;
    weft_status status = wf_ask_choose("system", WF_ASK_SYSTEMS, asked->system, &system, err);
    if (!status)
        status = wf_ask_choose("encoder", WF_ASK_ENCODERS, asked->encoder, &encoder, err);
    if (!status)
        status = wf_ask_choose("decoder", WF_ASK_DECODERS, asked->decoder, &decoder, err);
    if (!status) status = wf_ask_raster(asked->raster, &s->raster, err);
    if (status) return status;
    s->system = (wf_tv_system)(system < 0 ? 0 : system);
    s->set = (wf_broadcast){.raster = asked->raster ? &s->raster : NULL,
                            .system = system < 0 ? NULL : &s->system,
                            .keep_sound = !job->audio && !asked->audio,
                            .encoder = (wf_tv_encoder)encoder,
                            .decoder = (wf_tv_decoder)decoder};
    return WEFT_OK;
}

static weft_status check_inputs(const weft_job *job, weft_error *err) {
    weft_status status = wf_ask_inputs(
        job, "nothing to show; give video, such as shot.y4m or out.####.dpx", err);
    if (status || job->input_count == 1) return status;
    return wf_fail(err, WEFT_USAGE,
                   "one input at a time, and '%.200s' is a second; a sequence is one when it "
                   "is given as a pattern, in quotes: 'shot.####.dpx'",
                   job->inputs[1]);
}

static weft_status show(weft_job *job, const wf_broadcast *set, weft_error *err) {
    double start = wf_now_s();
    weft_error own;
    if (!err) err = &own;
    wf_report report = {.command = "composite", .raster = &job->raster};
    weft_status status = wf_broadcast_run(job, set, &report, err);
    report.wall_s = wf_now_s() - start;
    report.error = status ? err->text : NULL;
    free(job->report);
    job->report = wf_report_json(&report);
    return status;
}

weft_status weft_job_composite(weft_job *job, const weft_composite *asked, weft_error *err) {
    weft_composite own;
    settled s = {0};
    weft_status status = wf_asked(asked, "weft_composite", &own, sizeof own, err);
    if (!status) status = check_inputs(job, err);
    if (!status && own.audio) status = weft_job_set(job, "audio", own.audio, err);
    if (!status) status = settle(job, &own, &s, err);
    return status ? status : show(job, &s.set, err);
}
