#ifndef WF_CONVERT_READ_VIDEO_H
#define WF_CONVERT_READ_VIDEO_H

#include "convert/media/video_kind.h"

/* Finished video read back, frame by frame and as signals, for what measures or decodes it:
 * Y4M, raw v210 and uyvy, pictures and sequences of them and, through the libav module where it
 * is there, whatever else. One thread at a time. */

/* Opens a file, a pattern or a directory of pictures, or "-" for video on standard input, and
 * reads what it says of itself. */
weft_status wf_video_open(const char *path, const wf_video_options *options, wf_video **out,
                          weft_error *err);
const wf_video_info *wf_video_info_of(const wf_video *video);

/* The next frame, owned by the video and valid until the next call; NULL after the last. A file
 * that ends within a frame, or a picture of another size, is an error that says which. */
weft_status wf_video_next(wf_video *video, const wf_video_frame **frame, weft_error *err);

/* The same as codes: fills planes of the sizes that frame->width_px and lines state, of
 * wf_video_code_bytes a code, the fourth being alpha where options.want_alpha asked for it, or
 * where they are NULL passes the picture over. *more is false, and nothing filled, after the
 * last. */
weft_status wf_video_next_codes(wf_video *video, void *const plane[], bool *more,
                                weft_error *err);

/* Goes forward to a picture, counted from 0, without decoding all that lie before it where the
 * file lets it; *next is the picture that is given next, which may be any up to that one. What
 * is given from there on is bit for bit what reading on would have given. */
weft_status wf_video_seek(wf_video *video, int64_t picture, int64_t *next, weft_error *err);

/* WEFT_FAILED where the file's own structure tells that it was cut off; pipes, and containers
 * that do not say where they end, are taken for whole. */
weft_status wf_video_check_whole(const wf_video *video, weft_error *err);

/* When the picture last given is shown, in ticks of info.tick_s from any zero; INT64_MIN: it
 * does not say. How long it is shown; 0: it does not say. */
int64_t wf_video_ticks(const wf_video *video);
int64_t wf_video_lasts(const wf_video *video);

/* Whether the picture last given is missing: it could not be decoded, and has the codes of the
 * one before it, or of the first that could. */
bool wf_video_is_missing(const wf_video *video);
const wf_video_troubles *wf_video_troubles_of(const wf_video *video);

/* How large plane p is. */
void wf_video_plane_size(const wf_video *video, int p, int *width_px, int *lines);
void wf_video_close(wf_video *video); /* NULL is fine */

/* Whether the name is that of a video, which is not a picture or a sequence of them: standard
 * input or another pipe, Y4M, or a file for libav. WEFT_FAILED if a file
 * that is there cannot be read. */
weft_status wf_video_is(const char *path, bool *is, weft_error *err);

#endif
