/* How options store their values in a job, and free what they have stored. */
#include "convert/job/option_rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/range.h"
#include "convert/base/values.h"
#include "convert/job/audio.h"
#include "convert/job/delivery.h"
#include "convert/job/meant.h"
#include "filters/base/spelling.h"

static void *member(weft_job *job, const wf_option_row *row) {
    return (char *)job + row->offset;
}

static weft_status refuse(const wf_option_row *row, const char *value, const char *right,
                          weft_error *err) {
    const char *meant = wf_meant_by(row->shown.name, value);
    return wf_fail(err, WEFT_USAGE, "--%s: '%.200s' will not do; it takes %s%s%s%s",
                   row->shown.name, value, right, meant ? " (did you mean " : "",
                   meant ? meant : "", meant ? "?)" : "");
}

/* ---- Setters ---- */

weft_status wf_set_text(weft_job *job, const wf_option_row *row, const char *value,
                        weft_error *err) {
    char **text = member(job, row), *copy = strdup(value);
    if (!copy) return wf_fail(err, WEFT_NO_MEMORY, "--%s: out of memory", row->shown.name);
    free(*text);
    *text = copy;
    return WEFT_OK;
}

weft_status wf_set_flag(weft_job *job, const wf_option_row *row, const char *value,
                        weft_error *err) {
    if (*value)
        return wf_fail(err, WEFT_USAGE, "--%s takes no value, and was given '%.200s'",
                       row->shown.name, value);
    *(bool *)member(job, row) = true;
    return WEFT_OK;
}

/* The index of value among the words of row->shown.takes; -1 if it is none of them. */
static int choice_index(const wf_option_row *row, const char *value) {
    size_t length = strlen(value);
    const char *word = row->shown.takes;
    for (int index = 0;; index++) {
        size_t word_length = strcspn(word, "|");
        if (word_length == length && !strncmp(word, value, length)) return index;
        word += word_length;
        if (!*word++) return -1;
    }
}

static weft_status refuse_choice(const wf_option_row *row, const char *value, weft_error *err) {
    char right[96];
    snprintf(right, sizeof right, "one of %s", row->shown.takes);
    return refuse(row, value, right, err);
}

weft_status wf_set_choice(weft_job *job, const wf_option_row *row, const char *value,
                          weft_error *err) {
    int index = choice_index(row, value);
    if (index < 0) return refuse_choice(row, value, err);
    *(unsigned *)member(job, row) = (unsigned)(row->base + index);
    return WEFT_OK;
}

/* Two words: the second means true. */
weft_status wf_set_switch(weft_job *job, const wf_option_row *row, const char *value,
                          weft_error *err) {
    int index = choice_index(row, value);
    if (index < 0) return refuse_choice(row, value, err);
    *(bool *)member(job, row) = index == 1;
    return WEFT_OK;
}

weft_status wf_set_bits(weft_job *job, const wf_option_row *row, const char *value,
                        weft_error *err) {
    if (choice_index(row, value) < 0) return refuse_choice(row, value, err);
    *(int *)member(job, row) = atoi(value);
    return WEFT_OK;
}

static weft_status refuse_number(const wf_option_row *row, const char *value, weft_error *err) {
    char right[160];
    snprintf(right, sizeof right, "a number from %.10g to %.10g%s", row->low, row->high,
             row->what);
    return refuse(row, value, right, err);
}

static bool parse_within(const wf_option_row *row, const char *value, bool rate,
                         wf_rational *out) {
    wf_rational number;
    if (!(rate ? wf_rate_parse : wf_ratio_parse)(value, &number)) return false;
    double size = wf_ratio_value(number);
    if (size < row->low || size > row->high) return false;
    *out = number;
    return true;
}

weft_status wf_set_ratio(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    return parse_within(row, value, false, member(job, row)) ? WEFT_OK
                                                             : refuse_number(row, value, err);
}

#define LEAST_SEEN 0.05 /* of a just noticeable difference */

/* Light, or after "visible:" what is seen. */
weft_status wf_set_flicker_limit(weft_job *job, const wf_option_row *row, const char *value,
                                 weft_error *err) {
    static const char word[] = "visible:";
    bool seen = !strncmp(value, word, sizeof word - 1);
    wf_rational limit;
    if (!parse_within(row, seen ? value + sizeof word - 1 : value, false, &limit) ||
        (seen && wf_ratio_value(limit) < LEAST_SEEN)) {
        char right[160];
        snprintf(right, sizeof right, "%s, E from %.10g to %.10g%s and N from %g",
                 row->shown.takes, row->low, row->high, row->what, LEAST_SEEN);
        return refuse(row, value, right, err);
    }
    job->flicker_limit = limit;
    job->limit_is_seen = seen;
    return WEFT_OK;
}

