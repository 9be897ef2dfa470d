#ifndef WF_CONVERT_MEDIA_KINDS_H
#define WF_CONVERT_MEDIA_KINDS_H

#include "convert/base/fail.h"

/* What files are that are neither pictures nor video that weft reads: documents, scenes of
 * other programs, archives, raw pictures of cameras, formats that other programs turn into one
 * that weft reads. */

/* An error that says what the file is and what to do, if it is one of these by how it begins
 * (or, of raw pictures, which begin as TIFF, by its ending); else OK. Only regular files are
 * looked at: pipes can be read once. */
weft_status wf_refuse_kind(const char *path, weft_error *err);

/* One row of the table, for those that test it: what begins with `magic` at `offset` is
 * refused with these words. NULL past the last. */
typedef struct wf_kind {
    size_t offset;
    const char *magic;
    size_t magic_bytes;
    const char *name;   /* "a Photoshop document" */
    const char *advice; /* a command that has IN and OUT, or what else to do */
} wf_kind;
const wf_kind *wf_kind_at(size_t index);

#endif
