#ifndef WF_CONVERT_JOB_REPORT_H
#define WF_CONVERT_JOB_REPORT_H

#include <stddef.h>

#include "color/codes/encoding.h"
#include "convert/base/json.h"
#include "convert/job/taken.h"
#include "filters/raster/raster.h"

/* What is known of the legality of the codes written. Shares of the picture are of all pixels
 * of all frames. */
typedef struct wf_report_legal {
    const char
        *legalize;      /* "none", "clip", "r103"; NULL: nothing was quantized, "legal" is {} */
    const char *dither; /* "none", "tpdf" */
    const char *range;  /* "narrow", "full" */
    int bits;
    wf_legal_counts counts; /* of r103; pixels 0: none were counted */
    double worst_share;     /* of a frame, left outside: the most of all frames */
} wf_report_legal;

/* How flicker was held. */
typedef struct wf_report_flicker {
    bool held;            /* false: it was not, and "flicker" is {} */
    double weight, limit; /* limit 0: none */
    bool limit_is_seen;   /* it is in just noticeable differences */
    int64_t clipped; /* pixels of all lines of fields whose light was brought to its range */
    int64_t columns_solved; /* of fields, that did not hold the limit as they were */
} wf_report_flicker;

/* What a run has to tell (convert/README.md, Reports). Everything is borrowed; NULL, 0 and {0}
 * mean "not known" or "none" and are safe in every member. */
typedef struct wf_report {
    const char *command;     /* "convert" */
    const wf_raster *raster; /* NULL: "raster" is {} */
    wf_raster coded;         /* what raster may lie in: as it is in the file */
    int64_t frames, fields;  /* written by this run */

    int64_t listed, opened; /* subframes selected, missing ones included; files opened */
    wf_rational *missing;   /* [missing_count] numbers that are needed and absent */
    size_t missing_count;
    int64_t chunks_decoded, chunks_reused, nan_fixed, nan_alone;
    wf_taken_list taken; /* what the input was taken for: members of "input" */

    bool traced; /* false: "tracer" is {} */
    int64_t samples, rays, tiles, tiles_skipped, tiles_reused, fields_reused;
    double error_estimate; /* RMS, display-encoded; 0: none was made */

    wf_report_legal legal;
    wf_report_flicker flicker;
    const char *key;            /* the kind of output that is the key; NULL: none is */
    const char *fill, *key_law; /* of alpha that is written; NULL: none is */
    double fill_clipped_share;  /* of pixels whose straight fill was above 1 */
    void (*add_plan)(wf_json *json, const void *plan); /* of a dry run; NULL: of none */
    void *plan;
    double trace_s; /* summed over threads, as all of these but wall_s are */
    double wall_s, decode_s, resample_s, color_s, write_s;
    int64_t peak_memory_bytes; /* 0: wf_peak_memory_bytes() is asked */
    bool degraded;     /* frames were held, NaN and Inf replaced, an error not reached */
    const char *error; /* why the run failed; NULL: it did not */
} wf_report;

/* The report as one JSON object of several lines, newline at its end. Owned by the caller,
 * freed with free(); NULL when memory is out. */
char *wf_report_json(const wf_report *report);

/* A member that describes a raster, for reports and listings. */
void wf_report_raster(wf_json *json, const char *key, const wf_raster *raster);

/* The most memory this process has held at one time; 0 if the system does not say. */
int64_t wf_peak_memory_bytes(void);

#endif
