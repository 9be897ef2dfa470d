#ifndef WF_CONVERT_BASE_OUTFILE_H
#define WF_CONVERT_BASE_OUTFILE_H

#include <stdint.h>

#include "convert/base/fail.h"

/* A file that appears at its final name whole or not at all: written without a name (O_TMPFILE)
 * or beside the final one, synced, then linked or renamed. Errors stick: after the first failed
 * write every call returns the same failure. One thread at a time. */
typedef struct wf_outfile wf_outfile;

/* "-" is standard output, which is written as it comes. An existing file is an error unless
 * overwrite. */
weft_status wf_outfile_open(const char *path, bool overwrite, wf_outfile **out,
                            weft_error *err);
weft_status wf_outfile_write(wf_outfile *file, const void *data, size_t bytes, weft_error *err);
/* Goes on at another place of a regular file; past its end the gap is zeros. */
weft_status wf_outfile_seek(wf_outfile *file, int64_t offset, weft_error *err);
/* Reads back what was written there: *got bytes, fewer at the end of the file. */
weft_status wf_outfile_read(wf_outfile *file, int64_t offset, void *data, size_t bytes,
                            size_t *got, weft_error *err);
/* Whether a file could be written there now, as wf_outfile_open would: for outputs that are
 * written after long work. Nothing is left. Pipes and devices are not opened. */
weft_status wf_outfile_check(const char *path, bool overwrite, weft_error *err);
weft_status wf_outfile_commit(wf_outfile *file, weft_error *err); /* frees file in any case */
void wf_outfile_abandon(wf_outfile *file);

#endif
