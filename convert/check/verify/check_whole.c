/* Checks: whether all of the file is there, as its structure and its lengths tell. */
#include "convert/check/verify/check_whole.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

wf_verdict wf_check_whole(const wf_subject *s, wf_finding *f) {
    const wf_structure *structure = &s->structure;
    if (*structure->missing) return wf_say(f, false, structure->missing, "all of the file");
    if (s->streamed) return wf_open_question(f, "whole frames; it does not say how many");
    if (!structure->known)
        return wf_open_question(f, "its structure is not read, or does not say where it ends");
    if (structure->doubt) return wf_open_question(f, structure->doubt);
    if (!structure->ends) return wf_open_question(f, "it does not say where it ends");
    return wf_say(f, true, "to its last byte", "");
}

/* Metadata is final in a closed partition, and known in a complete one. */
wf_verdict wf_check_header(const wf_subject *s, wf_finding *f) {
    static const char *const words[] = {"not said", "open and incomplete",
                                        "closed and incomplete", "open and complete",
                                        "closed and complete"};
    wf_mxf_status header = s->structure.header, footer = s->structure.footer;
    char is[96];
    snprintf(is, sizeof is, "%s%s%s", words[header], footer ? ", repeated in the footer: " : "",
             footer ? words[footer] : "");
    return wf_say(f, header == WF_MXF_CLOSED_COMPLETE || footer == WF_MXF_CLOSED_COMPLETE, is,
                  words[WF_MXF_CLOSED_COMPLETE]);
}

double wf_picture_s(const wf_subject *s) {
    const wf_contents *there = &s->metadata.there;
    double frames = there->repeated ? (double)there->fields / 2 : (double)s->figures.frames;
    return frames / wf_ratio_value(s->figures.info.raster.frame_rate);
}

/* How far a stated length is from what is there, in seconds; what is allowed comes off. */
static double astray(const wf_subject *s, const wf_stated *stated) {
    double there_s = wf_picture_s(s), sound_s = s->metadata.there.sound_most_s;
    double block_s = s->metadata.there.sound_block_s;
    double frame_s = 1 / wf_ratio_value(s->figures.info.raster.frame_rate);
    double hidden_s = (double)s->metadata.there.hidden * frame_s;
    if (!strcmp(stated->of, "mdhd")) there_s += hidden_s; /* before the edit list */
    double far_s = fabs(stated->seconds - there_s);
    /* libavformat's are when the stream ends. */
    if (!strcmp(stated->of, "DURATION") || !strcmp(stated->of, "Duration"))
        far_s = fmin(far_s, fabs(stated->seconds - there_s - s->metadata.start_s));
    if (stated->of_all && sound_s > there_s)
        far_s = fmax(there_s - stated->seconds, stated->seconds - sound_s) - block_s;
    /* An edit list may begin within a frame. */
    return far_s - stated->tick_s - (hidden_s > 0 ? frame_s / 2 : 0);
}

wf_verdict wf_check_durations(const wf_subject *s, wf_finding *f) {
    char is[160], should[64];
    const wf_structure *t = &s->structure;
    double half_s = 0.5 / wf_ratio_value(s->figures.info.raster.frame_rate);
    const wf_stated *worst = &t->stated[0];
    if (!t->stated_count) return wf_open_question(f, "none is stated");
    for (int i = 1; i < t->stated_count; i++)
        if (astray(s, &t->stated[i]) > astray(s, worst)) worst = &t->stated[i];
    snprintf(is, sizeof is, "%.3f s (%s), and %" PRId64 " frames are there", worst->seconds,
             worst->of, s->figures.frames);
    snprintf(should, sizeof should, "%.3f s", wf_picture_s(s));
    return wf_say(f, astray(s, worst) < half_s, is, should);
}

/* A UMID's number is its second half; libavformat counts packages in its last byte. */
static bool is_zero(const uint8_t id[WF_ID_BYTES], bool umid) {
    static const uint8_t none[16];
    return !memcmp(id + (umid ? 16 : 0), none, umid ? 15 : 16);
}

static void tell_id(const uint8_t *id, bool umid, char *text, size_t size) {
    size_t used = 0;
    for (int i = 0; i < 16; i++)
        used += (size_t)snprintf(text + used, size - used, "%02x", id[i + (umid ? 16 : 0)]);
}

/* Two shots never have the same. Matroska need not have any. */
wf_verdict wf_check_identity(const wf_subject *s, wf_finding *f) {
    const wf_structure *t = &s->structure;
    bool umid = !strcmp(s->metadata.container, "mxf");
    const uint8_t *id = t->id[t->has_id[1]];
    char is[160];
    if (!t->has_id[0] && !t->has_id[1]) return wf_open_question(f, "none");
    tell_id(id, umid, is, sizeof is);
    if (is_zero(id, umid)) return wf_say(f, false, is, "a number of its own");
    if (!s->shared_with) return wf_say(f, true, is, "");
    snprintf(is + 32, sizeof is - 32, ", as %.100s", s->shared_with);
    return wf_say(f, false, is, "another than any other shot has");
}
