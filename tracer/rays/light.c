/* Which of the loops over lit packets is used. */
#include "tracer/rays/light.h"

WF_ISA_DISPATCH(wf_light_ops)
