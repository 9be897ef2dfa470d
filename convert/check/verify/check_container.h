#ifndef WF_CONVERT_CHECK_VERIFY_CHECK_CONTAINER_H
#define WF_CONVERT_CHECK_VERIFY_CHECK_CONTAINER_H

#include "convert/check/verify/subject.h"

/* What MOV and MXF files hold besides their pictures, against their formats. */
wf_check_fn wf_check_fiel, wf_check_atoms, wf_check_clap, wf_check_line_map, wf_check_layout,
    wf_check_bmx, wf_check_pattern, wf_check_dominance, wf_check_siting, wf_check_heard;

#endif
