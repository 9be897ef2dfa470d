#ifndef WF_CONVERT_READ_EXR_STREAM_H
#define WF_CONVERT_READ_EXR_STREAM_H

#include <openexr.h>

#include "convert/weft.h"

/* Enough for any picture; what a file really may cost is checked against its own length and
 * --max-memory. */
#define WF_EXR_MOST_PIXELS_A_SIDE (1 << 24)

/* An EXR file that OpenEXRCore reads through weft, so that what the system has against it is
 * known, and what the library says of its header. Whatever is open and immutable may be read by
 * many threads. */
typedef struct wf_exr_stream {
    exr_context_t exr;
    int fd;
    int code;                     /* errno of the last call that failed; 0: none did */
    bool opened;                  /* the header has been read */
    char said[256];               /* what the library says is wrong with it */
    unsigned unknown_compression; /* that it names, and the library does not know; 0: none */
} wf_exr_stream;

/* Opens a file and reads its header. `stream` is zeroed, is where it stays, and is ended by
 * wf_exr_stream_end whatever comes back: EXR_ERR_FILE_ACCESS and others, which
 * wf_exr_stream_trouble explains. */
exr_result_t wf_exr_stream_start(wf_exr_stream *stream, const char *path);
void wf_exr_stream_end(wf_exr_stream *stream);

/* WEFT_OK: the result is not the system's doing, and says what is wrong with the file. Else the
 * reason, with the path: WEFT_NO_MEMORY, or WEFT_FAILED as "Input/output error". */
weft_status wf_exr_stream_trouble(const wf_exr_stream *stream, exr_result_t result,
                                  const char *path, weft_error *err);

#endif
