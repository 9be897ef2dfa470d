#ifndef WF_CONVERT_MEDIA_STRUCTURE_EXTENT_H
#define WF_CONVERT_MEDIA_STRUCTURE_EXTENT_H

#include <stdio.h>

#include "convert/media/structure/structure.h"

/* Inside the reading of structures: a file and how long it is. */
typedef struct wf_extent {
    FILE *file;
    int64_t bytes;
} wf_extent;

/* Reads exactly so many bytes from there; false where the file has fewer. */
bool wf_extent_read(const wf_extent *x, int64_t at, void *to, size_t bytes);

/* Notes what is not there, if it is the first thing. */
__attribute__((format(printf, 2, 3))) void wf_missing(wf_structure *s, const char *format, ...);

/* Notes a length that is stated; those of 0 and below say nothing. */
void wf_state(wf_structure *s, const char *of, double seconds, double tick_s, bool of_all);

/* Each reads the whole file of its container. */
void wf_structure_mxf(const wf_extent *x, wf_structure *s);
void wf_structure_mov(const wf_extent *x, wf_structure *s);
void wf_structure_mkv(const wf_extent *x, wf_structure *s);
void wf_structure_avi(const wf_extent *x, wf_structure *s);
void wf_structure_ts(const wf_extent *x, wf_structure *s);
void wf_structure_ps(const wf_extent *x, wf_structure *s);

#endif
