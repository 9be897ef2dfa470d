#ifndef WF_CONVERT_CHECK_VERIFY_VERIFY_H
#define WF_CONVERT_CHECK_VERIFY_VERIFY_H

#include <signal.h>

#include "convert/check/verify/checks.h"
#include "convert/check/verify/identity.h"
#include "convert/check/verify/profiles.h"
#include "convert/weft.h"
#include "filters/raster/raster.h"

/* Whether a delivered file says and holds what its raster, or a delivery profile, demands;
 * convert/check/verify/README.md tells how the checks are made. */

typedef struct wf_verification {
    wf_raster raster; /* that it was held to */
    const wf_delivery_profile *profile;
    wf_finding finding[WF_FINDINGS_MOST];
    size_t count, wrong; /* of the findings */
} wf_verification;

typedef struct wf_verify_options {
    const wf_delivery_profile *profile; /* NULL: none */
    const wf_raster *raster; /* NULL: the profile's, else the one that the file says */
    const wf_identities
        *others; /* of all files that are verified together; NULL: it is alone */
    size_t max_memory_bytes;
    weft_progress_fn *progress;
    void *progress_user;
    const volatile sig_atomic_t *canceled; /* as of wf_measure_options */
} wf_verify_options;

/* Reads the file to its end. A file that cannot be read is a finding, not an error; errors are
 * those of memory and of names. */
weft_status wf_verify(const char *path, const wf_verify_options *options, wf_verification *out,
                      weft_error *err);

#endif
