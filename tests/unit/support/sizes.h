#ifndef WF_TESTS_UNIT_SUPPORT_SIZES_H
#define WF_TESTS_UNIT_SUPPORT_SIZES_H

/* How much of a loop a test does. An ordinary build does all of it, and so do the sanitizers at
 * full length (WEFT_LONG); in their daily run, which takes ten times as long as an ordinary
 * one, they do every step-th case: 1 or `step`. */
int test_step(int step);

#endif
