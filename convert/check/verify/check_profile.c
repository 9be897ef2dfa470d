/* Checks: what the profile asks for. */
#include "convert/check/verify/check_profile.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "convert/check/verify/check_whole.h"

wf_verdict wf_check_container(const wf_subject *s, wf_finding *f) {
    const char *is = s->contained ? s->metadata.container : "no container";
    return wf_say(f, !strcmp(is, s->profile->container), is, s->profile->container);
}

wf_verdict wf_check_codec(const wf_subject *s, wf_finding *f) {
    const char *is = s->contained ? s->metadata.codec : s->figures.info.format;
    return wf_say(f, !strcmp(is, s->profile->codec), is, s->profile->codec);
}

static wf_verdict say_number(wf_finding *f, int is, int should) {
    char has[16], asks[16];
    snprintf(has, sizeof has, "%d", is);
    snprintf(asks, sizeof asks, "%d", should);
    return wf_say(f, is == should, has, asks);
}

wf_verdict wf_check_bits(const wf_subject *s, wf_finding *f) {
    return say_number(f, s->figures.info.bits, s->profile->bits);
}

wf_verdict wf_check_channels(const wf_subject *s, wf_finding *f) {
    char is[64], should[64];
    snprintf(is, sizeof is, "%d channels", s->metadata.sound_channels);
    snprintf(should, sizeof should, "%d or more", s->profile->sound_channels);
    return wf_say(f, s->metadata.sound_channels >= s->profile->sound_channels, is, should);
}

wf_verdict wf_check_tracks(const wf_subject *s, wf_finding *f) {
    char is[16];
    snprintf(is, sizeof is, "%d", s->metadata.sound_channels);
    return wf_say(f, wf_in_words(s->profile->channels, is), is, s->profile->channels);
}

wf_verdict wf_check_sound_bits(const wf_subject *s, wf_finding *f) {
    return say_number(f, s->metadata.sound_bits, s->profile->sound_bits);
}

wf_verdict wf_check_start(const wf_subject *s, wf_finding *f) {
    const char *is = *s->metadata.timecode ? s->metadata.timecode : "none";
    return wf_say(f, !strcmp(is, s->profile->start), is, s->profile->start);
}

/* ---- What the codec does ---- */

wf_verdict wf_check_codec_profile(const wf_subject *s, wf_finding *f) {
    const char *is = *s->metadata.profile ? s->metadata.profile : "not said";
    return wf_say(f, !strcmp(is, s->profile->codec_profile), is, s->profile->codec_profile);
}

wf_verdict wf_check_level(const wf_subject *s, wf_finding *f) {
    return say_number(f, s->metadata.level, s->profile->level);
}

/* Names of deeper pixels begin with that of those of 8 bits: yuv422p, yuv422p10le. */
wf_verdict wf_check_chroma(const wf_subject *s, wf_finding *f) {
    const char *is = s->metadata.pixels, *should = s->profile->chroma;
    size_t length = strlen(should);
    bool deeper =
        is[0] && !strncmp(is, should, length) && is[length] >= '0' && is[length] <= '9';
    return wf_say(f, deeper || !strcmp(is, should), is, should);
}

/* QuickTime's graphics modes of straight alpha, and of alpha that color is multiplied by. */
wf_verdict wf_check_alpha(const wf_subject *s, wf_finding *f) {
    bool there = !strncmp(s->metadata.pixels, "yuva", 4);
    const char *fill = s->metadata.graphics_mode == 0x100   ? "straight"
                       : s->metadata.graphics_mode == 0x102 ? "premultiplied, over black"
                                                            : NULL;
    if (there && !fill)
        return wf_open_question(f, "there, and not said how color lies beside it");
    return wf_say(f, there, there ? fill : "none", "alpha");
}

