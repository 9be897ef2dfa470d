/* Runs a job once for each aperture of a list, and makes a page of what comes out. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "convert/ask/asking.h"
#include "convert/base/names.h"
#include "convert/job/audio.h"
#include "convert/job/colors.h"
#include "convert/job/job.h"
#include "convert/page/page.h"

/* So many different warnings of runs are remembered; further ones may come again. */
#define MOST_WARNINGS 64

typedef struct comparing {
    weft_job *job;
    weft_job asked;    /* a copy, for what each run begins with; it owns nothing */
    const char *title; /* NULL: the page makes one */
    char *text;        /* the list, cut into entries */
    char *entry[WF_PAGE_MOST_CLIPS]; /* in it */
    size_t entries;
    char *folder;      /* NULL: there is none now */
    char path[48];     /* of the clip in hand, which has no name any more */
    int fd;            /* it; -1: none */
    weft_status worst; /* WEFT_OK or WEFT_DEGRADED */
    wf_page_step_fn *step;
    void *step_user;
    char *warned[MOST_WARNINGS]; /* what was warned of */
    size_t warnings;
} comparing;

/* ---- The list ---- */

/* Whether an entry begins here: the names of apertures do, what follows them does not. */
static bool begins_entry(const char *text) {
    const char *name;
    size_t length = strcspn(text, ":+,");
    for (size_t i = 0; (name = weft_aperture_name(i)); i++)
        if (strlen(name) == length && !strncmp(name, text, length)) return true;
    return length == strlen("design") && !strncmp(text, "design", length);
}

/* Cuts the list at commas; those within an aperture's own numbers ("mitchell:1,0") stay. */
static weft_status cut_list(comparing *c, weft_error *err) {
    for (char *at = c->text; at;) {
        char *comma = strchr(at, ',');
        while (comma && !begins_entry(comma + 1) && memchr(at, ':', (size_t)(comma - at)))
            comma = strchr(comma + 1, ',');
        if (comma) *comma = '\0';
        if (!*at)
            return wf_fail(err, WEFT_USAGE,
                           "--compare: an entry is empty; it takes apertures with commas, such "
                           "as box,shaped,line+limit=.06");
        if (c->entries == WF_PAGE_MOST_CLIPS)
            return wf_fail(err, WEFT_USAGE, "--compare: a page shows at most %d clips",
                           WF_PAGE_MOST_CLIPS);
        c->entry[c->entries++] = at;
        at = comma ? comma + 1 : NULL;
    }
    return WEFT_OK;
}

/* What may follow an aperture, and the option that it sets. */
static const struct {
    const char *key, *option;
} held[] = {{"limit=", "flicker-limit"}, {"weight=", "flicker-weight"}};

static weft_status set_held(weft_job *job, const char *word, const char *entry, unsigned *set,
                            weft_error *err) {
    for (size_t i = 0; i < sizeof held / sizeof *held; i++) {
        size_t length = strlen(held[i].key);
        if (strncmp(word, held[i].key, length) != 0) continue;
        if (*set & 1u << i)
            return wf_fail(err, WEFT_USAGE, "--compare: '%.200s' has +%s twice; leave one out",
                           entry, held[i].key);
        *set |= 1u << i;
        return weft_job_set(job, held[i].option, word + length, err);
    }
    return wf_fail(err, WEFT_USAGE,
                   "--compare: '%.200s' of '%.200s' will not do; after an aperture come "
                   "+limit=E and +weight=MU",
                   word, entry);
}

/* The job as it was asked for, with what the entry says. */
static weft_status set_entry(comparing *c, const char *entry, weft_error *err) {
    weft_job *job = c->job;
    unsigned set = 0; /* bits by the rows of held */
    char *words = strdup(entry), *rest = words;
    if (!words) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    job->flicker_weight = c->asked.flicker_weight;
    job->flicker_limit = c->asked.flicker_limit;
    job->limit_is_seen = c->asked.limit_is_seen;
    weft_status status = weft_job_set(job, "aperture", strsep(&rest, "+"), err);
    for (char *word; !status && (word = strsep(&rest, "+"));)
        status = set_held(job, word, entry, &set, err);
    free(words);
    return status ? status : wf_job_check(job, err);
}

