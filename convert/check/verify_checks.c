/* The table of checks. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "color/codes/r103.h"
#include "convert/check/verify_checks.h"
#include "convert/job/timecode.h"
#include "convert/media/container.h"


wf_verdict wf_say(wf_finding *f, bool right, const char *is, const char *should) {
    snprintf(f->is, sizeof f->is, "%s", is);
    snprintf(f->should, sizeof f->should, "%s", right ? "" : should);
    return right ? WF_RIGHT : WF_WRONG;
}

wf_verdict wf_open_question(wf_finding *f, const char *is) {
    wf_say(f, true, is, "");
    return WF_OPEN;
}

/* ---- What the profile asks ---- */

bool wf_in_words(const char *words, const char *name) {
    size_t length = strlen(name);
    for (const char *w = words; *w; w += strspn(w, " ")) {
        size_t word = strcspn(w, " ");
        if (word == length && !strncmp(w, name, length)) return true;
        w += word;
    }
    return false;
}

static wf_verdict check_container(const wf_subject *s, wf_finding *f) {
    const char *is = s->contained ? s->metadata.container : "no container";
    return wf_say(f, !strcmp(is, s->profile->container), is, s->profile->container);
}

static wf_verdict check_codec(const wf_subject *s, wf_finding *f) {
    const char *is = s->contained ? s->metadata.codec : s->figures.info.format;
    return wf_say(f, !strcmp(is, s->profile->codec), is, s->profile->codec);
}

static wf_verdict check_bits(const wf_subject *s, wf_finding *f) {
    char is[16], should[16];
    snprintf(is, sizeof is, "%d", s->figures.info.bits);
    snprintf(should, sizeof should, "%d", s->profile->bits);
    return wf_say(f, s->figures.info.bits == s->profile->bits, is, should);
}

static wf_verdict check_channels(const wf_subject *s, wf_finding *f) {
    char is[64], should[64];
    snprintf(is, sizeof is, "%d channels", s->metadata.sound_channels);
    snprintf(should, sizeof should, "%d or more", s->profile->sound_channels);
    return wf_say(f, s->metadata.sound_channels >= s->profile->sound_channels, is, should);
}

static wf_verdict check_tracks(const wf_subject *s, wf_finding *f) {
    char is[16];
    snprintf(is, sizeof is, "%d", s->metadata.sound_channels);
    return wf_say(f, wf_in_words(s->profile->channels, is), is, s->profile->channels);
}

static wf_verdict check_sound_bits(const wf_subject *s, wf_finding *f) {
    char is[16], should[16];
    snprintf(is, sizeof is, "%d", s->metadata.sound_bits);
    snprintf(should, sizeof should, "%d", s->profile->sound_bits);
    return wf_say(f, s->metadata.sound_bits == s->profile->sound_bits, is, should);
}

static wf_verdict check_start(const wf_subject *s, wf_finding *f) {
    const char *is = *s->metadata.timecode ? s->metadata.timecode : "none";
    return wf_say(f, !strcmp(is, s->profile->start), is, s->profile->start);
}

/* ---- The raster ---- */

static void tell_raster(const wf_raster *r, char *text, size_t size) {
    snprintf(text, size, "%s: %dx%d at %.6g, %s", r->name, r->width_px, r->lines,
             wf_ratio_value(r->frame_rate), wf_raster_order(r));
}

static wf_verdict check_raster(const wf_subject *s, wf_finding *f) {
    char is[120];
    const wf_raster *r = &s->figures.info.raster;
    tell_raster(s->raster_known ? &s->raster : r, is, sizeof is);
    return wf_say(f, s->raster_known, is,
                  "one of those that 'weft rasters' lists, or --raster says what it is");
}

static wf_verdict check_size(const wf_subject *s, wf_finding *f) {
    char is[32], should[32];
    const wf_video_info *v = &s->figures.info;
    snprintf(is, sizeof is, "%dx%d", v->width_px, v->lines + v->interval_lines);
    snprintf(should, sizeof should, "%dx%d", s->raster.width_px, s->coded_lines);
    return wf_say(f, !strcmp(is, should), is, should);
}

