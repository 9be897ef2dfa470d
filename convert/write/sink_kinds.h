#ifndef WF_CONVERT_WRITE_SINK_KINDS_H
#define WF_CONVERT_WRITE_SINK_KINDS_H

#include "convert/write/sink.h"

/* The rows of the registry in sink.c: streams (sink_stream.c) and pictures (sink_pictures.c).
 */
extern const wf_output wf_output_y4m, wf_output_v210, wf_output_uyvy, wf_output_null,
    wf_output_hash;
extern const wf_output wf_output_exr, wf_output_dpx, wf_output_tiff, wf_output_png;

/* What drives deliveries (convert/job/delivery.h): sink_delivery.c, and sink_mxf.c for
 * uncompressed 4:2:2 in MXF, which libav cannot write. */
extern const wf_sink_ops wf_delivery_ops, wf_mxf_sink_ops;

/* Of silence beside so many frames: 24 bits at 48 kHz. (sink_delivery.c) */
int64_t wf_sound_bytes(const wf_output_options *options, int64_t frames);

/* 4:2:2 frames as bytes: v210 has 10 bits, lines of whole 128 bytes; uyvy has 8 bits. Packing
 * returns how many bytes were written to `to`, which are those of a frame. */
size_t wf_v210_bytes(const wf_output_options *options);
size_t wf_v210_pack(const wf_output_options *options, const wf_frame *frame, uint8_t *to);
size_t wf_uyvy_bytes(const wf_output_options *options);
size_t wf_uyvy_pack(const wf_output_options *options, const wf_frame *frame, uint8_t *to);

#endif
