#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_SOUND_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_SOUND_H

#include "convert/media/libav/libav_writing.h"

/* Silent tracks beside a video. Adds the streams, if any are asked for; */
weft_status wf_sound_open(wf_writing *w, weft_error *err);

/* writes the silence that belongs to the frames written up to now; */
weft_status wf_sound_write(wf_writing *w, weft_error *err);

/* and frees. */
void wf_sound_free(wf_sound *sound);

#endif
