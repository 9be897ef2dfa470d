/* Which of the loops over packets is used. */
#include "tracer/rays/packet.h"

WF_ISA_DISPATCH(wf_packet_ops)
