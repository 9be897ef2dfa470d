#ifndef WF_CONVERT_RUN_RATE_H
#define WF_CONVERT_RUN_RATE_H

#include "convert/media/image.h"
#include "convert/read/sequence.h"

/* How many pictures of a sequence are shown a second. */

/* What the first file says: weft:subframeRate, which counts the files there are, or
 * framesPerSecond, which counts whole numbers, divided by the step of what is selected. input
 * is what the user called the files. WEFT_FAILED where what it says is absurd; WEFT_USAGE where
 * it says nothing; both name --subframe-rate. */
weft_status wf_rate_of_files(const char *input, const wf_image_info *first,
                             const wf_sequence *sequence, wf_rational *rate, weft_error *err);

/* "240" or "480000/1001"; returns text. */
const char *wf_rate_text(wf_rational rate, char text[48]);

#endif
