/* Checks: what MOV and MXF files hold besides their pictures, against their formats. */
#include "convert/check/verify/check_container.h"

#include <stdio.h>
#include <string.h>

#include "convert/media/container_mov.h"
#include "convert/media/klv.h"

wf_verdict wf_check_fiel(const wf_subject *s, wf_finding *f) {
    char is[32] = "none", should[32];
    bool interlaced = s->raster.scan == WF_INTERLACED;
    int detail = !interlaced ? 0 : s->raster.top_first ? 9 : 14;
    if (s->metadata.has_fiel)
        snprintf(is, sizeof is, "{%d,%d}", s->metadata.fiel[0], s->metadata.fiel[1]);
    snprintf(should, sizeof should, "{%d,%d}", interlaced ? 2 : 1, detail);
    if (!s->metadata.has_fiel && interlaced && s->metadata.scan_known)
        return wf_open_question(f, "none, and the stream itself says its order");
    if (s->metadata.there.repeated) return wf_open_question(f, "its fields are repeated");
    /* 1 and 6 are fields one after the other, as which libavformat has those of codecs that
     * weave them themselves. */
    bool apart = s->metadata.fiel[0] == 2 && s->metadata.fiel[1] == (detail == 9 ? 1 : 6);
    if (interlaced && apart && wf_in_words("mpeg2video h264 hevc", s->metadata.codec))
        return wf_open_question(f, is);
    bool left_out = !s->metadata.has_fiel && !interlaced;
    if (!s->metadata.has_fiel && s->metadata.of_mpeg4)
        return wf_open_question(f, "none, which ISO/IEC 14496-12 does not know");
    return wf_say(f, left_out || !strcmp(is, should), is, should);
}

wf_verdict wf_check_atoms(const wf_subject *s, wf_finding *f) {
    const wf_metadata *c = &s->metadata;
    char is[64];
    snprintf(is, sizeof is, "%s%s%s", c->has_pasp ? "pasp " : "", c->has_colr ? "colr " : "",
             c->has_clap ? "clap" : "");
    if (c->has_pasp && !c->has_colr && !s->profile && !s->raster_asked)
        return wf_open_question(f, is); /* nobody asks for colors */
    return wf_say(f, c->has_pasp && c->has_colr, *is ? is : "none", "pasp and colr");
}

/* Clean apertures of other makers: 2.5 % or less is cut off at each edge, or the line of 601 is
 * taken to be 702 samples wide (Rec. ITU-R BT.601), or 711 of 525 lines (53.33 us hold 710.85
 * of these). */
static const struct {
    int width_px, lines, clean_width, clean_lines;
} apertures[] = {
    {1920, 1080, 1888, 1062}, {1440, 1080, 1416, 1062}, {1280, 1080, 1259, 1062},
    {1280, 720, 1248, 702},   {960, 720, 936, 702},     {720, 576, 702, 576},
    {720, 576, 703, 576},     {720, 576, 704, 576},     {720, 486, 704, 480},
    {720, 486, 704, 486},     {720, 486, 711, 486},     {720, 480, 704, 480},
    {720, 480, 711, 480},
};

/* Whether another maker cuts off as much, or nothing, as libavformat does; parts of a pixel do
 * not count. */
static bool is_customary(const wf_raster *r, const int64_t clean[2]) {
    int64_t width = (clean[0] + 32768) >> 16, lines = (clean[1] + 32768) >> 16;
    if (width == r->width_px && lines == r->lines) return true;
    for (size_t i = 0; i < sizeof apertures / sizeof *apertures; i++)
        if (apertures[i].width_px == r->width_px && apertures[i].lines == r->lines &&
            apertures[i].clean_width == width && apertures[i].clean_lines == lines)
            return true;
    return false;
}