/* ---- What a page cannot be made of ---- */

static bool has_sound(const weft_job *job) {
    wf_audio audio;
    return wf_audio_parse(job->audio, &audio) && audio.kind != WF_AUDIO_NONE;
}

static weft_status check_job(const weft_job *job, weft_error *err) {
    const struct {
        bool wrong;
        const char *says;
    } rules[] = {
        {!job->output, "where to is not said; give -o look.html"},
        {job->raster.scan == WF_PROGRESSIVE, "--compare: a page shows fields, and the raster "
                                             "is progressive; take an interlaced one "
                                             "with --raster"},
        {job->chunk_count > 1, "--compare makes a whole page: leave --chunk out"},
        {job->resume, "--compare makes a page anew: leave --resume out"},
        {job->dry_run, "--compare writes a page: leave --dry-run out, or --compare"},
        {job->key || job->alpha_out,
         "--compare: a page shows pictures without alpha; leave --key and --alpha-out out"},
        {job->output &&
             (!strncmp(job->output, "hash:", 5) || !strncmp(job->output, "null:", 5)),
         "--compare writes a page, which is a file of its own; give -o look.html"},
        {has_sound(job), "--compare: a page has no sound; leave --audio out"},
        {job->codec, "--compare: a page has no codec; leave --codec out"},
        {job->separate_fields, "--compare: leave --fields out, a page shows all fields"}};
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].wrong) return wf_fail(err, WEFT_USAGE, "%s", rules[i].says);
    return WEFT_OK;
}

/* ---- One run ---- */

static void on_progress(const weft_progress *progress, void *user) {
    const comparing *c = user;
    double all = (double)progress->frames_total;
    double part = all > 0 ? ((double)progress->frames_done + progress->frame_part) / all : 0;
    c->step(part, progress->frames_total, c->step_user);
}

/* All runs read the same input: what one has warned of the next does not say again. */
static void warn_once(const char *text, void *user) {
    comparing *c = user;
    for (size_t i = 0; i < c->warnings; i++)
        if (!strcmp(c->warned[i], text)) return;
    if (c->warnings < MOST_WARNINGS && (c->warned[c->warnings] = strdup(text))) c->warnings++;
    if (c->asked.warning) c->asked.warning(text, c->asked.warning_user);
}

static void forget_warnings(comparing *c) {
    while (c->warnings) free(c->warned[--c->warnings]);
    weft_job_on_warning(c->job, c->asked.warning, c->asked.warning_user);
}

/* Names the video in the folder. */
static char *video_name(const comparing *c) {
    char *name = NULL;
    return asprintf(&name, "%s/clip.y4m", c->folder) < 0 ? NULL : name;
}

static void remove_folder(comparing *c) {
    char *name = c->folder ? video_name(c) : NULL;
    if (name) unlink(name);
    if (c->folder) rmdir(c->folder);
    free(name);
    free(c->folder);
    c->folder = NULL;
}

static weft_status make_folder(comparing *c, weft_error *err) {
    const char *top = getenv("TMPDIR");
    if (!top || !*top) top = "/tmp";
    if (asprintf(&c->folder, "%s/weft-page-XXXXXX", top) < 0) {
        c->folder = NULL;
        return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    }
    if (mkdtemp(c->folder)) return WEFT_OK;
    int code = errno;
    free(c->folder);
    c->folder = NULL;
    return wf_fail(err, WEFT_FAILED,
                   "%.500s: no folder for the video to compare: %s; $TMPDIR can name another "
                   "place",
                   top, strerror(code));
}

