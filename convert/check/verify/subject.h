#ifndef WF_CONVERT_CHECK_VERIFY_SUBJECT_H
#define WF_CONVERT_CHECK_VERIFY_SUBJECT_H

#include <stdbool.h>

#include "convert/check/figures.h"
#include "convert/check/verify/finding.h"
#include "convert/check/verify/frame_labels.h"
#include "convert/check/verify/profiles.h"
#include "convert/media/metadata.h"
#include "convert/media/structure/structure.h"

/* A file that is verified, with all that is known of it. */
typedef struct wf_subject {
    const wf_delivery_profile *profile; /* NULL: none is asked for */
    wf_metadata metadata;
    bool contained; /* it has a container, and metadata is known */
    bool streamed;  /* it is frames one after the other: Y4M, v210, uyvy */
    wf_structure structure;
    const char *shared_with; /* another file that says it is the same material; NULL: none */
    wf_figures figures;      /* frames 0: the pixels cannot be read */
    wf_raster raster;        /* that it is held to */
    bool raster_known;
    bool raster_asked;      /* by --raster, which goes before the profile's */
    wf_frame_labels labels; /* files 0: it is no image sequence */
    int coded_lines;        /* with those of the vertical interval */
    const char *trouble;    /* why the pixels cannot be read; NULL: they can */
} wf_subject;

/* Looks at one thing and fills the finding. */
typedef wf_verdict wf_check_fn(const wf_subject *subject, wf_finding *finding);

#endif
