#ifndef WF_TRACER_SAMPLE_ROW_TIME_H
#define WF_TRACER_SAMPLE_ROW_TIME_H

#include "tracer/sample/sampling_inside.h"

/* Which fields and lines a row of the raster serves, and the time in which its samples lie. */

/* What a row's samples are drawn for: times from..to field periods after the field's instant,
 * and how late its own instant is. */
typedef struct wf_row_time {
    double from, to, late;
} wf_row_time;

/* A field period in seconds. */
wf_rational wf_sampling_period(const wf_sampling *s);

/* How many fields see the unit's first instant: both of a segmented frame, and those of film,
 * of whose three the last sees what the first does. */
int wf_fields_of_unit(const wf_sampling *s);

/* Lines of a field that a row's samples can reach: first <= l < end. */
void wf_lines_of_row(const wf_sampling *s, int64_t field, int row, int *first, int *end);

/* How late a frame line's instant is, in field periods after that of the first. */
double wf_late_of_line(const wf_sampling *s, double line);

/* False: no line needs the row. */
bool wf_find_row_time(const wf_sampling *s, int row, wf_row_time *time);

/* Where in the window a sample of time t lies, 0..1; f: its number, where the window is an
 * instant. */
double wf_window_fraction(const wf_sampling *s, double t, double late, double f);

#endif
