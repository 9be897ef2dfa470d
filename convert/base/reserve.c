/* Blocks of memory that grow and are used again. */
#include "convert/base/reserve.h"

#include <stdlib.h>

bool wf_reserve(void *pointer, size_t *capacity, size_t bytes) {
    void **block = pointer;
    if (bytes <= *capacity && *block) return true;
    free(*block);
    *capacity = (bytes + 4095) / 4096 * 4096;
    *block = aligned_alloc(64, *capacity);
    if (!*block) *capacity = 0;
    return *block != NULL;
}
