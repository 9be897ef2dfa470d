#ifndef WF_FILTERS_BASE_FRACTION_H
#define WF_FILTERS_BASE_FRACTION_H

/* Reads "1.5" or "3/2" as far as it goes; *end is where that is, text itself if it is no
 * number. 1/0 is infinite. */
double wf_fraction_read(const char *text, const char **end);

#endif
