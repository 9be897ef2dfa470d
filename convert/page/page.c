/* Reads, measures and packs the clips of a page. */
#include "convert/page/page.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "convert/base/clock.h"
#include "convert/base/names.h"
#include "convert/check/heat.h"
#include "convert/check/measure.h"
#include "convert/page/parts.h"

#define PAGE_ITSELF_BYTES                                                                      \
    ((size_t)1 << 20) /* more than all of it but packed fields and maps                        \
                       */

/* What is done with a clip, one after the other. */
typedef enum stage { MAKE, MEASURE, PACK, STAGES } stage;

static const char *const stage_names[] = {"convert", "measure", "pack"};

typedef struct making {
    wf_page page;
    double began_s, stage_began_s;
    size_t clip; /* in hand */
    stage stage;
    double took_s[STAGES]; /* of the first clip, or what is usual */
    int64_t frames;        /* of a clip, as far as it is known */
    double done;           /* frames, as was told */
    size_t packed_bytes;   /* of clips before the one in hand, and of maps */
} making;

static const wf_page_request *request_of(const making *m) {
    return m->page.request;
}

static void warn(const making *m, const char *text) {
    if (request_of(m)->warning) request_of(m)->warning(text, request_of(m)->warning_user);
}

/* ---- Progress ---- */

/* Frames count as done by the share of a clip's time that stages have taken, since one takes
 * several times as long as another. */
static void tell_progress(making *m, double part) {
    const wf_page_request *r = request_of(m);
    double before = 0, all = 0;
    for (int i = 0; i < STAGES; i++) {
        all += m->took_s[i];
        if (i < (int)m->stage) before += m->took_s[i];
    }
    double share = (before + fmin(part, 1) * m->took_s[m->stage]) / all;
    m->done = fmax(m->done, ((double)m->clip + share) * (double)m->frames);
    const weft_progress progress = {.frames_done = (int64_t)m->done,
                                    .frame_part = m->done - floor(m->done),
                                    .frames_total = m->frames * (int64_t)r->clips,
                                    .seconds = wf_now_s() - m->began_s,
                                    .stage = stage_names[m->stage]};
    if (r->progress) r->progress(&progress, r->progress_user);
}

static void begin_stage(making *m, stage of) {
    m->stage = of;
    m->stage_began_s = wf_now_s();
}

/* Later clips take as long as the first did. */
static void end_stage(making *m) {
    if (!m->clip) m->took_s[m->stage] = wf_now_s() - m->stage_began_s;
}

static void on_step(double part, int64_t frames, void *user) {
    making *m = user;
    if (frames > m->frames) m->frames = frames;
    tell_progress(m, part);
}

static void on_measured(const weft_progress *progress, void *user) {
    on_step((double)progress->frames_done / (double)progress->frames_total,
            progress->frames_total, user);
}

static weft_status check_canceled(const making *m, weft_error *err) {
    if (!request_of(m)->canceled || !*request_of(m)->canceled) return WEFT_OK;
    return wf_fail(err, WEFT_INTERRUPTED, "interrupted; no page was written");
}

/* ---- Which clips can be shown ---- */

static weft_status open_clip(const making *m, const char *path, wf_video **video,
                             weft_error *err) {
    const wf_video_options options = {.raster = request_of(m)->raster,
                                      .transfer = request_of(m)->transfer,
                                      .max_memory_bytes = request_of(m)->max_memory_bytes};
    if (!strcmp(path, "-"))
        return wf_fail(
            err, WEFT_USAGE,
            "standard input can be read once, and a page reads each clip twice: give "
            "a file");
    return wf_video_open(path, &options, video, err);
}

static weft_status check_fields(const char *path, const wf_video_info *info, weft_error *err) {
    if (info->lines % 2)
        return wf_fail(err, WEFT_FAILED,
                       "%.500s: its pictures have %d lines, an odd number; two fields need an "
                       "even one",
                       path, info->lines);
    if (info->raster.scan != WF_PROGRESSIVE) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%.500s says that it is progressive (%s), and a page shows fields: make "
                   "interlaced video of it with 'weft convert', or, if it is that, name its "
                   "--raster",
                   path, info->raster.name);
}

