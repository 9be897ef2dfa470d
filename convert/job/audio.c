/* Reads what --audio asks for, and counts samples of sound by frames. */
#include "convert/job/audio.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "convert/job/timecode.h"

/* ---- Words ---- */

/* "silent:8": the number behind a word and a colon; 0 where it is another word. */
static int tracks_of(const char *text, const char *word) {
    size_t length = strlen(word);
    int tracks, read = 0;
    if (strncmp(text, word, length) || !isdigit((unsigned char)text[length])) return 0;
    if (sscanf(text + length, "%3d%n", &tracks, &read) != 1 || text[length + (size_t)read])
        return 0;
    return tracks <= WF_SOUND_TRACKS ? tracks : 0;
}

/* Whether a word of these was meant, whatever follows it. */
static bool begins_a_word(const char *text) {
    return !strncmp(text, "silent:", 7) || !strncmp(text, "tone:", 5);
}

/* Whether it is meant as a file: it has an ending, or begins as a path. */
static bool is_file(const char *text, size_t length) {
    const char *dot = memrchr(text, '.', length);
    if (*text == '/' || !strncmp(text, "./", 2) || !strncmp(text, "../", 3)) return true;
    return dot && isalpha((unsigned char)dot[1]) &&
           !memchr(dot, '/', length - (size_t)(dot - text));
}

static void parse_file(const char *text, wf_audio *out) {
    const wf_rational any = {60, 1};
    wf_rational seconds;
    *out = (wf_audio){.kind = WF_AUDIO_FILE, .path_length = strlen(text)};
    for (const char *colon = strchr(text, ':'); colon; colon = strchr(colon + 1, ':'))
        if (colon > text && wf_audio_offset(colon + 1, any, &seconds)) {
            out->path_length = (size_t)(colon - text);
            out->offset = colon + 1;
            return;
        }
}

bool wf_audio_parse(const char *text, wf_audio *out) {
    int silent = text ? tracks_of(text, "silent:") : 0;
    int tone = text ? tracks_of(text, "tone:") : 0;
    *out = (wf_audio){.kind = WF_AUDIO_NONE};
    if (!text || !strcmp(text, "none")) return true;
    if (silent || tone) {
        *out = (wf_audio){silent ? WF_AUDIO_SILENT : WF_AUDIO_TONE, silent + tone, 0, NULL};
    } else if (!strcmp(text, "copy")) {
        out->kind = WF_AUDIO_COPY;
    } else {
        parse_file(text, out);
        return !begins_a_word(text) && is_file(text, out->path_length);
    }
    return true;
}

/* ---- Times ---- */

/* "12.25", up to nine decimals; *text moves past it. */
static bool take_seconds(const char **text, wf_rational *seconds) {
    const char *at = *text;
    int64_t number = 0, scale = 1;
    if (!isdigit((unsigned char)*at)) return false;
    for (; isdigit((unsigned char)*at) && number < 100000000; at++)
        number = 10 * number + (*at - '0');
    if (*at == '.')
        for (at++; isdigit((unsigned char)*at) && scale < 1000000000; at++, scale *= 10)
            number = 10 * number + (*at - '0');
    *seconds = wf_ratio(number, scale);
    *text = at;
    return wf_ratio_given(*seconds);
}

/* "[[HH:]MM:]SS[.FRACTION]" */
static bool parse_clock(const char *text, wf_rational *seconds) {
    wf_rational sum = {0, 1}, part;
    for (int parts = 0; parts < 3; parts++) {
        if (!take_seconds(&text, &part)) return false;
        sum = wf_ratio_sum(wf_ratio_mul(sum, wf_ratio(60, 1)), part);
        if (!*text) *seconds = sum;
        if (!*text) return wf_ratio_given(sum);
        if (*text++ != ':' || part.den != 1) return false;
    }
    return false;
}

static bool parse_label(const char *text, wf_rational frame_rate, wf_rational *seconds) {
    wf_timecode label;
    char why[256];
    if (!wf_parse_timecode(text, &label)) return false;
    if (label.drop_frame && !wf_timecode_may_drop(frame_rate))
        frame_rate = wf_ratio(30000, 1001); /* what drop frame labels are of */
    if (!wf_timecode_check(&label, frame_rate, why, sizeof why)) return false;
    *seconds = wf_ratio_div(wf_ratio(wf_timecode_frame(&label, frame_rate), 1), frame_rate);
    return wf_ratio_given(*seconds);
}

bool wf_audio_offset(const char *text, wf_rational frame_rate, wf_rational *seconds) {
    bool negative = *text == '-';
    text += negative;
    if (!parse_clock(text, seconds) && !parse_label(text, frame_rate, seconds)) return false;
    if (negative) seconds->num = -seconds->num;
    return true;
}

/* ---- Samples of frames ---- */

__extension__ typedef __int128 wide;

int64_t wf_sound_samples(wf_rational frame_rate, int64_t n) {
    wide twice = 2 * (wide)n * WF_SOUND_RATE * frame_rate.den;
    return (int64_t)((twice + frame_rate.num) / (2 * (wide)frame_rate.num));
}
