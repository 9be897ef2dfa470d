/* A job settled: how flicker is weighed and bounded, and in which light. */
#include <math.h>

#include "convert/finish/setup.h"
#include "convert/job/colors.h"

/* Light of white is 203 cd/m2 in PQ and HLG alone. */
static wf_viewing viewing_of(const weft_job *job, const wf_raster *raster,
                             const wf_displayed *shown) {
    bool high = shown->encoded && shown->transfer != WF_TRANSFER_BT1886;
    return (wf_viewing){.distance_heights = wf_ratio_given(job->view_distance)
                                                ? wf_ratio_value(job->view_distance)
                                                : wf_viewing_usual_heights(raster->lines),
                        .white_cd_m2 = wf_ratio_given(job->peak)
                                           ? wf_ratio_value(job->peak)
                                           : wf_viewing_usual_white_cd_m2(high),
                        .hz = wf_ratio_value(raster->frame_rate),
                        .width_px = raster->width_px,
                        .lines = raster->lines,
                        .pixel_aspect = wf_ratio_value(raster->pixel_aspect)};
}

static wf_nearest_desc describe(const weft_job *job, const wf_raster *raster) {
    bool limited = wf_ratio_given(job->flicker_limit);
    return (wf_nearest_desc){.held = wf_job_holds_flicker(job),
                             .weight = wf_job_flicker_weight(job),
                             .limit = limited ? wf_ratio_value(job->flicker_limit) : HUGE_VAL,
                             .limit_is_seen = limited && job->limit_is_seen,
                             .channels = wf_job_writes_alpha(job),
                             .raster = raster};
}

wf_nearest_desc wf_setup_flicker_of_light(const weft_job *job, const wf_raster *raster) {
    wf_nearest_desc desc = describe(job, raster);
    desc.shown = wf_displayed_of_light(&wf_chromaticities_of[WF_PRIMARIES_709]);
    desc.viewing = viewing_of(job, raster, &desc.shown);
    return desc;
}

static wf_displayed shown_of_codes(const wf_setup *s, const wf_space *space) {
    const wf_curve *curve = space ? space->curve : NULL;
    if (curve == &wf_curve_pq) return wf_displayed_of_codes(space->primaries, WF_TRANSFER_PQ);
    if (curve == &wf_curve_hlg) return wf_displayed_of_codes(space->primaries, WF_TRANSFER_HLG);
    return wf_displayed_of_codes(wf_colors_of(s->raster.matrix)->primaries, WF_TRANSFER_BT1886);
}

/* Of OpenEXR that is not asked for another space, and of linear ones, it is light itself. */
void wf_setup_flicker(const weft_job *job, wf_setup *s) {
    char why[900];
    const wf_space *space = wf_space_find(s->color_space, why, sizeof why);
    bool linear = s->output.kind->layout == WF_LINEAR,
         asked = job->to || job->display || job->look;
    s->flicker = describe(job, &s->made);
    if (linear && !asked)
        s->flicker.shown = wf_displayed_of_light(s->output_options.primaries
                                                     ? s->output_options.primaries
                                                     : &wf_chromaticities_of[WF_PRIMARIES_709]);
    else if (space && !space->curve)
        s->flicker.shown = wf_displayed_of_light(&wf_chromaticities_of[space->primaries]);
    else
        s->flicker.shown = shown_of_codes(s, space);
    s->flicker.viewing = viewing_of(job, &s->raster, &s->flicker.shown);
}
