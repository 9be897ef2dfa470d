#ifndef WF_CONVERT_JOB_AUDIO_H
#define WF_CONVERT_JOB_AUDIO_H

#include <stdbool.h>
#include <stddef.h>

#include "filters/base/rational.h"

/* What --audio asks for, and how samples of sound are shared out to frames. */

#define WF_SOUND_RATE   48000 /* samples a second of all sound that is written */
#define WF_SOUND_TRACKS 16    /* that a file has at most */

typedef enum wf_audio_kind {
    WF_AUDIO_NONE,
    WF_AUDIO_COPY, /* the input video's */
    WF_AUDIO_FILE,
    WF_AUDIO_SILENT,
    WF_AUDIO_TONE
} wf_audio_kind;

typedef struct wf_audio {
    wf_audio_kind kind;
    int tracks;         /* of silence and of the tone */
    size_t path_length; /* of the file's name, with which the text begins */
    const char *offset; /* in the text; NULL: 0 */
} wf_audio;

/* "none", "copy", "silent:N", "tone:N" with N from 1 to WF_SOUND_TRACKS, or a file's name,
 * which has an ending or begins with '/' or "./", with or without ":OFFSET" behind it. NULL is
 * none. False if it is nothing of these. */
bool wf_audio_parse(const char *text, wf_audio *out);

/* "1.5", "-2", "01:02.25", "01:00:00.5", or with frames of frame_rate "01:00:00:12" and
 * "01:00:00;12": seconds, with a minus before them negative. */
bool wf_audio_offset(const char *text, wf_rational frame_rate, wf_rational *seconds);

/* How many samples frames 0 .. n - 1 have, n >= 0: frame n's sound begins at the sample that is
 * nearest to its exact time, so that the count of any length is within half a sample of it. At
 * 30000/1001 frames have 1602 1601 1602 1601 1602 samples, as in SMPTE ST 299-1 and 382. */
int64_t wf_sound_samples(wf_rational frame_rate, int64_t n);

#endif