static wf_verdict check_rate(const wf_subject *s, wf_finding *f) {
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

static wf_verdict check_flags(const wf_subject *s, wf_finding *f) {
    const wf_video_info *v = &s->figures.info;
    bool known = s->contained ? s->metadata.scan_known : v->scan_known;
    bool interlaced = s->contained ? s->metadata.interlaced : v->raster.scan == WF_INTERLACED;
    bool top_first = s->contained ? s->metadata.top_first : v->raster.top_first;
    const char *is = known ? order_text(interlaced, top_first) : "not said";
    return wf_say(f, !strcmp(is, wanted_order(s)), is, wanted_order(s));
}

/* Frames of an interlaced stream may be coded as progressive; those coded as fields have its
 * order. */
static wf_verdict check_coded(const wf_subject *s, wf_finding *f) {
    const char *is = order_text(s->metadata.coded_fields, s->metadata.coded_top_first);
    if (!s->metadata.coded_fields || !s->metadata.interlaced)
        return wf_open_question(f, "the first frame is not coded as fields");
    const char *said = order_text(true, s->metadata.top_first);
    return wf_say(f, !strcmp(is, said), is, said);
}

static wf_verdict check_order(const wf_subject *s, wf_finding *f) {
    const char *is = s->figures.order_verdict;
    bool fields = s->raster.scan == WF_INTERLACED;
    if (!is) return wf_open_question(f, "a single frame has none");
    bool ordered = !strcmp(is, "tff") || !strcmp(is, "bff");
    if (!ordered && fields) return wf_open_question(f, is);
    bool right = fields ? !strcmp(is, s->raster.top_first ? "tff" : "bff") : !ordered;
    return wf_say(f, right, is, fields ? (s->raster.top_first ? "tff" : "bff") : "progressive");
}

/* ---- What containers hold ---- */

static wf_verdict check_fiel(const wf_subject *s, wf_finding *f) {
    char is[32] = "none", should[32];
    bool interlaced = s->raster.scan == WF_INTERLACED;
    int detail = !interlaced ? 0 : s->raster.top_first ? 9 : 14;
    if (s->metadata.has_fiel)
        snprintf(is, sizeof is, "{%d,%d}", s->metadata.fiel[0], s->metadata.fiel[1]);
    snprintf(should, sizeof should, "{%d,%d}", interlaced ? 2 : 1, detail);
    bool left_out = !s->metadata.has_fiel && !interlaced;
    return wf_say(f, left_out || !strcmp(is, should), is, should);
}

static wf_verdict check_atoms(const wf_subject *s, wf_finding *f) {
    const wf_metadata *c = &s->metadata;
    char is[64];
    snprintf(is, sizeof is, "%s%s%s", c->has_pasp ? "pasp " : "", c->has_colr ? "colr " : "",
             c->has_clap ? "clap" : "");
    return wf_say(f, c->has_pasp && c->has_colr, *is ? is : "none", "pasp and colr");
}

static wf_verdict check_clap(const wf_subject *s, wf_finding *f) {
    char is[48], should[48];
    uint32_t width, lines;
    const int64_t *clean = s->metadata.clean;
    if (!s->metadata.has_clap) return wf_open_question(f, "none");
    wf_clean_aperture(&s->raster, &width, &lines);
    snprintf(is, sizeof is, "%.6gx%.6g", (double)clean[0] / 65536, (double)clean[1] / 65536);
    snprintf(should, sizeof should, "%ux%u", width, lines);
    return wf_say(f, !strcmp(is, should), is, should);
}

/* The raster's map, moved up by the lines that are coded above the picture. */
static wf_verdict check_line_map(const wf_subject *s, wf_finding *f) {
    char is[48] = "none", should[48];
    int above = (s->coded_lines - s->raster.lines) / 2;
    if (!s->raster.total_lines || s->raster.scan != WF_INTERLACED)
        return wf_open_question(f, "the raster has none");
    if (s->metadata.has_line_map)
        snprintf(is, sizeof is, "{%d,%d}", s->metadata.line_map[0], s->metadata.line_map[1]);
    snprintf(should, sizeof should, "{%d,%d}", s->raster.line1 - above,
             s->raster.line2 - above);
    return wf_say(f, !strcmp(is, should), is, should);
}

static wf_verdict check_layout(const wf_subject *s, wf_finding *f) {
    static const char *const names[] = {"full frame", "separate fields", "one field",
                                        "mixed fields", "segmented frame"};
    int layout = s->metadata.frame_layout;
    const char *is = layout >= 0 && layout < 5 ? names[layout] : "none";
    if (s->raster.scan == WF_INTERLACED)
        return wf_say(f, layout == 1 || layout == 3, is, "separate or mixed fields");
    bool segmented = s->raster.scan == WF_SEGMENTED && layout == 4;
    return wf_say(f, layout == 0 || segmented, is, "full frame");
}

static wf_verdict check_pattern(const wf_subject *s, wf_finding *f) {
    return wf_say(f, !strcmp(s->metadata.pattern, "OP1a"), s->metadata.pattern, "OP1a");
}

static wf_verdict check_dominance(const wf_subject *s, wf_finding *f) {
    char is[16];
    int first = s->metadata.dominance;
    if (first < 0) return wf_open_question(f, "not said");
    snprintf(is, sizeof is, "%d", first);
    return wf_say(f, first == 1, is, "1, as field 1 is the first in time");
}

static wf_verdict check_siting(const wf_subject *s, wf_finding *f) {
    char is[16];
    if (s->metadata.siting < 0) return wf_open_question(f, "not said");
    snprintf(is, sizeof is, "%d", s->metadata.siting);
    bool right = s->metadata.siting == 0 || s->metadata.siting == 4; /* 4: as Rec. 601 has it */
    return wf_say(f, right, is, "0, with the first luma sample of a pair");
}

static bool of_601(const wf_raster *r) {
    return r->matrix == WF_601_525 || r->matrix == WF_601_625;
}

static wf_verdict check_aspect(const wf_subject *s, wf_finding *f) {
    char is[32] = "none", should[48];
    bool mxf = s->contained && !strcmp(s->metadata.container, "mxf");
    wf_rational want = s->raster.pixel_aspect, have = s->metadata.pixel_aspect;
    if (mxf) { /* of the picture, not of a pixel */
        bool narrow = of_601(&s->raster) && wf_ratio_value(want) < 1.15;
        want = narrow ? wf_ratio(4, 3) : wf_ratio(16, 9);
        have = s->metadata.aspect;
    } else if (!s->contained) {
        have = s->figures.info.raster.pixel_aspect;
    }
    if (have.den) snprintf(is, sizeof is, "%" PRId64 ":%" PRId64, have.num, have.den);
    snprintf(should, sizeof should, "%" PRId64 ":%" PRId64, want.num, want.den);
    bool square = !have.den && want.num == want.den; /* what is not said is 1:1 */
    return wf_say(f, square || (have.den && wf_ratio_equal(have, want)), is, should);
}

static bool same_tags(wf_color_tags a, wf_color_tags b) {
    bool both_601 = (a.matrix == 5 || a.matrix == 6) && (b.matrix == 5 || b.matrix == 6);
    /* 1, 6, 14 and 15 are one curve (Rec. ITU-T H.273). */
    bool one_curve = (a.transfer == 1 || a.transfer == 6 || a.transfer > 13) &&
                     (b.transfer == 1 || b.transfer == 6 || b.transfer == 14);
    return a.primaries == b.primaries && (a.transfer == b.transfer || one_curve) &&
           (a.matrix == b.matrix || both_601);
}

static wf_verdict check_colors(const wf_subject *s, wf_finding *f) {
    static const char *const spaces[] = {"", "rec2100-pq", "rec2100-hlg"};
    char is[48] = "not said", should[48];
    wf_color_tags have = s->metadata.tags, own = wf_color_tags_of("", s->raster.matrix);
    bool right = false;
    if (s->metadata.tagged)
        snprintf(is, sizeof is, "%d-%d-%d", have.primaries, have.transfer, have.matrix);
    snprintf(should, sizeof should, "%d-%d-%d (%s)", own.primaries, own.transfer, own.matrix,
             wf_colors_of(s->raster.matrix)->space);
    for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++)
        right |= s->metadata.tagged &&
                 same_tags(have, wf_color_tags_of(spaces[i], s->raster.matrix));
    return wf_say(f, right, is, should);
}

