#ifndef WF_CONVERT_READ_SOURCE_H
#define WF_CONVERT_READ_SOURCE_H

#include "convert/base/fail.h"
#include "convert/job/choices.h"
#include "convert/job/taken.h"
#include "convert/media/image.h"
#include "convert/read/choice/pick.h"
#include "convert/read/file_colors.h"

/* What the job asks of every subframe. Strings are borrowed and outlive the source. */
typedef struct wf_source_options {
    const char *layer; /* channel prefix, NULL: the beauty */
    const char *part;  /* part name or number, NULL: any */
    bool want_alpha;   /* deliver A as a fourth channel where the file has one */
    wf_alpha alpha;    /* how color is stored; WF_ALPHA_UNSET: as the file says */
    bool to_light;     /* deliver light: what is encoded is decoded; else samples as stored */
    const wf_transform
        *decode; /* with to_light: decodes in the file's place; NULL: as it says */
    wf_nan_fix nan_fix;
    size_t max_memory_bytes;
} wf_source_options;

typedef enum wf_sample_type { WF_HALF, WF_FLOAT } wf_sample_type;

/* Rows y0 <= y < y1 of one subframe, columns data.x0 .. data.x1: plane[c] is channel c (R, G,
 * B[, A]) at (x0, y0), line_stride samples from line to line. A lone Y is delivered three
 * times; Y RY BY as R G B. Color is multiplied by alpha. Memory belongs to the reader that made
 * it and lives until its next wf_reader_rows. */
typedef struct wf_rows {
    const void *plane[4];
    size_t line_stride;
    wf_sample_type type;
    int channels; /* 3, or 4 with alpha */
    int y0, y1, x0, x1;
} wf_rows;

typedef struct wf_subframe
    wf_subframe;                    /* an open picture: immutable after opening, any threads */
typedef struct wf_reader wf_reader; /* buffers of one thread */

/* Pixels with NaN or Inf: all, and those of them that had no finite neighbor to be made of. */
typedef struct wf_nan_counts {
    int64_t fixed, alone;
} wf_nan_counts;

typedef struct wf_source_counts {
    int64_t chunks_decoded, chunks_reused;
    wf_nan_counts nan;
} wf_source_counts;

/* Opens path (part as in wf_subframe_ref) and checks everything that can be checked without
 * decoding pixels: channels, windows, sizes against max_memory_bytes, compression. EXR goes
 * through OpenEXRCore; every other format through the OpenImageIO module. */
weft_status wf_subframe_open(const char *path, int part, const wf_source_options *options,
                             wf_subframe **out, weft_error *err);
void wf_subframe_close(wf_subframe *subframe); /* NULL is fine */

/* How rows of a picture that is no file are made: light, in float. */
typedef struct wf_row_maker {
    size_t scratch_bytes; /* that `rows` needs, of the reader that calls it */
    int most_rows;        /* that are asked for at once */
    int channels;         /* 3, or 4 with alpha, which color is multiplied by */
    /* Rows y0 <= y < y1 to plane[c][(y - y0) width_px]. */
    void (*rows)(const void *picture, int y0, int y1, void *scratch, float *const plane[]);
    void (*close)(void *picture); /* by wf_subframe_close */
} wf_row_maker;

/* A picture of width_px by lines whose rows a maker makes, which is borrowed. Any thread; on
 * failure the picture has been closed. */
weft_status wf_subframe_made(const wf_row_maker *maker, void *picture, int width_px, int lines,
                             wf_subframe **out, weft_error *err);
/* A picture that exists in part: columns and rows of the display window, half-open. */
typedef struct wf_layer_over {
    wf_subframe *picture;
    wf_box region;
} wf_layer_over;

/* A picture that shows at every pixel the last of `layers` that exists there. The first is
 * everywhere, whatever its region says, and all are of one size. Takes the pictures over, on
 * failure too; layers itself is copied. */
weft_status wf_subframe_composed(const wf_layer_over *layers, int count, wf_subframe **out,
                                 weft_error *err);

const wf_image_info *wf_subframe_info(const wf_subframe *subframe);

/* Which picture of the file it is: the part's name ("" if it has none, or the file has no
 * other) and what was picked of it. */
const char *wf_subframe_part_name(const wf_subframe *subframe);
const wf_pick *wf_subframe_pick(const wf_subframe *subframe);

/* What its colors are by what the file says. */
const wf_file_colors *wf_subframe_colors(const wf_subframe *subframe);

/* Adds what the file is taken for: "part", "layer", "channels", "space", "transfer",
 * "alpha". */
void wf_subframe_take(const wf_subframe *subframe, wf_taken_list *list);

/* Tells all layers of all parts of an EXR, deep ones too; of other formats none. */
weft_status wf_source_layers(const char *path, wf_layer_fn *tell, void *user, weft_error *err);

weft_status wf_reader_new(const wf_source_options *options, wf_reader **out, weft_error *err);
void wf_reader_free(wf_reader *reader);

/* Reads rows y0 <= y < y1 (inside the data window) with NaN and Inf replaced as nan_fix says
 * (box3 looks at rows beyond y0 and y1 where it has to). Chunks whose packed bytes equal those
 * of the reader's previous result for the same rows are reused, not inflated. Errors name the
 * file and the line. */
weft_status wf_reader_rows(wf_reader *reader, const wf_subframe *subframe, int y0, int y1,
                           wf_rows *rows, weft_error *err);

/* Whether wf_reader_rows would return for these rows what the reader's last result already
 * holds, seen from packed bytes alone. The last result stays valid. */
weft_status wf_reader_same(wf_reader *reader, const wf_subframe *subframe, int y0, int y1,
                           bool *same, weft_error *err);
wf_source_counts wf_reader_counts(const wf_reader *reader);

/* How many parts of a file carry weft:time: a multi-part file with any is a sequence, ordered
 * by it. 0 for files that are not multi-part EXR. part_of (if not NULL) receives the part
 * numbers, in order of time, and time_of their times; both owned by the caller, free(). */
weft_status wf_source_timed_parts(const char *path, int *count, int **part_of,
                                  wf_rational **time_of, weft_error *err);

/* weft:time of a file, or of one part of it; of a file whose part is -1 that of the first part
 * that has one. {0, 0} where it has none, and for other formats than EXR. Reads headers only.
 */
weft_status wf_source_time(const char *path, int part, wf_rational *time_s, weft_error *err);

#endif
