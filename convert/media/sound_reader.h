#ifndef WF_CONVERT_MEDIA_SOUND_READER_H
#define WF_CONVERT_MEDIA_SOUND_READER_H

#include "convert/base/fail.h"
#include "filters/base/rational.h"

/* Sound as it is read from a file, whatever its streams are: samples at WF_SOUND_RATE. */

typedef struct wf_sound_info {
    char format[64]; /* for people: "pcm_s24le, 48000 Hz, 8 streams" */
    int channels;    /* of all its streams, one after the other */
    int bits; /* of a sample, the most that a stream has; 0: floats, or compressed with loss */
    bool resampled;  /* a stream has another rate */
    double length_s; /* 0: not known before the end */
} wf_sound_info;

/* Where reading begins: so many samples, as they are given out, after start_s of the file,
 * either of which may be negative; and how fast the file is played, 1 being as it was recorded.
 */
typedef struct wf_sound_start {
    wf_rational start_s, speed;
    int64_t samples;
} wf_sound_start;

typedef struct wf_sound_reader {
    /* beside_video: its time 0 is when the file's video shows its first picture, else when its
     * sound begins. A file without sound has no channels, which is no error. */
    weft_status (*open)(const char *path, bool beside_video, void **state, wf_sound_info *info,
                        weft_error *err);
    /* Once, before the first read. */
    weft_status (*begin)(void *state, const wf_sound_start *start, weft_error *err);
    /* Fills to[count][channels] with the next samples, of 32 bits; before the sound begins, in
     * its gaps and after the end of a stream they are 0. *got is less than count only at the
     * end of all streams, and what is beyond it is 0. Damage is an error that says when. */
    weft_status (*read)(void *state, int32_t *to, int64_t count, int64_t *got, weft_error *err);
    const char *(*note)(void *state); /* what people should know of it; "": nothing */
    void (*close)(void *state);       /* NULL is fine */
} wf_sound_reader;

/* wf_libav_sound, an entry point of the libav module. */
typedef const wf_sound_reader *wf_libav_sound_fn(void);

#endif
