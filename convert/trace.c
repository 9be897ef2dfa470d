#include "convert/render.h"

weft_status wf_run_trace(weft_job *job, wf_report *report, weft_error *err) {
    (void)job, (void)report;
    return wf_fail(err, WEFT_FAILED, "not yet");
}
