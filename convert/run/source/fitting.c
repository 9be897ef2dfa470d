/* Where a picture lies on the raster: its size, the shape of its pixels, and how it is fitted.
 */
#include "convert/run/source/fitting.h"

#include <inttypes.h>
#include <math.h>

#include "convert/finish/setup.h"

/* The simplest ratio within float32's accuracy of value: files hold 10:11 as 0.909090936. */
static wf_rational simplest_ratio(double value) {
    int64_t num[2] = {1, 0}, den[2] = {0, 1};
    double rest = value;
    for (int step = 0; step < 16; step++) {
        int64_t whole = (int64_t)floor(rest);
        int64_t n = whole * num[0] + num[1], d = whole * den[0] + den[1];
        num[1] = num[0], num[0] = n;
        den[1] = den[0], den[0] = d;
        if (fabs((double)n / (double)d - value) <= 2e-7 * value) break;
        rest = 1 / (rest - (double)whole);
    }
    return wf_ratio(num[0], den[0]);
}

static wf_rational input_pixel_aspect(const weft_job *job, const wf_image_info *first) {
    if (wf_ratio_given(job->input_par)) return job->input_par;
    double aspect = first->pixel_aspect;
    return aspect > 1e-3 && aspect < 1e3 ? simplest_ratio(aspect) : wf_ratio(1, 1);
}

static void warn_of_aspect(const weft_job *job, const wf_image_info *first, wf_rational par) {
    double width = first->display.x1 - first->display.x0;
    double height = first->display.y1 - first->display.y0;
    double input = width / height * wf_ratio_value(par);
    double raster = (double)job->raster.width_px / job->raster.lines *
                    wf_ratio_value(job->raster.pixel_aspect);
    if (job->fit == WF_FIT_STRETCH && fabs(input / raster - 1) > 0.01)
        wf_job_warn(
            job,
            "the input's picture is %.4f:1 (%.0fx%.0f, pixels %" PRId64 ":%" PRId64
            ") and the raster's %.4f:1 (%s): it will be stretched; --input-par says what "
            "the input's pixels are, --fit crop or pad keeps its shape",
            input, width, height, par.num, par.den, raster, job->raster.name);
}

/* Crop and pad give cells one scale for both axes, in the shape of the pixels. */
static void fit_evenly(const weft_job *job, wf_rational par, wf_fitting *x, wf_fitting *y) {
    wf_rational shape = wf_ratio_div(par, job->raster.pixel_aspect);
    wf_rational by_height = y->cell, by_width = wf_ratio_div(x->cell, shape);
    bool width_larger = wf_ratio_value(by_width) > wf_ratio_value(by_height);
    bool take_width = width_larger == (job->fit == WF_FIT_CROP);
    y->cell = take_width ? by_width : by_height;
    x->cell = wf_ratio_mul(y->cell, shape);
    x->padded = y->padded = job->fit == WF_FIT_PAD;
}

void wf_fit_picture(const weft_job *job, const wf_image_info *first, wf_fitting *x,
                    wf_fitting *y) {
    wf_rational par = input_pixel_aspect(job, first);
    *x = (wf_fitting){.pixels = job->raster.width_px,
                      .cells = first->display.x1 - first->display.x0};
    *y = (wf_fitting){.pixels = job->raster.lines,
                      .cells = first->display.y1 - first->display.y0};
    x->cell = wf_ratio(x->pixels, x->cells);
    y->cell = wf_ratio(y->pixels, y->cells);
    warn_of_aspect(job, first, par);
    if (job->fit != WF_FIT_STRETCH) fit_evenly(job, par, x, y);
}

wf_resample_desc wf_describe_fields(const weft_job *job, const wf_image_info *first,
                                    wf_rational rate, int64_t pictures) {
    wf_resample_desc desc = {
        .raster = &job->raster,
        .aperture = job->aperture,
        .timing = {.raster = &job->raster,
                   .subframe_rate = rate,
                   .subframe_center = job->subframe_time_center,
                   .subframes = pictures,
                   .width = wf_setup_width(job),
                   .position = job->shutter_position,
                   .skew = wf_ratio_given(job->scan_skew) ? job->scan_skew : wf_ratio(0, 1)},
        .channels = 3,
        .background = {job->background[0], job->background[1], job->background[2]},
        .band_rows = 16,
    };
    wf_fit_picture(job, first, &desc.x, &desc.y);
    return desc;
}

weft_status wf_fit_frames(wf_run *run, const wf_resample_desc *desc, int64_t frames,
                          int64_t *end_field, wf_resampler **out, weft_error *err) {
    char why[512];
    weft_status status = wf_setup_chosen_frames(run->job, &run->setup, frames, err);
    if (status) return status;
    *end_field = frames * wf_raster_fields_per_frame(&run->job->raster);
    if (!wf_resampler_new(desc, out, why, sizeof why))
        return wf_fail(err, WEFT_FAILED, "%s", why);
    return WEFT_OK;
}
