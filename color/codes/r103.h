#ifndef WF_COLOR_CODES_R103_H
#define WF_COLOR_CODES_R103_H

#include <stddef.h>

/* EBU R 103 v3: R', G', B' and Y' are each from -5 % to 105 %, 10-bit codes 20 to 984, and up
 * to 1 % of the picture may be outside. */
#define WF_R103_LOW   ((20 - 64) / 876.0)
#define WF_R103_HIGH  ((984 - 64) / 876.0)
#define WF_R103_SHARE 0.01

/* How many of count pixels are outside. Y' is a mean of R', G' and B' and need not be looked
 * at: it is outside only where one of them is. */
int wf_r103_outside(const float *const rgb[3], size_t count);

#endif
