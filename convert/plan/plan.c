/* Which subframes the windows of a job's fields meet, and how they are to be rendered. */
#include "convert/plan/plan.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert/base/values.h"
#include "convert/plan/refine.h"
#include "convert/read/rate.h"
#include "convert/run/source/fitting.h"
#include "convert/run/time/picture_rate.h"

void wf_plan_free(wf_plan *plan) {
    wf_resampler_free(plan->resampler);
    free(plan->subframe);
    *plan = (wf_plan){0};
}

wf_rational wf_plan_time(const wf_plan *plan, int64_t number) {
    return wf_ratio_div(wf_ratio(number, 1), plan->rate);
}

/* ---- Rates and frames ---- */

static wf_rational field_rate(const wf_plan *plan) {
    return wf_ratio_div(wf_ratio(1, 1), wf_raster_field_period(&plan->job.raster));
}

static weft_status refuse_rate(const wf_plan *plan, weft_error *err) {
    wf_rational fields = field_rate(plan);
    char rate[48], least[48], good[48];
    const char *what = plan->job.raster.pulldown                ? "film frames"
                       : plan->job.raster.scan == WF_INTERLACED ? "fields"
                                                                : "frames";
    return wf_fail(err, WEFT_USAGE,
                   "--subframe-rate %s: there are %s %s a second in %s, and fewer pictures "
                   "would repeat in them; take %s, which is eight for each",
                   wf_rate_text(plan->rate, rate), wf_rate_text(fields, least), what,
                   plan->job.raster.name,
                   wf_rate_text(wf_ratio_mul(fields, wf_ratio(8, 1)), good));
}

static weft_status settle_rate(wf_plan *plan, weft_error *err) {
    char good[48];
    wf_rational fields = field_rate(plan);
    if (!wf_ratio_given(plan->rate))
        return wf_fail(
            err, WEFT_USAGE,
            "how many subframes a second are there to be? Give --subframe-rate, such "
            "as --subframe-rate %s, which is eight for each field of %s",
            wf_rate_text(wf_ratio_mul(fields, wf_ratio(8, 1)), good), plan->job.raster.name);
    if (plan->job.raster.pulldown) {
        char *inputs[] = {"the plan"}; /* what a message begins with */
        weft_job asked = plan->job;
        asked.inputs = inputs;
        weft_status status = wf_settle_film(&asked, "subframes", &plan->shown_rate, err);
        if (status) return status;
    }
    return wf_ratio_value(plan->shown_rate) < wf_ratio_value(fields) * (1 - 1e-9)
               ? refuse_rate(plan, err)
               : WEFT_OK;
}

static weft_status settle_frames(wf_plan *plan, weft_error *err) {
    const weft_job *job = &plan->job;
    int64_t first, end;
    if (!job->frames)
        return wf_fail(err, WEFT_USAGE,
                       "which frames of the output? Give --frames A-B, counted from 0, such as "
                       "--frames 0-99");
    if (!wf_parse_span(job->frames, &first, &end))
        return wf_fail(err, WEFT_USAGE,
                       "--frames %.200s: a plan takes A-B, the first and the last frame of the "
                       "output counted from 0, such as 0-99",
                       job->frames);
    int per_frame = wf_raster_fields_per_frame(&job->raster);
    plan->first_field = first * per_frame;
    plan->end_field = end * per_frame;
    double each = wf_ratio_value(plan->shown_rate) / wf_ratio_value(job->raster.frame_rate);
    double frames = floor(WF_PLAN_MOST / each);
    if ((double)(end - first) <= frames || end - first == 1) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--frames %.200s: a plan has room for %d subframes, which is %.0f frames at "
                   "this rate; plan in parts, such as --frames %" PRId64 "-%" PRId64,
                   job->frames, WF_PLAN_MOST, frames, first,
                   first + (frames < 1 ? 0 : (int64_t)frames - 1));
}

/* ---- Pictures ---- */

/* The whole multiple of half the raster's lines that is nearest. */
static int whole_lines(const wf_raster *raster, int asked) {
    int half = raster->lines % 2 ? raster->lines : raster->lines / 2;
    int times = (asked + half / 2) / half;
    return half * (times < 1 ? 1 : times);
}

static weft_status settle_size(wf_plan *plan, weft_error *err) {
    const weft_job *job = &plan->job;
    const wf_raster *raster = &job->raster;
    int asked = job->render_lines;
    plan->width_px = job->render_width ? job->render_width : raster->width_px;
    plan->lines = asked ? whole_lines(raster, asked) : raster->lines;
    if (asked && plan->lines != asked)
        wf_job_warn(job,
                    "--size %dx%d: %d lines are no whole multiple of half the %d of %s, and "
                    "would leave a residue of flicker; planned is %dx%d",
                    plan->width_px, asked, asked, raster->lines, raster->name, plan->width_px,
                    plan->lines);
    wf_rational across = wf_ratio(raster->width_px, plan->width_px);
    wf_rational down = wf_ratio(plan->lines, raster->lines);
    plan->pixel_aspect = wf_ratio_mul(raster->pixel_aspect, wf_ratio_mul(across, down));
    if (wf_ratio_given(plan->pixel_aspect)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--size %dx%d: its pixels have no aspect that fits",
                   plan->width_px, plan->lines);
}

