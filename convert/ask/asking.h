/* What all questions share: reading what is asked, files one after another, the report. */
#ifndef WF_CONVERT_ASK_ASKING_H
#define WF_CONVERT_ASK_ASKING_H

#include "convert/base/json.h"
#include "convert/job/job.h"

/* Copies a public structure, whose first member is its size, into one of this version: what the
 * caller's version does not have is zero. given NULL: nothing is given. WEFT_USAGE where the
 * size cannot be, or a member is given that this version does not know. */
weft_status wf_asked(const void *given, const char *name, void *own, size_t own_size,
                     weft_error *err);

/* The other way: fills as much of a public structure, whose size its caller set, as there is of
 * this version's. */
void wf_asked_give(const void *own, size_t own_size, void *to);

/* Which of the words of `takes` ("a|b|c") the value of option name is: *index gets it, and
 * keeps what it is where nothing was given. */
weft_status wf_ask_choose(const char *name, const char *takes, const char *value, int *index,
                          weft_error *err);

/* A raster by its name, which an option gave; NULL: *raster stays as it is. */
weft_status wf_ask_raster(const char *name, wf_raster *raster, weft_error *err);

/* How a question about several files went: one that fails does not stop the others. */
typedef struct wf_troubles {
    weft_warning_fn *tell; /* each is told as it comes; NULL: wf_troubles_end tells */
    void *user;
    weft_status worst;
    weft_error first;
    size_t count;
} wf_troubles;
void wf_trouble(wf_troubles *troubles, weft_status status, const char *text);

/* The worst status, and in err the first trouble and how many there are, unless they have been
 * told. */
weft_status wf_troubles_end(const wf_troubles *troubles, weft_error *err);

/* WEFT_USAGE with that message if the job has no input. */
weft_status wf_ask_inputs(const weft_job *job, const char *message, weft_error *err);

/* Makes the document the job's report. Frees it in any case. */
weft_status wf_ask_report(weft_job *job, wf_json *json, weft_error *err);

#endif
