#ifndef WF_CONVERT_SINK_KINDS_H
#define WF_CONVERT_SINK_KINDS_H

#include "convert/sink.h"

/* The rows of the registry in convert/sink.c: streams (sink_stream.c) and pictures
 * (sink_pictures.c). */
extern const wf_sink_kind wf_sink_y4m, wf_sink_v210, wf_sink_uyvy, wf_sink_null, wf_sink_hash;
extern const wf_sink_kind wf_sink_exr, wf_sink_dpx, wf_sink_tiff, wf_sink_png;

#endif