/* ---- Pixels ---- */

static wf_verdict check_reading(const wf_subject *s, wf_finding *f) {
    char is[64];
    snprintf(is, sizeof is, "%" PRId64 " frames", s->figures.frames);
    return wf_say(f, !s->trouble, s->trouble ? s->trouble : is, "frames to the end");
}

static wf_verdict check_levels(const wf_subject *s, wf_finding *f) {
    char is[64];
    snprintf(is, sizeof is, "%.3g %% of the picture is outside EBU R 103",
             100 * s->figures.r103_share);
    return wf_say(f, s->figures.r103_share <= WF_R103_SHARE, is, "at most 1 %");
}

/* Codecs that lose something overshoot, and what receives them clips. */
static wf_verdict check_reserved(const wf_subject *s, wf_finding *f) {
    char is[64];
    double share = s->figures.reserved_share;
    bool exact = !s->contained || wf_in_words("v210 ffv1 rawvideo", s->metadata.codec);
    snprintf(is, sizeof is, "%.3g %% of the picture%s", 100 * share,
             exact ? "" : ", as it is decoded");
    return share > 0 && !exact ? wf_open_question(f, is) : wf_say(f, share <= 0, is, "none");
}

/* ---- The table ---- */

typedef enum applies {
    ALWAYS = 0,
    TO_PIXELS = 1, /* could be read */
    TO_RASTER = 2, /* it is known */
    TO_CONTAINER = 4,
    TO_MOV = 8,
    TO_MXF = 16,
    TO_SOUND = 32,
    TO_FIELDS = 64,
    TO_FILES = 128, /* of an image sequence */
} applies;

