/* Checks: what MOV and MXF files hold besides their pictures, against their formats. */
#include "convert/check/check_container.h"

#include <stdio.h>
#include <string.h>

#include "convert/media/container_mov.h"

wf_verdict wf_check_fiel(const wf_subject *s, wf_finding *f) {
    char is[32] = "none", should[32];
    bool interlaced = s->raster.scan == WF_INTERLACED;
    int detail = !interlaced ? 0 : s->raster.top_first ? 9 : 14;
    if (s->metadata.has_fiel)
        snprintf(is, sizeof is, "{%d,%d}", s->metadata.fiel[0], s->metadata.fiel[1]);
    snprintf(should, sizeof should, "{%d,%d}", interlaced ? 2 : 1, detail);
    bool left_out = !s->metadata.has_fiel && !interlaced;
    return wf_say(f, left_out || !strcmp(is, should), is, should);
}

wf_verdict wf_check_atoms(const wf_subject *s, wf_finding *f) {
    const wf_metadata *c = &s->metadata;
    char is[64];
    snprintf(is, sizeof is, "%s%s%s", c->has_pasp ? "pasp " : "", c->has_colr ? "colr " : "",
             c->has_clap ? "clap" : "");
    return wf_say(f, c->has_pasp && c->has_colr, *is ? is : "none", "pasp and colr");
}

wf_verdict wf_check_clap(const wf_subject *s, wf_finding *f) {
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
        return wf_say(f, layout == 1 || layout == 3, is, "separate or mixed fields");
    bool segmented = s->raster.scan == WF_SEGMENTED && layout == 4;
    return wf_say(f, layout == 0 || segmented, is, "full frame");
}

wf_verdict wf_check_pattern(const wf_subject *s, wf_finding *f) {
    return wf_say(f, !strcmp(s->metadata.pattern, "OP1a"), s->metadata.pattern, "OP1a");
}

wf_verdict wf_check_dominance(const wf_subject *s, wf_finding *f) {
    char is[16];
    int first = s->metadata.dominance;
    if (first < 0) return wf_open_question(f, "not said");
    snprintf(is, sizeof is, "%d", first);
    return wf_say(f, first == 1, is, "1, as field 1 is the first in time");
}

wf_verdict wf_check_siting(const wf_subject *s, wf_finding *f) {
    char is[16];
    if (s->metadata.siting < 0) return wf_open_question(f, "not said");
    snprintf(is, sizeof is, "%d", s->metadata.siting);
    bool right = s->metadata.siting == 0 || s->metadata.siting == 4; /* 4: as Rec. 601 has it */
    return wf_say(f, right, is, "0, with the first luma sample of a pair");
}
