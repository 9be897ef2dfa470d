#ifndef WF_TESTS_UNIT_SUPPORT_JOBS_H
#define WF_TESTS_UNIT_SUPPORT_JOBS_H

#include <stddef.h>
#include <stdint.h>

#include "convert/weft.h"

/* Jobs of a test, run through the public interface in a directory of their own. */

#define JOB_REPORT 8192

extern char job_directory[64];
int job_make_directory(void **state);   /* group setup */
int job_remove_directory(void **state); /* group teardown */

/* Empties the directory. */
void job_clean(void);

/* DIRECTORY/name. */
void job_path(char path[512], const char *name);

/* Sets the options "name=value flag .." in their order, up to one that will not do. */
weft_status job_set(weft_job *job, const char *options, weft_error *err);

/* Runs oiiotool in the directory; skips the test where there is none. */
void job_oiiotool(const char *arguments);

/* Converts in.####.exr -> output with the options "name=value flag ..". report (if not NULL)
 * gets the JSON. The test is skipped where that needs a module that was not built. */
weft_status job_run(const char *options, const char *output, char report[JOB_REPORT],
                    weft_error *err);

/* The same where it must work, and where it must fail with this status and word. */
void job_done(const char *options, const char *output, char report[JOB_REPORT]);
void job_refused(const char *options, const char *output, weft_status status, const char *word);

/* A number of the report. */
double job_number(const char *report, const char *key);

/* The bytes of a file; free(). */
uint8_t *job_file(const char *name, size_t *size);

/* Fails unless the file has these bytes. */
void job_same(const char *name, const uint8_t *bytes, size_t size);

#endif
