/* A plan as text: for people, and as data. */
#include "convert/plan/tell.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/json.h"
#include "convert/read/rate.h"
#include "filters/base/spelling.h"

const char *wf_plan_ratio_text(wf_rational ratio, char text[48]) {
    snprintf(text, 48, "%" PRId64 "/%" PRId64, ratio.num, ratio.den);
    return text;
}

wf_rational wf_plan_frame(const wf_plan *plan, int64_t number) {
    return wf_ratio_mul(wf_plan_time(plan, number), plan->job.scene_fps);
}

int64_t wf_plan_last(const wf_plan *plan) {
    return plan->count ? plan->subframe[plan->count - 1].number : 0;
}

/* ---- For people ---- */

static void put_convert(const wf_plan *plan, FILE *to) {
    char rate[48];
    fprintf(
        to,
        "to convert them: weft convert shot.####.exr --frames 0-%" PRId64
        " --subframe-rate %s --output-frames %s, and the plan's --raster, --aperture and so "
        "on\n",
        wf_plan_last(plan), wf_rate_text(plan->rate, rate), plan->job.frames);
}

static void put_head(const wf_plan *plan, FILE *to) {
    char rate[48];
    int64_t all = plan->count ? wf_plan_last(plan) - plan->subframe[0].number + 1 : 0;
    const char *name = plan->job.raster.name, *frames = plan->job.frames;
    wf_rate_text(plan->rate, rate);
    if (!plan->job.refine)
        fprintf(to,
                "%s, frames %s: %zu subframes of the %" PRId64
                " that there are at %s a second\n",
                name, frames, plan->count, all, rate);
    else if (plan->count)
        fprintf(to, "%s, frames %s: %zu subframes, or parts of them, are still wanted\n", name,
                frames, plan->count);
    else
        fprintf(to, "%s, frames %s: nothing more is wanted\n", name, frames);
    fprintf(to, "size: %dx%d, pixel aspect %" PRId64 ":%" PRId64 "\n", plan->width_px,
            plan->lines, plan->pixel_aspect.num, plan->pixel_aspect.den);
    fprintf(to, "region: apertures reach %d,%d to %d,%d\n", plan->reach.x0, plan->reach.y0,
            plan->reach.x1, plan->reach.y1);
    if (plan->samples)
        fprintf(to,
                "samples a pixel: %" PRId64 ", for the noise of a finished frame at %" PRId64
                "\n",
                plan->samples, plan->job.samples_a_pixel);
}

static void put_text(const wf_plan *plan, FILE *to) {
    char time[48], frame[48];
    put_head(plan, to);
    if (plan->count && !plan->job.refine) put_convert(plan, to);
    for (size_t i = 0; i < plan->count; i++) {
        const wf_plan_subframe *s = &plan->subframe[i];
        wf_rational in_frames = wf_plan_frame(plan, s->number);
        fprintf(to, "%" PRId64 ": %s s", s->number,
                wf_plan_ratio_text(wf_plan_time(plan, s->number), time));
        if (wf_ratio_given(in_frames))
            fprintf(to, ", frame %s", wf_plan_ratio_text(in_frames, frame));
        if (plan->job.refine)
            fprintf(to, ", %d,%d to %d,%d", s->region.x0, s->region.y0, s->region.x1,
                    s->region.y1);
        fputc('\n', to);
    }
}

/* ---- As data ---- */

static void put_csv(const wf_plan *plan, FILE *to) {
    char time[48], frame[48];
    fputs("number,time,seconds,frame,x0,y0,x1,y1\n", to);
    for (size_t i = 0; i < plan->count; i++) {
        const wf_plan_subframe *s = &plan->subframe[i];
        wf_rational t = wf_plan_time(plan, s->number),
                    in_frames = wf_plan_frame(plan, s->number);
        fprintf(to, "%" PRId64 ",%s,%.12g,%s,%d,%d,%d,%d\n", s->number,
                wf_plan_ratio_text(t, time), wf_ratio_value(t),
                wf_ratio_given(in_frames) ? wf_plan_ratio_text(in_frames, frame) : "",
                s->region.x0, s->region.y0, s->region.x1, s->region.y1);
    }
}

