/* A job: what it holds besides its options, and which options contradict each other. */
#include "convert/job/colors.h"
#include "convert/job/job.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/job/timecode.h"

void wf_job_clear_inputs(weft_job *job) {
    for (size_t i = 0; i < job->input_count; i++) free(job->inputs[i]);
    job->input_count = 0;
}

weft_status weft_job_add_input(weft_job *job, const char *path, weft_error *err) {
    if (!path || !*path)
        return wf_fail(err, WEFT_USAGE,
                       "an input's name is empty; give a file, a pattern such as "
                       "shot.####.exr, or a directory");
    char **grown = realloc(job->inputs, (job->input_count + 1) * sizeof *grown);
    if (grown) job->inputs = grown;
    char *copy = grown ? strdup(path) : NULL;
    if (!copy) return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", path);
    job->inputs[job->input_count++] = copy;
    return WEFT_OK;
}

weft_status weft_job_set_output(weft_job *job, const char *path, weft_error *err) {
    if (!path || !*path)
        return wf_fail(err, WEFT_USAGE,
                       "the output's name is empty; give a file such as out.y4m");
    char *copy = strdup(path);
    if (!copy) return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", path);
    free(job->output);
    job->output = copy;
    return WEFT_OK;
}

static const char *const command_names[] = {
    [WF_CONVERT] = "convert", [WF_RENDER] = "render", [WF_TRACE] = "trace"};

const char *wf_command_name(wf_command command) {
    return command_names[command];
}

void weft_job_on_progress(weft_job *job, weft_progress_fn *fn, void *user) {
    job->progress = fn;
    job->progress_user = user;
}

void weft_job_on_warning(weft_job *job, weft_warning_fn *fn, void *user) {
    job->warning = fn;
    job->warning_user = user;
}

void weft_job_on_print(weft_job *job, weft_print_fn *fn, void *user) {
    job->print = fn;
    job->print_user = user;
}

void wf_job_warn(const weft_job *job, const char *format, ...) {
    if (!job->warning) return;
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    job->warning(text, job->warning_user);
}

weft_status weft_job_set_command(weft_job *job, const char *name, weft_error *err) {
    for (size_t i = 0; i < sizeof command_names / sizeof *command_names; i++)
        if (!strcmp(command_names[i], name)) {
            job->command = (wf_command)i;
            return WEFT_OK;
        }
    return wf_fail(err, WEFT_USAGE,
                   "'%.200s' is no command of jobs; there are convert, render "
                   "and trace",
                   name);
}

void weft_job_cancel(weft_job *job) {
    job->canceled = 1;
}

const char *weft_job_report(const weft_job *job) {
    return job->report ? job->report : "{}";
}

/* ---- Contradictions ---- */

/* Whether a label exists depends on the raster: how many frames a second has, and whether
 * labels are dropped. */
static weft_status check_timecode(const weft_job *job, weft_error *err) {
    wf_timecode timecode;
    char why[256];
    if (!job->timecode || !wf_parse_timecode(job->timecode, &timecode) ||
        wf_timecode_check(&timecode, job->raster.frame_rate, why, sizeof why))
        return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--timecode %s: %s (raster %s)", job->timecode, why,
                   job->raster.name);
}

/* A cadence spreads film frames over 60 fields a second; all fields of a film frame see one
 * time. */
static weft_status check_cadence(const weft_job *job, weft_error *err) {
    if (job->cadence == WF_CADENCE_NONE) return WEFT_OK;
    if (job->command == WF_TRACE)
        return wf_fail(err, WEFT_USAGE,
                       "--cadence is for fields, and trace stores samples; give it to convert");
    if (wf_ratio_given(wf_raster_film_rate(&job->raster))) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--cadence 2:3 makes 60000/1001 or 60 fields (or progressive frames) a "
                   "second of film, and %s has another rate or scan; take 525i, 1080i59.94, "
                   "1080i60 or 720p59.94",
                   job->raster.name);
}

/* The nearest picture is near to the sharpest one, unless another is named. */
static void settle_aperture(weft_job *job) {
    char why[256];
    const char *name = wf_job_holds_flicker(job) ? "line" : "shaped";
    if (!job->aperture_given) wf_aperture_parse(name, &job->aperture, why, sizeof why);
}

void wf_job_settle(weft_job *job) {
    settle_aperture(job);
    job->raster.pulldown = job->cadence == WF_CADENCE_2_3;
    job->raster.all_lines = wf_job_holds_flicker(job);
    job->raster.whole_frames = false;
}

wf_raster wf_job_raster_shown(const weft_job *job) {
    wf_raster raster = job->raster;
    raster.matrix = wf_color_matrix_of(job->to, raster.matrix);
    return raster;
}

typedef struct rule {
    bool wrong;
    const char *says;
} rule;

static weft_status check_rules(const rule *rules, size_t count, weft_error *err) {
    for (size_t i = 0; i < count; i++)
        if (rules[i].wrong) return wf_fail(err, WEFT_USAGE, "%s", rules[i].says);
    return WEFT_OK;
}

bool wf_job_writes_alpha(const weft_job *job) {
    return job->alpha_out || job->key;
}

