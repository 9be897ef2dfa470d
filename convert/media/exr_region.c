/* weft:region, read from the header of an EXR file. */
#include "convert/media/exr_region.h"

#include <stdio.h>
#include <string.h>

#include "convert/base/infile.h"

enum { LONGEST_NAME = 256, MOST_ATTRIBUTES = 4096, LONGEST_TEXT = 128 };

/* An attribute: its name and type, and how many bytes of the file its value has. */
typedef struct attribute {
    char name[LONGEST_NAME], type[LONGEST_NAME];
    uint32_t size;
} attribute;

/* What is looked for; windows are half-open. */
typedef struct header {
    wf_box display, data, region;
    bool has_region, is_box;
    bool is_far;             /* a window or region reaches beyond what pixels are counted to */
    char text[LONGEST_TEXT]; /* of a region that is text */
} header;

static bool read_word(FILE *file, char word[LONGEST_NAME]) {
    for (int i = 0, c; i < LONGEST_NAME; i++) {
        if ((c = getc(file)) == EOF) return false;
        word[i] = (char)c;
        if (!c) return true;
    }
    return false;
}

static bool read_number(FILE *file, uint32_t *number) {
    uint8_t b[4];
    if (fread(b, 1, 4, file) != 4) return false;
    *number =
        (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    return true;
}

/* False at the header's end, which an empty name is, and where it is cut off. */
static bool next_attribute(FILE *file, attribute *a) {
    return read_word(file, a->name) && *a->name && read_word(file, a->type) &&
           read_number(file, &a->size);
}

static bool is(const attribute *a, const char *name, const char *type) {
    return !strcmp(a->name, name) && !strcmp(a->type, type);
}

/* Places of pixels beyond this are damage, and could not be added to one another. */
static bool is_place(int64_t n) {
    return n > -(INT64_C(1) << 29) && n < INT64_C(1) << 29;
}

/* One that is too far is read over, so that what stands behind it is seen. */
static bool read_box(FILE *file, wf_box *box, bool *is_far) {
    int32_t n[4];
    for (int i = 0; i < 4; i++) {
        uint32_t bits;
        if (!read_number(file, &bits)) return false;
        n[i] = (int32_t)bits;
    }
    for (int i = 0; i < 4; i++)
        if (!is_place(n[i])) return *is_far = true;
    *box = (wf_box){n[0], n[1], n[2] + 1, n[3] + 1};
    return true;
}

static bool read_text(FILE *file, uint32_t size, char text[LONGEST_TEXT]) {
    if (size >= LONGEST_TEXT || fread(text, 1, size, file) != size) return false;
    text[size] = '\0';
    return true;
}

static bool skip(FILE *file, uint32_t size) {
    return !fseeko(file, (off_t)size, SEEK_CUR);
}

static bool take_region(FILE *file, const attribute *a, header *h) {
    h->has_region = true;
    h->is_box = is(a, a->name, "box2i") && a->size == 16;
    if (h->is_box) return read_box(file, &h->region, &h->is_far);
    return is(a, a->name, "string") ? read_text(file, a->size, h->text) : skip(file, a->size);
}

static bool take(FILE *file, const attribute *a, header *h) {
    if (is(a, "displayWindow", "box2i") && a->size == 16)
        return read_box(file, &h->display, &h->is_far);
    if (is(a, "dataWindow", "box2i") && a->size == 16)
        return read_box(file, &h->data, &h->is_far);
    if (!strcmp(a->name, "weft:region")) return take_region(file, a, h);
    return skip(file, a->size);
}

static void read_header(FILE *file, header *h) {
    uint32_t magic, version;
    attribute a;
    if (!read_number(file, &magic) || magic != 20000630 || !read_number(file, &version)) return;
    for (int i = 0; i < MOST_ATTRIBUTES && next_attribute(file, &a); i++)
        if (!take(file, &a, h)) return;
}

/* From the display window's corner. */
static bool settle(header *h) {
    int x = h->display.x0, y = h->display.y0;
    wf_box *r = &h->region;
    if (!h->is_box) {
        char rest;
        long long n[4];
        if (sscanf(h->text, "%lld ,%lld ,%lld ,%lld%c", &n[0], &n[1], &n[2], &n[3], &rest) != 4)
            return false;
        for (int i = 0; i < 4; i++)
            if (!is_place(n[i])) return false;
        *r = (wf_box){(int)n[0], (int)n[1], (int)n[2], (int)n[3]};
        return true;
    }
    *r = (wf_box){r->x0 - x, r->y0 - y, r->x1 - x, r->y1 - y};
    return true;
}

/* Whether it has a pixel that the file could have. */
static bool meets(const header *h) {
    int x0 = h->data.x0 < h->display.x0 ? h->data.x0 - h->display.x0 : 0;
    int y0 = h->data.y0 < h->display.y0 ? h->data.y0 - h->display.y0 : 0;
    int x1 = (h->data.x1 > h->display.x1 ? h->data.x1 : h->display.x1) - h->display.x0;
    int y1 = (h->data.y1 > h->display.y1 ? h->data.y1 : h->display.y1) - h->display.y0;
    const wf_box *r = &h->region;
    return r->x0 < r->x1 && r->y0 < r->y1 && r->x0 < x1 && r->x1 > x0 && r->y0 < y1 &&
           r->y1 > y0;
}

weft_status wf_exr_region(const char *path, wf_box *region, bool *has, weft_error *err) {
    header h = {.has_region = false};
    *has = false;
    FILE *file;
    weft_status status = wf_infile_open(path, &file, err);
    if (status) return status;
    read_header(file, &h);
    status = wf_infile_close(file, path, WEFT_OK, err);
    if (status || !h.has_region) return status;
    if (h.is_far || !settle(&h) || !meets(&h))
        return wf_fail(
            err, WEFT_FAILED,
            "%s: its weft:region is no rectangle of its pixels; it is a box2i, or text "
            "such as 0,0,%d,%d for all of it",
            path, h.display.x1 - h.display.x0, h.display.y1 - h.display.y0);
    *region = h.region;
    *has = true;
    return WEFT_OK;
}
