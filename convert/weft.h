/* weft: oversampled progressive renders to interlaced broadcast video.
 *
 * The public interface. Opaque handles live until their _free; plain structs describe.
 * Functions that can fail return a weft_status and, where the caller gave a weft_error, leave a
 * sentence in it: what was wrong, with which file, frame or line, and what would be right.
 * Nothing here exits, prints, or keeps global state. A handle is used by one thread at a time;
 * different handles are independent. */
#ifndef WEFT_H
#define WEFT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define WEFT_API __attribute__((visibility("default")))
#else
#define WEFT_API
#endif

/* The header's version, as text and, for #if, as numbers. */
#define WEFT_VERSION "0.2.0"
/* Numbers stand apart, so that nobody's formatter moves the line above, which scripts read. */
#define WEFT_VERSION_MAJOR 0
#define WEFT_VERSION_MINOR 2
#define WEFT_VERSION_PATCH 0

/* The version of the library that is running; WEFT_VERSION is the header's. Static storage. */
WEFT_API const char *weft_version(void);

typedef enum weft_status {
    WEFT_OK = 0,
    WEFT_FAILED,     /* input or output at fault: exit code 1 */
    WEFT_USAGE,      /* the request makes no sense: exit code 2 */
    WEFT_DEGRADED,   /* finished, but frames were held, NaN and Inf replaced, or the error asked
                        for not reached: exit code 3 */
    WEFT_NO_MEMORY,  /* an allocation failed or --max-memory would not do: exit code 1 */
    WEFT_INTERRUPTED /* weft_job_cancel: nothing half-written is left */
} weft_status;

typedef struct weft_error {
    char text[1024]; /* UTF-8, no newline at its end; "" if nothing went wrong */
} weft_error;

/* ---- Conversion jobs ------------------------------------------------------------------------
 */

/* One run of the program: inputs, an output, and options by the names of the command line. */
typedef struct weft_job weft_job;

/* NULL when memory is out. */
WEFT_API weft_job *weft_job_new(void);
WEFT_API void weft_job_free(weft_job *job); /* NULL is fine */

/* What the job does: "convert" (which a new job does), "render" or "trace". */
WEFT_API weft_status weft_job_set_command(weft_job *job, const char *name, weft_error *err);

/* Adds a file, a sequence pattern or a directory, in order; to render and trace, one scene. The
 * text is copied. */
WEFT_API weft_status weft_job_add_input(weft_job *job, const char *path, weft_error *err);
WEFT_API weft_status weft_job_set_output(weft_job *job, const char *path, weft_error *err);

/* Sets option name ("raster", "temporal-width"; no dashes) to the text value as the command
 * line would; a flag takes NULL or "". WEFT_USAGE says what the option takes and, for an
 * unknown name, which one may be meant. */
WEFT_API weft_status weft_job_set(weft_job *job, const char *name, const char *value,
                                  weft_error *err);

/* Sets what a job file says: JSON, {"inputs": ["shot.####.exr"], "output": "shot.y4m",
 * "raster": "625i", "overwrite": true, "set": {"speed": 2}}. Keys are the names of options,
 * "inputs" (replacing those there are), "output" and "command"; values are text, numbers, true
 * and false for flags, and for options that may be given several times also arrays, or an
 * object of names and values. Paths are relative to the file's folder; "-" is standard input
 * and the current folder. What is set later, by another file or weft_job_set, wins. WEFT_USAGE
 * names file, line and column; the job is then part set and good for weft_job_free only. */
WEFT_API weft_status weft_job_load(weft_job *job, const char *path, weft_error *err);

/* A job file may hold several jobs: an array of such objects, or an object with them as "jobs"
 * beside what all of them share. *count is how many there are, 0 of a file that is one job;
 * weft_job_load refuses a list, and weft_job_load_nth loads its job `number`, from 1. */
WEFT_API weft_status weft_jobs_in(const char *path, size_t *count, weft_error *err);
WEFT_API weft_status weft_job_load_nth(weft_job *job, const char *path, size_t number,
                                       weft_error *err);

/* Progress of weft_job_run, called from the thread that called it: between frames and, now and
 * then, within one that takes long. */
typedef struct weft_progress {
    int64_t frames_done, frames_total; /* a total of 0: it is not known, as of a pipe */
    double seconds;                    /* since the run began */
    const char *stage;                 /* what the job does; static storage */
    double frame_part;                 /* of the frame that is being made, 0 to 1 */
    double frames_made; /* frames_done, and parts of all frames that are being made together */
} weft_progress;
typedef void weft_progress_fn(const weft_progress *progress, void *user);
WEFT_API void weft_job_on_progress(weft_job *job, weft_progress_fn *fn, void *user);

