/* QuickTime's atoms about the picture (QuickTime File Format, and Apple's TN2162). */
#include <string.h>

#include "convert/base/big_endian.h"
#include "convert/media/metadata_mov.h"

#define DEEPEST      8
#define ENTRY_BYTES  86 /* of a video sample description before its extensions */
#define TIMECODE_AT  12 /* of the flags in the body of its entry */
#define DESCRIPTIONS 8  /* version, flags and count of stsd */

typedef struct atom {
    char name[4];
    int64_t body, next;
} atom;

/* False at the end of the parent, and where what stands there is no atom. */
static bool next_atom(FILE *file, int64_t at, int64_t end, atom *out) {
    uint8_t head[16];
    if (end - at < 8 || fseeko(file, (off_t)at, SEEK_SET) || fread(head, 8, 1, file) != 1)
        return false;
    uint64_t bytes = wf_big_endian(head, 4), used = 8;
    memcpy(out->name, head + 4, 4);
    if (bytes == 1) { /* 64 bits follow */
        if (fread(head + 8, 8, 1, file) != 1) return false;
        bytes = wf_big_endian(head + 8, 8);
        used = 16;
    }
    if (bytes < used || bytes > (uint64_t)(end - at)) return false;
    out->body = at + (int64_t)used;
    out->next = at + (int64_t)bytes;
    return true;
}

static bool is(const atom *a, const char *name) {
    return !memcmp(a->name, name, 4);
}

static bool read_at(FILE *file, int64_t at, void *value, size_t bytes) {
    return !fseeko(file, (off_t)at, SEEK_SET) && fread(value, bytes, 1, file) == 1;
}

/* A size is a ratio of two numbers. */
static int64_t clean_size(const uint8_t *ratio) {
    uint64_t num = wf_big_endian(ratio, 4), den = wf_big_endian(ratio + 4, 4);
    return den ? (int64_t)((num << 16) / den) : 0;
}

static void read_extensions(FILE *file, int64_t at, int64_t end, wf_metadata *metadata) {
    for (atom a; next_atom(file, at, end, &a); at = a.next) {
        uint8_t value[16];
        int64_t bytes = a.next - a.body;
        metadata->has_pasp |= is(&a, "pasp");
        metadata->has_colr |= is(&a, "colr");
        if (is(&a, "fiel") && bytes >= 2 && read_at(file, a.body, value, 2)) {
            metadata->has_fiel = true;
            metadata->fiel[0] = value[0];
            metadata->fiel[1] = value[1];
        }
        if (is(&a, "clap") && bytes >= 32 && read_at(file, a.body, value, sizeof value)) {
            metadata->has_clap = true;
            for (int i = 0; i < 2; i++) metadata->clean[i] = clean_size(value + 8 * i);
        }
    }
}

/* Reads the description of a timecode track: flags, time scale, length of a frame, labels a
 * second. */
static void read_timecode(FILE *file, const atom *entry, wf_metadata *metadata) {
    uint8_t value[13];
    if (!is(entry, "tmcd") || entry->next - entry->body < TIMECODE_AT + (int)sizeof value ||
        metadata->timecode_base ||
        !read_at(file, entry->body + TIMECODE_AT, value, sizeof value))
        return;
    metadata->timecode_drop = value[3] & 1;
    metadata->timecode_base = value[12];
}

typedef enum kind { OTHER, VIDEO, TIMECODE } kind;

/* By the handler of a media atom. */
static kind kind_of(FILE *file, int64_t at, int64_t end) {
    char name[4] = "";
    for (atom a; next_atom(file, at, end, &a); at = a.next)
        if (is(&a, "hdlr") && read_at(file, a.body + 8, name, sizeof name))
            return !memcmp(name, "vide", 4)   ? VIDEO
                   : !memcmp(name, "tmcd", 4) ? TIMECODE
                                              : OTHER;
    return OTHER;
}

typedef struct place {
    int64_t at, end;
    int depth;
    kind of; /* the track */
} place;

static void read_description(FILE *file, const atom *stsd, kind of, wf_metadata *metadata) {
    atom entry;
    if (!next_atom(file, stsd->body + DESCRIPTIONS, stsd->next, &entry)) return;
    if (of == TIMECODE) read_timecode(file, &entry, metadata);
    if (of == VIDEO) read_extensions(file, entry.body + ENTRY_BYTES - 8, entry.next, metadata);
}

static void read_graphics_mode(FILE *file, const atom *vmhd, wf_metadata *metadata) {
    uint8_t value[2];
    if (vmhd->next - vmhd->body >= 6 && read_at(file, vmhd->body + 4, value, sizeof value))
        metadata->graphics_mode = (int)wf_big_endian(value, 2);
}

static void descend(FILE *file, place p, wf_metadata *metadata) {
    static const char inner[][5] = {"moov", "trak", "mdia", "minf", "stbl"};
    for (atom a; p.depth < DEEPEST && next_atom(file, p.at, p.end, &a); p.at = a.next) {
        bool goes_in = false;
        for (size_t i = 0; i < sizeof inner / sizeof *inner; i++) goes_in |= is(&a, inner[i]);
        if (is(&a, "vmhd")) read_graphics_mode(file, &a, metadata);
        if (is(&a, "mdia")) p.of = kind_of(file, a.body, a.next);
        if (is(&a, "stsd")) read_description(file, &a, p.of, metadata);
        if (goes_in) descend(file, (place){a.body, a.next, p.depth + 1, p.of}, metadata);
    }
}

void wf_metadata_mov(FILE *file, wf_metadata *metadata) {
    if (!fseeko(file, 0, SEEK_END))
        descend(file, (place){0, (int64_t)ftello(file), 0, OTHER}, metadata);
}