/* Either way from 0. */
weft_status wf_set_stops(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    bool negative = *value == '-', positive = *value == '+';
    wf_rational *stops = member(job, row);
    if (!parse_within(row, value + (negative || positive), false, stops))
        return refuse_number(row, value, err);
    if (negative) stops->num = -stops->num;
    return WEFT_OK;
}

weft_status wf_set_rate(weft_job *job, const wf_option_row *row, const char *value,
                        weft_error *err) {
    return parse_within(row, value, true, member(job, row)) ? WEFT_OK
                                                            : refuse_number(row, value, err);
}

weft_status wf_set_width(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    weft_status status = wf_set_ratio(job, row, value, err);
    if (!status) job->width_given = true;
    return status;
}

/* 360 degrees are one field period. */
weft_status wf_set_angle(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    wf_rational degrees;
    if (!parse_within(row, value, false, &degrees)) return refuse_number(row, value, err);
    wf_rational width = wf_ratio_div(degrees, wf_ratio(360, 1));
    if (!wf_ratio_given(width)) return refuse_number(row, value, err);
    job->temporal_width = width;
    job->angle_given = true;
    return WEFT_OK;
}

weft_status wf_set_threads(weft_job *job, const wf_option_row *row, const char *value,
                           weft_error *err) {
    wf_rational number = {0, 1};
    bool all = !strcmp(value, "all");
    if (!all && (!parse_within(row, value, false, &number) || number.den != 1))
        return refuse_number(row, value, err);
    job->threads = (int)number.num;
    return WEFT_OK;
}

weft_status wf_set_whole(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    wf_rational number;
    if (!parse_within(row, value, false, &number) || number.den != 1)
        return refuse_number(row, value, err);
    *(int64_t *)member(job, row) = number.num;
    return WEFT_OK;
}

/* Several values may be given; of two with one name the scene sees the later. */
weft_status wf_set_param(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    const char *equals = strchr(value, '=');
    if (!equals || equals == value)
        return refuse(row, value, "NAME=VALUE, which the scene reads as param.NAME", err);
    char **grown = realloc(job->params, (job->param_count + 1) * sizeof *grown);
    if (grown) job->params = grown;
    char *copy = grown ? strdup(value) : NULL;
    if (!copy) return wf_fail(err, WEFT_NO_MEMORY, "--%s: out of memory", row->shown.name);
    job->params[job->param_count++] = copy;
    return WEFT_OK;
}

/* Whether the numbers suit the raster is checked when that is known. */
weft_status wf_set_oversample(weft_job *job, const wf_option_row *row, const char *value,
                              weft_error *err) {
    int across, down, times;
    if (wf_parse_oversample(value, &across, &down, &times))
        return wf_set_text(job, row, value, err);
    return refuse(
        row, value,
        "SxLxT, samples a pixel, a line and a field, each from 1 to 64, such as 4x4x8", err);
}

