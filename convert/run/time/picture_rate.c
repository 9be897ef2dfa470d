/* Pictures a second, held against what a raster shows. */
#include "convert/run/time/picture_rate.h"

#include <string.h>

#include "convert/read/rate.h"

static bool is_whole(wf_rational r) {
    return wf_ratio_given(r) && r.den == 1;
}

static weft_status refuse_rate(const weft_job *job, const char *what, wf_rational given,
                               weft_error *err) {
    char text[48];
    if (!wf_ratio_given(given))
        return wf_fail(
            err, WEFT_USAGE,
            "%s: --cadence 2:3 takes film at an even rate, and its %s have irregular "
            "times",
            job->inputs[0], what);
    return wf_fail(err, WEFT_USAGE,
                   "%s: --cadence 2:3 takes film, 24 or 23.976 frames a second of one %.*s or "
                   "more, such as 192, and not %s %s a second",
                   job->inputs[0], (int)strlen(what) - 1, what, wf_rate_text(given, text),
                   what);
}

weft_status wf_settle_film(const weft_job *job, const char *what, wf_rational *rate,
                           weft_error *err) {
    const wf_rational speeds[] = {{1, 1}, {1000, 1001}, {1001, 1000}}, given = *rate;
    wf_rational film = wf_raster_film_rate(&job->raster);
    char from[48], to[48], shown[48];
    for (size_t i = 0; wf_ratio_given(given) && i < sizeof speeds / sizeof *speeds; i++) {
        *rate = wf_ratio_mul(given, speeds[i]);
        if (!is_whole(wf_ratio_div(*rate, film))) continue;
        if (i)
            wf_job_warn(job,
                        "%s %s a second run at %s, since %s shows film at %s frames a second",
                        wf_rate_text(given, from), what, wf_rate_text(*rate, to),
                        job->raster.name, wf_rate_text(film, shown));
        return WEFT_OK;
    }
    return refuse_rate(job, what, given, err);
}

void wf_warn_of_few(const weft_job *job, double pictures_a_second) {
    const wf_raster *raster = &job->raster;
    double shown = 1 / wf_ratio_value(wf_raster_field_period(raster));
    bool fields = raster->scan == WF_INTERLACED;
    if (pictures_a_second > shown * (1 - 1e-9)) return;
    wf_job_warn(job, "%s: %.6g pictures a second are fewer than the %.6g %s of %s: %s repeat",
                job->inputs[0], pictures_a_second, shown,
                raster->pulldown ? "film frames"
                : fields         ? "fields"
                                 : "frames",
                raster->name, fields ? "fields" : "frames");
}
