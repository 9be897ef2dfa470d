#ifndef WF_CONVERT_READ_RATE_H
#define WF_CONVERT_READ_RATE_H

#include "convert/media/image.h"
#include "convert/read/sequence.h"

/* How many pictures of a sequence are shown a second. */

/* What the first file says: weft:subframeRate, which counts the files there are, or
 * framesPerSecond, which counts whole numbers, divided by the step of what is selected. input
 * is what the user called the files. WEFT_FAILED where what it says is absurd; WEFT_USAGE where
 * it says nothing; both name --subframe-rate. */
weft_status wf_rate_of_files(const char *input, const wf_image_info *first,
                             const wf_sequence *sequence, wf_rational *rate, weft_error *err);

/* When the pictures of a sequence are shown: so many a second, or each at a time of its own. */
typedef struct wf_shown {
    wf_rational rate; /* a second; {0, 0}: they have times */
    wf_rational
        *times_s; /* [sequence.count + 1] ascending: when each is shown, and the end of the
                     last, which lasts as long as the one before; NULL: there is a rate */
} wf_shown;

void wf_shown_free(wf_shown *shown);

/* Settles it from the files, which may all carry weft:time: then no rate is needed, and where
 * times do not grow evenly with the files' numbers they are *shown, and files whose numbers are
 * absent are taken out of the sequence. Else it is wf_rate_of_files. Reads the headers of all
 * files if the first one has a time. WEFT_FAILED for times that repeat or run backwards. */
weft_status wf_shown_by_files(const char *input, const wf_image_info *first,
                              wf_sequence *sequence, wf_shown *shown, weft_error *err);

/* "240" or "480000/1001"; returns text. */
const char *wf_rate_text(wf_rational rate, char text[48]);

#endif
