/* A page that shows the files of a job: what is asked. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/ask/asking.h"
#include "convert/base/names.h"
#include "convert/base/range.h"
#include "convert/base/values.h"
#include "convert/page/page.h"
#include "convert/page/preview.h"

typedef struct asking {
    weft_job *job;
    weft_page asked;
    char *labels; /* what the clips' labels point into */
    wf_raster raster;
    wf_page_clip clip[WF_PAGE_MOST_CLIPS];
    wf_page_request request;
} asking;

/* One run of whole numbers from 0 on. */
static weft_status read_frames(const char *text, wf_page_request *r, weft_error *err) {
    wf_frame_range range = {0};
    if (!text) return WEFT_OK;
    weft_status status = wf_range_parse(text, WF_RANGE_MOST, &range, err);
    const wf_range_run *run = range.run;
    if (!status && (range.runs != 1 || run->den != 1 || run->step > 1 || run->first < 0))
        status = wf_fail(err, WEFT_USAGE,
                         "--frames: '%.200s' will not do; a page shows one run of frames, "
                         "numbered from 0, such as 0-59",
                         text);
    if (!status) r->first = run->first, r->count = run->count;
    wf_range_free(&range);
    return status;
}

static weft_status check_clips(const asking *a, weft_error *err) {
    size_t clips = a->job->input_count;
    weft_status status =
        wf_ask_inputs(a->job, "nothing to show; give finished video, such as shot.y4m", err);
    if (status) return status;
    if (clips > WF_PAGE_MOST_CLIPS)
        return wf_fail(err, WEFT_USAGE, "%zu clips are given, and a page shows at most %d",
                       clips, WF_PAGE_MOST_CLIPS);
    if (!a->job->output && !a->asked.preview)
        return wf_fail(err, WEFT_USAGE, "where to is not said; give -o look.html");
    if (a->asked.preview && clips > 1)
        return wf_fail(err, WEFT_USAGE, "--preview is of one clip, and %zu are given", clips);
    return WEFT_OK;
}

static weft_status read_labels(asking *a, weft_error *err) {
    size_t labels = 0, clips = a->job->input_count;
    for (size_t i = 0; i < clips; i++) a->clip[i] = (wf_page_clip){.path = a->job->inputs[i]};
    if (!a->asked.labels) return WEFT_OK;
    char *rest = a->labels = strdup(a->asked.labels);
    if (!rest) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    for (char *label; (label = strsep(&rest, "\n")); labels++)
        if (labels < clips) a->clip[labels].label = label;
    if (labels <= clips) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--label is given %zu times, and there are %zu clips",
                   labels, clips);
}

static weft_status read_size(const char *text, size_t *to, weft_error *err) {
    if (!text || wf_parse_size(text, to)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--max-size: '%.200s' will not do; it takes a size, such as 20M or 1G",
                   text);
}

static weft_status read_asked(asking *a, weft_error *err) {
    const weft_job *job = a->job;
    a->request = (wf_page_request){.clip = a->clip,
                                   .clips = job->input_count,
                                   .title = a->asked.title,
                                   .raster = a->asked.raster ? &a->raster : NULL,
                                   .max_bytes = WF_PAGE_MOST_BYTES,
                                   .max_memory_bytes = job->max_memory_bytes,
                                   .overwrite = job->overwrite,
                                   .canceled = &job->canceled,
                                   .progress = job->progress,
                                   .progress_user = job->progress_user,
                                   .warning = job->warning,
                                   .warning_user = job->warning_user};
    weft_status status = check_clips(a, err);
    if (!status) status = read_labels(a, err);
    if (!status) status = wf_ask_raster(a->asked.raster, &a->raster, err);
    if (!status) status = read_frames(a->asked.frames, &a->request, err);
    return status ? status : read_size(a->asked.max_size, &a->request.max_bytes, err);
}

/* Nothing is replaced that is looked at, and all that is to be written can be. */
static weft_status check_names(const asking *a, weft_error *err) {
    const weft_job *job = a->job;
    const char *written[] = {job->output, a->asked.preview};
    for (size_t i = 0; i < job->input_count; i++)
        for (int k = 0; k < 2; k++)
            if (written[k] && wf_name_replaces(written[k], job->inputs[i]))
                return wf_fail(err, WEFT_USAGE,
                               "%.300s would replace what is shown; give it another name",
                               written[k]);
    weft_status status = WEFT_OK;
    if (a->asked.preview) status = wf_preview_check_name(a->asked.preview, job->overwrite, err);
    if (!status && job->output) status = wf_page_check_name(job->output, job->overwrite, err);
    return status;
}

static weft_status read_preview(const asking *a, wf_preview_request *preview, weft_error *err) {
    *preview = (wf_preview_request){.video = a->job->inputs[0],
                                    .raster = a->request.raster,
                                    .frame = -1,
                                    .max_memory_bytes = a->request.max_memory_bytes,
                                    .overwrite = a->request.overwrite,
                                    .canceled = a->request.canceled};
    return wf_preview_read_frame(a->asked.preview_frame, a->asked.preview, &preview->frame,
                                 err);
}

weft_status weft_job_page(weft_job *job, const weft_page *asked, weft_error *err) {
    wf_preview_request preview;
    asking *a = calloc(1, sizeof *a);
    if (!a) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    a->job = job;
    weft_status status = wf_asked(asked, "weft_page", &a->asked, sizeof a->asked, err);
    if (!status) status = read_asked(a, err);
    if (!status) status = read_preview(a, &preview, err);
    if (!status) status = check_names(a, err);
    if (!status && a->asked.preview) status = wf_preview_write(&preview, a->asked.preview, err);
    if (!status && job->output) status = wf_page_make(&a->request, job->output, err);
    free(a->labels);
    free(a);
    return status;
}
