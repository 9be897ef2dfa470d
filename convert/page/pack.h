/* Packs fields of codes of up to 9 bits without loss, for unpack.js to unpack in a browser. */
#ifndef WF_CONVERT_PAGE_PACK_H
#define WF_CONVERT_PAGE_PACK_H

#include <stddef.h>
#include <stdint.h>

#include "convert/base/fail.h"

/* The planes of a field: the first is the finest, the others have its lines and its width or
 * half of it. */
#define WF_PACK_PLANES 3
#define WF_PACK_MOST   511 /* the largest code */
typedef struct wf_pack_shape {
    int planes;
    int width_px[WF_PACK_PLANES];
    int lines; /* of a field */
} wf_pack_shape;

/* What packs field after field (README.md has the format). One thread at a time. */
typedef struct wf_packer wf_packer;

weft_status wf_packer_new(const wf_pack_shape *shape, wf_packer **out, weft_error *err);
void wf_packer_free(wf_packer *packer); /* NULL is fine */

/* Packs a field, which the one before the last resembles: plane[p] is
 * [lines][width_px[p]], each up to 511. WEFT_NO_MEMORY: the packer is good for wf_packer_free
 * only. */
weft_status wf_packer_add(wf_packer *packer, const uint16_t *const plane[], weft_error *err);

/* What has been packed so far; valid until the next call. */
const uint8_t *wf_packer_data(const wf_packer *packer, size_t *bytes);

#endif
