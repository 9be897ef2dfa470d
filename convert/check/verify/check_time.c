/* Checks: labels of time, how many frames there are and how much sound. */
#include "convert/check/verify/check_time.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "convert/check/verify/check_whole.h"
#include "convert/job/timecode.h"

wf_verdict wf_check_timecode(const wf_subject *s, wf_finding *f) {
    wf_timecode label;
    char why[160] = "HH:MM:SS:FF of the first frame";
    const char *is = *s->metadata.timecode ? s->metadata.timecode : "none";
    if (!*s->metadata.timecode && !(s->profile && s->profile->timecode))
        return wf_open_question(f, "none");
    bool right = wf_parse_timecode(is, &label) &&
                 wf_timecode_check(&label, s->raster.frame_rate, why, sizeof why);
    return wf_say(f, right, is, why);
}

/* Of image sequences: where one file has a label all have, one after the other. */
wf_verdict wf_check_labels(const wf_subject *s, wf_finding *f) {
    const wf_frame_labels *l = &s->labels;
    char is[160], should[160] = "a label in every file", text[2][WF_TIMECODE_SIZE];
    bool right = wf_timecode_check(&l->first, s->raster.frame_rate, should, sizeof should) &&
                 l->labeled == l->files && !l->wrong;
    if (!l->labeled) return wf_open_question(f, "the files have none");
    snprintf(is, sizeof is, "%s, in %" PRId64 " of %" PRId64 " files",
             wf_timecode_text(&l->first, text[0]), l->labeled, l->files);
    if (l->wrong)
        snprintf(is, sizeof is, "%s, %" PRId64 " files after %s",
                 wf_timecode_text(&l->is, text[1]), l->wrong_at, text[0]);
    if (l->wrong) wf_timecode_text(&l->should, should);
    return wf_say(f, right, is, should);
}

wf_verdict wf_check_interlace(const wf_subject *s, wf_finding *f) {
    static const char *const words[] = {"not said, or not alike", "noninterlaced",
                                        "2:1 interlace"};
    int should = s->raster.scan == WF_INTERLACED;
    if (s->labels.interlace < 0) return wf_open_question(f, words[0]);
    return wf_say(f, s->labels.interlace == should, words[1 + s->labels.interlace],
                  words[1 + should]);
}

/* Labels a second, and whether some are dropped: 24, 30 and 60 for the rates over 1001. */
wf_verdict wf_check_base(const wf_subject *s, wf_finding *f) {
    char is[48], should[64];
    bool drop = s->metadata.timecode_drop;
    int base = s->metadata.timecode_base;
    double rate = wf_ratio_value(s->raster.frame_rate);
    int want = (int)ceil(rate - 0.001);
    bool may_drop = s->raster.frame_rate.den == 1001 && want % 30 == 0;
    if (!base) return wf_open_question(f, "not said");
    snprintf(is, sizeof is, "%d%s", base, drop ? ", drop frame" : "");
    snprintf(should, sizeof should, "%d%s", want, may_drop ? "" : ", no frames dropped");
    return wf_say(f, base == want && (!drop || may_drop), is, should);
}

/* Frames that so many make which the container counts: it may count fields, frames that show
 * repeated ones, and those that an edit list leaves out. */
static double frames_of(const wf_subject *s, double said) {
    const wf_contents *there = &s->metadata.there;
    said -= (double)there->hidden;
    if (there->lone_fields && there->lone_fields == there->packets) return said / 2;
    bool shown = there->repeated && fabs(said - (double)there->fields / 2) < 1;
    return shown ? (double)s->figures.frames : said;
}

wf_verdict wf_check_frames(const wf_subject *s, wf_finding *f) {
    char is[64], should[64];
    double said = s->metadata.frames > 0
                      ? (double)s->metadata.frames
                      : s->metadata.video_s * wf_ratio_value(s->metadata.rate);
    /* AVI counts ticks of its own rate, of which some have no picture. */
    double ticks = wf_ratio_value(s->metadata.rate);
    if (!strcmp(s->metadata.container, "avi") && ticks > 0)
        said *= wf_ratio_value(s->figures.info.raster.frame_rate) / ticks;
    if (said <= 0 || !s->structure.known || s->structure.fragments)
        return wf_open_question(f, "the container does not say");
    snprintf(is, sizeof is, "%.0f said, %" PRId64 " there", said, s->figures.frames);
    snprintf(should, sizeof should, "as many as are said");
    return wf_say(f, fabs(frames_of(s, said) - (double)s->figures.frames) < 0.5, is, should);
}

/* Whether a stream of sound is as long as the picture, to a frame and what its coding pads. */
static bool fits(const wf_subject *s, double sound_s, double video_s) {
    double frame_s = 1 / wf_ratio_value(s->raster.frame_rate);
    return !(sound_s > 0) ||
           fabs(sound_s - video_s) < frame_s + s->metadata.there.sound_block_s;
}

wf_verdict wf_check_sound(const wf_subject *s, wf_finding *f) {
    char is[96], should[96];
    const wf_metadata *c = &s->metadata;
    double video_s = wf_picture_s(s), there_s = c->there.sound_least_s;
    double stated_s = c->there.hidden ? 0 : c->sound_s; /* with what an edit list leaves out */
    bool rate = c->sound_rate == 48000;
    bool right = fits(s, stated_s, video_s) && fits(s, there_s, video_s) &&
                 fits(s, c->there.sound_most_s, video_s) &&
                 (!(stated_s > 0) || fits(s, there_s, stated_s));
    bool other = fits(s, there_s, video_s);
    snprintf(is, sizeof is, "%d channels of %d Hz, %.3f s", c->sound_channels, c->sound_rate,
             !other || !(c->sound_s > 0) ? there_s : c->sound_s);
    if (right && !rate && !s->profile) return wf_open_question(f, is);
    right &= rate;
    snprintf(should, sizeof should, "48000 Hz, as long as the video, %.3f s", video_s);
    return wf_say(f, right, is, should);
}