static weft_status run_into(comparing *c, size_t number, const char *video, weft_error *err) {
    weft_status status = weft_job_set_output(c->job, video, err);
    if (!status) status = weft_job_run(c->job, err);
    /* The video's name means nothing to whoever gave an option that it cannot have. */
    if (status == WEFT_USAGE) wf_error_rename(err, video, c->entry[number]);
    if (status == WEFT_DEGRADED) c->worst = status, status = WEFT_OK;
    if (status) return status;
    c->fd = open(video, O_RDONLY | O_CLOEXEC);
    if (c->fd < 0) return wf_fail(err, WEFT_FAILED, "%.500s: %s", video, strerror(errno));
    snprintf(c->path, sizeof c->path, "/proc/self/fd/%d", c->fd);
    return WEFT_OK;
}

static void close_clip(comparing *c) {
    if (c->fd >= 0) close(c->fd);
    c->fd = -1;
}

/* Makes the video of an entry. It is taken from its folder as soon as it is open, so that
 * only a program that is killed while it writes leaves something: the folder. */
static weft_status make_clip(void *user, size_t number, wf_page_step_fn *step, void *step_user,
                             const char **path, weft_error *err) {
    comparing *c = user;
    c->step = step;
    c->step_user = step_user;
    close_clip(c);
    weft_status status = set_entry(c, c->entry[number], err);
    if (!status) status = make_folder(c, err);
    if (status) return status;
    char *video = video_name(c);
    status =
        video ? run_into(c, number, video, err) : wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    free(video);
    remove_folder(c);
    if (!status) *path = c->path;
    return status;
}

/* ---- All of it ---- */

/* Every entry is understood before the first is made. */
static weft_status check_entries(comparing *c, weft_error *err) {
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < c->entries && !status; i++) status = set_entry(c, c->entry[i], err);
    return status;
}

static weft_status make_page(comparing *c, const char *output, weft_error *err) {
    wf_page_clip clip[WF_PAGE_MOST_CLIPS];
    for (size_t i = 0; i < c->entries; i++) clip[i] = (wf_page_clip){.label = c->entry[i]};
    const wf_raster raster = wf_job_raster_shown(&c->asked);
    const wf_transfer transfer = wf_color_transfer_of(c->asked.to);
    const wf_page_request request = {.raster = &raster,
                                     .transfer = c->asked.to ? &transfer : NULL,
                                     .title = c->title,
                                     .clip = clip,
                                     .clips = c->entries,
                                     .max_bytes = WF_PAGE_MOST_BYTES,
                                     .max_memory_bytes = c->asked.max_memory_bytes,
                                     .overwrite = c->asked.overwrite,
                                     .canceled = &c->job->canceled,
                                     .progress = c->asked.progress,
                                     .progress_user = c->asked.progress_user,
                                     .warning = c->asked.warning,
                                     .warning_user = c->asked.warning_user,
                                     .make_clip = make_clip,
                                     .make_user = c};
    weft_job_on_progress(c->job, on_progress, c);
    weft_status status = wf_page_make(&request, output, err);
    return status ? status : c->worst;
}

/* Does the job that is checked, way by way. */
static weft_status compare(comparing *c, const char *ways, weft_error *err) {
    weft_status status = WEFT_OK;
    char *output = strdup(c->job->output);
    c->text = strdup(ways);
    if (!output || !c->text) status = wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    if (!status) status = cut_list(c, err);
    if (!status) status = check_entries(c, err);
    if (!status) status = make_page(c, output, err);
    close_clip(c);
    free(c->text);
    free(output);
    return status;
}

weft_status weft_job_compare(weft_job *job, const weft_compare *asked, weft_error *err) {
    weft_compare request;
    weft_status status = wf_asked(asked, "weft_compare", &request, sizeof request, err);
    if (!status && !request.ways)
        status =
            wf_fail(err, WEFT_USAGE,
                    "nothing to compare; give apertures, such as box,shaped,line+limit=.06");
    if (!status) status = check_job(job, err);
    if (status) return status;
    comparing c = {.job = job, .asked = *job, .title = request.title, .fd = -1};
    weft_job_on_warning(job, warn_once, &c);
    status = compare(&c, request.ways, err);
    forget_warnings(&c);
    weft_job_on_progress(job, c.asked.progress, c.asked.progress_user);
    return status;
}