static void add_numbers(wf_json *json, const char *key, const int64_t *numbers, size_t count) {
    wf_json_open(json, key, '[');
    for (size_t i = 0; i < count; i++) wf_json_int(json, NULL, numbers[i]);
    wf_json_close(json);
}

static void add_box(wf_json *json, const wf_box *box) {
    add_numbers(json, "region", (int64_t[]){box->x0, box->y0, box->x1, box->y1}, 4);
}

static void add_subframe(wf_json *json, const wf_plan *plan, const wf_plan_subframe *s) {
    char text[48];
    wf_rational frame = wf_plan_frame(plan, s->number);
    wf_json_open(json, NULL, '{');
    wf_json_int(json, "number", s->number);
    wf_json_text(json, "time", wf_plan_ratio_text(wf_plan_time(plan, s->number), text));
    if (wf_ratio_given(frame)) wf_json_text(json, "frame", wf_plan_ratio_text(frame, text));
    if (plan->job.refine) add_box(json, &s->region);
    wf_json_close(json);
}

static void put_json(const wf_plan *plan, FILE *to) {
    wf_json json = {0};
    char rate[48];
    wf_json_open(&json, NULL, '{');
    wf_json_text(&json, "raster", plan->job.raster.name);
    wf_json_text(&json, "rate", wf_rate_text(plan->rate, rate));
    add_numbers(&json, "size", (int64_t[]){plan->width_px, plan->lines}, 2);
    add_numbers(&json, "pixel_aspect",
                (int64_t[]){plan->pixel_aspect.num, plan->pixel_aspect.den}, 2);
    add_box(&json, &plan->reach);
    if (plan->samples) wf_json_int(&json, "samples_a_pixel", plan->samples);
    wf_json_open(&json, "subframes", '[');
    for (size_t i = 0; i < plan->count; i++) add_subframe(&json, plan, &plan->subframe[i]);
    char *text = wf_json_finish(&json);
    if (text) fputs(text, to);
    free(text);
}

/* ---- Formats ---- */

static const struct {
    const char *name;
    void (*put)(const wf_plan *plan, FILE *to);
    bool renders; /* makes pictures that do not say which part of them exists */
} formats[] = {{"text", put_text, false},
               {"json", put_json, false},
               {"csv", put_csv, false},
               {"blender", wf_plan_for_blender, true},
               {"povray", wf_plan_for_povray, true},
               {"houdini", wf_plan_for_houdini, true}};

static weft_status refuse_format(const char *format, weft_error *err) {
    wf_spelling spelling = {.text = format};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        wf_spelling_offer(&spelling, formats[i].name);
    return wf_fail(err, WEFT_USAGE,
                   "--format: '%.200s' will not do; it takes one of " WF_PLAN_FORMATS "%s%s",
                   format, spelling.best ? "; did you mean " : "",
                   spelling.best ? spelling.best : "");
}

/* Its row; past the last: there is none. */
static size_t find_format(const char *format) {
    size_t i = 0;
    while (i < sizeof formats / sizeof *formats && strcmp(formats[i].name, format)) i++;
    return i;
}

weft_status wf_plan_check_format(const weft_job *job, const char *format, weft_error *err) {
    size_t i = find_format(format);
    if (i == sizeof formats / sizeof *formats) return refuse_format(format, err);
    if (job->refine && formats[i].renders)
        return wf_fail(
            err, WEFT_USAGE,
            "--format %s and --refine: rectangles have to say where they are, which its "
            "pictures do not; take --format json and stamp them with weft:region, as "
            "examples/stamp_exr.py does",
            format);
    return WEFT_OK;
}

weft_status wf_plan_tell(const wf_plan *plan, const char *format, char **text,
                         weft_error *err) {
    size_t size = 0;
    *text = NULL;
    FILE *to = open_memstream(text, &size);
    if (to) formats[find_format(format)].put(plan, to);
    if (to && !fclose(to) && size) return WEFT_OK;
    free(*text);
    *text = NULL;
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan's text");
}
