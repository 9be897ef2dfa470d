/* Looks for the name that was meant. */
#include "filters/base/spelling.h"

#include <string.h>

#define LONGEST 40

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

/* Optimal string alignment distance of two words shorter than LONGEST. */
static size_t distance(const char *a, const char *b) {
    size_t rows[3][LONGEST + 1], a_length = strlen(a), b_length = strlen(b);
    size_t *before = rows[0], *last = rows[1], *row = rows[2];
    for (size_t j = 0; j <= b_length; j++) row[j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t *oldest = before;
        before = last, last = row, row = oldest;
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            row[j] =
                least(last[j - 1] + (a[i - 1] != b[j - 1]), least(last[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least(row[j], before[j - 2] + 1);
        }
    }
    return row[b_length];
}

void wf_spelling_offer(wf_spelling *spelling, const char *candidate) {
    size_t length = strlen(spelling->text);
    if (length > LONGEST || strlen(candidate) > LONGEST) return;
    size_t d = distance(spelling->text, candidate), allowed = (length + 2) / 3;
    if (d > allowed || (spelling->best && d >= spelling->distance)) return;
    spelling->best = candidate;
    spelling->distance = d;
}