/* Messages that do not stop the job (an aspect that will be stretched, subframes held). */
typedef void weft_warning_fn(const char *text, void *user);
WEFT_API void weft_job_on_warning(weft_job *job, weft_warning_fn *fn, void *user);

/* Lines that a scene prints, without their end; a few thousand at most. */
typedef void weft_print_fn(const char *line, void *user);
WEFT_API void weft_job_on_print(weft_job *job, weft_print_fn *fn, void *user);

/* Runs the job to its end. Uses the number of threads the option says. WEFT_DEGRADED is a
 * finished run. On any failure no file stands at the output's name that was not there before.
 */
WEFT_API weft_status weft_job_run(weft_job *job, weft_error *err);

/* Asks a running job to stop soon. Safe in a signal handler and from any thread. */
WEFT_API void weft_job_cancel(weft_job *job);

/* The report of the last run as JSON, for whoever called weft_job_run; "{}" before. Lives as
 * long as the job or until its next run. */
WEFT_API const char *weft_job_report(const weft_job *job);

/* Tells what a renderer has to make for the job's frames, before there is any of it: which
 * subframes some field sees, and their times, size and pixel aspect. Of the job's options those
 * count that `weft plan` takes: raster, frames ("A-B", of the output), subframe-rate, aperture,
 * size and others; it needs no input. format: "text" (NULL), "json", "csv", "blender",
 * "povray", "houdini". *text lives as long as the job or until its next plan; NULL on failure.
 */
WEFT_API weft_status weft_job_plan(weft_job *job, const char *format, const char **text,
                                   weft_error *err);

/* ---- Questions ------------------------------------------------------------------------------
 *
 * What the commands measure, verify, info, filters, composite, page and plot do. They ask about
 * the inputs of a job, whose progress and warning functions, weft_job_cancel, and options (of
 * them max-memory, and of composite also those of the output) count as for weft_job_run.
 * Afterwards weft_job_report is what the command prints with --json, and of composite as after
 * weft_job_run; share/weft/schema describes each. A job can be asked again and otherwise. Its
 * command does not matter.
 *
 * Each takes a structure that can grow: `size` is sizeof of it where the caller was compiled,
 * and what an older caller does not have is not given; WEFT_USAGE where a newer one gives what
 * this library does not know. NULL for the structure gives nothing. A member is the text that
 * the command's option of its name takes (weft COMMAND --help tells); NULL: not given. Texts
 * and structures are borrowed for the call.
 *
 * WEFT_FAILED and other failures: err says what is wrong with the first file that something is
 * wrong with, and of how many others; the report has what was found of all of them. */

/* weft measure: figures of video. `limit` has commas between limits, of which WEFT_FAILED says
 * that one is exceeded; `heatmap` is a PNG file that is written. */
typedef struct weft_measure {
    size_t size;
    const char *raster, *chart, *display, *view_distance, *peak, *against, *limit, *heatmap,
        *heat;
} weft_measure;
WEFT_API weft_status weft_job_measure(weft_job *job, const weft_measure *asked,
                                      weft_error *err);

/* weft verify: what delivered files say and hold, against a raster or profile. WEFT_FAILED if
 * something is wrong with one. */
typedef struct weft_verify {
    size_t size;
    const char *profile, *raster;
} weft_verify;
WEFT_API weft_status weft_job_verify(weft_job *job, const weft_verify *asked, weft_error *err);

/* Delivery profile i; false past the end. out->size is the caller's to set, and not more is
 * filled. Strings have static storage. */
typedef struct weft_profile {
    size_t size;
    const char *name, *about; /* about: with where it was read */
    const char *rasters;      /* that it allows, with blanks between */
    const char *not_checked;  /* what the format asks for besides; NULL: nothing */
} weft_profile;
WEFT_API bool weft_profile_at(size_t index, weft_profile *out);

/* weft info: what files and sequences say of themselves, and what they would be taken for. */
WEFT_API weft_status weft_job_info(weft_job *job, weft_error *err);

/* weft filters: all apertures, or the responses of the one that is named; the job's options
 * raster and temporal-width count. `plot` and `frontier` are PNG files that are written. The
 * job needs no input. */
