#ifndef WF_CONVERT_RUN_TIME_PLANNED_H
#define WF_CONVERT_RUN_TIME_PLANNED_H

#include "convert/job/job.h"
#include "convert/media/image.h"
#include "convert/read/sequence.h"

/* Takes the numbers of a sequence for those of a plan, which count from 0 in steps of one,
 * where output-frames are asked for, no range is, and all files that are there are seen by just
 * these frames if numbers are read so: a part of a shot was planned and rendered. Then the
 * sequence becomes that from 0 on, and *rate is the rate of such numbers. Else both stay as
 * they are. */
weft_status wf_take_planned(const weft_job *job, const wf_image_info *first,
                            wf_sequence *sequence, wf_rational *rate, weft_error *err);

#endif
