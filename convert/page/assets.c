/* The page's HTML, CSS and scripts. */
#include "convert/page/assets.h"

#include <string.h>

/* What CMake makes of the files: an array for each, and `assets`, the table of them. */
#include "convert/page_assets.inc"

const unsigned char *wf_page_asset(const char *name, size_t *bytes) {
    for (size_t i = 0; i < sizeof assets / sizeof *assets; i++) {
        if (strcmp(assets[i].name, name) != 0) continue;
        *bytes = assets[i].bytes;
        return assets[i].data;
    }
    return NULL;
}
