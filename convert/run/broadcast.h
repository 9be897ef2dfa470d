#ifndef WF_CONVERT_RUN_BROADCAST_H
#define WF_CONVERT_RUN_BROADCAST_H

#include "color/composite/composite.h"
#include "convert/job/job.h"
#include "convert/job/report.h"

/* What a television shows of video that reaches it as composite. */

typedef struct wf_broadcast {
    const wf_raster *raster;    /* of the input; NULL: as the file says */
    const wf_tv_system *system; /* NULL: the raster's */
    bool keep_sound;            /* the input's, where the output holds sound */
    wf_tv_encoder encoder;
    wf_tv_decoder decoder;
} wf_broadcast;

/* Takes the job's one input, video of any form that is read, through a coder and a decoder to
 * its output, in its raster and with its time code. Of the job, what concerns the output's
 * codes and running is looked at; its raster becomes the input's. Tells the report what was
 * done. */
weft_status wf_broadcast_run(weft_job *job, const wf_broadcast *set, wf_report *report,
                             weft_error *err);

#endif
