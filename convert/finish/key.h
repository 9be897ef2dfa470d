#ifndef WF_CONVERT_FINISH_KEY_H
#define WF_CONVERT_FINISH_KEY_H

#include "convert/finish/setup.h"

/* The outputs of a run, fill and key, as one: both stand at their names, or neither. */
typedef struct wf_outputs {
    wf_sink *fill, *key; /* NULL: not open */
    uint16_t *neutral;   /* [width_px]: a line of chroma, of a key in Y'CbCr */
} wf_outputs;

/* Opens both; wf_outputs_close releases them whatever came of it. */
weft_status wf_outputs_open(const wf_setup *setup, wf_outputs *outputs, weft_error *err);

/* Writes a frame of each. key: its plane, of wf_key_sample_bytes a sample; NULL: there is no
 * key. Files of sequences stand at their names after this, and stay there. */
weft_status wf_outputs_write(const wf_setup *setup, wf_outputs *outputs, const wf_frame *fill,
                             const void *key, weft_error *err);

/* Closes both. First the key gets its name, then the fill; if the fill cannot, the key is
 * removed again. */
weft_status wf_outputs_commit(const wf_setup *setup, wf_outputs *outputs, weft_error *err);

/* Abandons what is open. */
void wf_outputs_close(const wf_setup *setup, wf_outputs *outputs);

/* Bytes of a sample of the key's plane; 0: there is no key. */
size_t wf_key_sample_bytes(const wf_setup *setup);

/* A line of K as the key's samples: floats as they are; luma of narrow range, 16 to 235 of 8
 * bits; R'G'B' of its range. */
void wf_key_put(const wf_setup *setup, const float *k, size_t count, void *to);

#endif