wf_verdict wf_check_clap(const wf_subject *s, wf_finding *f) {
    char is[48], should[48];
    uint32_t width, lines;
    const int64_t *clean = s->metadata.clean;
    if (!s->metadata.has_clap) return wf_open_question(f, "none");
    wf_clean_aperture(&s->raster, &width, &lines);
    snprintf(is, sizeof is, "%.6gx%.6g", (double)clean[0] / 65536, (double)clean[1] / 65536);
    snprintf(should, sizeof should, "%ux%u", width, lines);
    bool own = !strcmp(is, should);
    if (!own && is_customary(&s->raster, clean)) return wf_open_question(f, is);
    return wf_say(f, own, is, should);
}

/* The raster's map, moved up by the lines that are coded above the picture. */
wf_verdict wf_check_line_map(const wf_subject *s, wf_finding *f) {
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

wf_verdict wf_check_layout(const wf_subject *s, wf_finding *f) {
    static const char *const names[] = {"full frame", "separate fields", "one field",
                                        "mixed fields", "segmented frame"};
    int layout = s->metadata.frame_layout;
    const char *is = layout >= 0 && layout < 5 ? names[layout] : "none";
    if (s->raster.scan == WF_INTERLACED)
        return wf_say(f, layout == WF_MXF_SEPARATE_FIELDS || layout == WF_MXF_MIXED_FIELDS, is,
                      "separate or mixed fields");
    bool segmented = s->raster.scan == WF_SEGMENTED && layout == WF_MXF_SEGMENTED_FRAME;
    return wf_say(f, layout == WF_MXF_FULL_FRAME || segmented, is, "full frame");
}

/* bmx takes only mixed fields for uncompressed, by its table of these. */
wf_verdict wf_check_bmx(const wf_subject *s, wf_finding *f) {
    bool mixed = s->metadata.frame_layout == WF_MXF_MIXED_FIELDS;
    return wf_open_question(f, mixed
                                   ? "mixed fields, as it asks for; not run with bmx"
                                   : "not mixed fields, which alone it takes for uncompressed; "
                                     "not run with bmx");
}

/* OP-Atom (SMPTE ST 390) has one track a file, which no profile here asks for. */
wf_verdict wf_check_pattern(const wf_subject *s, wf_finding *f) {
    const char *is = s->metadata.pattern;
    if (!s->profile && !strcmp(is, "OPAtom")) return wf_open_question(f, is);
    return wf_say(f, !strcmp(is, "OP1a"), is, "OP1a");
}

wf_verdict wf_check_dominance(const wf_subject *s, wf_finding *f) {
    char is[16];
    int first = s->metadata.dominance;
    if (first < 0) return wf_open_question(f, "not said");
    snprintf(is, sizeof is, "%d", first);
    return wf_say(f, first == 1, is, "1, as field 1 is the first in time");
}

/* 0 and 4 are co-sited, as 4:2:2 is; 6 is between two lines, as 4:2:0 of MPEG-2 is. */
wf_verdict wf_check_siting(const wf_subject *s, wf_finding *f) {
    char is[16];
    int siting = s->metadata.siting;
    if (siting < 0 || siting == 255) return wf_open_question(f, "not said");
    snprintf(is, sizeof is, "%d", siting);
    bool between = siting == 6 && s->figures.info.down == 2;
    return wf_say(f, siting == 0 || siting == 4 || between, is,
                  "0, with the first luma sample of a pair");
}

/* Of disabled tracks players are silent, and of a group they play one. */
wf_verdict wf_check_heard(const wf_subject *s, wf_finding *f) {
    char is[96];
    const wf_structure *t = &s->structure;
    bool right = !t->sound_disabled && t->sound_grouped < 2;
    snprintf(is, sizeof is, "of %d tracks of sound %d are disabled and %d in a group",
             t->sound_tracks, t->sound_disabled, t->sound_grouped);
    if (!right && !s->profile) return wf_open_question(f, is);
    return wf_say(f, right, is, "every track enabled, and in no group");
}