/* The two clips can be shown in step, line by line. */
static weft_status check_alike(const wf_page_packed *a, const wf_page_packed *b,
                               weft_error *err) {
    const wf_video_info *x = &a->info, *y = &b->info;
    static const char rule[] =
        "a page compares clips of one size and rate; make pages of their "
        "own, or convert one to the other's raster";
    if (x->width_px != y->width_px || x->lines != y->lines)
        return wf_fail(err, WEFT_USAGE, "%.300s is %dx%d and %.300s %dx%d: %s", a->path,
                       x->width_px, x->lines, b->path, y->width_px, y->lines, rule);
    if (wf_ratio_equal(x->raster.frame_rate, y->raster.frame_rate)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "%.300s has %.5g frames a second and %.300s %.5g: %s",
                   a->path, wf_ratio_value(x->raster.frame_rate), b->path,
                   wf_ratio_value(y->raster.frame_rate), rule);
}

static void tell_guess(const making *m, const wf_page_packed *clip) {
    char text[1024];
    if (clip->info.scan_known) return;
    snprintf(text, sizeof text,
             "%.500s does not say how it is scanned: it is taken for %s, %s; --raster says "
             "otherwise",
             clip->label, clip->info.raster.name, wf_raster_order(&clip->info.raster));
    warn(m, text);
}

static weft_status look_at(making *m, size_t i, weft_error *err) {
    wf_page_packed *clip = &m->page.clip[i];
    const wf_page_request *r = request_of(m);
    wf_video *video;
    weft_status status = open_clip(m, clip->path, &video, err);
    if (status) return status;
    clip->info = *wf_video_info_of(video);
    clip->info.times = NULL; /* the video's */
    wf_video_close(video);
    int64_t frames = clip->info.frames - r->first;
    if (r->count && (clip->info.frames < 0 || frames > r->count)) frames = r->count;
    if (frames > m->frames) m->frames = frames;
    status = check_fields(clip->path, &clip->info, err);
    if (!status) tell_guess(m, clip);
    return status || !i ? status : check_alike(&m->page.clip[0], clip, err);
}

/* ---- Measuring ---- */

static weft_status measure(making *m, wf_page_packed *clip, weft_error *err) {
    const wf_page_request *r = request_of(m);
    const wf_measure_options options = {.raster = r->raster,
                                        .transfer = r->transfer,
                                        .want_heat = true,
                                        .first_frame = r->first,
                                        .frame_count = r->count,
                                        .max_memory_bytes = r->max_memory_bytes,
                                        .progress = on_measured,
                                        .progress_user = m};
    begin_stage(m, MEASURE);
    weft_status status = wf_measure(clip->path, &options, &clip->figures, err);
    end_stage(m);
    double top = isnan(clip->figures.flicker_p999) ? 0 : clip->figures.flicker_p999;
    m->page.heat_high = fmax(m->page.heat_high, top);
    return status;
}

/* ---- Packing ---- */

static size_t as_text(size_t bytes) {
    return (bytes + 2) / 3 * 4;
}

/* Whether so much more than what is packed is more than a page may be; *all is then its size.
 */
static bool is_too_large(const making *m, size_t bytes, size_t *all) {
    *all = as_text(m->packed_bytes + bytes) + PAGE_ITSELF_BYTES;
    return *all > request_of(m)->max_bytes;
}

/* As many frames as there is room for, beside heat maps of a byte a pixel, if all are like
 * those so far. */
static double fitting_frames(const making *m, const wf_page_packed *clip, size_t all) {
    double heat = (double)as_text((size_t)clip->info.width_px * (size_t)clip->info.lines);
    double room =
        (double)request_of(m)->max_bytes - PAGE_ITSELF_BYTES - (double)m->page.clips * heat;
    double frames = (double)m->clip * (double)m->frames + (double)clip->frames;
    return floor(0.95 * frames * room / (double)(all - PAGE_ITSELF_BYTES) /
                 (double)m->page.clips);
}

static weft_status check_size(const making *m, const wf_page_packed *clip, weft_error *err) {
    size_t bytes, all;
    char fewer[64] = "";
    wf_packer_data(clip->fields, &bytes);
    if (!is_too_large(m, bytes, &all)) return WEFT_OK;
    double fits = fitting_frames(m, clip, all);
    if (fits >= 1) snprintf(fewer, sizeof fewer, "fewer frames, such as %.0f, or ", fits);
    return wf_fail(err, WEFT_FAILED,
                   "the page would be larger than %.0f MB (--max-size): %.300s has reached it "
                   "at frame %" PRId64 "; show %sfewer clips, or allow more",
                   (double)request_of(m)->max_bytes / 1e6, clip->label, clip->frames, fewer);
}

