#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_WRITE_SOUND_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_WRITE_SOUND_H

#include "convert/media/libav/libav_writing.h"

/* Tracks of sound beside a video: PCM, mono tracks or one of all channels; or what an encoder
 * makes of pairs of them. */

/* Adds their streams to the file, if any are asked for. wf_written_sound_free releases in any
 * case. */
weft_status wf_written_sound_open(wf_writing *w, weft_error *err);

/* Writes the sound that belongs to the frames written up to now. */
weft_status wf_written_sound_write(wf_writing *w, weft_error *err);

/* After the last frame: writes what encoders still hold. */
weft_status wf_written_sound_finish(wf_writing *w, weft_error *err);

void wf_written_sound_free(wf_written_sound *sound);

#endif
