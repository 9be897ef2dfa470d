/* Which of the resampler's inner loops is used. */
#include "filters/resample/rows.h"

WF_ISA_DISPATCH(wf_row_ops)
