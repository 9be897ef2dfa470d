#ifndef WF_CONVERT_CHECK_VERIFY_H
#define WF_CONVERT_CHECK_VERIFY_H

#include "convert/check/measure.h"
#include "convert/media/metadata.h"

/* Does a delivered file say and hold what its raster, or a delivery profile, demands. */

/* What a station or a format asks for: a row of the table. "" and 0: anything will do. */
typedef struct wf_profile {
    const char *name, *about; /* with its source */
    const char *container;    /* libavformat's name */
    const char *codec;        /* libavcodec's name */
    const char *rasters;      /* one, or several with blanks between */
    const char *start;        /* timecode of the first frame */
    int bits;
    int sound_channels;   /* the least */
    const char *channels; /* one of these numbers, with blanks between */
    int sound_bits;
    int coded_lines; /* with the vertical interval; 0: the raster's */
} wf_profile;

/* By index; NULL past the end. */
const wf_profile *wf_profile_at(size_t index);
const wf_profile *wf_profile_find(const char *name, weft_error *err);

typedef enum wf_verdict { WF_RIGHT, WF_WRONG, WF_OPEN } wf_verdict;

/* What came of one check. */
typedef struct wf_finding {
    const char *check;
    wf_verdict verdict;        /* WF_OPEN: the file gives no answer */
    char is[160], should[160]; /* for people; should "": as it is */
    char by[96];               /* what demands it */
} wf_finding;

#define WF_FINDINGS_MOST 32

typedef struct wf_verification {
    wf_raster raster; /* that it was held to */
    const wf_profile *profile;
    wf_finding finding[WF_FINDINGS_MOST];
    size_t count, wrong;
} wf_verification;

typedef struct wf_verify_options {
    const wf_profile *profile; /* NULL: none */
    const wf_raster *raster;   /* NULL: the profile's, else the one that the file says */
    size_t max_memory_bytes;
    weft_progress_fn *progress;
    void *progress_user;
} wf_verify_options;

/* Reads the file to its end. A file that cannot be read is a finding, not an error; errors are
 * those of memory and of names. */
weft_status wf_verify(const char *path, const wf_verify_options *options, wf_verification *out,
                      weft_error *err);

#endif
