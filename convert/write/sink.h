#ifndef WF_CONVERT_WRITE_SINK_H
#define WF_CONVERT_WRITE_SINK_H

#include "convert/write/sink_kind.h"

/* The registry of outputs: what there is, and which of it a name asks for. */

/* The registry, by index; {NULL, NULL} past the end. */
wf_output wf_output_at(size_t index);

/* The output that a name asks for and, in a container, the codec (NULL: its default);
 * {NULL, NULL} with an error that lists what there is. */
wf_output wf_output_for(const char *name, const char *codec, weft_error *err);

/* Opens the output. Of a sequence, whose files are opened as they are written, that one can be
 * written there is tried first. */
weft_status wf_output_open(wf_output output, const wf_output_options *options, wf_sink **out,
                           weft_error *err);

/* How many bytes so many frames will take; {0} where the output cannot tell. */
wf_sink_size wf_output_size(const wf_output *output, const wf_output_options *options,
                            int64_t frames);

/* The file that a name of this kind is written to; NULL: none is, or it is standard output. Of
 * a sequence it is the name. */
const char *wf_output_file(const wf_output_kind *kind, const char *name);

/* Whether file `frame` is already there, whole (sequences), or the whole output is (index < 0).
 */
bool wf_output_present(const wf_output_kind *kind, const char *name, int64_t frame);

#endif
