/* Which of the loops over blocks is used. */
#include "convert/read/exr/dct.h"

WF_ISA_DISPATCH(wf_dct_ops)
