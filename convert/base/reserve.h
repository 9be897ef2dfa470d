#ifndef WF_CONVERT_BASE_RESERVE_H
#define WF_CONVERT_BASE_RESERVE_H

#include <stdbool.h>
#include <stddef.h>

/* Makes *(void **)pointer a block of at least `bytes` bytes, aligned to 64, where *capacity
 * says that it is not one already. What the block held is lost. Starts from NULL and 0; the
 * block is freed with free(). False, with NULL and 0, when memory is out. */
bool wf_reserve(void *pointer, size_t *capacity, size_t bytes);

#endif
