/* The checksums of FFV1's slices, for the libav module. */
#include "convert/media/libav/ffv1_slices.h"

#include <libavutil/crc.h>

/* A slice ends with its size without these, in three bytes, a byte of status and the checksum,
 * with which the checksum of the whole slice is 0. */
enum { FOOTER_BYTES = 3 + 1 + 4 };

/* Where the slice that ends there begins; past it where it would begin before the packet. */
static size_t slice_begin(const uint8_t *packet, size_t end) {
    const uint8_t *footer = packet + end - FOOTER_BYTES;
    size_t bytes =
        ((size_t)footer[0] << 16 | (size_t)footer[1] << 8 | footer[2]) + FOOTER_BYTES;
    return bytes <= end ? end - bytes : end;
}

wf_ffv1_slices wf_ffv1_check(const uint8_t *packet, size_t bytes) {
    const AVCRC *table = av_crc_get_table(AV_CRC_32_IEEE);
    bool sound = true;
    size_t end = bytes;
    while (end > FOOTER_BYTES) {
        size_t begin = slice_begin(packet, end);
        if (begin == end) return WF_FFV1_UNCHECKED;
        sound &= !av_crc(table, 0, packet + begin, end - begin);
        end = begin;
    }
    return end ? WF_FFV1_UNCHECKED : sound ? WF_FFV1_SOUND : WF_FFV1_DAMAGED;
}
