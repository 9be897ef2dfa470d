/* Configurations of OpenColorIO: from the space "lin" to the space "out" of whatever this is.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "color/space/ocio/ocio.h"
#include "convert/base/module.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void convert(const wf_transform *t) {
    float r[] = {0, 0.18f, 1, -1}, g[] = {0, 0.18f, 0.5f, 70000}, b[] = {0, 0.18f, 0, NAN};
    t->apply(t->self, r, g, b, 4);
    t->free(t->self);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[64], why[1024] = "";
    void *symbol;
    wf_ocio_open_fn *open;
    wf_transform transform;
    weft_error err;
    if (wf_module_symbol("ocio", "wf_ocio_open", "a color space", &symbol, &err)) return 0;
    memcpy(&open, &symbol, sizeof open);
    int descriptor = memfd_create("config.ocio", 0);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    const wf_ocio_query query = {.config = path, .from = "lin", .to = "out"};
    /* A failure that does not say why is one of memory, which some files ask for without end.
     */
    if (open(&query, &transform, why, sizeof why)) convert(&transform);
    close(descriptor);
    return 0;
}
