#ifndef WF_CONVERT_RUN_SOURCE_FITTING_H
#define WF_CONVERT_RUN_SOURCE_FITTING_H

#include "convert/media/image.h"
#include "convert/run/sum/flow.h"
#include "filters/resample/resampler.h"

/* How pictures like `first` lie on the job's raster, across and down, as its --fit and
 * --input-par say; warns where they will be stretched. */
void wf_fit_picture(const weft_job *job, const wf_image_info *first, wf_fitting *across,
                    wf_fitting *down);

/* How the job's fields look at pictures like `first`, of which there are so many, and as many a
 * second (0/0: `timing.edges` will be set). Three channels, and bands of 16 rows. */
wf_resample_desc wf_describe_fields(const weft_job *job, const wf_image_info *first,
                                    wf_rational rate, int64_t pictures);

/* Settles which of the `frames` that pictures give are made, where their fields end, and how
 * these are summed; the caller frees what is made. */
weft_status wf_fit_frames(wf_run *run, const wf_resample_desc *desc, int64_t frames,
                          int64_t *end_field, wf_resampler **out, weft_error *err);

#endif