/* Maps are packed last, since all are drawn by the strongest flicker of any. */
static weft_status count_heat(making *m, const wf_page_packed *clip, weft_error *err) {
    size_t bytes, all;
    wf_packer_data(clip->heat, &bytes);
    if (is_too_large(m, bytes, &all))
        return wf_fail(err, WEFT_FAILED,
                       "the page would be larger than %.0f MB (--max-size) with the map of "
                       "where %.300s flickers; show fewer frames or clips, or allow more",
                       (double)request_of(m)->max_bytes / 1e6, clip->label);
    m->packed_bytes += bytes;
    return WEFT_OK;
}

static weft_status pack_frame(making *m, wf_page_packed *clip, wf_page_shown *shown,
                              const wf_video_frame *frame, weft_error *err) {
    weft_status status = check_canceled(m, err);
    wf_page_shown_take(shown, frame);
    for (int field = 0; field < 2 && !status; field++) {
        int parity = wf_raster_parity(&clip->info.raster, field);
        status = wf_packer_add(clip->fields, wf_page_shown_field(shown, parity), err);
    }
    clip->frames++;
    if (!status) on_step((double)clip->frames / (double)clip->figures.frames, clip->frames, m);
    return status ? status : check_size(m, clip, err);
}

static weft_status pack_frames(making *m, wf_page_packed *clip, wf_video *video,
                               wf_page_shown *shown, weft_error *err) {
    int64_t first = request_of(m)->first;
    const wf_video_frame *frame;
    weft_status status = WEFT_OK;
    while (!status && clip->frames < clip->figures.frames) {
        status = wf_video_next(video, &frame, err);
        if (!status && !frame) break;
        if (!status && frame->index >= first) status = pack_frame(m, clip, shown, frame, err);
    }
    return status;
}

static weft_status pack(making *m, wf_page_packed *clip, weft_error *err) {
    wf_video *video = NULL;
    wf_page_shown *shown = NULL;
    size_t bytes;
    begin_stage(m, PACK);
    weft_status status = open_clip(m, clip->path, &video, err);
    if (!status) status = wf_page_shown_new(&clip->info, &shown, err);
    if (!status) {
        clip->form = *wf_page_shown_form(shown);
        status = wf_packer_new(&clip->form.shape, &clip->fields, err);
    }
    if (!status) status = pack_frames(m, clip, video, shown, err);
    wf_page_shown_free(shown);
    if (video) wf_video_close(video);
    if (status) return status;
    end_stage(m);
    wf_packer_data(clip->fields, &bytes);
    m->packed_bytes += bytes;
    return WEFT_OK;
}

/* The heat map in 255 steps, as one field of all lines. */
static weft_status pack_heat(making *m, wf_page_packed *clip, weft_error *err) {
    const wf_pack_shape shape = {
        .planes = 1, .width_px = {clip->info.width_px}, .lines = clip->info.lines};
    size_t samples = (size_t)clip->info.width_px * (size_t)clip->info.lines;
    uint16_t *steps = malloc(samples * sizeof *steps);
    if (!steps) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the heat map");
    for (size_t i = 0; i < samples; i++)
        steps[i] = (uint16_t)lrint(
            255 * fmin(fmax((double)clip->figures.heat[i] / m->page.heat_high, 0), 1));
    weft_status status = wf_packer_new(&shape, &clip->heat, err);
    if (!status) status = wf_packer_add(clip->heat, (const uint16_t *const[]){steps}, err);
    free(steps);
    return status ? status : count_heat(m, clip, err);
}

/* ---- Names ---- */

