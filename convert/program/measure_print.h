/* Part of weft measure: its output for people. */
#ifndef WF_CONVERT_PROGRAM_MEASURE_PRINT_H
#define WF_CONVERT_PROGRAM_MEASURE_PRINT_H

#include "convert/check/measure.h"

/* Prints the figures of a file as lines for people, on standard output. */
void wf_measure_print(const char *path, const wf_measure_options *options,
                      const wf_figures *figures);

#endif
