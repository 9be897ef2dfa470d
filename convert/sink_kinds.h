#ifndef WF_CONVERT_SINK_KINDS_H
#define WF_CONVERT_SINK_KINDS_H

#include "convert/sink.h"

/* The rows of the registry in convert/sink.c: streams (sink_stream.c) and pictures
 * (sink_pictures.c). */
extern const wf_sink_kind wf_sink_y4m, wf_sink_v210, wf_sink_uyvy, wf_sink_null, wf_sink_hash;
extern const wf_sink_kind wf_sink_exr, wf_sink_dpx, wf_sink_tiff, wf_sink_png;

/* What all deliveries (convert/delivery.h) are driven by: sink_delivery.c. */
weft_status wf_delivery_check(const wf_sink_options *options, weft_error *err);
weft_status wf_delivery_open(const wf_sink_options *options, wf_sink **out, weft_error *err);
weft_status wf_delivery_write(wf_sink *sink, const wf_frame *frame, weft_error *err);
weft_status wf_delivery_commit(wf_sink *sink, weft_error *err);
void wf_delivery_abandon(wf_sink *sink);

#endif