static weft_status name_page(making *m, weft_error *err) {
    const wf_page_request *r = request_of(m);
    wf_text title = {0};
    if (r->title) wf_text_add(&title, "%s", r->title);
    for (size_t i = 0; i < r->clips; i++) {
        const wf_page_clip *from = &r->clip[i];
        wf_page_packed *clip = &m->page.clip[i];
        clip->path = from->path;
        clip->label = strdup(from->label ? from->label : wf_base_name(from->path));
        if (!clip->label) title.failed = true;
        if (!r->title) wf_text_add(&title, "%s%s", i ? ", " : "", clip->label);
    }
    m->page.title = title.at;
    return title.failed ? wf_fail(err, WEFT_NO_MEMORY, "out of memory") : WEFT_OK;
}

static void tell_lengths(const making *m) {
    char text[160];
    int64_t most = 0;
    for (size_t i = 0; i < m->page.clips; i++)
        if (m->page.clip[i].frames > most) most = m->page.clip[i].frames;
    if (most == m->page.frames) return;
    snprintf(text, sizeof text,
             "clips are not equally long: of up to %" PRId64 " frames the first %" PRId64
             " of each are shown",
             most, m->page.frames);
    warn(m, text);
}

/* ---- All of it ---- */

/* Makes a clip, if that is to be done. */
static weft_status make(making *m, wf_page_packed *clip, weft_error *err) {
    const wf_page_request *r = request_of(m);
    if (!r->make_clip) return WEFT_OK;
    begin_stage(m, MAKE);
    weft_status status = r->make_clip(r->make_user, m->clip, on_step, m, &clip->path, err);
    end_stage(m);
    return status ? status : look_at(m, m->clip, err);
}

static weft_status take_clip(making *m, weft_error *err) {
    wf_page *page = &m->page;
    wf_page_packed *clip = &page->clip[m->clip];
    weft_status status = make(m, clip, err);
    if (!status) status = check_canceled(m, err);
    if (!status) status = measure(m, clip, err);
    if (!status) status = pack(m, clip, err);
    if (!m->clip || clip->frames < page->frames) page->frames = clip->frames;
    if (status && request_of(m)->make_clip && clip->path)
        wf_error_rename(err, clip->path, clip->label);
    return status;
}

static weft_status gather(making *m, weft_error *err) {
    wf_page *page = &m->page;
    weft_status status = name_page(m, err);
    for (size_t i = 0; i < page->clips && !status && !request_of(m)->make_clip; i++)
        status = look_at(m, i, err);
    for (m->clip = 0; m->clip < page->clips && !status; m->clip++) status = take_clip(m, err);
    page->heat_high = wf_heat_top(page->heat_high);
    for (size_t i = 0; i < page->clips && !status; i++)
        status = pack_heat(m, &page->clip[i], err);
    if (!status) tell_lengths(m);
    return status;
}

static void release(wf_page *page) {
    for (size_t i = 0; page->clip && i < page->clips; i++) {
        free(page->clip[i].label);
        free(page->clip[i].figures.heat);
        wf_packer_free(page->clip[i].fields);
        wf_packer_free(page->clip[i].heat);
    }
    free(page->clip);
    free(page->title);
}

static weft_status check_ending(const char *path, weft_error *err) {
    if (wf_name_ends_in(path, ".html") || wf_name_ends_in(path, ".htm")) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "%.500s: a page is HTML; name it such as look.html", path);
}

weft_status wf_page_check_name(const char *path, bool overwrite, weft_error *err) {
    weft_status status = check_ending(path, err);
    return status ? status : wf_outfile_check(path, overwrite, err);
}

/* Opened when all else is done, so that nothing is there that could stay unfinished. */
static weft_status write_file(const wf_page *page, const char *path, weft_error *err) {
    wf_outfile *file;
    weft_status status = wf_outfile_open(path, page->request->overwrite, &file, err);
    if (status) return status;
    status = wf_page_write(page, file, err);
    if (!status) return wf_outfile_commit(file, err);
    wf_outfile_abandon(file);
    return status;
}

weft_status wf_page_make(const wf_page_request *request, const char *path, weft_error *err) {
    making m = {.page = {.request = request, .clips = request->clips},
                .began_s = wf_now_s(),
                .took_s = {request->make_clip ? 5 : 0, 3.5, 1}};
    weft_status status = wf_page_check_name(path, request->overwrite, err);
    if (status) return status;
    m.page.clip = calloc(request->clips, sizeof *m.page.clip);
    status = m.page.clip ? gather(&m, err) : wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    if (!status) status = write_file(&m.page, path, err);
    release(&m.page);
    return status;
}
