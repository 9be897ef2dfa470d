/* Checks: what is in the pixels, whatever the file says. */
#include "convert/check/verify/check_pixels.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "color/codes/r103.h"

wf_verdict wf_check_order(const wf_subject *s, wf_finding *f) {
    const char *is = s->figures.order_verdict;
    bool fields = s->raster.scan == WF_INTERLACED;
    if (!is) return wf_open_question(f, "a single frame has none");
    bool ordered = !strcmp(is, "tff") || !strcmp(is, "bff");
    if (!strcmp(is, "open") || (!ordered && fields)) return wf_open_question(f, is);
    bool right = fields ? !strcmp(is, s->raster.top_first ? "tff" : "bff") : !ordered;
    return wf_say(f, right, is, fields ? (s->raster.top_first ? "tff" : "bff") : "progressive");
}

wf_verdict wf_check_reading(const wf_subject *s, wf_finding *f) {
    char is[64];
    snprintf(is, sizeof is, "%" PRId64 " frames", s->figures.frames);
    return wf_say(f, !s->trouble, s->trouble ? s->trouble : is, "frames to the end");
}

wf_verdict wf_check_levels(const wf_subject *s, wf_finding *f) {
    char is[64];
    snprintf(is, sizeof is, "%.3g %% of the picture is outside EBU R 103",
             100 * s->figures.r103_share);
    return wf_say(f, s->figures.r103_share <= WF_R103_SHARE, is,
                  "at most 1 %, which --legalize r103 of convert makes");
}

/* Codecs that lose something overshoot, and what receives them clips. */
wf_verdict wf_check_reserved(const wf_subject *s, wf_finding *f) {
    char is[64];
    double share = s->figures.reserved_share;
    bool exact = !s->contained || wf_in_words("v210 ffv1 rawvideo", s->metadata.codec);
    snprintf(is, sizeof is, "%.3g %% of the picture%s", 100 * share,
             exact ? "" : ", as it is decoded");
    return share > 0 && !exact ? wf_open_question(f, is) : wf_say(f, share <= 0, is, "none");
}
