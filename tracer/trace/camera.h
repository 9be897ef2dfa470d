#ifndef WF_TRACER_TRACE_CAMERA_H
#define WF_TRACER_TRACE_CAMERA_H

#include "tracer/trace/tracer_inside.h"

/* From places of the picture to rays. */

/* Fills the packet's rays, whose count and times are there: from the eye through the places x,
 * y ([WF_PACKET]) of the raster, as the camera stands at each lane's time. */
void wf_camera_rays(const wf_tracer *tracer, const double *x, const double *y,
                    wf_packet *packet);

/* A shaft that holds the rays of all samples of a rectangle at any time of the window. */
wf_shaft wf_camera_shaft(const wf_tracer *tracer, const double x[2], const double y[2]);

#endif
