#ifndef WF_CONVERT_JOB_JOB_H
#define WF_CONVERT_JOB_JOB_H

#include <signal.h>

#include "color/codes/encoding.h"
#include "convert/base/fail.h"
#include "convert/job/choices.h"
#include "filters/aperture/aperture.h"
#include "filters/raster/timing.h"
#include "tracer/sample/sampler.h"

/* Everything that a run is asked for. convert/job/options.c fills it, one table row an option.
 * The job owns its strings. */
struct weft_job {
    wf_command command;
    char **inputs;
    size_t input_count;
    char *output;

    wf_raster raster;
    wf_aperture aperture;       /* its width is the option's if one was given */
    bool aperture_given;        /* else it is the preset (wf_job_settle) */
    wf_rational flicker_weight; /* {0, 1}: it weighs nothing */
    wf_rational flicker_limit;  /* {0,0}: none */
    bool limit_is_seen; /* it is in just noticeable differences; else in light, white being 1 */
    wf_rational view_distance;     /* picture heights, for what is seen; {0,0}: as usual */
    wf_rational peak;              /* cd/m2 of white, for the same; {0,0}: as usual */
    wf_rational temporal_width;    /* field periods; {0,0}: the aperture's */
    bool width_given, angle_given; /* which of the two options that set it were */
    wf_position shutter_position;
    wf_rational scan_skew;
    wf_cadence cadence;

    char *frames;                     /* range of the selection; NULL: all */
    int64_t output_first, output_end; /* frames to make; 0, 0: all that the input gives */
    wf_rational subframe_rate;        /* {0,0}: from the files */
    bool subframe_time_center;
    wf_fit fit;
    wf_rational input_par; /* {0,0}: from the files */
    wf_input_scan input_scan;
    float background[3]; /* scene-linear */
    char *layer, *part;
    wf_alpha alpha; /* UNSET: as the files say */

    char *ocio, *from, *to, *display, *view, *look;
    wf_rational exposure; /* stops */
    int bits;             /* 0: the output's default */
    wf_code_range range;
    wf_chroma chroma;
    wf_legalize legalize;
    bool alpha_out; /* alpha is written, and nothing lies behind the pictures */
    char *key;      /* where alpha is written as a picture of its own; NULL: nowhere */
    wf_fill fill;
    wf_key_choice key_law;
    wf_dither dither;

    wf_sampler_kind sampler;
    int64_t samples; /* a pixel, frame line and field */
    int64_t seed;
    wf_rational error; /* RMS, display-encoded; {0,0}: none asked for */
    char *oversample;  /* "SxLxT"; NULL: none */
    int64_t scene_steps;
    size_t scene_memory_bytes;
    char **params; /* "NAME=VALUE" of --set */
    size_t param_count;
    wf_on_empty on_empty;

    int render_width, render_lines; /* of a plan's subframes; 0: the raster's */
    int64_t samples_a_pixel;        /* of a finished frame; 0: not told */
    wf_rational scene_fps;          /* {0,0}: not told */
    char *refine;                   /* the folder of what is rendered so far; NULL: none */

    bool separate_fields; /* of image sequences: a file each */
    char *timecode;       /* of frame 0; NULL: the input's, or 00:00:00:00 */
    char *date;           /* "2026-11-30T10:20:30Z"; NULL: unknown */
    char *codec;          /* NULL: the container's default */
    char *audio;          /* wf_audio_parse takes it; NULL: no sound */
    int64_t audio_tracks; /* 0: as many as the sound has channels */
    int audio_bits;       /* of a sample */
    wf_on_missing on_missing;
    wf_nan_fix nan_fix;
    int chunk, chunk_count; /* 1-based */
    int threads;            /* 0: all */
    bool skip;              /* --skip on */
    size_t max_memory_bytes;
    bool overwrite, resume;
    bool dry_run;

    weft_progress_fn *progress;
    void *progress_user;
    weft_warning_fn *warning;
    void *warning_user;
    weft_print_fn *print;
    void *print_user;
    volatile sig_atomic_t canceled;
    char *report; /* JSON of the last run */
    char *plan;   /* of a dry run, for people; NULL: there is none */
    char *asked;  /* what weft_job_plan has told; NULL: nothing */
};

/* Forgets the inputs there are. */
void wf_job_clear_inputs(weft_job *job);

/* "convert", "render", "trace". */
const char *wf_command_name(wf_command command);

/* Sends a message to the job's warning function. */
void wf_job_warn(const weft_job *job, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Contradictions between options that can be seen without opening a file: what weft_job_run
 * looks at first. Options may be set in any order. */
weft_status wf_job_check(const weft_job *job, weft_error *err);

/* Whether alpha goes anywhere: beside the picture, or into a key. */
bool wf_job_writes_alpha(const weft_job *job);

/* Whether what lies behind pictures is other than black. */
bool wf_job_shows_background(const weft_job *job);

/* The same of the options of alpha alone. */
weft_status wf_job_check_alpha(const weft_job *job, weft_error *err);

/* The same of the options that say when fields look alone: width and cadence. */
weft_status wf_job_check_time(const weft_job *job, weft_error *err);

/* How much flicker weighs, by its option or by the aperture; 0: nothing. */
double wf_job_flicker_weight(const weft_job *job);

/* Whether flicker is weighed or bounded. */
bool wf_job_holds_flicker(const weft_job *job);

/* The same of the options of flicker alone. */
weft_status wf_job_check_flicker(const weft_job *job, weft_error *err);

/* Settles what depends on several options, in a job that wf_job_check passes: an aperture that
 * is not named is shaped, or line where flicker is held, the raster takes on the cadence, and
 * fields all lines where flicker is held. */
void wf_job_settle(weft_job *job);

/* What to read the job's video as, asked before a run settles the raster: codes in some spaces
 * have a Y'CbCr of their own. */
wf_raster wf_job_raster_shown(const weft_job *job);

#endif
