#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_PACKETS_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_PACKETS_H

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>

#include "convert/media/metadata.h"

/* Counts what a file holds, packet by packet, and decodes no more than its first picture. */

/* Reads from where `format` stands to its end: fills metadata's `there` and, with the first
 * picture that is decoded, frame (which may stay empty). 0 or an AVERROR of memory. */
int wf_libav_packets(AVFormatContext *format, int stream, wf_metadata *metadata,
                     AVFrame *frame);

#endif
