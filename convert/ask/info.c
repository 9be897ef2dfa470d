/* What the files of a job are: pictures, sequences, video. */
#include "convert/ask/info.h"

#include <stdio.h>
#include <sys/stat.h>

#include "convert/ask/asking.h"
#include "convert/ask/info_facts.h"
#include "convert/base/pattern.h"
#include "convert/media/kinds.h"
#include "convert/read/rate.h"
#include "convert/read/sequence.h"
#include "convert/read/source.h"

/* ---- Pictures ---- */

static void fact_window(wf_facts *facts, const char *key, wf_box box) {
    char text[96];
    snprintf(text, sizeof text, "%dx%d at %d,%d", box.x1 - box.x0, box.y1 - box.y0, box.x0,
             box.y0);
    if (facts->line) {
        wf_fact_text(facts, key, text);
        return;
    }
    wf_json_open(facts->json, key, '{');
    wf_json_int(facts->json, "x", box.x0);
    wf_json_int(facts->json, "y", box.y0);
    wf_json_int(facts->json, "width", box.x1 - box.x0);
    wf_json_int(facts->json, "height", box.y1 - box.y0);
    wf_json_close(facts->json);
}

static void tell_picture(wf_facts *facts, const wf_image_info *info) {
    wf_fact_text(facts, "format", info->format);
    wf_fact_int(facts, "width", info->display.x1 - info->display.x0);
    wf_fact_int(facts, "height", info->display.y1 - info->display.y0);
    fact_window(facts, "display_window", info->display);
    fact_window(facts, "data_window", info->data);
    wf_fact_real(facts, "pixel_aspect", info->pixel_aspect);
    if (wf_ratio_given(info->rate) && !facts->line)
        wf_fact_ratio(facts, "rate", info->rate, '/');
    if (wf_ratio_given(info->time_s)) wf_fact_ratio(facts, "time", info->time_s, '/');
    if (*info->timecode) wf_fact_text(facts, "timecode", info->timecode);
}

/* The sequence may lose what is missing. */
static void take_rate(const wf_image_info *info, wf_sequence *sequence, wf_taken_list *taken,
                      wf_facts *facts) {
    wf_shown shown;
    weft_error why;
    char text[48] = "irregular";
    bool told = wf_ratio_given(info->rate) || wf_ratio_given(info->time_s);
    if (wf_shown_by_files("", info, sequence, &shown, &why)) {
        if (told) wf_fact_text(facts, "trouble", why.text);
        return;
    }
    if (!shown.times_s) wf_rate_text(shown.rate, text);
    wf_take(taken, "rate", text, "file");
    wf_shown_free(&shown);
}

/* A layer that the file has: a line, or an object of "layers". */
static void tell_layer(void *user, int part, const char *part_name, const char *layer,
                       const char *channels) {
    wf_facts *facts = user;
    char text[900];
    if (!facts->line) {
        wf_json_open(facts->json, NULL, '{');
        wf_json_int(facts->json, "part", part);
        wf_json_text(facts->json, "part_name", part_name);
        wf_json_text(facts->json, "layer", layer);
        wf_json_text(facts->json, "channels", channels);
        wf_json_close(facts->json);
        return;
    }
    snprintf(text, sizeof text, "part %d%s%s%s: %s (%s)", part, *part_name ? " '" : "",
             part_name, *part_name ? "'" : "", *layer ? layer : "without a name", channels);
    wf_fact_text(facts, "has_layer", text);
}

static weft_status tell_layers(const char *path, wf_facts *facts, weft_error *err) {
    if (!facts->line) wf_json_open(facts->json, "layers", '[');
    weft_status status = wf_source_layers(path, tell_layer, facts, err);
    if (!facts->line) wf_json_close(facts->json);
    return status;
}

/* A file of a sequence. */
static weft_status describe_file(const wf_subframe_ref *ref, wf_sequence *sequence,
                                 wf_facts *facts, weft_error *err) {
    const wf_source_options options = {.nan_fix = WF_NAN_BOX3,
                                       .max_memory_bytes = (size_t)2 << 30};
    wf_subframe *subframe;
    wf_taken_list taken = {0};
    weft_error untold;
    /* What is wrong with it is told when it is opened. */
    weft_status layers = tell_layers(ref->path, facts, &untold);
    weft_status status = wf_subframe_open(ref->path, ref->part, &options, &subframe, err);
    if (status) return status;
    tell_picture(facts, wf_subframe_info(subframe));
    wf_subframe_take(subframe, &taken);
    take_rate(wf_subframe_info(subframe), sequence, &taken, facts);
    wf_facts_taken(facts, &taken);
    const wf_file_colors *colors = wf_subframe_colors(subframe);
    if (*colors->trouble) wf_fact_text(facts, "trouble", colors->trouble);
    if (*colors->warning) wf_fact_text(facts, "warning", colors->warning);
    wf_subframe_close(subframe);
    return layers ? wf_fail(err, layers, "%s", untold.text) : WEFT_OK;
}

/* ---- Sequences ---- */

static void fact_number(wf_facts *facts, const char *key, wf_rational number) {
    if (number.den == 1)
        wf_fact_int(facts, key, number.num);
    else
        wf_fact_real(facts, key, wf_ratio_value(number));
}

