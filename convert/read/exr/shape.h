#ifndef WF_CONVERT_READ_EXR_SHAPE_H
#define WF_CONVERT_READ_EXR_SHAPE_H

#include <stdbool.h>
#include <stddef.h>

/* What a chunk of an EXR holds: how its samples lie once they are decoded. */

typedef enum wf_exr_type { WF_EXR_UINT, WF_EXR_HALF, WF_EXR_FLOAT } wf_exr_type;

/* A channel of a chunk. */
typedef struct wf_exr_channel {
    const char *name; /* borrowed */
    wf_exr_type type;
    size_t bytes;       /* of a sample: 2 or 4 */
    int across, down;   /* pixels and lines a sample */
    bool linear;        /* quantized as it is, not after a curve that the eye's is like */
    size_t width;       /* samples of a line of the chunk */
    size_t lines;       /* of the chunk that have samples */
    size_t line_bytes;  /* width * bytes */
    size_t plane_bytes; /* lines * line_bytes */
} wf_exr_channel;

/* Lines y0 <= y < y0 + lines. Decoded they follow each other, each of them all channels'
 * samples one channel after the other; a line of which a channel has no samples (y is no
 * multiple of its `down`) goes without. */
typedef struct wf_exr_shape {
    const wf_exr_channel *channel; /* [channels], in the order of names */
    int channels;
    int y0, lines;
    size_t bytes; /* of all samples */
} wf_exr_shape;

/* Whether the channel has samples of line y. */
static inline bool wf_exr_has_line(const wf_exr_channel *channel, int y) {
    return channel->down == 1 || y % channel->down == 0;
}

#endif
