#ifndef WF_CONVERT_BASE_NUMBERS_H
#define WF_CONVERT_BASE_NUMBERS_H

#include "convert/base/names.h"

/* What the numbers of a sequence's files mean where names do not say it exactly. Entries are in
 * the order of their numbers, and only read where nothing else is said. */

/* Gaps that must be equal before numbers are taken for a progression. */
#define WF_GAPS_EQUAL 3

/* The step from number to number where none is missing. Fractions: the largest step that meets
 * all of them. Whole numbers: 1, or, where at least WF_GAPS_EQUAL gaps and more than half of
 * all are equal, and all others are multiples of these, such a gap (*stepped: numbers between
 * are taken to be left out on purpose). {0, 0} where it does not fit. */
wf_rational wf_number_step(const wf_numbered *entry, size_t count, bool *stepped);

/* Of "1001.333" and "1001.667", 3: the smallest n <= 1000 for which all numbers are wholes of
 * 1/n, rounded or cut off at their decimals, if that leaves fewer numbers missing than reading
 * them as they are written, and at least WF_GAPS_EQUAL gaps equal; else 0. */
int64_t wf_number_parts(const wf_numbered *entry, size_t count);

/* Rewrites numbers as wholes of 1/parts. */
void wf_numbers_round(wf_numbered *entry, size_t count, int64_t parts);

/* Which share of the numbers from the first to the last is there, in steps of wf_number_step
 * and in wf_number_parts; 0 for a file alone, and where a number is there twice. */
double wf_number_density(const wf_numbered *entry, size_t count);

#endif
