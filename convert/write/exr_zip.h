#ifndef WF_CONVERT_WRITE_EXR_ZIP_H
#define WF_CONVERT_WRITE_EXR_ZIP_H

#include <libdeflate.h>
#include <stddef.h>
#include <stdint.h>

/* ZIP and ZIPS of OpenEXR, forwards: count bytes become at most count in packed, and their
 * number is returned. Those that do not get smaller are stored as they are, which readers tell
 * by the number. merged and packed have room for count bytes each. */
size_t wf_exr_zip(struct libdeflate_compressor *how, const uint8_t *raw, size_t count,
                  uint8_t *merged, uint8_t *packed);

#endif
