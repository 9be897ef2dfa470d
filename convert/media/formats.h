#ifndef WF_CONVERT_MEDIA_FORMATS_H
#define WF_CONVERT_MEDIA_FORMATS_H

#include <stdbool.h>

#include "convert/base/fail.h"

/* Formats of single pictures that are read through OpenImageIO, told by how files begin and not
 * by their names. OpenImageIO would try every plugin it has on a file it does not know. */

/* *format receives OpenImageIO's name of the format of the file at path ("png"), static
 * storage. What decoders pass over in silence is looked at here: checksums of PNG, the ends of
 * JPEG, the sizes DPX states. Damage, and a format that is not one of them, is an error that
 * names the file. */
weft_status wf_format_of(const char *path, const char **format, weft_error *err);

/* Whether it is a PNG of several pictures (APNG), which are video. WEFT_FAILED if it cannot be
 * read. */
weft_status wf_is_animated_png(const char *path, bool *is, weft_error *err);

/* Whether the file at path begins as one of them does, whatever it is called. TGA begins with
 * nothing of its own, and is told by its name. WEFT_FAILED if it cannot be read. */
weft_status wf_begins_as_picture(const char *path, bool *is, weft_error *err);

#endif
