#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_H

#include "convert/job/delivery.h"
#include "convert/media/frame.h"
#include "convert/media/video_kind.h"

/* wf_libav_kind, the entry point of the libav module: how it reads video. */
typedef const wf_video_kind *wf_libav_kind_fn(void);

/* wf_libav_writer_of, the other: how it writes deliveries. open's state is freed by commit, in
 * any case, or by abandon. The delivery takes the options: wf_delivery_check has passed. */
typedef struct wf_libav_writer {
    weft_status (*open)(const wf_output_options *options, const wf_delivery *delivery,
                        void **state, weft_error *err);
    weft_status (*write)(void *state, const wf_frame *frame, weft_error *err);
    weft_status (*commit)(void *state, weft_error *err);
    void (*abandon)(void *state);
} wf_libav_writer;
typedef const wf_libav_writer *wf_libav_writer_fn(void);

#endif
