/* Progressive video as a source: a file that libav or weft reads, or a pipe. */
#include "convert/run/source/video_source.h"

#include <inttypes.h>
#include <stdlib.h>

#include "convert/media/kinds.h"
static weft_status takes(const weft_job *job, bool *takes, weft_error *err) {
    *takes = false;
    if (job->command != WF_CONVERT || !job->input_count) return WEFT_OK;
    return wf_video_is(job->inputs[0], takes, err);
}

static void close_input(wf_run *run) {
    wf_video_source *s = run->source;
    if (!s) return;
    wf_aside_end(&s->ahead, NULL);
    wf_resampler_free(s->resampler);
    wf_video_window_free(s->window);
    wf_light_free(s->light);
    wf_arrivals_free(s->arrivals);
    free(s->times_s);
    free(s->edges);
    free(s->missing);
    free(s);
    run->source = NULL;
}

/* ---- What it is ---- */

static weft_status refuse_interlaced(const wf_run *run, weft_error *err) {
    const wf_video_source *s = run->source;
    if (!s->info.interlaced || run->job->input_scan == WF_INPUT_PROGRESSIVE) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: it says that it is interlaced, and fields are made of progressive "
                   "pictures; deinterlace it first, such as with ffmpeg -i %s -vf "
                   "bwdif=mode=send_field -c:v ffv1 OUT.mkv, or where what it says is wrong "
                   "give --input-scan progressive",
                   s->path, s->path);
}

/* Guesses that can be wrong are told. */
static void tell_guess(const wf_run *run) {
    const wf_video_source *s = run->source;
    const wf_meaning *m = &s->meaning;
    char space[128], curve[24];
    if (*m->colors.warning) wf_job_warn(run->job, "%s: %s", s->path, m->colors.warning);
    if (m->tagged || run->job->from) return;
    wf_file_colors_name(&m->colors, space, sizeof space);
    wf_job_warn(run->job,
                "%s: its colors are not all tagged: it is taken as %s (%s, %s range); --from "
                "says otherwise",
                s->path, space, wf_decoding_name(&m->colors.decoding, curve),
                m->full_range ? "full" : "narrow");
}

bool wf_video_source_has_alpha(const wf_video_source *s) {
    return s->alpha == WF_ALPHA_STRAIGHT || s->alpha == WF_ALPHA_PREMULTIPLIED;
}

/* Alpha counts wherever there is some; it is delivered where something lies behind the
 * pictures, or it is written. */
static void find_alpha(wf_run *run) {
    const weft_job *job = run->job;
    wf_video_source *s = run->source;
    s->alpha = wf_meaning_alpha(&s->info, job->alpha, &run->report->taken);
    s->channels = wf_video_source_has_alpha(s) &&
                          (wf_job_shows_background(job) || wf_job_writes_alpha(job))
                      ? 4
                      : 3;
    if (s->info.alpha_lost && job->alpha != WF_ALPHA_IGNORED)
        wf_job_warn(job,
                    "%s: it has alpha, which this libavcodec does not decode: its pictures are "
                    "taken as they are, and --alpha ignore says that this is right",
                    s->path);
}

static void tell_others(const wf_run *run) {
    const wf_video_source *s = run->source;
    if (s->info.videos > 1)
        wf_job_warn(
            run->job,
            "%s: it holds %d streams of video, and the first is taken; ffmpeg -i IN -map "
            "0:v:1 -c copy OUT.mkv makes a file of the second",
            s->path, s->info.videos);
}

/* What a tag of H.273 is that says nothing. */
enum { UNSAID = 2 };

/* --from counts whatever the stream says, and settles the matrix where that is not said; it is
 * looked up when the output is settled. */
static weft_status find_meaning(wf_run *run, weft_error *err) {
    wf_video_source *s = run->source;
    bool said = s->info.tags.matrix != UNSAID || !run->job->from;
    if (!said) s->info.tags.matrix = wf_matrix_of_space(run->job->from);
    weft_status status = wf_meaning_of(&s->info, s->path, &s->meaning, err);
    if (status) return status;
    s->meaning.matrix_asked = !said && s->info.tags.matrix != UNSAID;
    wf_meaning_take(&s->meaning, &s->info, &run->report->taken);
    run->setup.decodes = true;
    find_alpha(run);
    tell_others(run);
    if (run->job->from) return WEFT_OK;
    if (*s->meaning.colors.trouble)
        return wf_fail(err, WEFT_USAGE, "%s: %s", s->path, s->meaning.colors.trouble);
    tell_guess(run);
    run->setup.scene_primaries = &s->meaning.colors.primaries;
    return WEFT_OK;
}