weft_status wf_set_raster(weft_job *job, const wf_option_row *row, const char *value,
                          weft_error *err) {
    char why[512];
    if (wf_raster_parse(value, &job->raster, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--%s: %s", row->shown.name, why);
}

weft_status wf_set_aperture(weft_job *job, const wf_option_row *row, const char *value,
                            weft_error *err) {
    char why[512];
    if (wf_aperture_parse(value, &job->aperture, why, sizeof why)) {
        job->aperture_given = true;
        return WEFT_OK;
    }
    const char *meant = wf_meant_by("aperture", value);
    if (meant)
        return wf_fail(err, WEFT_USAGE,
                       "--aperture: no aperture is called '%.100s'; what is like it is %s",
                       value, meant);
    return wf_fail(err, WEFT_USAGE, "--%s: %s", row->shown.name, why);
}

weft_status wf_set_background(weft_job *job, const wf_option_row *row, const char *value,
                              weft_error *err) {
    if (wf_parse_rgb(value, job->background)) return WEFT_OK;
    return refuse(row, value,
                  "one number for all channels or three as r,g,b, scene-linear, each from 0 to "
                  "65504, such as 0.18 or 0.2,0.2,0.3",
                  err);
}

weft_status wf_set_chunk(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    if (wf_parse_chunk(value, &job->chunk, &job->chunk_count)) return WEFT_OK;
    return refuse(
        row, value,
        "I/N, the I-th of N equal runs of frames with 1 <= I <= N <= 1000000, such as 1/4",
        err);
}

weft_status wf_set_size(weft_job *job, const wf_option_row *row, const char *value,
                        weft_error *err) {
    if (wf_parse_size(value, member(job, row))) return WEFT_OK;
    return refuse(
        row, value,
        "a size from 1M to 1024T in bytes, or with K, M, G or T (and KiB ..) for powers "
        "of 1024, KB .. for powers of 1000, such as 512M or 1.5G",
        err);
}

/* How large FF may be depends on the raster, with which wf_job_check looks at it. */
weft_status wf_set_timecode(weft_job *job, const wf_option_row *row, const char *value,
                            weft_error *err) {
    if (wf_parse_timecode(value, &(wf_timecode){0})) return wf_set_text(job, row, value, err);
    return refuse(row, value, "HH:MM:SS:FF, or HH:MM:SS;FF for drop frame, up to 23:59:59",
                  err);
}

weft_status wf_set_date(weft_job *job, const wf_option_row *row, const char *value,
                        weft_error *err) {
    char whole[sizeof "0000-00-00T00:00:00Z"];
    bool day_alone = !strchr(value, 'T');
    if (wf_parse_date(value, &(wf_date){0})) {
        snprintf(whole, sizeof whole, "%s%s", value, day_alone ? "T00:00:00Z" : "");
        return wf_set_text(job, row, whole, err);
    }
    return refuse(row, value, "YYYY-MM-DD or YYYY-MM-DDTHH:MM:SSZ, of 1970 to 2099", err);
}

/* Which of these numbers have files is seen when the input is opened. */
weft_status wf_set_frames(weft_job *job, const wf_option_row *row, const char *value,
                          weft_error *err) {
    wf_frame_range range;
    weft_status status = wf_range_parse(value, WF_RANGE_MOST, &range, err);
    wf_range_free(&range);
    return status ? status : wf_set_text(job, row, value, err);
}

weft_status wf_set_output_frames(weft_job *job, const wf_option_row *row, const char *value,
                                 weft_error *err) {
    if (wf_parse_span(value, &job->output_first, &job->output_end)) return WEFT_OK;
    return refuse(row, value, "A-B, the first and the last frame counted from 0, such as 10-19",
                  err);
}

/* Two ints, the second after the first. */
weft_status wf_set_dimensions(weft_job *job, const wf_option_row *row, const char *value,
                              weft_error *err) {
    int *size = member(job, row);
    if (wf_parse_dimensions(value, &size[0], &size[1])) return WEFT_OK;
    return refuse(row, value,
                  "WxH, pixels across and down, each from 1 to 65536, such as "
                  "1920x1080",
                  err);
}

weft_status wf_set_audio(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    static const char *const words[] = {"none", "copy", "silent:2", "tone:2"};
    wf_spelling spelling = {.text = value};
    wf_audio audio;
    bool known = wf_audio_parse(value, &audio);
    if (known && audio.kind != WF_AUDIO_NONE) return wf_set_text(job, row, value, err);
    if (known) {
        free(job->audio);
        job->audio = NULL;
        return WEFT_OK;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        wf_spelling_offer(&spelling, words[i]);
    char right[200];
    snprintf(right, sizeof right,
             "one of %s, with N tracks from 1 to %d%s%s; files have an ending, such as .wav",
             row->shown.takes, WF_SOUND_TRACKS, spelling.best ? "; did you mean " : "",
             spelling.best ? spelling.best : "");
    return refuse(row, value, right, err);
}

weft_status wf_set_codec(weft_job *job, const wf_option_row *row, const char *value,
                         weft_error *err) {
    char there[256];
    wf_spelling spelling = {.text = value};
    const wf_delivery *d;
    for (size_t i = 0; (d = wf_delivery_at(i)); i++) {
        if (!strcmp(d->kind.name, value)) return wf_set_text(job, row, value, err);
        wf_spelling_offer(&spelling, d->kind.name);
    }
    if (spelling.best && !wf_meant_by("codec", value))
        return wf_fail(err, WEFT_USAGE, "--codec: '%.100s' is unknown; did you mean %s?", value,
                       spelling.best);
    wf_delivery_codecs(there, sizeof there);
    return refuse(row, value, there, err);
}

/* ---- Releasing ---- */

void wf_release_text(weft_job *job, const wf_option_row *row) {
    free(*(char **)member(job, row));
}

void wf_release_params(weft_job *job, const wf_option_row *row) {
    (void)row;
    for (size_t i = 0; i < job->param_count; i++) free(job->params[i]);
    free(job->params);
}