typedef struct weft_filters {
    size_t size;
    const char *name; /* "shaped", "design:sharp=0.7"; NULL: all */
    const char *input_lines, *plot, *frontier;
} weft_filters;
WEFT_API weft_status weft_job_filters(weft_job *job, const weft_filters *asked,
                                      weft_error *err);

/* weft composite: what a television shows of the job's one input, written to its output as
 * weft_job_run would. The job's raster becomes the input's. */
typedef struct weft_composite {
    size_t size;
    const char *system, *encoder, *decoder, *raster;
    const char *audio; /* NULL: the job's option, else the input's */
} weft_composite;
WEFT_API weft_status weft_job_composite(weft_job *job, const weft_composite *asked,
                                        weft_error *err);

/* weft page: one page of HTML that shows the inputs, finished video, written to the job's
 * output; of the job overwrite and max-memory count. There is no report. */
typedef struct weft_page {
    size_t size;
    const char *raster, *frames, *title, *max_size;
    const char *labels;                  /* of the clips in order, with newlines between them */
    const char *preview, *preview_frame; /* also, or without an output only, a PNG of a frame */
} weft_page;
WEFT_API weft_status weft_job_page(weft_job *job, const weft_page *asked, weft_error *err);

/* weft convert --compare: the job is done once for each of `ways`, and what comes out is shown
 * on one page, written to the job's output. A way is an aperture and what is held, and names
 * its clip: "box,least:4,line+limit=.06,line+weight=2+limit=visible:1", at most 16. Video lies
 * in $TMPDIR, else /tmp, while it is looked at, one clip at a time. WEFT_DEGRADED where a run
 * was. There is no report. */
typedef struct weft_compare {
    size_t size;
    const char *ways, *title; /* title: NULL for the clips' names */
} weft_compare;
WEFT_API weft_status weft_job_compare(weft_job *job, const weft_compare *asked,
                                      weft_error *err);

/* weft plot: draws what the JSON file at path tells (weft plot --help) into output, .svg or
 * .png, which replaces what is there. */
WEFT_API weft_status weft_plot(const char *path, const char *output, weft_error *err);

/* ---- Samples from a renderer ----------------------------------------------------------------
 */

/* Fields that gather samples as a renderer makes them: how they look, and where frames go, are
 * the job's options. Memory is that of the fields in hand: weft_fields_until says which are
 * done with. One thread at a time. */
typedef struct weft_fields weft_fields;

/* Samples in any order, one array for each property, borrowed for the call. */
typedef struct weft_samples {
    size_t count;
    const float *x,
        *y;         /* raster coordinates: pixels and frame lines from the upper left corner */
    const float *t; /* field periods after the instant of `field` */
    int64_t field;  /* from 0 */
    const float *red, *green, *blue; /* scene-linear */
    const float *weight;             /* NULL: all count alike */
    const float *alpha; /* by which color is multiplied already; NULL: 1. Color lies over the
                           background unless the job's alpha-out or key is set */
} weft_samples;

/* A regular grid of samples at one instant, over a rectangle of the raster: sample (i, j) is at
 * the middle of its cell. */
typedef struct weft_tile {
    double x0, y0, x1, y1; /* of the raster */
    double t;              /* field periods after the instant of `field` */
    int64_t field;
    int width, height;  /* samples */
    const float *rgb;   /* [height][width][3], scene-linear */
    const float *alpha; /* [height][width], as of weft_samples */
} weft_tile;

/* A finished field; rgb and alpha are valid during the call. */
typedef struct weft_field {
    int64_t index;                    /* from 0 */
    int first_line, line_step, lines; /* its lines in the frame: first_line + l * line_step */
    int width_px;
    const float *rgb;   /* [lines][width_px][3], scene-linear */
    const float *alpha; /* [lines][width_px]; NULL where neither alpha-out nor key is set */
} weft_field;
typedef void weft_field_fn(const weft_field *field, void *user);

/* Fields of `frames` frames. Each is handed to fn (NULL: to nobody) and, if the job has an
 * output, written there as weft_job_run would. The job must not be changed until
 * weft_fields_free. */
WEFT_API weft_status weft_fields_new(weft_job *job, int64_t frames, weft_field_fn *fn,
                                     void *user, weft_fields **out, weft_error *err);
/* Frees what is left; an output that was not finished is taken back. NULL is fine. */
WEFT_API void weft_fields_free(weft_fields *fields);

/* WEFT_USAGE if a sample belongs to a field that is finished. */
WEFT_API weft_status weft_fields_push(weft_fields *fields, const weft_samples *samples,
                                      weft_error *err);