weft_status wf_video_source_light(wf_run *run, weft_error *err) {
    wf_video_source *s = run->source;
    const wf_transform *decode = run->job->from ? &run->setup.decode : NULL;
    if (run->setup.from_curve) { /* as if the stream had said it, so that it is as quick */
        s->meaning.colors.decoding = wf_decoding_of(run->setup.from_curve);
        decode = NULL;
    }
    wf_setup_take_from(run->job, &run->setup, &run->report->taken);
    return wf_light_new(&s->info, &s->meaning, decode, &s->light, err);
}

static weft_status open_video(wf_run *run, weft_error *err) {
    wf_video_source *s = run->source;
    wf_video *video;
    const wf_video_options options = {.max_memory_bytes = run->job->max_memory_bytes,
                                      .want_times = true,
                                      .codes_only = true,
                                      .want_alpha = run->job->alpha != WF_ALPHA_IGNORED,
                                      .progressive_only =
                                          run->job->input_scan != WF_INPUT_PROGRESSIVE,
                                      .mends = run->job->on_missing != WF_MISSING_ERROR};
    weft_status status = wf_video_open(s->path, &options, &video, err);
    if (status) return status;
    s->info = *wf_video_info_of(video);
    return wf_video_window_new(video, options.want_alpha, run->job->max_memory_bytes / 2,
                               &s->window, err);
}

static weft_status open_input(wf_run *run, weft_error *err) {
    const weft_job *job = run->job;
    wf_video_source *s = run->source = calloc(1, sizeof *s);
    if (!s) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the job");
    s->path = job->inputs[0];
    if (job->input_count > 1)
        return wf_fail(
            err, WEFT_USAGE,
            "%s is video, of which one file is taken at a time, and %s is given too; "
            "convert them one by one, or join them first",
            s->path, job->inputs[1]);
    weft_status status = wf_refuse_kind(s->path, err);
    if (!status) status = open_video(run, err);
    if (!status) status = refuse_interlaced(run, err);
    return status ? status : find_meaning(run, err);
}

/* ---- What became of it ---- */

static void tell_missing(const wf_run *run, const wf_video_troubles *troubles) {
    const wf_video_source *s = run->source;
    const char *instead =
        run->job->on_missing == WF_MISSING_HOLD ? "their neighbors are held" : "they are black";
    size_t count = s->missing_count;
    if (!count && !troubles->cut && !*s->cut.text) return;
    run->report->degraded = true;
    wf_job_warn(run->job, "%s", *troubles->missing.text ? troubles->missing.text : s->cut.text);
    if (count)
        wf_job_warn(run->job, "%s: %zu picture%s missing, the first is %" PRId64 ": %s",
                    s->path, count, count == 1 ? " is" : "s are", s->missing[0].num, instead);
}

static void tell_troubles(const wf_run *run, const wf_video_troubles *troubles) {
    const wf_video_source *s = run->source;
    tell_missing(run, troubles);
    if (troubles->complaints && !s->missing_count)
        wf_job_warn(run->job,
                    "%s: its decoder complained %" PRId64
                    " time%s, first about picture %" PRId64
                    ", and went on: look whether it shows what it should",
                    s->path, troubles->complaints, troubles->complaints == 1 ? "" : "s",
                    troubles->complained_at);
}

static void tell(const wf_run *run, wf_report *report) {
    wf_video_source *s = run->source;
    report->listed = s->count < 0 ? 0 : s->count;
    if (run->finished && s->window) tell_troubles(run, wf_video_window_troubles(s->window));
    report->missing = s->missing;
    report->missing_count = s->missing_count;
    s->missing = NULL; /* the report's now */
}

const wf_source_kind wf_source_video = {
    .name = "video",
    .takes = takes,
    .open = open_input,
    .count = wf_video_source_count,
    .ready = wf_video_source_ready,
    .needs = wf_video_source_needs,
    .summing = &wf_summing_pictures,
    .pictures = &wf_video_source_pictures,
    .tell = tell,
    .close = close_input,
};
