#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_SAMPLES_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_SAMPLES_H

#include <libavutil/frame.h>
#include <stdbool.h>

/* Fills to[samples][channels] with those of a decoded frame, of any format: integers have their
 * bits on top of 32, floats are rounded and held within full scale, and what is no number is 0.
 * False where the format is not known. */
bool wf_libav_samples(const AVFrame *frame, int32_t *to);

#endif
