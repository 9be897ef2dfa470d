#ifndef WF_TRACER_RAYS_QUARTIC_H
#define WF_TRACER_RAYS_QUARTIC_H

/* Runs of from <= t <= to where q[0] + q[1] t + .. + q[4] t^4 < 0: their ends in pairs,
 * ascending, into end; how many runs (0..2). A run cut by from or to ends there. Roots are
 * bracketed between those of the derivatives (Yuksel, High-performance polynomial root finding,
 * 2022), so that none is lost and none is found twice. */
int wf_quartic_runs(const double q[5], double from, double to, double end[4]);

#endif
