/* How many bytes a run will write, where that follows from its length. */
#include "convert/write/size.h"

#include "convert/job/audio.h"

int64_t wf_bytes_at_rate(const wf_output_options *o, int64_t frames, int64_t rate) {
    return (int64_t)((double)(frames * rate) / wf_ratio_value(o->raster->frame_rate));
}

int64_t wf_sound_bytes(const wf_output_options *o, int64_t frames) {
    return o->sound.tracks * (o->sound.bits / 8) *
           wf_sound_samples(o->raster->frame_rate, frames);
}
