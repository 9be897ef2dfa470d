#ifndef WF_CONVERT_RUN_DRY_RUN_H
#define WF_CONVERT_RUN_DRY_RUN_H

#include "convert/run/sum/flow.h"

/* --dry-run: what a run would do. Nothing is read but headers, and nothing is written. */

/* Puts what the run would do into its report, as "plan", and for people into its job. The run
 * is ready to begin: what its source needs is known, and its pace where it opens files.
 * pictures: it makes subframes, of setup.output_options.raster, and no fields. */
weft_status wf_dry_run_make(wf_run *run, bool pictures, weft_error *err);

/* Frees the report's plan; NULL is fine. */
typedef struct wf_dry_run wf_dry_run;
void wf_dry_run_free(wf_dry_run *dry_run);

#endif
