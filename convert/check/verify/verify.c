/* Reads a file to its end and gathers all that the checks look at. */
#include "convert/check/verify/verify.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "convert/check/measure.h"
#include "convert/media/metadata_read.h"

/* ---- What it is held to ---- */

/* Takes the one of the profile's rasters that the file says it is, else the profile's first. */
static void take_profile_raster(wf_subject *s, const char *said) {
    char name[64], why[256];
    const char *rasters = s->profile->rasters;
    if (wf_in_words(rasters, said))
        snprintf(name, sizeof name, "%s", said);
    else
        snprintf(name, sizeof name, "%.*s", (int)strcspn(rasters, " "), rasters);
    s->raster_known = wf_raster_parse(name, &s->raster, why, sizeof why);
}

/* The name of a raster of the table with the file's size, scan and rate, whatever its order. */
static const char *raster_but_for_order(const wf_raster *said) {
    const wf_raster *r;
    for (size_t i = 0; (r = wf_raster_at(i)); i++)
        if (r->width_px == said->width_px && r->lines == said->lines && r->scan == said->scan &&
            wf_ratio_equal(r->frame_rate, said->frame_rate))
            return r->name;
    return NULL;
}

/* A progressive raster of the table with the file's size and rate; NULL: none. */
static const char *progressive_like(const wf_raster *said) {
    const wf_raster *r;
    for (size_t i = 0; (r = wf_raster_at(i)); i++)
        if (r->scan == WF_PROGRESSIVE && r->width_px == said->width_px &&
            r->lines == said->lines && wf_ratio_equal(r->frame_rate, said->frame_rate))
            return r->name;
    return NULL;
}

static bool shows_fields(const wf_figures *f) {
    return f->order_verdict && wf_in_words("tff bff telecined", f->order_verdict);
}

/* Whole pictures of a size and rate that have a name for fields alone, as those of 601: "625i"
 * becomes "720x576@25p". */
static void call_progressive(wf_raster *r) {
    r->scan = WF_PROGRESSIVE;
    snprintf(r->name, sizeof r->name, "%dx%d@%.4gp", r->width_px, r->lines,
             wf_ratio_value(r->frame_rate));
}

/* Takes the raster that the file says it is. Where its order or scan fits none of the table,
 * one that differs in no more than that is taken; a size that the table does not have stays as
 * it is. Where it does not say how it is scanned, it may be progressive, unless its pixels
 * show fields or there is no such raster. */
static void take_said_raster(wf_subject *s) {
    const wf_video_info *v = &s->figures.info;
    char why[256];
    bool known = v->scan_known || s->metadata.scan_known;
    s->raster = v->raster;
    if (s->contained && s->metadata.scan_known && !s->metadata.interlaced)
        s->raster.scan = WF_PROGRESSIVE;
    const char *whole =
        known || shows_fields(&s->figures) ? NULL : progressive_like(&s->raster);
    bool made_up = strchr(v->raster.name, '@') || s->raster.scan != v->raster.scan;
    const char *name = whole     ? whole
                       : made_up ? raster_but_for_order(&s->raster)
                                 : v->raster.name;
    bool progressive = !made_up && s->raster.scan == WF_PROGRESSIVE;
    s->raster_known = name ? wf_raster_parse(name, &s->raster, why, sizeof why) : known;
    bool misnamed = !name && s->raster.scan != v->raster.scan;
    if ((progressive && s->raster.scan == WF_INTERLACED) || misnamed)
        call_progressive(&s->raster);
}

static void find_raster(wf_subject *s, const wf_raster *asked) {
    if (!s->trouble) take_said_raster(s);
    if (asked) {
        s->raster = *asked;
        s->raster_known = s->raster_asked = true;
    } else if (s->profile) {
        take_profile_raster(s, s->raster_known ? s->raster.name : "");
        s->coded_lines = s->profile->coded_lines;
    }
    if (!s->coded_lines) s->coded_lines = s->raster.lines + s->figures.info.interval_lines;
}

static bool is_streamed(const wf_video_info *v) {
    return !strncmp(v->format, "Y4M ", 4) || !strncmp(v->format, "raw ", 4);
}

/* Raw files say nothing of themselves; others are held to what they say. */
static bool is_raw(const char *path) {
    const char *ending = strrchr(path, '.');
    return ending && (!strcasecmp(ending, ".v210") || !strcasecmp(ending, ".uyvy"));
}

weft_status wf_verify(const char *path, const wf_verify_options *options, wf_verification *out,
                      weft_error *err) {
    const wf_measure_options measure = {.stage = "verify",
                                        .raster = is_raw(path) ? options->raster : NULL,
                                        .of_delivery = true,
                                        .max_memory_bytes = options->max_memory_bytes,
                                        .progress = options->progress,
                                        .progress_user = options->progress_user,
                                        .canceled = options->canceled};
    weft_error trouble = {""}, untold;
    wf_subject s = {.profile = options->profile};
    *out = (wf_verification){.profile = options->profile};
    weft_status status = wf_measure(path, &measure, &s.figures, &trouble);
    if (status == WEFT_NO_MEMORY || status == WEFT_INTERRUPTED)
        return wf_fail(err, status, "%s", trouble.text);
    s.trouble = status ? trouble.text : NULL;
    s.streamed = !status && is_streamed(&s.figures.info);
    if (status || s.figures.info.videos)
        s.contained = !wf_metadata_read(path, &s.metadata, &untold);
    if (!status && s.figures.info.videos && !s.contained)
        return wf_fail(err, WEFT_FAILED, "%s", untold.text);
    weft_status unread = WEFT_OK;
    if (s.contained) unread = wf_structure_read(path, s.metadata.container, &s.structure, err);
    if (unread) return unread;
    unread = wf_identities_shared(options->others, path, &s.structure, &s.shared_with, err);
    if (unread) return unread;
    find_raster(&s, options->raster);
    if (!status && !s.contained && !s.streamed)
        unread = wf_frame_labels_read(path, s.raster.frame_rate,
                                      s.figures.info.separate ? 2 : 1, &s.labels, err);
    if (unread) return unread;
    out->raster = s.raster;
    out->count = wf_run_checks(&s, out->finding);
    for (size_t i = 0; i < out->count; i++) out->wrong += out->finding[i].verdict == WF_WRONG;
    return WEFT_OK;
}
