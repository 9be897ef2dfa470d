#ifndef WF_TRACER_SCENE_SCRIPT_H
#define WF_TRACER_SCENE_SCRIPT_H

#include <stdbool.h>
#include <stddef.h>

/* Reads a regular file of at most `most` bytes of text, without the byte order mark that UTF-8
 * may begin with; free it. NULL with a reason. */
char *wf_script_read(const char *path, size_t most, size_t *size, char *why, size_t why_size);

#endif