/* From one picture that needs no other to the next. */
wf_verdict wf_check_groups(const wf_subject *s, wf_finding *f) {
    char is[96], should[96];
    const wf_contents *there = &s->metadata.there;
    int most = s->profile->group;
    bool intra = there->whole == there->packets;
    if (!there->types_known) return wf_open_question(f, "it does not say");
    if (intra)
        snprintf(is, sizeof is, "every picture is whole");
    else
        snprintf(is, sizeof is, "up to %" PRId64 " pictures", there->longest_group);
    if (most == 1)
        snprintf(should, sizeof should, "every picture is whole");
    else
        snprintf(should, sizeof should, "up to %d pictures%s", most,
                 s->profile->between ? ", most of them predicted" : "");
    bool right =
        there->longest_group <= most && !(s->profile->between && intra && there->packets > 1);
    return wf_say(f, right, is, should);
}

/* ---- How large it is ---- */

/* Bits that a decoder of MPEG-2's 4:2:2 Profile at High Level holds back (Rec. ITU-T H.262):
 * by so much what has come differs from a constant rate at most. */
#define BUFFER_BITS 47185920.0

wf_verdict wf_check_bit_rate(const wf_subject *s, wf_finding *f) {
    char is[96], should[48];
    double want = s->profile->bit_rate, length_s = wf_picture_s(s);
    double bits = 8.0 * (double)s->metadata.there.bytes;
    double said = (double)s->metadata.bit_rate;
    snprintf(is, sizeof is, "%.4g Mb/s said, %.4g Mb in %.3g s", 1e-6 * said, 1e-6 * bits,
             length_s);
    snprintf(should, sizeof should, "%.4g Mb/s, constant", 1e-6 * want);
    bool right = fabs(said - want) < 1000 && fabs(bits - want * length_s) <= BUFFER_BITS;
    return wf_say(f, right, is, should);
}

wf_verdict wf_check_frame_bytes(const wf_subject *s, wf_finding *f) {
    char is[64], should[112], least[24], most[24];
    const wf_contents *there = &s->metadata.there;
    snprintf(least, sizeof least, "%" PRId64, there->least_bytes);
    snprintf(most, sizeof most, "%" PRId64, there->most_bytes);
    snprintf(is, sizeof is, "%s to %s bytes", least, most);
    snprintf(should, sizeof should, "%.80s bytes, every frame", s->profile->frame_bytes);
    return wf_say(f,
                  wf_in_words(s->profile->frame_bytes, least) &&
                      wf_in_words(s->profile->frame_bytes, most),
                  is, should);
}

wf_verdict wf_check_partitions(const wf_subject *s, wf_finding *f) {
    bool right = s->structure.header == WF_MXF_CLOSED_COMPLETE;
    return wf_say(f, right, right ? "closed and complete" : "the header is not final",
                  "a header partition that is closed and complete");
}

/* ---- Sound ---- */

wf_verdict wf_check_sound_codec(const wf_subject *s, wf_finding *f) {
    return wf_say(f, wf_in_words(s->profile->sound_codec, s->metadata.sound_codec),
                  s->metadata.sound_codec, s->profile->sound_codec);
}

static void tell_streams(const wf_subject *s, char *text, size_t size) {
    snprintf(text, size, "%d channels in %d streams", s->metadata.sound_channels,
             s->metadata.sound_streams);
}

wf_verdict wf_check_mono(const wf_subject *s, wf_finding *f) {
    char is[64];
    tell_streams(s, is, sizeof is);
    return wf_say(f, s->metadata.sound_channels == s->metadata.sound_streams, is,
                  "one channel a stream");
}

wf_verdict wf_check_one_sound(const wf_subject *s, wf_finding *f) {
    char is[64];
    tell_streams(s, is, sizeof is);
    return wf_say(f, s->metadata.sound_streams == 1, is, "all channels in one stream");
}

/* ---- And what is not looked at ---- */

wf_verdict wf_check_not(const wf_subject *s, wf_finding *f) {
    return wf_open_question(f, s->profile->not_checked);
}
