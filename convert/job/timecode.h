#ifndef WF_CONVERT_JOB_TIMECODE_H
#define WF_CONVERT_JOB_TIMECODE_H

#include <stdint.h>

#include "convert/base/values.h"
#include "filters/base/rational.h"

/* SMPTE ST 12-1 time code: what frames are called. A second has as many labels as the rate
 * rounded up: 24 at 23.976, 30 at 29.97. Drop frame makes labels keep up with the clock at
 * 30000/1001 and 60000/1001 only: every minute but each tenth begins with label ;02 (;04
 * at 59.94), so that ten minutes are 17982 frames (35964) and a day 2589408 (5178816). After a
 * day labels begin again. */

int wf_timecode_base(wf_rational rate);      /* labels a second */
bool wf_timecode_may_drop(wf_rational rate); /* whether the rate has drop frame */

/* Whether label is one of the rate's; else why says what would be. */
bool wf_timecode_check(const wf_timecode *label, wf_rational rate, char *why, size_t why_size);

/* Frames from 00:00:00:00 to a label that wf_timecode_check passes, and the label of a frame
 * (any, modulo a day). drop_frame only where wf_timecode_may_drop. */
int64_t wf_timecode_frame(const wf_timecode *label, wf_rational rate);
wf_timecode wf_timecode_label(int64_t frame, wf_rational rate, bool drop_frame);
int64_t wf_timecode_day(wf_rational rate, bool drop_frame); /* frames */

/* The label `frames` (which may be negative) after one. */
wf_timecode wf_timecode_add(const wf_timecode *label, int64_t frames, wf_rational rate);

/* What a label of one rate is at another: hours, minutes and seconds stay, and frames keep
 * their share of the second, rounded down, as 24-frame and 30-frame counts of one tape do. Drop
 * frame stays where the other rate has it. False where it is no label of `from`. */
bool wf_timecode_convert(wf_timecode label, wf_rational from, wf_rational to, wf_timecode *out);

/* "01:02:03;04". Returns text. */
#define WF_TIMECODE_SIZE 20
const char *wf_timecode_text(const wf_timecode *label, char text[WF_TIMECODE_SIZE]);

/* How many frames share a label in EXR and DPX, whose words hold labels up to 39: 1 where those
 * are enough, 2 at 50 to 60 frames a second, and so on. */
int wf_timecode_together(wf_rational rate);

/* The word that EXR (timeCode) and DPX hold: binary coded decimal, from the lowest bits frames,
 * seconds, minutes, hours, a byte each, with bit 6 for drop frame; flags otherwise 0, as
 * OpenEXR's ImfTimeCode.h calls packing for 60-field television, which files use whatever their
 * rate. Two bits of tens hold 39 frames: from 50 a second on, ST 12-1 counts pairs of frames
 * and bit 15, the field mark, says which of a pair. */
uint32_t wf_timecode_bcd(const wf_timecode *label, wf_rational rate);

#endif
