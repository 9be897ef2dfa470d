/* QuickTime's structure, and MP4's (ISO/IEC 14496-12): atoms to the last byte, the chunks of
 * every track, lengths, and which tracks of sound are heard. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/big_endian.h"
#include "convert/media/structure/extent.h"

#define DEEPEST    8
#define TABLE_MOST ((int64_t)1 << 28) /* bytes of a table that is read */

typedef struct atom {
    char name[4];
    int64_t at, body, next;
} atom;

typedef struct table {
    uint8_t *data; /* owned; NULL: it is not there */
    size_t bytes;
} table;

/* What is read of a track before its chunks are looked at. */
typedef struct track {
    char handler[4];
    uint32_t scale;        /* of its own time */
    double length_s;       /* by mdhd */
    uint64_t shown, edits; /* by tkhd, in the movie's time; entries of elst */
    bool disabled, grouped, elsewhere;
    table sizes, chunks, runs;
    bool wide; /* chunks have 64 bits */
} track;

typedef struct movie {
    const wf_extent *x;
    wf_structure *s;
    track *of; /* the track that is read; NULL: none */
    uint32_t scale;
    bool there, fragments, fragment_index;
} movie;

static bool is(const atom *a, const char *name) {
    return !memcmp(a->name, name, 4);
}

/* False at the end of the parent, and where what stands there is no atom. One of size 0 goes to
 * the end. */
static bool next_atom(const wf_extent *x, int64_t at, int64_t end, atom *out) {
    uint8_t head[16];
    if (end - at < 8 || !wf_extent_read(x, at, head, 8)) return false;
    uint64_t bytes = wf_big_endian(head, 4), used = 8;
    memcpy(out->name, head + 4, 4);
    if (bytes == 1) { /* 64 bits follow */
        if (!wf_extent_read(x, at + 8, head + 8, 8)) return false;
        bytes = wf_big_endian(head + 8, 8);
        used = 16;
    }
    if (!bytes) bytes = (uint64_t)(end - at);
    out->at = at;
    out->body = at + (int64_t)used;
    out->next = at + (int64_t)bytes;
    return bytes >= used && bytes <= (uint64_t)(end - at);
}

/* ---- Headers ---- */

/* Numbers of mvhd, tkhd and mdhd are 4 or, in version 1, 8 bytes long. */
static void read_movie_header(movie *m, const atom *a) {
    uint8_t v[32];
    if (!wf_extent_read(m->x, a->body, v, 20)) return;
    bool wide = v[0] == 1 && wf_extent_read(m->x, a->body, v, sizeof v);
    m->scale = (uint32_t)wf_big_endian(v + (wide ? 20 : 12), 4);
    double length = (double)wf_big_endian(v + (wide ? 24 : 16), wide ? 8 : 4);
    if (m->scale && !m->fragments)
        wf_state(m->s, "mvhd", length / m->scale, 1.0 / m->scale, true);
}

static void read_media_header(movie *m, const atom *a) {
    uint8_t v[32];
    if (!wf_extent_read(m->x, a->body, v, 20)) return;
    bool wide = v[0] == 1 && wf_extent_read(m->x, a->body, v, sizeof v);
    m->of->scale = (uint32_t)wf_big_endian(v + (wide ? 20 : 12), 4);
    double length = (double)wf_big_endian(v + (wide ? 24 : 16), wide ? 8 : 4);
    if (m->of->scale) m->of->length_s = length / m->of->scale;
}

static void read_track_header(movie *m, const atom *a) {
    uint8_t v[48];
    if (!wf_extent_read(m->x, a->body, v, 36)) return;
    bool wide = v[0] == 1 && wf_extent_read(m->x, a->body, v, sizeof v);
    m->of->disabled = !(v[3] & 1);
    m->of->shown = wf_big_endian(v + (wide ? 28 : 20), wide ? 8 : 4);
    m->of->grouped = wf_big_endian(v + (wide ? 46 : 34), 2) != 0;
}

static void read_handler(movie *m, const atom *a) {
    char name[4];
    bool there = wf_extent_read(m->x, a->body + 8, name, sizeof name);
    if (there && memcmp(name, "url ", 4) && memcmp(name, "alis", 4))
        memcpy(m->of->handler, name, sizeof name);
}

/* A data reference whose flag 1 is not set is another file. */
static void read_reference(movie *m, const atom *a) {
    uint8_t v[20];
    if (wf_extent_read(m->x, a->body, v, sizeof v)) m->of->elsewhere = !(v[19] & 1);
}

static void read_edits(movie *m, const atom *a) {
    uint8_t v[8];
    if (wf_extent_read(m->x, a->body, v, sizeof v)) m->of->edits = wf_big_endian(v + 4, 4);
}

/* ---- Tables ---- */

static void load(const wf_extent *x, const atom *a, table *out) {
    int64_t bytes = a->next - a->body;
    if (out->data || bytes > TABLE_MOST || bytes < 8) return;
    out->data = malloc((size_t)bytes);
    out->bytes = (size_t)bytes;
    if (!out->data || wf_extent_read(x, a->body, out->data, out->bytes)) return;
    free(out->data);
    out->data = NULL;
}

/* Number `column` of row `i` of a table whose rows begin at byte 8, or 12 for sizes. */
static uint64_t cell(const table *t, size_t start, size_t row_bytes, uint64_t i, size_t column,
                     size_t bytes) {
    uint64_t at = start + i * row_bytes + column;
    return i < UINT32_MAX && at + bytes <= t->bytes ? wf_big_endian(t->data + at, bytes) : 0;
}

