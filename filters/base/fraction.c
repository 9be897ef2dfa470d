/* Numbers written as fractions. */
#include "filters/base/fraction.h"

#include <stdlib.h>

static double read(const char *text, const char **end) {
    char *stop;
    double value = strtod(text, &stop);
    *end = stop;
    return value;
}

double wf_fraction_read(const char *text, const char **end) {
    double value = read(text, end);
    if (*end == text || **end != '/') return value;
    const char *below = *end + 1;
    value /= read(below, end);
    if (*end == below) *end = text;
    return value;
}
