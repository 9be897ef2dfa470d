/* Which of the walks' loops is used. */
#include "tracer/rays/walk.h"

WF_ISA_DISPATCH(wf_walk_ops)
