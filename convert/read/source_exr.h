#ifndef WF_CONVERT_READ_SOURCE_EXR_H
#define WF_CONVERT_READ_SOURCE_EXR_H

#include "convert/read/subframe.h"

/* Opening EXR files, and what their headers say. */

/* Opens the EXR at subframe->path: with success everything but the pixels is known. *by_chunks:
 * these can be read as rows are asked for; else whole, by wf_exr_read_subsampled. Whatever the
 * status, wf_subframe_close releases. */
weft_status wf_exr_open(wf_subframe *subframe, const wf_source_options *options, int part,
                        bool *by_chunks, weft_error *err);

/* Reads the picture of an open EXR, some of whose channels have not a sample for every pixel,
 * into planes [channels][height][width]: floats, R G B[, A]. Luminance and chroma become R G B
 * by the luma weights of the file's chromaticities, else Rec. 709's; chroma is interpolated by
 * Rec. BT.601's half-band, cosited with even pixels and lines. */
weft_status wf_exr_read_subsampled(const wf_subframe *subframe, float *planes, weft_error *err);

/* Whether the file starts like an EXR. WEFT_FAILED if it cannot be read. */
weft_status wf_is_exr(const char *path, bool *is_exr, weft_error *err);

/* Fails: why the chunk at line y of the data window could not be read. */
weft_status wf_exr_unread(const wf_subframe *subframe, int y, exr_result_t result,
                          weft_error *err);

/* What OpenEXRCore's status means, for people. */
const char *wf_exr_trouble(exr_result_t result);

#endif
