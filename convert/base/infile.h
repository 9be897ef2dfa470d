#ifndef WF_CONVERT_BASE_INFILE_H
#define WF_CONVERT_BASE_INFILE_H

#include <stdio.h>

#include "convert/weft.h"

/* Files that are read. What the system has against one (no more descriptors, an input error) is
 * said as that, and is not taken for what the file holds. */

/* Opens a regular file, a pipe or a device; the caller closes it. WEFT_FAILED: the system's
 * reason, with the path. */
weft_status wf_infile_open(const char *path, FILE **out, weft_error *err);

/* Closes it. WEFT_FAILED: the system could not read some of it, and whatever was made of that
 * is to be dropped. Where there is an error already (`status`), one of reading takes its place,
 * since it is the reason. Nothing but fseeko may have been done to the file's position: rewind
 * forgets errors. */
weft_status wf_infile_close(FILE *file, const char *path, weft_status status, weft_error *err);

/* Reads the first bytes of a file, *got of them where it is shorter. */
weft_status wf_infile_head(const char *path, void *to, size_t bytes, size_t *got,
                           weft_error *err);

#endif
