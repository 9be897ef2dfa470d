/* QuickTime's atoms about the picture (QuickTime File Format, and Apple's TN2162). */
#include <string.h>

#include "convert/claims.h"
#include "convert/klv.h"

#define DEEPEST      8
#define ENTRY_BYTES  86 /* of a video sample description before its extensions */
#define DESCRIPTIONS 8  /* version, flags and count of stsd */

typedef struct atom {
    char name[4];
    int64_t body, next;
} atom;

/* False at the end of the parent, and where there is no atom. */
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

static void read_extensions(FILE *file, int64_t at, int64_t end, wf_claims *claims) {
    for (atom a; next_atom(file, at, end, &a); at = a.next) {
        uint8_t value[2];
        claims->has_pasp |= is(&a, "pasp");
        claims->has_colr |= is(&a, "colr");
        claims->has_clap |= is(&a, "clap");
        if (!is(&a, "fiel") || fseeko(file, (off_t)a.body, SEEK_SET) ||
            fread(value, sizeof value, 1, file) != 1)
            continue;
        claims->has_fiel = true;
        claims->fiel[0] = value[0];
        claims->fiel[1] = value[1];
    }
}

/* Whether a media atom's handler is of video. */
static bool is_video(FILE *file, int64_t at, int64_t end) {
    char kind[4] = "";
    for (atom a; next_atom(file, at, end, &a); at = a.next)
        if (is(&a, "hdlr") && !fseeko(file, (off_t)a.body + 8, SEEK_SET))
            return fread(kind, sizeof kind, 1, file) == 1 && !memcmp(kind, "vide", 4);
    return false;
}

static void descend(FILE *file, int64_t at, int64_t end, int depth, wf_claims *claims) {
    static const char inner[][5] = {"moov", "trak", "mdia", "minf", "stbl"};
    for (atom a, entry; depth < DEEPEST && next_atom(file, at, end, &a); at = a.next) {
        bool goes_in = false;
        for (size_t i = 0; i < sizeof inner / sizeof *inner; i++) goes_in |= is(&a, inner[i]);
        if (is(&a, "mdia") && !is_video(file, a.body, a.next)) goes_in = false;
        if (is(&a, "stsd") && next_atom(file, a.body + DESCRIPTIONS, a.next, &entry))
            read_extensions(file, entry.body + ENTRY_BYTES - 8, entry.next, claims);
        if (goes_in) descend(file, a.body, a.next, depth + 1, claims);
    }
}

void wf_claims_mov(FILE *file, wf_claims *claims) {
    if (!fseeko(file, 0, SEEK_END)) descend(file, 0, (int64_t)ftello(file), 0, claims);
}
