/* The composite system that goes with a raster. */
#include "convert/read/television.h"

bool wf_television_of(const wf_raster *raster, wf_tv *tv) {
    static const wf_tv_system systems[] = {WF_NTSC, WF_PAL};
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        if (raster->width_px != 720 ||
            raster->total_lines != wf_tv_standard_of(systems[i])->total_lines)
            continue;
        tv->system = systems[i];
        tv->width_px = raster->width_px;
        tv->lines = raster->lines;
        tv->line1 = raster->line1;
        tv->line2 = raster->line2;
        tv->top_first = raster->top_first;
        return true;
    }
    return false;
}
