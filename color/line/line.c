/* Which of the inner loops of color is used. */
#include "color/line/line.h"

WF_ISA_DISPATCH(wf_line_ops)
