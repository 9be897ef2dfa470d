#ifndef WF_CONVERT_RUN_FITTING_H
#define WF_CONVERT_RUN_FITTING_H

#include "convert/job/job.h"
#include "convert/media/image.h"
#include "filters/resample/lattice.h"

/* How pictures like `first` lie on the job's raster, across and down, as its --fit and
 * --input-par say; warns where they will be stretched. */
void wf_fit_picture(const weft_job *job, const wf_image_info *first, wf_fitting *across,
                    wf_fitting *down);

#endif
