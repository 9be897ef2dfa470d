#ifndef WF_CONVERT_VIDEO_WINDOW_H
#define WF_CONVERT_VIDEO_WINDOW_H

#include "convert/read/video.h"

/* A window of decoded pictures, which moves forward over a video. Pictures are numbered from 0
 * and kept as codes. It is moved by one thread; while it stands still, any may look through it.
 */
typedef struct wf_video_window wf_video_window;

/* Takes the video over, which was opened with this want_alpha: wf_video_window_free closes it.
 * At most most_bytes of pictures are kept at once. */
weft_status wf_video_window_new(wf_video *video, bool want_alpha, size_t most_bytes,
                                wf_video_window **out, weft_error *err);
void wf_video_window_free(wf_video_window *window); /* NULL is fine */

size_t wf_video_window_picture_bytes(const wf_video_window *window);

/* The picture that is decoded next; how many there are in all, -1 until the end was met. */
int64_t wf_video_window_next(const wf_video_window *window);
int64_t wf_video_window_end(const wf_video_window *window);

/* wf_video_ticks and wf_video_lasts of the picture that was decoded last. */
int64_t wf_video_window_ticks(const wf_video_window *window);
int64_t wf_video_window_lasts(const wf_video_window *window);

/* Whether a picture that is kept is missing (wf_video_is_missing). */
bool wf_video_window_lacks(const wf_video_window *window, int64_t number);
const wf_video_troubles *wf_video_window_troubles(const wf_video_window *window);

/* Forgets the pictures before `number`. */
void wf_video_window_forget(wf_video_window *window, int64_t number);

/* Decodes the next picture, and keeps it or passes it over. At the end it sets
 * wf_video_window_end instead. */
weft_status wf_video_window_advance(wf_video_window *window, bool keep, weft_error *err);

/* Reading ahead: has the next `count` pictures decoded, or those that there is memory for,
 * before advance, which then takes them without waiting, and errors in their turn. plan settles
 * where they go; read decodes them, on any one thread, while the window is only looked through;
 * neither is called again before advance or jump is through with them. */
void wf_video_window_plan_ahead(wf_video_window *window, int count);
void wf_video_window_read_ahead(wf_video_window *window);

/* Goes forward to the picture `number`, or to one before it where the file cannot be entered
 * there; what is kept stays. */
weft_status wf_video_window_jump(wf_video_window *window, int64_t number, weft_error *err);

/* wf_video_check_whole. */
weft_status wf_video_window_check_whole(const wf_video_window *window, weft_error *err);

/* The codes of a picture that is kept, the fourth plane being alpha, of wf_video_code_bytes
 * each, until it is forgotten; false: it is not. */
bool wf_video_window_find(const wf_video_window *window, int64_t number, const void *plane[4]);

#endif