WEFT_API weft_status weft_fields_push_tile(weft_fields *fields, const weft_tile *tile,
                                           weft_error *err);

/* Promises that no sample before the instant of `field` comes any more: fields whose windows
 * end by then are finished. A pixel that no sample reached is an error, or what --on-empty
 * says. */
WEFT_API weft_status weft_fields_until(weft_fields *fields, int64_t field, weft_error *err);

/* Finishes all fields and the output. */
WEFT_API weft_status weft_fields_finish(weft_fields *fields, weft_error *err);

/* ---- Options ---- */

/* One option of weft_job_set, for help texts and bindings. */
typedef struct weft_option {
    const char *name;   /* "temporal-width" */
    const char *takes;  /* "T", "start|center|end"; NULL: a flag */
    const char *preset; /* the default, for people; NULL: none */
    const char *help;   /* one sentence */
    const char *group;  /* heading it belongs under */
} weft_option;

/* Option by index; false past the end. Strings have static storage. */
WEFT_API bool weft_option_at(size_t index, weft_option *out);

/* ---- Apertures ---- */

/* Name of aperture i ("line", "rotated", ..); NULL past the end. Static storage. */
WEFT_API const char *weft_aperture_name(size_t index);

/* Frequency response of an aperture ("box", "mitchell:1.5,-0.25") of temporal width tau_fields
 * at fx cycles a pixel, fy cycles a frame line, ft cycles a field period: a closed form
 * (integrated for shaped), 1 at DC, real since every aperture is symmetric. tau_fields < 0: its
 * own default. */
WEFT_API weft_status weft_aperture_response(const char *aperture, double tau_fields, double fx,
                                            double fy, double ft, double *response,
                                            weft_error *err);

/* ---- Rasters ---- */

typedef struct weft_raster {
    char name[64];
    int width_px, lines;                   /* whole frame */
    int64_t rate_num, rate_den;            /* frames a second */
    bool interlaced, segmented, top_first; /* top_first means something when interlaced */
    int64_t pixel_aspect_num, pixel_aspect_den;
    const char *matrix;            /* "601-525", "601-625", "709", "2020" */
    int line1, line2, total_lines; /* analog line map; 0 where there is none */
} weft_raster;

/* Named raster i; false past the end. */
WEFT_API bool weft_raster_at(size_t index, weft_raster *out);

/* A raster by name or by description ("180x122@30i,tff"). */
WEFT_API weft_status weft_raster_parse(const char *text, weft_raster *out, weft_error *err);

/* ---- Finished video, read back ---- */

/* Y4M, raw v210 and uyvy, pictures and sequences of them, and what libav reads, frame by frame.
 * One thread at a time. */
typedef struct weft_video weft_video;

typedef struct weft_video_info {
    size_t size;         /* the caller's to set */
    const char *format;  /* for people: "Y4M 422p10"; lives as long as the video, as the next */
    const char *layout;  /* "ycbcr", "rgb", or "linear": scene-linear light */
    int width_px, lines; /* of the frame */
    int bits;            /* of a code; 32: floats */
    int across, down;    /* luma samples to a chroma sample: 1 1, 2 1, 2 2, 4 1 */
    bool full_range;
    bool scan_known; /* the file or the user says how it is scanned: raster is no guess */
    int64_t frames;  /* -1: not known before the end */
    weft_raster raster;
} weft_video_info;

/* A frame, both fields woven: signals, and linear light as it is. Planes are
 * [lines[p]][width_px[p]], borrowed until the next call: R' G' B' and Y' from 0 (black) to 1
 * (white), Cb and Cr from -1/2 to 1/2, beyond which they may lie; R G B of linear light. */
typedef struct weft_picture {
    size_t size;           /* the caller's to set */
    int64_t index;         /* from 0 */
    const float *plane[3]; /* NULL past the end of the video; 1 and 2 also of a lone Y */
    int width_px[3], lines[3];
} weft_picture;

/* path is a file, a pattern or a directory; raster says what it is where it does not, NULL: as
 * it says. *out is weft_video_close's. */
WEFT_API weft_status weft_video_open(const char *path, const char *raster, weft_video **out,
                                     weft_error *err);
WEFT_API void weft_video_close(weft_video *video); /* NULL is fine */
WEFT_API void weft_video_tell(const weft_video *video, weft_video_info *out);
WEFT_API weft_status weft_video_next(weft_video *video, weft_picture *out, weft_error *err);

#ifdef __cplusplus
}
#endif

#endif
