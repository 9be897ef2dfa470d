/* PNG files of 8 bits. */
#ifndef WF_CONVERT_PAGE_PNG_H
#define WF_CONVERT_PAGE_PNG_H

#include <stdint.h>

#include "convert/base/outfile.h"

/* Writes a picture, [lines][width_px][3] of R'G'B', as a PNG (ISO/IEC 15948) into a file that
 * is open. */
weft_status wf_png_write(const uint8_t *rgb, int width_px, int lines, wf_outfile *file,
                         weft_error *err);

#endif
