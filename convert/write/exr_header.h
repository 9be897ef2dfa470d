#ifndef WF_CONVERT_WRITE_EXR_HEADER_H
#define WF_CONVERT_WRITE_EXR_HEADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "filters/base/rational.h"

/* What a file of OpenEXR begins with (its file layout, version 2), put together in memory.
 * Numbers are little-endian, as this machine has them. Nothing of OpenEXR's library is called,
 * of which 3.1.5 crashes where memory is out. */
typedef struct wf_exr_header {
    uint8_t bytes[8192];
    size_t used;
    bool full; /* something did not fit, and the header is of no use */
} wf_exr_header;

/* Of the byte "compression". */
enum { WF_EXR_ZIPS = 2, WF_EXR_ZIP = 3 };
/* Beside the version: samples of a pixel are of any number. */
enum { WF_EXR_DEEP = 0x800 };

/* flags: 0 or WF_EXR_DEEP. */
void wf_exr_header_begin(wf_exr_header *h, int32_t flags);
void wf_exr_put(wf_exr_header *h, const char *name, const char *type, const void *value,
                size_t bytes);
void wf_exr_put_int(wf_exr_header *h, const char *name, int32_t value);
/* Nothing, where the text is empty or EXR's rational cannot hold the ratio. */
void wf_exr_put_text(wf_exr_header *h, const char *name, const char *text);
void wf_exr_put_ratio(wf_exr_header *h, const char *name, wf_rational ratio);
/* Float channels of a sample for every pixel; names in the order of the alphabet, which samples
 * have to be in too. */
void wf_exr_put_channels(wf_exr_header *h, const char *const *name, size_t count);
/* What else has to be there: both windows are width_px x lines at (0, 0), and lines come from
 * the top. */
void wf_exr_put_required(wf_exr_header *h, int compression, int width_px, int lines,
                         wf_rational pixel_aspect);
void wf_exr_header_end(wf_exr_header *h);

#endif
