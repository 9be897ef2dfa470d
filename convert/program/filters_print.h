/* Part of weft filters: its output for people. */
#ifndef WF_CONVERT_PROGRAM_FILTERS_PRINT_H
#define WF_CONVERT_PROGRAM_FILTERS_PRINT_H

#include "convert/ask/filters.h"

/* The list of apertures, or the response of the query's, on standard output. */
void wf_filters_print(const wf_filters_query *query);

/* What follows of a design: what was wished, and how it came out. */
void wf_filters_print_design(const wf_filters_query *query);

#endif
