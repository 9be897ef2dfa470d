#ifndef WF_CONVERT_PLAN_TELL_H
#define WF_CONVERT_PLAN_TELL_H

#include <stdio.h>

#include "convert/plan/plan.h"

/* What the formats of a plan share. */

/* "3/8", with a denominator always. Returns text. */
const char *wf_plan_ratio_text(wf_rational ratio, char text[48]);

/* The time in frames of the scene; {0, 0} where --scene-fps is not given. */
wf_rational wf_plan_frame(const wf_plan *plan, int64_t number);

/* The last number of the plan. */
int64_t wf_plan_last(const wf_plan *plan);

/* Scripts for renderers. (scripts.c) */
void wf_plan_for_blender(const wf_plan *plan, FILE *to);
void wf_plan_for_povray(const wf_plan *plan, FILE *to);
void wf_plan_for_houdini(const wf_plan *plan, FILE *to);

#endif