static const struct check {
    const char *name;
    unsigned needs;
    size_t profile; /* offset of the text or number it is asked by; 0: by every file */
    bool number;
    wf_check_fn *run;
    const char *by; /* what demands it; %s is the raster, or the profile's */
} checks[] = {
#define ASKED(member) offsetof(wf_profile, member)
    {"reading", ALWAYS, 0, false, check_reading, "its own header"},
    {"container", ALWAYS, ASKED(container), false, check_container, "%s"},
    {"codec", ALWAYS, ASKED(codec), false, check_codec, "%s"},
    {"bits", TO_PIXELS, ASKED(bits), true, check_bits, "%s"},
    {"raster", TO_PIXELS, 0, false, check_raster, "weft rasters"},
    {"size", TO_PIXELS | TO_RASTER, 0, false, check_size, "%s"},
    {"rate", TO_PIXELS | TO_RASTER, 0, false, check_rate, "%s"},
    {"flags", TO_PIXELS | TO_RASTER, 0, false, check_flags, "%s"},
    {"coded", TO_CONTAINER | TO_PIXELS | TO_FIELDS, 0, false, check_coded, "its container"},
    {"order", TO_PIXELS | TO_RASTER, 0, false, check_order, "%s"},
    {"aspect", TO_PIXELS | TO_RASTER, 0, false, check_aspect, "%s"},
    {"colors", TO_CONTAINER | TO_RASTER, 0, false, check_colors, "%s"},
    {"fiel", TO_MOV | TO_RASTER, 0, false, check_fiel, "QuickTime File Format, for %s"},
    {"atoms", TO_MOV | TO_RASTER, 0, false, check_atoms, "QuickTime File Format, for %s"},
    {"clap", TO_MOV | TO_RASTER, 0, false, check_clap, "Apple TN2162, for %s"},
    {"pattern", TO_MXF, 0, false, check_pattern, "SMPTE ST 378"},
    {"layout", TO_MXF | TO_RASTER, 0, false, check_layout, "SMPTE ST 377-1, for %s"},
    {"line map", TO_MXF | TO_RASTER, 0, false, check_line_map, "SMPTE ST 377-1, for %s"},
    {"dominance", TO_MXF | TO_FIELDS, 0, false, check_dominance, "SMPTE ST 377-1, for %s"},
    {"siting", TO_MXF, 0, false, check_siting, "Rec. ITU-R BT.601 and BT.709"},
    {"timecode", TO_CONTAINER | TO_RASTER, 0, false, wf_check_timecode,
     "SMPTE ST 12-1, for %s"},
    {"labels", TO_FILES | TO_RASTER, 0, false, wf_check_labels, "SMPTE ST 12-1, for %s"},
    {"interlace", TO_FILES | TO_RASTER, 0, false, wf_check_interlace, "SMPTE ST 268-1, for %s"},
    {"base", TO_CONTAINER | TO_RASTER, 0, false, wf_check_base, "SMPTE ST 12-1, for %s"},
    {"start", ALWAYS, ASKED(start), false, check_start, "%s"},
    {"frames", TO_CONTAINER | TO_PIXELS, 0, false, wf_check_frames, "the container"},
    {"sound", TO_SOUND | TO_PIXELS | TO_RASTER, 0, false, wf_check_sound, "the video's length"},
    {"channels", ALWAYS, ASKED(sound_channels), true, check_channels, "%s"},
    {"tracks", ALWAYS, ASKED(channels), false, check_tracks, "%s"},
    {"sound bits", ALWAYS, ASKED(sound_bits), true, check_sound_bits, "%s"},
    {"levels", TO_PIXELS, 0, false, check_levels, "EBU R 103"},
    {"reserved", TO_PIXELS, 0, false, check_reserved, "Rec. ITU-R BT.601 and BT.709"},
};

