/* The parts of the public interface that only wrap: versions, apertures, rasters. */
#include <math.h>

#include "convert/base/fail.h"
#include "convert/job/raster_tell.h"
#include "filters/aperture/aperture.h"
#include "filters/raster/raster.h"

const char *weft_version(void) {
    return WEFT_VERSION;
}

const char *weft_aperture_name(size_t index) {
    const wf_aperture_kind *kind = wf_aperture_at(index);
    return kind ? kind->name : NULL;
}

weft_status weft_aperture_response(const char *aperture, double tau_fields, double fx,
                                   double fy, double ft, double *response, weft_error *err) {
    wf_aperture parsed;
    char why[512];
    if (!wf_aperture_parse(aperture, &parsed, why, sizeof why))
        return wf_fail(err, WEFT_USAGE, "%s", why);
    if (!isfinite(tau_fields) || !isfinite(fx) || !isfinite(fy) || !isfinite(ft))
        return wf_fail(err, WEFT_USAGE,
                       "a response needs finite frequencies and width; these are "
                       "fx %g, fy %g, ft %g, tau %g",
                       fx, fy, ft, tau_fields);
    double tau = tau_fields < 0 ? wf_ratio_value(parsed.kind->default_width) : tau_fields;
    *response = wf_response(&parsed, tau, fx, fy, ft);
    return WEFT_OK;
}

bool weft_raster_at(size_t index, weft_raster *out) {
    const wf_raster *raster = wf_raster_at(index);
    if (raster) wf_raster_tell(raster, out);
    return raster != NULL;
}

weft_status weft_raster_parse(const char *text, weft_raster *out, weft_error *err) {
    wf_raster raster;
    char why[512];
    if (!wf_raster_parse(text, &raster, why, sizeof why))
        return wf_fail(err, WEFT_USAGE, "%s", why);
    wf_raster_tell(&raster, out);
    return WEFT_OK;
}
