#ifndef WF_CONVERT_WRITE_SINK_H
#define WF_CONVERT_WRITE_SINK_H

#include "convert/job/output.h"
#include "convert/media/frame.h"

typedef struct wf_sink wf_sink; /* an output that is being written; each kind has its own */

/* How many bytes a run will write, as far as that can be told before. */
typedef enum wf_size_known {
    WF_SIZE_UNKNOWN,
    WF_SIZE_EXACT,
    WF_SIZE_ABOUT, /* within some percent */
    WF_SIZE_MOST   /* before compression */
} wf_size_known;

typedef struct wf_sink_size {
    int64_t bytes;
    wf_size_known known;
} wf_sink_size;

/* What drives outputs of some kinds. A sink is driven by one thread at a time. */
typedef struct wf_sink_ops {
    /* Whether it takes all of that, before anything is read; NULL: it does. */
    weft_status (*check)(const wf_output_options *options, weft_error *err);
    /* What it will change without being asked to, for people; "": nothing. NULL: nothing. */
    void (*tell)(const wf_output_options *options, char *text, size_t size);
    /* Bytes of `frames` frames; NULL: not known. */
    wf_sink_size (*size)(const wf_output_options *options, int64_t frames);
    weft_status (*open)(const wf_output_options *options, wf_sink **out, weft_error *err);
    weft_status (*write)(wf_sink *sink, const wf_frame *frame, weft_error *err);
    weft_status (*commit)(wf_sink *sink,
                          weft_error *err); /* sync, rename; frees sink in any case */
    void (*abandon)(wf_sink *sink);         /* removes what is unfinished, frees */
} wf_sink_ops;

/* A kind of output and what drives it; both have static storage. {NULL, NULL}: none. */
typedef struct wf_output {
    const wf_output_kind *kind;
    const wf_sink_ops *ops;
} wf_output;

/* The registry, by index; {NULL, NULL} past the end. */
wf_output wf_output_at(size_t index);

/* The output that a name asks for and, in a container, the codec (NULL: its default);
 * {NULL, NULL} with an error that lists what there is. */
wf_output wf_output_for(const char *name, const char *codec, weft_error *err);

/* What the output says of that, {0} where it does not. */
wf_sink_size wf_output_size(const wf_output *output, const wf_output_options *options,
                            int64_t frames);

/* Files a frame of a sequence: frame n is files n * this and on, in order of time. */
int wf_output_files(const wf_output_options *options);

/* Whether file `frame` is already there, whole (sequences), or the whole output is (index < 0).
 */
bool wf_output_present(const wf_output_kind *kind, const char *name, int64_t frame);

#endif
