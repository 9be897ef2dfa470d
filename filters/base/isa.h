#ifndef WF_FILTERS_BASE_ISA_H
#define WF_FILTERS_BASE_ISA_H

/* How many of the levels that *_isa.c files are compiled for this processor runs: 1 is the
 * baseline (v1), 2 and 3 are x86-64-v3 and x86-64-v4. */
int wf_isa_levels(void);

#endif
