/* Tags of TIFF (6.0 and BigTIFF) that say how samples are to be understood. */
#include "convert/media/tiff_tags.h"

#include <stdint.h>
#include <string.h>

#define MOST_ENTRIES 512
#define MOST_PAGES   64
#define REDUCED      1 /* bits of NewSubfileType */
#define MASK         4
#define SHORT        3
#define LONG         4
#define RATIONAL     5
#define FLOAT        11
#define DOUBLE       12

typedef struct tiff {
    FILE *file;
    bool little, big_tiff;
} tiff;

/* An entry of a directory: its values are at offset, or in `inside` where they fit. */
typedef struct entry {
    unsigned tag, type;
    uint64_t count;
    uint8_t inside[8];
} entry;

static uint64_t number(const tiff *t, const uint8_t *at, size_t bytes) {
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; i++) value = value << 8 | at[t->little ? bytes - 1 - i : i];
    return value;
}

static bool read_at(const tiff *t, uint64_t offset, void *to, size_t bytes) {
    return offset < INT64_MAX && !fseeko(t->file, (off_t)offset, SEEK_SET) &&
           fread(to, 1, bytes, t->file) == bytes;
}

static double value_of(const tiff *t, unsigned type, const uint8_t *at) {
    float single;
    double twice;
    uint32_t word = (uint32_t)number(t, at, 4);
    uint64_t words = number(t, at, 8), under = number(t, at + 4, 4);
    memcpy(&single, &word, sizeof single);
    memcpy(&twice, &words, sizeof twice);
    switch (type) {
    case SHORT:
        return (double)number(t, at, 2);
    case LONG:
        return word;
    case RATIONAL:
        return under ? (double)word / (double)under : 0;
    case FLOAT:
        return (double)single;
    default:
        return twice;
    }
}

static size_t size_of(unsigned type) {
    return type == SHORT ? 2 : type == LONG || type == FLOAT ? 4 : 8;
}

/* The first `count` values; false if there are fewer, or of another type. */
static bool read_values(const tiff *t, const entry *e, size_t count, double *to) {
    uint8_t bytes[6 * 8 + 8] = {0};
    size_t each = size_of(e->type), inside = t->big_tiff ? 8 : 4;
    bool known = e->type == SHORT || e->type == LONG || e->type == RATIONAL ||
                 e->type == FLOAT || e->type == DOUBLE;
    if (!known || e->count < count || count > 6) return false;
    if (each * e->count <= inside)
        memcpy(bytes, e->inside, inside);
    else if (!read_at(t, number(t, e->inside, inside), bytes, each * count))
        return false;
    for (size_t i = 0; i < count; i++) to[i] = value_of(t, e->type, bytes + i * each);
    return true;
}

static void take_number(const tiff *t, const entry *e, int *to) {
    double value;
    if (read_values(t, e, 1, &value) && value >= 0 && value < 65536) *to = (int)value;
}

typedef struct found {
    bool white, primaries;
} found;

static void take_entry(const tiff *t, const entry *e, wf_tiff_tags *out, found *f) {
    switch (e->tag) {
    case 254:
        take_number(t, e, &out->subfile);
        break;
    case 256:
        take_number(t, e, &out->width_px);
        break;
    case 257:
        take_number(t, e, &out->lines);
        break;
    case 258:
        take_number(t, e, &out->bits);
        break;
    case 262:
        take_number(t, e, &out->photometric);
        break;
    case 277:
        take_number(t, e, &out->samples);
        break;
    case 318:
        f->white = read_values(t, e, 2, out->chromaticities + 6);
        break;
    case 319:
        f->primaries = read_values(t, e, 6, out->chromaticities);
        break;
    case 338:
        out->has_extra_samples = true;
        break;
    default:
        break;
    }
}

/* Reads a directory, and where the next one is: 0 if there is none. */
static bool read_directory(const tiff *t, uint64_t at, wf_tiff_tags *out, uint64_t *next) {
    uint8_t bytes[20];
    found f = {false, false};
    size_t count_bytes = t->big_tiff ? 8 : 2, entry_bytes = t->big_tiff ? 20 : 12;
    if (!read_at(t, at, bytes, count_bytes)) return false;
    uint64_t count = number(t, bytes, count_bytes);
    at += count_bytes;
    for (uint64_t i = 0; i < count && i < MOST_ENTRIES; i++, at += entry_bytes) {
        if (!read_at(t, at, bytes, entry_bytes)) return false;
        entry e = {.tag = (unsigned)number(t, bytes, 2),
                   .type = (unsigned)number(t, bytes + 2, 2)};
        size_t counted = t->big_tiff ? 8 : 4;
        e.count = number(t, bytes + 4, counted);
        memcpy(e.inside, bytes + 4 + counted, counted);
        take_entry(t, &e, out, &f);
    }
    out->has_chromaticities = f.white && f.primaries;
    size_t offset_bytes = t->big_tiff ? 8 : 4;
    *next = count <= MOST_ENTRIES && read_at(t, at, bytes, offset_bytes)
                ? number(t, bytes, offset_bytes)
                : 0;
    return true;
}

/* Whether there is another picture of the size of the first, which is no mask: smaller ones are
 * made of it. */
static bool has_page(const tiff *t, uint64_t at, const wf_tiff_tags *first) {
    for (int i = 0; at && i < MOST_PAGES; i++) {
        wf_tiff_tags tags = {0};
        if (!read_directory(t, at, &tags, &at)) return false;
        bool same = tags.width_px == first->width_px && tags.lines == first->lines;
        if (same && !(tags.subfile & (REDUCED | MASK))) return true;
    }
    return false;
}

bool wf_tiff_tags_read(FILE *file, wf_tiff_tags *out) {
    uint8_t head[16];
    tiff t = {.file = file};
    *out = (wf_tiff_tags){.photometric = -1, .bits = 1, .samples = 1};
    if (!read_at(&t, 0, head, 8)) return false;
    t.little = head[0] == 'I';
    t.big_tiff = number(&t, head + 2, 2) == 43;
    if (t.big_tiff && !read_at(&t, 0, head, 16)) return false;
    uint64_t at = t.big_tiff ? number(&t, head + 8, 8) : number(&t, head + 4, 4);
    if (!read_directory(&t, at, out, &at)) return false;
    out->more_pages = has_page(&t, at, out);
    return true;
}
