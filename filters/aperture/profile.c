/* Which of the loops over apertures is used. */
#include "filters/aperture/profile.h"

WF_ISA_DISPATCH(wf_profile_ops)
