#ifndef WF_CONVERT_READ_SOURCE_EXR_H
#define WF_CONVERT_READ_SOURCE_EXR_H

#include "convert/read/subframe.h"

/* Opening EXR files, and what their headers say. */

/* Opens the EXR at subframe->path; *needs_module means that its compression must be read by
 * other means, with everything but the pixels known. Whatever the status, wf_subframe_close
 * releases. */
weft_status wf_exr_open(wf_subframe *subframe, const wf_source_options *options, int part,
                        bool *needs_module, weft_error *err);

/* Whether the file starts like an EXR. False too if it cannot be read. */
bool wf_is_exr(const char *path);

/* What OpenEXRCore's status means, for people. */
const char *wf_exr_trouble(exr_result_t result);

#endif
