/* Verifying the files of a job: what is asked, and what is found. */
#include "convert/ask/verify.h"

#include "convert/ask/asking.h"
#include "convert/job/report.h"

static void add_findings(wf_json *json, const char *path, const wf_verification *v) {
    static const char *const words[] = {
        [WF_RIGHT] = "right", [WF_WRONG] = "wrong", [WF_OPEN] = "open"};
    wf_json_open(json, NULL, '{');
    wf_json_text(json, "file", path);
    wf_json_text(json, "profile", v->profile ? v->profile->name : NULL);
    wf_report_raster(json, "raster", *v->raster.name ? &v->raster : NULL);
    wf_json_bool(json, "right", !v->wrong);
    wf_json_open(json, "checks", '[');
    for (size_t i = 0; i < v->count; i++) {
        const wf_finding *f = &v->finding[i];
        wf_json_open(json, NULL, '{');
        wf_json_text(json, "check", f->check);
        wf_json_text(json, "verdict", words[f->verdict]);
        wf_json_text(json, "is", f->is);
        wf_json_text(json, "should", *f->should ? f->should : NULL);
        wf_json_text(json, "by", f->by);
        wf_json_close(json);
    }
    wf_json_close(json);
    wf_json_close(json);
}

static weft_status read_asked(const weft_job *job, const weft_verify *asked, wf_raster *raster,
                              wf_verify_options *o, weft_error *err) {
    *o = (wf_verify_options){.max_memory_bytes = job->max_memory_bytes,
                             .raster = asked->raster ? raster : NULL,
                             .progress = job->progress,
                             .progress_user = job->progress_user,
                             .canceled = &job->canceled};
    weft_status status =
        wf_ask_inputs(job, "nothing to verify; give a delivered file, such as shot.mxf", err);
    if (!status && asked->profile) {
        o->profile = wf_profile_find(asked->profile, err);
        if (!o->profile) return WEFT_USAGE;
    }
    return status ? status : wf_ask_raster(asked->raster, raster, err);
}

static weft_status verify_one(const char *path, const wf_verify_options *options,
                              const wf_verify_tell *tell, wf_json *json,
                              wf_troubles *troubles) {
    wf_verification v;
    weft_error trouble = {""};
    weft_status status = wf_verify(path, options, &v, &trouble);
    if (!status) {
        add_findings(json, path, &v);
        if (tell) tell->findings(tell->user, path, &v);
        if (v.wrong)
            status = wf_fail(&trouble, WEFT_FAILED, "%.700s: %zu of %zu checks found it wrong",
                             path, v.wrong, v.count);
    }
    if (status) wf_trouble(troubles, status, trouble.text);
    return status;
}

static weft_status verify_all(weft_job *job, wf_verify_options *options,
                              const wf_verify_tell *tell, weft_error *err) {
    wf_json json = {0};
    wf_troubles troubles = {.tell = tell ? tell->trouble : NULL,
                            .user = tell ? tell->user : NULL};
    weft_status status = WEFT_OK;
    wf_identities *all;
    status = wf_identities_read((const char *const *)job->inputs, job->input_count, &all, err);
    if (status) return status;
    options->others = all;
    wf_json_open(&json, NULL, '[');
    for (size_t i = 0; i < job->input_count && status != WEFT_INTERRUPTED; i++)
        status = verify_one(job->inputs[i], options, tell, &json, &troubles);
    wf_identities_free(all);
    weft_status told = wf_ask_report(job, &json, err);
    status = wf_troubles_end(&troubles, err);
    return status ? status : told;
}

weft_status wf_ask_verify(weft_job *job, const weft_verify *asked, const wf_verify_tell *tell,
                          weft_error *err) {
    weft_verify own;
    wf_raster raster;
    wf_verify_options options;
    weft_status status = wf_asked(asked, "weft_verify", &own, sizeof own, err);
    if (!status) status = read_asked(job, &own, &raster, &options, err);
    return status ? status : verify_all(job, &options, tell, err);
}

weft_status weft_job_verify(weft_job *job, const weft_verify *asked, weft_error *err) {
    return wf_ask_verify(job, asked, NULL, err);
}

bool weft_profile_at(size_t index, weft_profile *out) {
    const wf_delivery_profile *p = wf_profile_at(index);
    if (!p) return false;
    const weft_profile all = {out->size, p->name, p->about, p->rasters, p->not_checked};
    wf_asked_give(&all, sizeof all, out);
    return true;
}
