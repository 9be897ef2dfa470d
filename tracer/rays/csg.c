/* Which of the loops over programs of solids is used, and hits to begin with. */
#include "tracer/rays/csg.h"

#include <math.h>

WF_ISA_DISPATCH(wf_csg_ops)

void wf_hits_clear(wf_hits *hits) {
    for (int i = 0; i < WF_PACKET; i++) {
        hits->s[i] = HUGE_VAL;
        hits->solid[i] = -1;
        hits->entering[i] = 0;
    }
}
