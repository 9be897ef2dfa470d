/* Numbers by chance, by a linear congruence. */
#include "tests/unit/support/dice.h"

unsigned dice_state = 1;

int dice(int sides) {
    dice_state = dice_state * 1103515245u + 12345u;
    return (int)((dice_state >> 16) % (unsigned)sides);
}
