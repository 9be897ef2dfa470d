/* Which of the loops over textured points is used. */
#include "tracer/rays/texture.h"

WF_ISA_DISPATCH(wf_texture_ops)
