/* Numbers written as fractions. */
#ifndef WF_FILTERS_BASE_FRACTION_H
#define WF_FILTERS_BASE_FRACTION_H

/* Reads "1.5" or "3/2" from the beginning of text. *end is set to what follows the number, or
 * to text itself if there is none. 1/0 is infinite. */
double wf_fraction_read(const char *text, const char **end);

#endif
