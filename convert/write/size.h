#ifndef WF_CONVERT_WRITE_SIZE_H
#define WF_CONVERT_WRITE_SIZE_H

#include "convert/job/output.h"

/* Bytes of `frames` frames at so many bytes a second, rounded down. */
int64_t wf_bytes_at_rate(const wf_output_options *options, int64_t frames, int64_t rate);

/* Bytes of the sound beside so many frames. */
int64_t wf_sound_bytes(const wf_output_options *options, int64_t frames);

#endif
