#include "convert/container.h"

#include <string.h>

#include "convert/klv.h"

#define SET_MOST 8192 /* bytes of a descriptor, which has some hundred */

static void put_line_map(uint8_t *set, size_t bytes, const wf_raster *r) {
    size_t length, at = wf_klv_item(set, bytes, WF_MXF_LINE_MAP, &length);
    if (length != 16 || !r->total_lines) return;
    wf_put_big_endian(set + at + 8, (uint64_t)r->line1, 4);
    wf_put_big_endian(set + at + 12, (uint64_t)r->line2, 4);
}

/* The rasters of 601 are 4:3 or 16:9 pictures, whatever their pixels make of it exactly. */
static void put_aspect(uint8_t *set, size_t bytes, const wf_raster *r) {
    size_t length, at = wf_klv_item(set, bytes, WF_MXF_ASPECT, &length);
    bool of_601 = r->matrix == WF_601_525 || r->matrix == WF_601_625;
    bool wide = wf_ratio_value(r->pixel_aspect) > 1.15;
    if (length != 8 || !of_601 || !r->total_lines) return;
    wf_put_big_endian(set + at, wide ? 16 : 4, 4);
    wf_put_big_endian(set + at + 4, wide ? 9 : 3, 4);
}

static weft_status mend_descriptor(wf_outfile *file, const wf_klv *k, const wf_raster *raster,
                                   weft_error *err) {
    uint8_t set[SET_MOST];
    size_t bytes = (size_t)(k->next - k->value), got;
    if (bytes > sizeof set) return WEFT_OK;
    weft_status status = wf_outfile_read(file, k->value, set, bytes, &got, err);
    if (status || got < bytes) return status;
    put_line_map(set, bytes, raster);
    put_aspect(set, bytes, raster);
    status = wf_outfile_seek(file, k->value, err);
    return status ? status : wf_outfile_write(file, set, bytes, err);
}

weft_status wf_container_mend(wf_outfile *file, const char *muxer, const wf_raster *raster,
                              weft_error *err) {
    if (strncmp(muxer, "mxf", 3)) return WEFT_OK;
    for (wf_klv k = {{0}, 0, 0};;) {
        uint8_t head[WF_KLV_HEAD_BYTES];
        size_t got;
        weft_status status = wf_outfile_read(file, k.next, head, sizeof head, &got, err);
        if (status || !got) return status;
        if (!wf_klv_parse(head, got, k.next, &k))
            return wf_fail(err, WEFT_FAILED,
                           "the MXF that libavformat wrote is not well formed");
        if (wf_klv_is_picture(wf_klv_set_kind(k.key)))
            status = mend_descriptor(file, &k, raster, err);
        if (status) return status;
    }
}
