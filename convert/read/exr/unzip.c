/* Which of the loops over inflated bytes is used. */
#include "convert/read/exr/unzip.h"

WF_ISA_DISPATCH(wf_unzip_ops)
