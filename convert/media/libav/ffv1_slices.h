#ifndef WF_CONVERT_MEDIA_LIBAV_FFV1_SLICES_H
#define WF_CONVERT_MEDIA_LIBAV_FFV1_SLICES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What the checksums of a packet of FFV1 say (RFC 9043, sections 4.9 and 4.10). libavcodec
 * looks at them and shows damaged slices all the same. */
typedef enum wf_ffv1_slices {
    WF_FFV1_UNCHECKED, /* it does not look as if it had any */
    WF_FFV1_SOUND,     /* those of all slices are right */
    WF_FFV1_DAMAGED
} wf_ffv1_slices;

wf_ffv1_slices wf_ffv1_check(const uint8_t *packet, size_t bytes);

#endif
