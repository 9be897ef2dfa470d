#ifndef WF_CONVERT_SOUND_SOUND_H
#define WF_CONVERT_SOUND_SOUND_H

#include "convert/job/delivery.h"
#include "convert/job/job.h"

/* The sound that --audio asks for: the input video's, a file's, silence or a tone, as tracks of
 * the output. One thread at a time. */
typedef struct wf_sound wf_sound;

/* Opens it, and warns of what becomes of its channels, bits and rate; *out is NULL where none
 * is asked for. Job and delivery must outlive it. */
weft_status wf_sound_open(const weft_job *job, const wf_delivery *delivery, wf_sound **out,
                          weft_error *err);

/* What sound a file holds, for people: "2 channels (pcm_s24le, 48000 Hz, 1 stream)" or "none";
 * "" with an error where that cannot be found out. */
#define WF_SOUND_TEXT 128
weft_status wf_sound_in(const char *path, char text[WF_SOUND_TEXT], weft_error *err);

/* What a sink is told of it; it borrows the sound. */
wf_sound_feed wf_sound_feed_of(wf_sound *sound);

/* What it was taken for, for people. Returns text. */
const char *wf_sound_text(const wf_sound *sound, char text[WF_SOUND_TEXT]);

typedef struct wf_sound_place {
    wf_rational copied_s; /* when frame 0 begins on the clock of the input's sound; {0, 0}: 0 */
    wf_rational speed;    /* of its pictures as they are shown, 1 being its own; {0, 0}: 1 */
    int64_t first_frame;  /* of this run */
} wf_sound_place;

/* Has it begin with the first frame. Once, before the feed is read. */
weft_status wf_sound_begin(wf_sound *sound, const wf_sound_place *place, weft_error *err);

/* Warns where it was shorter or longer than the pictures, after the last frame. */
void wf_sound_tell(wf_sound *sound);

void wf_sound_close(wf_sound *sound); /* NULL is fine */

#endif
