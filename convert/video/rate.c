/* Pictures a second of video, from what it states and from its timestamps. */
#include "convert/video/rate.h"

#include <inttypes.h>
#include <stdlib.h>

/* More pictures a second than any camera takes, and fewer than any video has. */
#define MOST_RATE  1000000.0
#define LEAST_RATE 0.001

__extension__ typedef __int128 wide;

bool wf_video_in_step(const wf_video_info *info, wf_rational rate, int64_t picture,
                      int64_t ticks) {
    /* picture / rate in ticks is picture num / den. */
    wide num = (wide)rate.den * info->tick_s.den, den = (wide)rate.num * info->tick_s.num;
    wide off = (wide)ticks * den - picture * num;
    return off <= den && off >= -den;
}

/* Whether picture k is within a tick of k / rate for all k. */
static bool fits(const wf_video_info *info, wf_rational rate) {
    for (int64_t k = 0; k < info->frames; k++)
        if (!wf_video_in_step(info, rate, k, info->times[k] - info->times[0])) return false;
    return true;
}

static wf_rational mean_rate(const wf_video_info *info) {
    int64_t last = info->frames - 1, ticks = info->times[last] - info->times[0];
    if (ticks < 1) return (wf_rational){0, 0};
    return wf_ratio_div(wf_ratio(last, ticks), info->tick_s);
}

/* Rates in use that lie within a thousandth of the mean; with a little luck one of them is what
 * was meant. */
static bool find_usual(const wf_video_info *info, wf_rational mean, wf_rational *rate) {
    double value = wf_ratio_value(mean);
    int64_t near = (int64_t)(value + 0.5);
    const wf_rational usual[] = {wf_ratio(near, 1), wf_ratio(near * 1000, 1001)};
    for (size_t i = 0; near && i < sizeof usual / sizeof *usual; i++)
        if (fits(info, usual[i])) {
            *rate = usual[i];
            return true;
        }
    return false;
}

static weft_status check(const char *path, wf_rational rate, weft_error *err) {
    double value = wf_ratio_given(rate) && rate.num > 0 ? wf_ratio_value(rate) : 0;
    if (value == 0)
        return wf_fail(err, WEFT_USAGE,
                       "%s: it does not say how many pictures a second it has; give "
                       "--subframe-rate, such as 50 or 60000/1001",
                       path);
    if (value >= LEAST_RATE && value <= MOST_RATE) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: it says that it has %" PRId64 "/%" PRId64
                   " pictures a second, which cannot be; say how many by --subframe-rate",
                   path, rate.num, rate.den);
}

weft_status wf_video_rate(const wf_video_info *info, const char *path, wf_rational *rate,
                          weft_error *err) {
    *rate = info->rate;
    if (!info->times || info->frames < 2) return check(path, *rate, err);
    weft_status status = check(path, *rate, NULL);
    if (!status && fits(info, *rate)) return WEFT_OK;
    wf_rational mean = mean_rate(info);
    if (!check(path, mean, NULL) && find_usual(info, mean, rate)) return WEFT_OK;
    *rate = mean;
    if (!check(path, mean, NULL) && fits(info, mean)) return WEFT_OK;
    *rate = (wf_rational){0, 0};
    return WEFT_OK;
}

/* ---- Pictures that last unequally long ---- */

static weft_status refuse_back(const wf_video_info *info, const char *path, weft_error *err) {
    double rate = wf_ratio_given(info->rate) ? wf_ratio_value(info->rate) : 0;
    return wf_fail(
        err, WEFT_FAILED,
        "%s: its timestamps run backwards or begin again before picture %" PRId64
        " (%.3f s); cut the video there, or give --subframe-rate to take all pictures "
        "as equally long",
        path, info->back, rate > 0 ? (double)info->back / rate : 0);
}

static weft_status check_length(const wf_video_info *info, const char *path, int64_t k,
                                weft_error *err) {
    double tick_s = wf_ratio_value(info->tick_s);
    double lasts_s = (double)(info->times[k] - info->times[k - 1]) * tick_s;
    if (lasts_s <= WF_LONGEST_SHOWN_S) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "%s: picture %" PRId64 ", at %.3f s, would be shown for %.0f s: a timestamp is "
        "damaged; give --subframe-rate to take all pictures as equally long",
        path, k - 1, (double)(info->times[k - 1] - info->times[0]) * tick_s, lasts_s);
}

static weft_status check_order(const wf_video_info *info, const char *path, weft_error *err) {
    if (info->back) return refuse_back(info, path, err);
    weft_status status = WEFT_OK;
    for (int64_t k = 1; !status && k < info->frames; k++) {
        double at_s = (double)(info->times[k] - info->times[0]) * wf_ratio_value(info->tick_s);
        if (info->times[k] <= info->times[k - 1])
            return wf_fail(
                err, WEFT_FAILED,
                "%s: pictures %" PRId64 " and %" PRId64
                " are both shown at %.3f s; write its timestamps again, such as with "
                "ffmpeg -i IN -vf fps=120 -c:v ffv1 OUT.mkv, or give --subframe-rate "
                "to take all pictures as equally long",
                path, k - 1, k, at_s);
        status = check_length(info, path, k, err);
    }
    return status;
}

/* When a picture begins, in ticks; those beyond the last are as far apart as the last lasts. */
static int64_t begins(const wf_video_info *info, int64_t picture) {
    int64_t last = info->frames - 1, lasts = info->last_ticks;
    if (picture <= last) return info->times[picture];
    if (!lasts) lasts = last ? info->times[last] - info->times[last - 1] : 1;
    return info->times[last] + lasts;
}

weft_status wf_video_shown(const wf_video_info *info, const char *path, int64_t first,
                           int64_t step, int64_t count, wf_rational **times_s,
                           weft_error *err) {
    weft_status status = check_order(info, path, err);
    if (status) return status;
    *times_s = malloc((size_t)(count + 1) * sizeof **times_s);
    if (!*times_s) return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for its times", path);
    for (int64_t u = 0; u <= count; u++) {
        int64_t ticks = begins(info, first + u * step) - info->times[first];
        (*times_s)[u] = wf_ratio_mul(wf_ratio(ticks, 1), info->tick_s);
    }
    return WEFT_OK;
}
