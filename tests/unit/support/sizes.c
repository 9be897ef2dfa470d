/* How much of a loop a test does: less under the sanitizers, unless all is asked for. */
#include "tests/unit/support/sizes.h"

#include <stdlib.h>

static int is_set(const char *name) {
    const char *value = getenv(name);
    return value && *value;
}

int test_step(int step) {
    return is_set("WEFT_SANITIZE") && !is_set("WEFT_LONG") ? step : 1;
}
