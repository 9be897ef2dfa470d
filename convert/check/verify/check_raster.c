/* Checks: what the file says of its pictures, against its raster. */
#include "convert/check/verify/check_raster.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static void tell_raster(const wf_raster *r, char *text, size_t size) {
    snprintf(text, size, "%s: %dx%d at %.6g, %s", r->name, r->width_px, r->lines,
             wf_ratio_value(r->frame_rate), wf_raster_order(r));
}

wf_verdict wf_check_raster(const wf_subject *s, wf_finding *f) {
    char is[120];
    const wf_raster *r = &s->figures.info.raster;
    tell_raster(s->raster_known ? &s->raster : r, is, sizeof is);
    return wf_say(f, s->raster_known, is,
                  "one of those that 'weft rasters' lists, or --raster says what it is");
}

wf_verdict wf_check_size(const wf_subject *s, wf_finding *f) {
    char is[32], should[32];
    const wf_video_info *v = &s->figures.info;
    snprintf(is, sizeof is, "%dx%d", v->width_px, v->lines + v->interval_lines);
    snprintf(should, sizeof should, "%dx%d", s->raster.width_px, s->coded_lines);
    return wf_say(f, !strcmp(is, should), is, should);
}

wf_verdict wf_check_rate(const wf_subject *s, wf_finding *f) {
    char is[48], should[48];
    wf_rational rate = s->figures.info.raster.frame_rate, want = s->raster.frame_rate;
    snprintf(is, sizeof is, "%" PRId64 "/%" PRId64, rate.num, rate.den);
    snprintf(should, sizeof should, "%" PRId64 "/%" PRId64, want.num, want.den);
    return wf_say(f, wf_ratio_equal(rate, want), is, should);
}

static const char *order_text(bool interlaced, bool top_first) {
    return !interlaced ? "progressive" : top_first ? "top first" : "bottom first";
}

static const char *wanted_order(const wf_subject *s) {
    return order_text(s->raster.scan == WF_INTERLACED, s->raster.top_first);
}

/* Progressive pictures may go without saying so; fields do not. Film with repeated fields is
 * progressive pictures in the fields of its raster. */
wf_verdict wf_check_flags(const wf_subject *s, wf_finding *f) {
    const wf_video_info *v = &s->figures.info;
    bool known = s->contained ? s->metadata.scan_known : v->scan_known;
    bool interlaced = s->contained ? s->metadata.interlaced : v->raster.scan == WF_INTERLACED;
    bool top_first = s->contained ? s->metadata.top_first : v->raster.top_first;
    const char *is = known ? order_text(interlaced, top_first) : "not said";
    if (!known && s->raster.scan != WF_INTERLACED) return wf_open_question(f, is);
    if (s->contained && s->metadata.there.repeated)
        return wf_open_question(f, "progressive, with repeated fields");
    return wf_say(f, !strcmp(is, wanted_order(s)), is, wanted_order(s));
}

/* Frames of an interlaced stream may be coded as progressive; those coded as fields have its
 * order. */
wf_verdict wf_check_coded(const wf_subject *s, wf_finding *f) {
    const char *is = order_text(s->metadata.coded_fields, s->metadata.coded_top_first);
    if (!s->metadata.coded_fields || !s->metadata.interlaced)
        return wf_open_question(f, "the first frame is not coded as fields");
    const char *said = order_text(true, s->metadata.top_first);
    return wf_say(f, !strcmp(is, said), is, said);
}

static bool of_601(const wf_raster *r) {
    return r->matrix == WF_601_525 || r->matrix == WF_601_625;
}

/* MXF has the aspect of the picture: 4:3 or 16:9 of 601, though its pixels do not come to that
 * exactly. */
static wf_rational picture_aspect(const wf_raster *r) {
    bool narrow = wf_ratio_value(r->pixel_aspect) < 1.15;
    if (of_601(r) && r->total_lines) return narrow ? wf_ratio(4, 3) : wf_ratio(16, 9);
    return wf_ratio(r->width_px * r->pixel_aspect.num, r->lines * r->pixel_aspect.den);
}

/* Pixels that others give to 4:3 pictures of 601: of 704, 702, 711 or all 720 samples of a
 * line. Of 16:9 they are 4/3 as wide. */
