#ifndef WF_CONVERT_SINK_KINDS_H
#define WF_CONVERT_SINK_KINDS_H

#include "convert/sink.h"

/* The rows of the registry in convert/sink.c: streams (sink_stream.c) and pictures
 * (sink_pictures.c). */
extern const wf_sink_kind wf_sink_y4m, wf_sink_v210, wf_sink_uyvy, wf_sink_null, wf_sink_hash;
extern const wf_sink_kind wf_sink_exr, wf_sink_dpx, wf_sink_tiff, wf_sink_png;

/* What all deliveries (convert/delivery.h) are driven by: sink_delivery.c. */
weft_status wf_delivery_check(const wf_sink_options *options, weft_error *err);
wf_sink_size wf_delivery_size(const wf_sink_options *options, int64_t frames);
void wf_delivery_tell(const wf_sink_options *options, char *text, size_t size);
weft_status wf_delivery_open(const wf_sink_options *options, wf_sink **out, weft_error *err);
weft_status wf_delivery_write(wf_sink *sink, const wf_frame *frame, weft_error *err);
weft_status wf_delivery_commit(wf_sink *sink, weft_error *err);
void wf_delivery_abandon(wf_sink *sink);

/* The deliveries of uncompressed 4:2:2 in MXF, which libav cannot write: sink_mxf.c. */
weft_status wf_mxf_sink_check(const wf_sink_options *options, weft_error *err);
wf_sink_size wf_mxf_sink_size(const wf_sink_options *options, int64_t frames);
weft_status wf_mxf_sink_open(const wf_sink_options *options, wf_sink **out, weft_error *err);
weft_status wf_mxf_sink_write(wf_sink *sink, const wf_frame *frame, weft_error *err);
weft_status wf_mxf_sink_commit(wf_sink *sink, weft_error *err);
void wf_mxf_sink_abandon(wf_sink *sink);

/* Of silence beside so many frames: 24 bits at 48 kHz. (sink_delivery.c) */
int64_t wf_sound_bytes(const wf_sink_options *options, int64_t frames);

/* 4:2:2 frames as bytes: v210 has 10 bits, lines of whole 128 bytes; uyvy has 8 bits. Packing
 * returns how many bytes were written to `to`, which are those of a frame. */
size_t wf_v210_bytes(const wf_sink_options *options);
size_t wf_v210_pack(const wf_sink_options *options, const wf_frame *frame, uint8_t *to);
size_t wf_uyvy_bytes(const wf_sink_options *options);
size_t wf_uyvy_pack(const wf_sink_options *options, const wf_frame *frame, uint8_t *to);

#endif
