#ifndef WF_CONVERT_WRITE_PACKING_H
#define WF_CONVERT_WRITE_PACKING_H

#include "convert/job/output.h"
#include "convert/media/frame.h"

/* 4:2:2 frames as bytes, both fields woven, top line first. Packing returns how many bytes were
 * written to `to`, which are those of a frame. */

/* v210 (QuickTime Ice Floe 19): 10 bits, six pixels in four little-endian words of three codes;
 * lines are filled up to whole 128 bytes with zeros. */
size_t wf_v210_bytes(const wf_output_options *options);
size_t wf_v210_pack(const wf_output_options *options, const wf_frame *frame, uint8_t *to);

/* uyvy: 8 bits, Cb Y Cr Y. */
size_t wf_uyvy_bytes(const wf_output_options *options);
size_t wf_uyvy_pack(const wf_output_options *options, const wf_frame *frame, uint8_t *to);

#endif
