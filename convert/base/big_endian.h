#ifndef WF_CONVERT_BASE_BIG_ENDIAN_H
#define WF_CONVERT_BASE_BIG_ENDIAN_H

#include <stddef.h>
#include <stdint.h>

/* Whole numbers of 1 to 8 bytes, the highest byte first. */
uint64_t wf_big_endian(const uint8_t *bytes, size_t count);
void wf_put_big_endian(uint8_t *to, uint64_t value, size_t count);

#endif
