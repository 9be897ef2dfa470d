#ifndef WF_CONVERT_VIDEO_LIGHT_H
#define WF_CONVERT_VIDEO_LIGHT_H

#include "convert/video/meaning.h"

/* Rows of light from the codes of a picture: chroma at every luma sample, R'G'B' by the matrix
 * and the range, and light by the transfer, all in float, within 1e-6 of full scale. 1 is
 * reference white, and what lies below black, above white or out of gamut is kept. */
typedef struct wf_light wf_light;

/* Light from codes of this kind. decode makes light of R'G'B', and is borrowed; NULL: as the
 * meaning says; without apply R'G'B' is light. Any number of threads may use what is made, and
 * wf_light_free frees it. */
weft_status wf_light_new(const wf_video_info *info, const wf_meaning *meaning,
                         const wf_transform *decode, wf_light **out, weft_error *err);
void wf_light_free(wf_light *light); /* NULL is fine */

/* Most rows that are made at once, and bytes of scratch for them. */
#define WF_LIGHT_ROWS 16
size_t wf_light_scratch(const wf_light *light);

/* Rows y0 <= y < y1 of the picture whose codes, of wf_video_code_bytes each, are in plane,
 * [lines][width_px] each, to rgb[c][(y - y0) width_px]. The bits do not depend on which rows
 * are made together. */
void wf_light_rows(const wf_light *light, const void *const plane[3], int y0, int y1,
                   void *scratch, float *const rgb[3]);

/* The same where color is multiplied by alpha[(y - y0) width_px + x] already, as it is coded:
 * it is divided by that before it is decoded. What is made is light that is multiplied by it.
 */
void wf_light_rows_multiplied(const wf_light *light, const void *const plane[3], int y0, int y1,
                              void *scratch, const float *alpha, float *const rgb[3]);

#endif