/* As convert has them, with a sequence that has no end. */
static weft_status make_resampler(wf_plan *plan, weft_error *err) {
    const wf_image_info picture = {.display = {0, 0, plan->width_px, plan->lines},
                                   .data = {0, 0, plan->width_px, plan->lines},
                                   .pixel_aspect = wf_ratio_value(plan->pixel_aspect)};
    const wf_resample_desc desc =
        wf_describe_fields(&plan->job, &picture, plan->shown_rate, INT64_C(1) << 40);
    char why[512];
    if (!wf_resampler_new(&desc, &plan->resampler, why, sizeof why))
        return wf_fail(err, WEFT_USAGE, "%s", why);
    wf_cells reach = wf_resampler_reach(plan->resampler);
    plan->reach = (wf_box){reach.x0, reach.y0, reach.x1, reach.y1};
    return WEFT_OK;
}

/* ---- Subframes ---- */

/* Tells of every number that some field needs, ascending, to `to` (NULL: only counts them). */
static size_t walk(const wf_plan *plan, wf_plan_subframe *to) {
    size_t count = 0;
    int64_t next = 0;
    const wf_box whole = {0, 0, plan->width_px, plan->lines};
    for (int64_t n = plan->first_field; n < plan->end_field; n++) {
        wf_window window = wf_resampler_window(plan->resampler, n);
        int64_t end = window.first + window.count;
        for (next = next > window.first ? next : window.first; next < end; next++, count++)
            if (to) to[count] = (wf_plan_subframe){next, whole};
    }
    return count;
}

static weft_status list_subframes(wf_plan *plan, weft_error *err) {
    plan->count = walk(plan, NULL);
    if (plan->count > WF_PLAN_MOST)
        return wf_fail(err, WEFT_USAGE,
                       "%zu subframes are more than a plan has room for, which is %d; take a "
                       "lower --subframe-rate, or fewer --frames",
                       plan->count, WF_PLAN_MOST);
    plan->subframe = malloc((plan->count + 1) * sizeof *plan->subframe);
    if (!plan->subframe)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for %zu subframes", plan->count);
    walk(plan, plan->subframe);
    return WEFT_OK;
}

/* How many equal subframes have the noise of a field's weights: 1 / sum of their squares. */
static double together(const wf_plan *plan, int64_t field) {
    wf_window window = wf_resampler_window(plan->resampler, field);
    double squares = 0;
    for (int64_t k = window.first; k < window.first + window.count; k++) {
        double share = wf_resampler_share(plan->resampler, field, 0, k);
        squares += share * share;
    }
    return squares > 0 ? 1 / squares : 1;
}

/* Where rates do not go into each other, the field with the fewest decides. */
enum { FIELDS_LOOKED_AT = 1000 };

static void settle_samples(wf_plan *plan) {
    const wf_raster *raster = &plan->job.raster;
    int64_t end = plan->first_field + FIELDS_LOOKED_AT;
    double fewest = INFINITY;
    for (int64_t n = plan->first_field; n < plan->end_field && n < end; n++)
        fewest = fmin(fewest, together(plan, n));
    double pixels = (double)raster->width_px * raster->lines / plan->width_px / plan->lines;
    double samples = (double)plan->job.samples_a_pixel * pixels / fewest;
    plan->samples = plan->job.samples_a_pixel ? (int64_t)ceil(samples - 1e-6) : 0;
    if (plan->job.samples_a_pixel && plan->samples < 1) plan->samples = 1;
}

/* Of an instant one subframe a field is all that is seen. */
static void warn_of_width(const wf_plan *plan) {
    wf_resampler *rs = plan->resampler;
    int64_t second = plan->first_field + 1;
    wf_window here = wf_resampler_window(rs, plan->first_field);
    if (!here.alone || wf_resampler_window(rs, second).first <= here.first + 1) return;
    char rate[48];
    wf_job_warn(
        &plan->job,
        "fields of no width see one subframe each: %zu are planned, and --subframe-rate "
        "%s would number them one after the other",
        plan->count, wf_rate_text(field_rate(plan), rate));
}

weft_status wf_plan_make(const weft_job *job, wf_plan *plan, weft_error *err) {
    *plan = (wf_plan){.job = *job,
                      .asked = job,
                      .rate = job->subframe_rate,
                      .shown_rate = job->subframe_rate};
    weft_status status = wf_job_check_time(job, err);
    if (status) return status;
    if (wf_ratio_given(job->error) && !job->refine)
        return wf_fail(
            err, WEFT_USAGE,
            "--error: a plan has no error before anything is rendered; give --refine "
            "DIR too, the folder that subframes are rendered into, which may be empty");
    wf_job_settle(&plan->job);
    status = settle_rate(plan, err);
    if (!status) status = settle_frames(plan, err);
    if (!status) status = settle_size(plan, err);
    if (!status) status = make_resampler(plan, err);
    if (!status) status = list_subframes(plan, err);
    if (status) return status;
    settle_samples(plan);
    if (job->refine) return wf_plan_refine(plan, err);
    warn_of_width(plan);
    return WEFT_OK;
}
