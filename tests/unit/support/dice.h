#ifndef WF_TESTS_UNIT_SUPPORT_DICE_H
#define WF_TESTS_UNIT_SUPPORT_DICE_H

/* Chance that is the same in every run, of one thread. */

extern unsigned dice_state; /* what was thrown, and will be; set it to begin a round */

/* 0 to sides - 1. */
int dice(int sides);

#endif