static const struct {
    int lines;
    wf_rational pixel;
} narrow_pixels[] = {
    {480, {10, 11}}, {480, {8, 9}},   {480, {9, 10}},  {480, {4320, 4739}}, {480, {160, 177}},
    {486, {10, 11}}, {486, {9, 10}},  {486, {8, 9}},   {486, {4320, 4739}}, {486, {160, 177}},
    {576, {12, 11}}, {576, {16, 15}}, {576, {59, 54}}, {576, {128, 117}},
};

/* Whether another maker means the raster's shape by these pixels. Some give the picture's shape
 * to all lines of D-10, those of the vertical interval too. */
static bool is_customary(const wf_subject *s, wf_rational have) {
    bool wide = wf_ratio_value(s->raster.pixel_aspect) > 1.15;
    int64_t above = s->figures.info.interval_lines;
    if (!of_601(&s->raster) || s->raster.width_px != 720) return false;
    wf_rational all = wf_ratio_mul(picture_aspect(&s->raster),
                                   wf_ratio(s->raster.lines + above, s->raster.width_px));
    if (above && wf_ratio_equal(have, all)) return true;
    for (size_t i = 0; i < sizeof narrow_pixels / sizeof *narrow_pixels; i++) {
        wf_rational pixel = narrow_pixels[i].pixel;
        if (wide) pixel = wf_ratio(4 * pixel.num, 3 * pixel.den);
        if (narrow_pixels[i].lines == s->raster.lines && wf_ratio_equal(have, pixel))
            return true;
    }
    return false;
}

wf_verdict wf_check_aspect(const wf_subject *s, wf_finding *f) {
    char is[32] = "none", should[48];
    bool mxf = s->contained && !strcmp(s->metadata.container, "mxf");
    wf_rational want = s->raster.pixel_aspect, have = s->metadata.pixel_aspect;
    if (mxf) {
        want = picture_aspect(&s->raster);
        have = s->metadata.aspect;
    } else if (!s->contained) {
        have = s->figures.info.raster.pixel_aspect;
    }
    if (have.den) snprintf(is, sizeof is, "%" PRId64 ":%" PRId64, have.num, have.den);
    snprintf(should, sizeof should, "%" PRId64 ":%" PRId64, want.num, want.den);
    if (have.den && !wf_ratio_equal(have, want) && is_customary(s, have))
        return wf_open_question(f, is);
    bool square = !have.den && want.num == want.den; /* what is not said is 1:1 */
    return wf_say(f, square || (have.den && wf_ratio_equal(have, want)), is, should);
}

static bool same_tags(wf_color_tags a, wf_color_tags b) {
    bool both_601 = (a.matrix == 5 || a.matrix == 6) && (b.matrix == 5 || b.matrix == 6);
    /* 1, 6, 14 and 15 are one curve (Rec. ITU-T H.273). */
    bool one_curve =
        (a.transfer == 1 || a.transfer == 6 || a.transfer == 14 || a.transfer == 15) &&
        (b.transfer == 1 || b.transfer == 6 || b.transfer == 14);
    return a.primaries == b.primaries && (a.transfer == b.transfer || one_curve) &&
           (a.matrix == b.matrix || both_601);
}

wf_verdict wf_check_colors(const wf_subject *s, wf_finding *f) {
    static const char *const spaces[] = {"", "rec2100-pq", "rec2100-hlg"};
    char is[48] = "not said", should[48];
    wf_color_tags have = s->metadata.tags, own = wf_color_tags_of("", s->raster.matrix);
    bool right = false;
    if (!s->metadata.tagged && !s->profile && !s->raster_asked) return wf_open_question(f, is);
    if (s->metadata.tagged)
        snprintf(is, sizeof is, "%d-%d-%d", have.primaries, have.transfer, have.matrix);
    snprintf(should, sizeof should, "%d-%d-%d (%s)", own.primaries, own.transfer, own.matrix,
             wf_colors_of(s->raster.matrix)->space);
    for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++)
        right |= s->metadata.tagged &&
                 same_tags(have, wf_color_tags_of(spaces[i], s->raster.matrix));
    /* 625 lines were made for a display of gamma 2.8, and some call them so. */
    bool of_old = own.primaries == 5 && have.primaries == 5 && have.transfer == 5;
    if (!right && of_old && s->metadata.tagged) return wf_open_question(f, is);
    return wf_say(f, right, is, should);
}
