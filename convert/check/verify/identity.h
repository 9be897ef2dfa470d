#ifndef WF_CONVERT_CHECK_VERIFY_IDENTITY_H
#define WF_CONVERT_CHECK_VERIFY_IDENTITY_H

#include <stddef.h>

#include "convert/media/structure/structure.h"

/* Which material each of several files says it is. */
typedef struct wf_identities wf_identities;

/* Reads the structure of every file that is MXF or Matroska; others say nothing. The paths are
 * borrowed. WEFT_FAILED: a file that is there cannot be read. */
weft_status wf_identities_read(const char *const *paths, size_t count, wf_identities **out,
                               weft_error *err);
void wf_identities_free(wf_identities *identities); /* NULL is fine */

/* *shared: the path of another file of these that says it is what this one is, and is no copy
 * of it; NULL: there is none. */
weft_status wf_identities_shared(const wf_identities *identities, const char *path,
                                 const wf_structure *structure, const char **shared,
                                 weft_error *err);

#endif
