#ifndef WF_CONVERT_WRITE_SINK_KINDS_H
#define WF_CONVERT_WRITE_SINK_KINDS_H

#include "convert/write/sink_kind.h"

/* The rows of the registry (sink.c), each beside what drives it. */

/* Streams of frames: sink_stream.c. */
extern const wf_output wf_output_y4m, wf_output_v210, wf_output_uyvy, wf_output_null,
    wf_output_hash;

/* Sequences of pictures: sink_pictures.c. */
extern const wf_output wf_output_exr, wf_output_dpx, wf_output_tiff, wf_output_png;

/* What drives the deliveries of convert/job/delivery.c: sink_delivery.c those that libav
 * writes, sink_mxf.c uncompressed 4:2:2 in MXF, which it cannot. */
extern const wf_sink_ops wf_delivery_ops, wf_mxf_sink_ops;

#endif
