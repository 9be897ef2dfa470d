#ifndef WF_CONVERT_LIBAV_H
#define WF_CONVERT_LIBAV_H

#include "convert/video_kinds.h"

/* wf_libav_kind, the entry point of the libav module: how it reads video. */
typedef const wf_video_kind *wf_libav_kind_fn(void);

#endif
