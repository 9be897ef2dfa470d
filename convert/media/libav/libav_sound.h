#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_SOUND_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_SOUND_H

#include "convert/media/libav/libav_writing.h"

/* Silent tracks beside a video. */

/* Adds their streams to the file, if any are asked for. wf_sound_free releases in any case. */
weft_status wf_sound_open(wf_writing *w, weft_error *err);

/* Writes the silence that belongs to the frames written up to now. */
weft_status wf_sound_write(wf_writing *w, weft_error *err);

void wf_sound_free(wf_sound *sound);

#endif
