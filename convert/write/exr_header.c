/* Headers of OpenEXR: names, types and values, one after another. */
#include "convert/write/exr_header.h"

#include <string.h>

static void put(wf_exr_header *h, const void *data, size_t bytes) {
    h->full |= bytes > sizeof h->bytes - h->used;
    if (h->full) return;
    memcpy(h->bytes + h->used, data, bytes);
    h->used += bytes;
}

static void put_name(wf_exr_header *h, const char *name) {
    put(h, name, strlen(name) + 1);
}

static void put_number(wf_exr_header *h, int32_t value) {
    put(h, &value, sizeof value);
}

static void put_head(wf_exr_header *h, const char *name, const char *type, size_t bytes) {
    put_name(h, name);
    put_name(h, type);
    put_number(h, (int32_t)bytes);
}

void wf_exr_header_begin(wf_exr_header *h, int32_t flags) {
    const int32_t magic = 20000630, version = 2;
    h->used = 0;
    h->full = false;
    put_number(h, magic);
    put_number(h, version | flags);
}

void wf_exr_header_end(wf_exr_header *h) {
    put(h, "", 1);
}

void wf_exr_put(wf_exr_header *h, const char *name, const char *type, const void *value,
                size_t bytes) {
    put_head(h, name, type, bytes);
    put(h, value, bytes);
}

void wf_exr_put_int(wf_exr_header *h, const char *name, int32_t value) {
    wf_exr_put(h, name, "int", &value, sizeof value);
}

void wf_exr_put_text(wf_exr_header *h, const char *name, const char *text) {
    if (*text) wf_exr_put(h, name, "string", text, strlen(text));
}

void wf_exr_put_ratio(wf_exr_header *h, const char *name, wf_rational r) {
    const int32_t ratio[2] = {(int32_t)r.num, (int32_t)r.den};
    if (r.den > 0 && r.num <= INT32_MAX && r.den <= INT32_MAX)
        wf_exr_put(h, name, "rational", ratio, sizeof ratio);
}

void wf_exr_put_channels(wf_exr_header *h, const char *const *name, size_t count) {
    enum { FLOAT = 2 };
    const int32_t about[4] = {FLOAT, 0, 1, 1}; /* not of pLinear; sampling */
    size_t bytes = 1;
    for (size_t c = 0; c < count; c++) bytes += strlen(name[c]) + 1 + sizeof about;
    put_head(h, "channels", "chlist", bytes);
    for (size_t c = 0; c < count; c++) {
        put_name(h, name[c]);
        put(h, about, sizeof about);
    }
    put(h, "", 1);
}

void wf_exr_put_required(wf_exr_header *h, int compression, int width_px, int lines,
                         wf_rational pixel_aspect) {
    const int32_t window[4] = {0, 0, width_px - 1, lines - 1};
    const uint8_t how = (uint8_t)compression, increasing_y = 0;
    const float aspect = (float)wf_ratio_value(pixel_aspect), one = 1, center[2] = {0, 0};
    wf_exr_put(h, "compression", "compression", &how, 1);
    wf_exr_put(h, "dataWindow", "box2i", window, sizeof window);
    wf_exr_put(h, "displayWindow", "box2i", window, sizeof window);
    wf_exr_put(h, "lineOrder", "lineOrder", &increasing_y, 1);
    wf_exr_put(h, "pixelAspectRatio", "float", &aspect, sizeof aspect);
    wf_exr_put(h, "screenWindowCenter", "v2f", center, sizeof center);
    wf_exr_put(h, "screenWindowWidth", "float", &one, sizeof one);
}
