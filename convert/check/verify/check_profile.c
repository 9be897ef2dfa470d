/* Checks: what the profile asks for. */
#include "convert/check/verify/check_profile.h"

#include <stdio.h>
#include <string.h>

wf_verdict wf_check_container(const wf_subject *s, wf_finding *f) {
    const char *is = s->contained ? s->metadata.container : "no container";
    return wf_say(f, !strcmp(is, s->profile->container), is, s->profile->container);
}

wf_verdict wf_check_codec(const wf_subject *s, wf_finding *f) {
    const char *is = s->contained ? s->metadata.codec : s->figures.info.format;
    return wf_say(f, !strcmp(is, s->profile->codec), is, s->profile->codec);
}

wf_verdict wf_check_bits(const wf_subject *s, wf_finding *f) {
    char is[16], should[16];
    snprintf(is, sizeof is, "%d", s->figures.info.bits);
    snprintf(should, sizeof should, "%d", s->profile->bits);
    return wf_say(f, s->figures.info.bits == s->profile->bits, is, should);
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
    char is[16], should[16];
    snprintf(is, sizeof is, "%d", s->metadata.sound_bits);
    snprintf(should, sizeof should, "%d", s->profile->sound_bits);
    return wf_say(f, s->metadata.sound_bits == s->profile->sound_bits, is, should);
}

wf_verdict wf_check_start(const wf_subject *s, wf_finding *f) {
    const char *is = *s->metadata.timecode ? s->metadata.timecode : "none";
    return wf_say(f, !strcmp(is, s->profile->start), is, s->profile->start);
}
