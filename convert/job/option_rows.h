#ifndef WF_CONVERT_JOB_OPTION_ROWS_H
#define WF_CONVERT_JOB_OPTION_ROWS_H

#include "convert/base/fail.h"
#include "convert/job/job.h"

/* Inside the options (convert/job/options.c has the table): what a row is made of. */

/* One option. Its row makes the parser, the checks, the help, the manual, the completions, the
 * keys of job files and the binding of other languages. */
typedef struct wf_option_row wf_option_row;
typedef weft_status wf_option_set(weft_job *job, const wf_option_row *row, const char *value,
                                  weft_error *err);
typedef void wf_option_release(weft_job *job, const wf_option_row *row);

struct wf_option_row {
    weft_option shown;
    unsigned commands; /* WF_TAKEN_BY_ bits */
    bool initial;      /* the preset is a value, which a new job is given */
    wf_option_set *set;
    wf_option_release *release; /* frees what the member owns; NULL: it owns nothing */
    size_t offset;              /* of the member in weft_job */
    double low, high;           /* numbers: both allowed */
    const char *what;           /* numbers: "field periods, such as 0.5 or 1/3" */
    int base;                   /* choices: the value of the first */
    bool repeats;               /* several may be given */
};

/* Setters. Each stores a value in the member of a job that its row points at, or says what the
 * option takes. */
wf_option_set wf_set_text, wf_set_flag, wf_set_choice, wf_set_switch, wf_set_bits, wf_set_ratio,
    wf_set_flicker_limit, wf_set_stops, wf_set_rate, wf_set_width, wf_set_angle, wf_set_threads,
    wf_set_whole, wf_set_param, wf_set_oversample, wf_set_raster, wf_set_aperture,
    wf_set_background, wf_set_chunk, wf_set_size, wf_set_timecode, wf_set_date, wf_set_frames,
    wf_set_output_frames, wf_set_audio, wf_set_codec, wf_set_dimensions;

/* Frees a text that wf_set_text has made, and the values that wf_set_param has. */
wf_option_release wf_release_text, wf_release_params;

#endif
