#ifndef WF_CONVERT_FINISH_OVERWRITE_CHECK_H
#define WF_CONVERT_FINISH_OVERWRITE_CHECK_H

#include "convert/finish/setup.h"

/* Refuses a job whose output would replace one of its own inputs, under whatever name. Only
 * files that are there already can be; without --overwrite they are refused anyway. */
weft_status wf_refuse_own_inputs(const weft_job *job, const wf_setup *setup, weft_error *err);

#endif
