#ifndef WF_CONVERT_BASE_CLOCK_H
#define WF_CONVERT_BASE_CLOCK_H

/* Seconds of a clock that only goes forward, counted from some moment in the past: for
 * differences. Any thread. */
double wf_now_s(void);

#endif
