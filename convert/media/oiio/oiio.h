#ifndef WF_CONVERT_MEDIA_OIIO_OIIO_H
#define WF_CONVERT_MEDIA_OIIO_OIIO_H

#include "convert/base/fail.h"
#include "convert/media/image.h"
#include "convert/media/picture_out.h"

/* What the OpenImageIO module (convert/media/oiio) does for reading and writing: formats that
 * weft does not read or write itself. No function keeps anything between calls; any threads.
 * Entry points are found by name with wf_module_symbol("oiio", "wf_oiio_probe", ..). */

/* What picture `part` (subimage, counted from 0; -1: the first) of a file is, no pixel read.
 * Names of its channels follow each other in *names, each with its '\0'; owned by the caller,
 * free(). Refused: what cannot be opened, deep and volume images, pictures whose floats exceed
 * max_memory_bytes. */
typedef weft_status wf_oiio_probe_fn(const char *path, int part, size_t max_memory_bytes,
                                     wf_image_info *info, int *channel_count, char **names,
                                     weft_error *err);

/* Reads count channels of that picture into planes [count][data height][data width] as floats:
 * integer formats as 0 .. 1, alpha neither multiplied nor divided. data is what the probe (or
 * the EXR header) said; a file that no longer agrees is an error. */
typedef weft_status wf_oiio_read_fn(const char *path, int part, const int *channel, int count,
                                    const wf_box *data, float *planes, weft_error *err);

/* "wf_oiio_dpx" and "wf_oiio_tiff" are each a wf_encode_picture_fn. */

#endif
