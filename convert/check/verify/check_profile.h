#ifndef WF_CONVERT_CHECK_VERIFY_CHECK_PROFILE_H
#define WF_CONVERT_CHECK_VERIFY_CHECK_PROFILE_H

#include "convert/check/verify/subject.h"

/* What the profile asks for. */
wf_check_fn wf_check_container, wf_check_codec, wf_check_bits, wf_check_channels,
    wf_check_tracks, wf_check_sound_bits, wf_check_start, wf_check_codec_profile,
    wf_check_level, wf_check_chroma, wf_check_groups, wf_check_bit_rate, wf_check_frame_bytes,
    wf_check_partitions, wf_check_sound_codec, wf_check_mono, wf_check_one_sound,
    wf_check_alpha, wf_check_not;

#endif
