/* Numbers of 113 bits, for differences that a double would lose. */
#ifndef WF_FILTERS_BASE_QUAD_H
#define WF_FILTERS_BASE_QUAD_H

#include <float.h>

/* IEEE 754's binary128: what compilers for 64-bit Arm call long double, those for x86-64 not.
 */
#if LDBL_MANT_DIG == 113
typedef long double wf_quad;
#else
__extension__ typedef __float128 wf_quad;
#endif

#endif
