#ifndef WF_CONVERT_WRITE_SINK_KIND_H
#define WF_CONVERT_WRITE_SINK_KIND_H

#include "convert/job/output.h"
#include "convert/media/frame.h"

/* What a kind of output has to do. */

typedef struct wf_sink wf_sink; /* an output that is being written; each kind has its own */

/* How many bytes a run will write, and how exactly that is known before. */
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
    /* Refuses what it cannot write, before anything is read; NULL: it takes whatever its kind
     * says. */
    weft_status (*check)(const wf_output_options *options, weft_error *err);
    /* Says what it will change without being asked to, for people; "", or NULL: nothing. */
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

#endif