_Static_assert(sizeof checks / sizeof *checks <= WF_FINDINGS_MOST, "a finding for each check");

static unsigned nature_of(const wf_subject *s) {
    bool mov = s->contained && !strcmp(s->metadata.container, "mov");
    bool mxf = s->contained && !strcmp(s->metadata.container, "mxf");
    return (s->trouble ? 0 : TO_PIXELS) | (s->raster_known ? TO_RASTER : 0) |
           (s->raster_known && s->raster.scan == WF_INTERLACED ? TO_FIELDS : 0) |
           (s->contained ? TO_CONTAINER : 0) | (mov ? TO_MOV : 0) | (mxf ? TO_MXF : 0) |
           (s->contained && s->metadata.sound_streams ? TO_SOUND : 0) |
           (s->labels.files ? TO_FILES : 0);
}

/* Whether the profile has the member that a check needs. */
static bool is_asked(const struct check *check, const wf_profile *profile) {
    if (!check->profile) return true;
    if (!profile) return false;
    const char *member = (const char *)profile + check->profile;
    return check->number ? *(const int *)(const void *)member != 0
                         : *(const char *const *)(const void *)member != NULL;
}

static void tell_demand(const wf_subject *s, const struct check *check, wf_finding *f) {
    const char *rest = strstr(check->by, "%s"), *raster = s->raster.name;
    int before = (int)(rest ? rest - check->by : (ptrdiff_t)strlen(check->by));
    bool asks = check->profile || (s->profile && !s->options->raster && rest);
    if (check->profile)
        snprintf(f->by, sizeof f->by, "profile %.60s", s->profile->name);
    else if (rest)
        snprintf(f->by, sizeof f->by, "%.*sraster %.40s%s%.30s", before, check->by, raster,
                 asks ? " of profile " : "", asks ? s->profile->name : "");
    else
        snprintf(f->by, sizeof f->by, "%s", check->by);
}

void wf_run_checks(const wf_subject *s, wf_verification *out) {
    unsigned nature = nature_of(s);
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        wf_finding *f = &out->finding[out->count];
        if ((checks[i].needs & nature) != checks[i].needs || !is_asked(&checks[i], s->profile))
            continue;
        f->check = checks[i].name;
        tell_demand(s, &checks[i], f);
        f->verdict = checks[i].run(s, f);
        out->wrong += f->verdict == WF_WRONG;
        out->count++;
    }
}
