#include "convert/container.h"

#include <string.h>

#include "convert/container_kinds.h"

weft_status wf_container_mend(wf_outfile *file, const char *muxer, const wf_raster *raster,
                              weft_error *err) {
    static const struct {
        const char *muxer;
        weft_status (*mend)(wf_outfile *file, const wf_raster *raster, weft_error *err);
    } kinds[] = {{"mov", wf_container_mend_mov},
                 {"mxf", wf_container_mend_mxf},
                 {"mxf_d10", wf_container_mend_mxf}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (!strcmp(kinds[i].muxer, muxer)) return kinds[i].mend(file, raster, err);
    return WEFT_OK;
}
