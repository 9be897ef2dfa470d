#ifndef WF_CONVERT_RUN_SUM_SOURCE_H
#define WF_CONVERT_RUN_SUM_SOURCE_H

#include "convert/job/report.h"
#include "convert/finish/crew.h"

/* Where the light of fields comes from. A source is read in units of time, which it numbers in
 * ascending order: subframes, files of samples, moments of a scene. The run does not know which
 * source it has: it asks what a field needs, and has units added to the fields in flight. */

typedef struct wf_run wf_run;

/* Units first <= u < end. Of a later field neither is lower. */
typedef struct wf_needs {
    int64_t first, end;
} wf_needs;

/* Units that are read together, ascending. */
enum { WF_UNITS_TOGETHER = 64 };
typedef struct wf_units {
    int64_t unit[WF_UNITS_TOGETHER];
    int count;
    int64_t group_end; /* fields before it are finished when all their units have been added */
} wf_units;

/* How many fields and units a run has in hand at once. */
typedef struct wf_pace {
    int fields_together; /* a group: fields that are finished together */
    int fields_carried;  /* at most, after a group, that have begun before it ends and are kept;
                            0: units that the next group needs too are read again for it */
    int units_together;  /* at most WF_UNITS_TOGETHER */
    size_t memory_bytes; /* what all that takes, but for the libraries' own needs */
} wf_pace;

/* How units are summed to fields: from pictures (pictures.h) or from samples (gathering.h).
 * What it holds is run->sums. Its functions are called by the run's one thread. */
typedef struct wf_summing {
    /* Chooses run->pace, holds it against --max-memory, makes run->frames and run->sums. */
    weft_status (*begin)(wf_run *run, weft_error *err);
    /* Puts `field`, which comes after those in flight, in flight. */
    weft_status (*launch)(wf_run *run, int64_t field, weft_error *err);
    /* Reads units and adds them to all fields in flight that need them. */
    weft_status (*add)(wf_run *run, const wf_units *units, weft_error *err);
    /* Takes the lines of the first field in flight, whose needs have all been added, through
     * color into its frame, and the field out of flight. */
    weft_status (*finish)(wf_run *run, int64_t field, weft_error *err);
    void (*drop)(wf_run *run); /* all fields in flight: what follows are other frames */
    void (*tell)(const wf_run *run, wf_report *report); /* what it has counted */
    void (*end)(wf_run *run);                           /* frees run->sums; NULL is fine */
} wf_summing;

/* A kind of source. What one holds is run->source. Functions are called by the run's one
 * thread, in this order, where nothing else is said. */
typedef struct wf_source_kind {
    const char *name; /* for people */

    /* Whether the job's input is of this kind, from its command, names and headers. An error:
     * they cannot be read. */
    weft_status (*takes)(const weft_job *job, bool *takes, weft_error *err);
    /* Finds out what must be known before the output is settled, which is the space that its
     * colors are in (setup.scene_space). */
    weft_status (*open)(wf_run *run, weft_error *err);
    /* Finds out which frames there are (wf_setup_frames), and all else that needs no pixel. */
    weft_status (*count)(wf_run *run, weft_error *err);
    /* Gets ready for its first unit; NULL: it is. */
    weft_status (*start)(wf_run *run, weft_error *err);
    /* Has what fields before `field` need at hand. A source that does not know its end before
     * it has read that far lowers setup.end_frame when it meets it. NULL: it knows. */
    weft_status (*ready)(wf_run *run, int64_t field, weft_error *err);
    wf_needs (*needs)(const wf_run *run, int64_t field); /* any field, any time after start */
    /* How its units are summed, and how they are read for that. The one that does not belong to
     * `summing` is NULL. */
    const wf_summing *summing;
    const struct wf_picture_reading *pictures;
    const struct wf_sample_reading *samples;
    /* What it has counted, and what of it people should know; run->finished says whether the
     * run came to its end. Also where something failed before. */
    void (*tell)(const wf_run *run, wf_report *report);
    void (*close)(wf_run *run); /* also where nothing was opened */

    /* For --dry-run: how many files these units would open; marks them in
     * needed[sequence.count]. NULL: that is not told. */
    int64_t (*opens)(const wf_run *run, const wf_units *units, bool *needed);
    /* For --dry-run: how many samples a unit would be traced with. NULL: it is not traced. */
    int64_t (*samples_a_unit)(const wf_run *run);
} wf_source_kind;

/* The first kind of the table (sources.c) that takes the job. */
weft_status wf_source_for(const weft_job *job, const wf_source_kind **kind, weft_error *err);

/* WEFT_USAGE where the job has options of subframes that this kind would pass over. */
weft_status wf_source_check(const wf_source_kind *kind, const weft_job *job, weft_error *err);

/* Its rows, each of a file source_NAME.c. A scene, sampled where fields look: a unit is the
 * window of one field or, where windows overlap, one field period. */
extern const wf_source_kind wf_source_scene;
/* Sample buffers: a unit is a deep EXR file, which holds a frame's samples. */
extern const wf_source_kind wf_source_samples;
/* Progressive video, or a pipe of it: a unit is a picture of the selection, counted from 0. */
extern const wf_source_kind wf_source_video;
/* Progressive pictures, more of them a second than there are fields: a unit is the file, or the
 * part of one, that has its number in the selection, counted from 0. */
extern const wf_source_kind wf_source_subframes;

#endif