static void list_missing(wf_facts *facts, const wf_sequence *sequence) {
    wf_json_open(facts->json, "missing", '[');
    for (size_t k = 0; k < sequence->count; k++)
        if (!sequence->refs[k].path) fact_number(facts, NULL, sequence->refs[k].number);
    wf_json_close(facts->json);
}

/* Tells people how many numbers are missing, and the first eight of them. */
static void sum_up_missing(wf_facts *facts, const wf_sequence *sequence) {
    char text[256];
    int used = snprintf(text, sizeof text, "%zu", sequence->missing), shown = 0;
    for (size_t k = 0; k < sequence->count && shown <= 8; k++) {
        if (sequence->refs[k].path) continue;
        const char *before = shown ? ", " : ": ";
        used += shown == 8 ? snprintf(text + used, sizeof text - (size_t)used, "%s..", before)
                           : snprintf(text + used, sizeof text - (size_t)used, "%s%.9g", before,
                                      wf_ratio_value(sequence->refs[k].number));
        shown++;
    }
    wf_fact_text(facts, "missing", text);
}

static weft_status tell_refs(wf_facts *facts, wf_sequence *sequence, weft_error *err) {
    size_t present = 0, last = sequence->count - 1;
    wf_fact_text(facts, "kind", "sequence");
    wf_fact_int(facts, "subframes", (int64_t)sequence->count);
    fact_number(facts, "first", sequence->refs[0].number);
    fact_number(facts, "last", sequence->refs[last].number);
    (facts->line ? sum_up_missing : list_missing)(facts, sequence);
    while (present < last && !sequence->refs[present].path) present++;
    const wf_subframe_ref *ref = &sequence->refs[present];
    if (*sequence->notice) wf_fact_text(facts, "notice", sequence->notice);
    return ref->path ? describe_file(ref, sequence, facts, err) : WEFT_OK;
}

static weft_status describe_sequence(char *path, wf_facts *facts, weft_error *err) {
    wf_sequence sequence = {0};
    weft_status status = wf_sequence_expand(&path, 1, NULL, &sequence, err);
    if (!status) status = tell_refs(facts, &sequence, err);
    wf_sequence_free(&sequence);
    return status;
}

/* ---- Files ---- */

static weft_status tell(char *path, wf_facts *facts, weft_error *err) {
    struct stat about;
    bool exists = !stat(path, &about), is_y4m = false;
    if (exists ? S_ISDIR(about.st_mode) : wf_pattern_is(path))
        return describe_sequence(path, facts, err);
    weft_status status = wf_refuse_kind(path, err);
    if (status) return status;
    status = wf_info_y4m(path, facts, &is_y4m, err);
    if (status || is_y4m) return status;
    bool video;
    status = wf_video_is(path, &video, err);
    if (status) return status;
    if (video) return wf_info_video(path, facts, err);
    int timed = 0; /* parts that are subframes, and no layers of one picture */
    weft_error untold;
    weft_status parts = wf_source_timed_parts(path, &timed, NULL, NULL, &untold);
    if (timed) return describe_sequence(path, facts, err);
    wf_fact_text(facts, "kind", "picture");
    wf_sequence alone = {.step = {1, 1}, .number_step = {1, 1}};
    status = describe_file(&(wf_subframe_ref){.path = path, .part = -1}, &alone, facts, err);
    return status || !parts ? status : wf_fail(err, parts, "%s", untold.text);
}

static weft_status describe(char *path, const wf_info_tell *tell_to, wf_json *json,
                            weft_error *err) {
    wf_facts facts = {.json = json};
    if (tell_to) {
        facts.line = tell_to->line;
        facts.user = tell_to->user;
        tell_to->file(tell_to->user, path);
        return tell(path, &facts, err);
    }
    wf_json_open(json, NULL, '{');
    wf_json_text(json, "path", path);
    weft_status status = tell(path, &facts, err);
    if (status) wf_json_text(json, "error", err->text);
    wf_json_close(json);
    return status;
}

weft_status wf_ask_info(weft_job *job, const wf_info_tell *tell_to, weft_warning_fn *trouble,
                        void *user, weft_error *err) {
    wf_json json = {0};
    wf_troubles troubles = {.tell = trouble, .user = user};
    weft_status status = wf_ask_inputs(
        job,
        "nothing to tell about; give a file, a pattern such as shot.####.exr, or a directory",
        err);
    if (status) return status;
    wf_json_open(&json, NULL, '{');
    wf_json_open(&json, "files", '[');
    for (size_t i = 0; i < job->input_count && !job->canceled; i++) {
        weft_error why = {""};
        status = describe(job->inputs[i], tell_to, &json, &why);
        if (status) wf_trouble(&troubles, status, why.text);
    }
    if (job->canceled) wf_trouble(&troubles, WEFT_INTERRUPTED, "interrupted");
    weft_status told = wf_ask_report(job, &json, err);
    status = wf_troubles_end(&troubles, err);
    return status ? status : told;
}

weft_status weft_job_info(weft_job *job, weft_error *err) {
    if (err) err->text[0] = '\0';
    return wf_ask_info(job, NULL, NULL, NULL, err);
}
