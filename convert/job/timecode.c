/* Timecode: labels to frames and back, with drop frame. */
#include "convert/job/timecode.h"

#include <stdio.h>

#define SECONDS_A_DAY     86400
#define TEN_MINUTES_A_DAY 144
#define DROP_FRAME_BIT    (1u << 6)
#define FIELD_MARK_BIT    (1u << 15)

int wf_timecode_base(wf_rational rate) {
    return (int)((rate.num - 1) / rate.den + 1);
}

bool wf_timecode_may_drop(wf_rational rate) {
    return rate.den == 1001 && (rate.num == 30000 || rate.num == 60000);
}

/* Labels that a minute leaves out. */
static int left_out(wf_rational rate) {
    return rate.num == 60000 ? 4 : 2;
}

/* ---- Checking ---- */

static double frames_a_second(wf_rational rate) {
    return wf_ratio_value(rate);
}

static bool is_left_out(const wf_timecode *label, wf_rational rate) {
    return label->drop_frame && label->minutes % 10 && !label->seconds &&
           label->frames < left_out(rate);
}

bool wf_timecode_check(const wf_timecode *label, wf_rational rate, char *why, size_t why_size) {
    int base = wf_timecode_base(rate);
    if (label->hours < 0 || label->hours > 23 || label->minutes < 0 || label->minutes > 59 ||
        label->seconds < 0 || label->seconds > 59)
        snprintf(why, why_size, "a day ends with 23:59:59");
    else if (label->frames < 0 || label->frames >= base)
        snprintf(why, why_size,
                 "at %.6g frames a second, frames are 00 to %02d, and this says %02d",
                 frames_a_second(rate), base - 1, label->frames);
    else if (label->drop_frame && !wf_timecode_may_drop(rate))
        snprintf(
            why, why_size,
            "drop frame (;) is for 29.97 and 59.94 frames a second and not for %.6g; write : "
            "before the frames",
            frames_a_second(rate));
    else if (is_left_out(label, rate))
        snprintf(
            why, why_size,
            "drop frame leaves this label out; the first of this minute is %02d:%02d:00;%02d",
            label->hours, label->minutes, left_out(rate));
    else
        return true;
    return false;
}

/* ---- Counting ---- */

int64_t wf_timecode_day(wf_rational rate, bool drop_frame) {
    int64_t labels = (int64_t)SECONDS_A_DAY * wf_timecode_base(rate);
    return drop_frame ? labels - TEN_MINUTES_A_DAY * 9 * left_out(rate) : labels;
}

int64_t wf_timecode_frame(const wf_timecode *label, wf_rational rate) {
    int64_t minutes = 60 * label->hours + label->minutes;
    int64_t labels = (60 * minutes + label->seconds) * wf_timecode_base(rate) + label->frames;
    return label->drop_frame ? labels - left_out(rate) * (minutes - minutes / 10) : labels;
}

/* How many labels were left out up to frame: of every ten minutes the first is whole, and the
 * other nine are shorter by `out`. */
static int64_t left_out_before(int64_t frame, int base, int out) {
    int64_t minute = 60 * base - out, ten_minutes = 10 * minute + out;
    int64_t rest = frame % ten_minutes, short_minutes = rest < out ? 0 : (rest - out) / minute;
    return out * (9 * (frame / ten_minutes) + short_minutes);
}

wf_timecode wf_timecode_label(int64_t frame, wf_rational rate, bool drop_frame) {
    int base = wf_timecode_base(rate);
    int64_t day = wf_timecode_day(rate, drop_frame);
    frame = (frame % day + day) % day;
    int64_t label = frame + (drop_frame ? left_out_before(frame, base, left_out(rate)) : 0);
    int64_t seconds = label / base;
    return (wf_timecode){.hours = (int)(seconds / 3600),
                         .minutes = (int)(seconds / 60 % 60),
                         .seconds = (int)(seconds % 60),
                         .frames = (int)(label % base),
                         .drop_frame = drop_frame};
}

wf_timecode wf_timecode_add(const wf_timecode *label, int64_t frames, wf_rational rate) {
    int64_t day = wf_timecode_day(rate, label->drop_frame);
    return wf_timecode_label(wf_timecode_frame(label, rate) + frames % day, rate,
                             label->drop_frame);
}

bool wf_timecode_convert(wf_timecode label, wf_rational from, wf_rational to,
                         wf_timecode *out) {
    char why[256];
    label.drop_frame = label.drop_frame && wf_timecode_may_drop(from);
    if (!wf_timecode_check(&label, from, why, sizeof why)) return false;
    label.frames = label.frames * wf_timecode_base(to) / wf_timecode_base(from);
    label.drop_frame = label.drop_frame && wf_timecode_may_drop(to);
    *out = label;
    return true;
}

/* ---- Forms ---- */

int wf_timecode_together(wf_rational rate) {
    int base = wf_timecode_base(rate);
    return base > 39 ? (base + 29) / 30 : 1;
}

const char *wf_timecode_text(const wf_timecode *label, char text[WF_TIMECODE_SIZE]) {
    snprintf(text, WF_TIMECODE_SIZE, "%02d:%02d:%02d%c%02d", label->hours % 100,
             label->minutes % 100, label->seconds % 100, label->drop_frame ? ';' : ':',
             label->frames % 1000);
    return text;
}

static uint32_t decimal(int value) {
    return (uint32_t)(value / 10 << 4 | value % 10);
}

uint32_t wf_timecode_bcd(const wf_timecode *label, wf_rational rate) {
    int together = wf_timecode_together(rate);
    uint32_t word = decimal(label->hours) << 24 | decimal(label->minutes) << 16 |
                    decimal(label->seconds) << 8 | decimal(label->frames / together);
    if (label->drop_frame) word |= DROP_FRAME_BIT;
    if (label->frames % together) word |= FIELD_MARK_BIT;
    return word;
}
