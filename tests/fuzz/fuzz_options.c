/* Options under arbitrary text: lines "name=value" (or "name", a flag). Every refusal must say
 * why, and name the option it refuses; a job that took all of them must be checked and freed.
 */
#include <stdlib.h>
#include <string.h>

#include "convert/job/job.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void set(weft_job *job, char *line) {
    char *value = strchr(line, '=');
    if (value) *value++ = '\0';
    weft_error err = {""};
    weft_status status = weft_job_set(job, line, value, &err);
    if (status && !*err.text) abort();
    if (status == WEFT_USAGE && strncmp(err.text, "--", 2)) abort();
    if (!status && *err.text) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1), *rest = text;
    weft_job *job = weft_job_new();
    if (!text || !job) abort();
    if (size) memcpy(text, data, size);
    text[size] = '\0';
    for (char *line; (line = strsep(&rest, "\n"));) set(job, line);
    weft_error err = {""};
    weft_job_add_input(job, "in.####.exr", NULL);
    weft_job_set_output(job, "out.y4m", NULL);
    if (wf_job_check(job, &err) && !*err.text) abort();
    /* What was taken makes sense by itself. */
    if (job->raster.width_px < 1 || job->raster.lines < 1 || job->raster.frame_rate.num < 1)
        abort();
    if (job->chunk < 1 || job->chunk > job->chunk_count || !job->aperture.kind) abort();
    weft_job_free(job);
    free(text);
    return 0;
}