bool wf_job_shows_background(const weft_job *job) {
    return job->background[0] != 0 || job->background[1] != 0 || job->background[2] != 0;
}

weft_status wf_job_check_alpha(const weft_job *job, weft_error *err) {
    bool writes_alpha = wf_job_writes_alpha(job);
    const float *behind = job->background;
    const rule rules[] = {
        {writes_alpha && job->command == WF_TRACE,
         "--alpha-out and --key are for fields; trace stores alpha by itself where the scene "
         "has it"},
        {writes_alpha && wf_ratio_given(job->error),
         "--error looks at color alone: with --alpha-out or --key give --samples"},
        {writes_alpha && (behind[0] != 0 || behind[1] != 0 || behind[2] != 0),
         "--alpha-out and --key leave what is behind the pictures open, and --background fills "
         "it; give one of them"},
        {(job->fill || job->key_law) && !writes_alpha,
         "--fill and --key-law tell what is written beside alpha; give --alpha-out too, "
         "or --key"},
        {job->key && !*job->key, "--key needs a name, such as key.mov"},
    };
    return check_rules(rules, sizeof rules / sizeof *rules, err);
}

weft_status wf_job_check_time(const weft_job *job, weft_error *err) {
    if (job->width_given && job->angle_given)
        return wf_fail(err, WEFT_USAGE,
                       "--temporal-width and --shutter-angle say the same "
                       "thing; give one of them");
    return check_cadence(job, err);
}

double wf_job_flicker_weight(const weft_job *job) {
    if (job->aperture.kind && job->aperture.kind->nearest) return job->aperture.parameter[0];
    return wf_ratio_given(job->flicker_weight) ? wf_ratio_value(job->flicker_weight) : 0;
}

bool wf_job_holds_flicker(const weft_job *job) {
    return wf_job_flicker_weight(job) > 0 || wf_ratio_given(job->flicker_limit);
}

weft_status wf_job_check_flicker(const weft_job *job, weft_error *err) {
    bool limited = wf_ratio_given(job->flicker_limit), nearest = job->aperture.kind->nearest;
    if (wf_job_holds_flicker(job) && job->raster.scan == WF_PROGRESSIVE)
        return wf_fail(err, WEFT_USAGE,
                       "%s: interline flicker is between the two fields of a frame, and %s is "
                       "progressive; take an interlaced raster, or leave it out",
                       nearest   ? "--aperture least"
                       : limited ? "--flicker-limit"
                                 : "--flicker-weight",
                       job->raster.name);
    const rule rules[] = {
        {nearest && job->flicker_weight.num,
         "--aperture least:MU is line with --flicker-weight MU; give one of them"},
        {limited && wf_job_writes_alpha(job),
         "--flicker-limit bounds the light of a whole picture, and beside alpha it is not "
         "known "
         "what lies behind; with --alpha-out and --key give --flicker-weight"},
        {!(limited && job->limit_is_seen) && wf_ratio_given(job->view_distance),
         "--view-distance is for what is seen of flicker; give --flicker-limit visible:N too"},
        {!(limited && job->limit_is_seen) && wf_ratio_given(job->peak),
         "--peak is for what is seen of flicker; give --flicker-limit visible:N too"},
    };
    return check_rules(rules, sizeof rules / sizeof *rules, err);
}

weft_status wf_job_check(const weft_job *job, weft_error *err) {
    const rule rules[] = {
        {!job->input_count && job->command != WF_CONVERT,
         "no scene; give one, such as examples/scenes/carousel.lua"},
        {job->input_count > 1 && job->command != WF_CONVERT,
         "one scene at a time; others can be taken in by its include"},
        {job->command == WF_TRACE && wf_ratio_given(job->error),
         "--error is for render: samples that are written are as many everywhere"},
        {job->command == WF_TRACE && job->separate_fields,
         "--fields is for pictures of fields, and trace stores samples; give it to convert"},
        {!job->input_count,
         "nothing to convert; give a file, a pattern such as shot.####.exr, or a "
         "directory"},
        {!job->output, "nowhere to write; give an output, such as -o out.y4m"},
        {job->to && job->display,
         "--to and --display both name the output's color; give one of them"},
        {job->to && job->view,
         "--to and --view both name the output's color; give one of them"},
        {job->view && !job->display,
         "--view needs the display it belongs to; give --display too"},
        {job->look && !job->to && !job->display,
         "--look needs to know what it leads to; give --to, or --display and --view"},
        {job->audio_tracks && !job->audio,
         "--audio-tracks is for sound; give --audio too, such as silent:2"},
        {job->overwrite && job->resume, "--overwrite makes everything again and --resume only "
                                        "what is not there; give one of them"},
        {job->resume && job->output && !strcmp(job->output, "-"),
         "--resume: standard output cannot be resumed; write to a file"},
    };
    weft_status status = check_rules(rules, sizeof rules / sizeof *rules, err);
    if (!status) status = wf_job_check_alpha(job, err);
    if (!status) status = wf_job_check_flicker(job, err);
    if (!status) status = wf_job_check_time(job, err);
    return status ? status : check_timecode(job, err);
}