static uint64_t rows_of(const table *t, size_t start, size_t row_bytes) {
    return t->bytes < start ? 0 : (t->bytes - start) / row_bytes;
}

/* Bytes of `count` samples from `first` on. */
static uint64_t bytes_of(const table *sizes, uint64_t first, uint64_t count) {
    uint64_t each = cell(sizes, 4, 0, 0, 0, 4), sum = 0;
    if (each) return each * count;
    for (uint64_t i = 0; i < count && first + i < rows_of(sizes, 12, 4); i++)
        sum += cell(sizes, 12, 4, first + i, 0, 4);
    return sum;
}

/* Looks where each chunk ends. */
static void check_chunks(movie *m, const track *t) {
    size_t wide = t->wide ? 8 : 4;
    uint64_t chunks = rows_of(&t->chunks, 8, wide), sample = 0, run = 0;
    uint64_t runs = rows_of(&t->runs, 8, 12);
    for (uint64_t i = 0; i < chunks; i++) {
        while (run + 1 < runs && cell(&t->runs, 8, 12, run + 1, 0, 4) <= i + 1) run++;
        uint64_t count = cell(&t->runs, 8, 12, run, 4, 4);
        uint64_t at = cell(&t->chunks, 8, wide, i, 0, wide);
        uint64_t bytes = bytes_of(&t->sizes, sample, count);
        sample += count;
        if (at > (uint64_t)m->x->bytes || bytes > (uint64_t)m->x->bytes - at)
            return wf_missing(m->s, "chunk %" PRIu64 " of a track (%.4s) is not there", i,
                              t->handler);
    }
}

static void finish_track(movie *m, track *t) {
    bool video = !memcmp(t->handler, "vide", 4), sound = !memcmp(t->handler, "soun", 4);
    bool tables = t->sizes.data && t->chunks.data && t->runs.data;
    if (video && !m->fragments) {
        wf_state(m->s, "mdhd", t->length_s, t->scale ? 1.0 / t->scale : 0, false);
        if (m->scale && t->edits < 2)
            wf_state(m->s, "tkhd", (double)t->shown / m->scale, 1.0 / m->scale, false);
    }
    m->s->sound_tracks += sound;
    m->s->sound_disabled += sound && t->disabled;
    m->s->sound_grouped += sound && t->grouped;
    if (tables && !t->elsewhere) check_chunks(m, t);
    free(t->sizes.data);
    free(t->chunks.data);
    free(t->runs.data);
}

/* ---- The tree ---- */

static void descend(movie *m, int64_t at, int64_t end, int depth);

static void read_track(movie *m, const atom *a, int depth) {
    track t = {.scale = 0};
    track *outer = m->of;
    m->of = &t;
    descend(m, a->body, a->next, depth);
    m->of = outer;
    finish_track(m, &t);
}

/* Atoms of a track, and who reads them. */
static void read_of_track(movie *m, const atom *a) {
    static const struct {
        const char name[5];
        void (*read)(movie *m, const atom *a);
    } readers[] = {{"tkhd", read_track_header},
                   {"mdhd", read_media_header},
                   {"hdlr", read_handler},
                   {"dref", read_reference},
                   {"elst", read_edits}};
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        if (is(a, readers[i].name)) readers[i].read(m, a);
    if (is(a, "stsz")) load(m->x, a, &m->of->sizes);
    if (is(a, "stsc")) load(m->x, a, &m->of->runs);
    if (is(a, "co64")) m->of->wide = true;
    if (is(a, "stco") || is(a, "co64")) load(m->x, a, &m->of->chunks);
}

static void descend(movie *m, int64_t at, int64_t end, int depth) {
    static const char inner[][5] = {"mdia", "minf", "stbl", "dinf", "edts"};
    for (atom a; depth < DEEPEST && next_atom(m->x, at, end, &a); at = a.next) {
        if (is(&a, "mvhd")) read_movie_header(m, &a);
        if (is(&a, "trak")) read_track(m, &a, depth + 1);
        if (!m->of) continue;
        read_of_track(m, &a);
        for (size_t i = 0; i < sizeof inner / sizeof *inner; i++)
            if (is(&a, inner[i])) descend(m, a.body, a.next, depth + 1);
    }
}

/* mvex may stand behind the tracks that it is about. */
static bool has_fragments(const wf_extent *x, const atom *moov) {
    int64_t at = moov->body;
    for (atom a; next_atom(x, at, moov->next, &a); at = a.next)
        if (is(&a, "mvex")) return true;
    return false;
}

static void read_brand(movie *m, const atom *a) {
    char brand[4];
    if (wf_extent_read(m->x, a->body, brand, sizeof brand))
        m->s->quicktime = !memcmp(brand, "qt  ", sizeof brand);
}

void wf_structure_mov(const wf_extent *x, wf_structure *s) {
    movie m = {.x = x, .s = s};
    int64_t at = 0;
    s->quicktime = true;
    for (atom a; next_atom(x, at, x->bytes, &a); at = a.next) {
        m.fragment_index |= is(&a, "mfra");
        if (is(&a, "ftyp")) read_brand(&m, &a);
        if (!is(&a, "moov") || m.there) continue;
        m.there = true;
        m.fragments = s->fragments = has_fragments(x, &a);
        descend(&m, a.body, a.next, 0);
    }
    if (at < x->bytes)
        wf_missing(s, "it ends within the atom that begins at byte %" PRId64, at);
    if (!m.there) wf_missing(s, "its moov atom is not there");
    s->ends = !m.fragments || m.fragment_index;
}
