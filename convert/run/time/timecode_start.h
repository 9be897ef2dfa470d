#ifndef WF_CONVERT_RUN_TIME_TIMECODE_START_H
#define WF_CONVERT_RUN_TIME_TIMECODE_START_H

#include "convert/media/image.h"
#include "convert/finish/setup.h"

/* The timecode of frame 0 where none was given: that of the first subframe that is there, at
 * the raster's rate (wf_timecode_convert), with a notice; none where it has no label that makes
 * sense. A label counts at the files' framesPerSecond where that can have labels (60 or less),
 * else at the film's rate under a cadence and at the raster's without. */
void wf_start_timecode(const weft_job *job, wf_setup *setup, const wf_image_info *first);

/* Labels a second of the input's timecode: what it says, as far as that can be, else what the
 * raster shows. */
wf_rational wf_timecode_rate(const weft_job *job, const wf_image_info *first);

/* Moves the input's timecode to the picture that is shown so long after the one that it is of.
 */
void wf_advance_timecode(const weft_job *job, wf_image_info *first, wf_rational by_s);

#endif
