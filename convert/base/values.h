#ifndef WF_CONVERT_BASE_VALUES_H
#define WF_CONVERT_BASE_VALUES_H

#include <stdbool.h>
#include <stdint.h>
#include <stddef.h>

/* What option values look like. Each function reads the whole of text or returns false and
 * leaves its results alone. */

/* "268435456", "512M", "1.5G", "64MiB" (powers of 1024), "500MB" (of 1000); 1 MiB .. 1024 TiB.
 */
bool wf_parse_size(const char *text, size_t *bytes);

/* "2/4": 1 <= chunk <= count <= 10^6; not reduced. */
bool wf_parse_chunk(const char *text, int *chunk, int *count);

/* "10-19" or "10": first <= n < end of frames counted from 0, at most 10^9 of them. */
bool wf_parse_span(const char *text, int64_t *first, int64_t *end);

/* "4x4x8": samples a pixel, a line and a field, each 1 .. 64. */
bool wf_parse_oversample(const char *text, int *across, int *down, int *times);

/* "1920x1080": each 1 .. 65536. */
bool wf_parse_dimensions(const char *text, int *width, int *height);

/* "0.18" or "0.1,0.2,0.3", each 0 .. 65504. */
bool wf_parse_rgb(const char *text, float rgb[3]);

/* "01:02:03:04"; with ';' before the frames, drop frame. Frames 0 .. 99. */
typedef struct wf_timecode {
    int hours, minutes, seconds, frames;
    bool drop_frame;
} wf_timecode;
bool wf_parse_timecode(const char *text, wf_timecode *out);

/* "2026-11-30" or "2026-11-30T10:20:30Z" (ISO 8601, UTC), of the years 1970 to 2099. */
typedef struct wf_date {
    int year, month, day, hours, minutes, seconds; /* year 0: not known */
} wf_date;
bool wf_parse_date(const char *text, wf_date *out);

#endif
