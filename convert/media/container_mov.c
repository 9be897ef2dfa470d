/* Completes QuickTime files of libavformat's. Their moov atom is the last: it is read, copied
 * with what is completed, and written over. Where it grows, nothing follows that has to move.
 */
#include "convert/media/container_mov.h"

#include <stdlib.h>
#include <string.h>

#include "convert/base/big_endian.h"

#define MOOV_MOST         ((int64_t)1 << 30)
#define ENTRY_BYTES       86 /* of a video's sample description before its extensions */
#define SOUND_ENTRY_BYTES 36 /* of a sound's, version 0 */
#define LAYOUT_BYTES      24
#define COMPRESSOR_AT     50
#define COMPRESSOR_MOST   31
#define GROWTH_BYTES                                                                           \
    4096 /* that a movie grows by at most, with 64 tracks of sound and more                    \
          */

typedef struct atoms {
    const uint8_t *from;
    uint8_t *to;
    size_t used; /* of to */
    const wf_container_facts *facts;
    bool quicktime;    /* else it is MP4, whose descriptions libavformat has right */
    bool video, sound; /* the track that is copied is one */
} atoms;

static bool is(const uint8_t *atom, const char *type) {
    return !memcmp(atom + 4, type, 4);
}

/* ---- The picture ---- */

void wf_clean_aperture(const wf_raster *r, uint32_t *width, uint32_t *lines) {
    static const wf_rational shapes[] = {{10, 11}, {40, 33}, {12, 11}, {16, 11}};
    bool narrow = false;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        narrow = narrow || wf_ratio_equal(r->pixel_aspect, shapes[i]);
    narrow = narrow && r->width_px == 720;
    *width = narrow ? 704 : (uint32_t)r->width_px;
    *lines = narrow && r->lines == 486 ? 480 : (uint32_t)r->lines;
}

static uint8_t *begin(atoms *a, const char *type, uint32_t bytes) {
    uint8_t *atom = a->to + a->used;
    wf_put_big_endian(atom, bytes, 4);
    memcpy(atom + 4, type, 4);
    memset(atom + 8, 0, bytes - 8);
    a->used += bytes;
    return atom + 8;
}

/* Progressive files have one field. Others have two, whose lines are stored in turn: 9 says
 * that the top field is shown first, 14 the bottom one. */
static void put_fields(atoms *a) {
    const wf_raster *r = a->facts->raster;
    uint8_t *value = begin(a, "fiel", 10);
    value[0] = r->scan == WF_INTERLACED ? 2 : 1;
    value[1] = r->scan != WF_INTERLACED ? 0 : r->top_first ? 9 : 14;
}

static void put_colors(atoms *a) {
    const wf_color_tags *tags = &a->facts->tags;
    uint8_t *value = begin(a, "colr", 18);
    memcpy(value, "nclc", 4);
    value[5] = (uint8_t)tags->primaries;
    value[7] = (uint8_t)tags->transfer;
    value[9] = (uint8_t)tags->matrix;
}

static void put_shape(atoms *a) {
    const wf_raster *r = a->facts->raster;
    uint8_t *value = begin(a, "pasp", 16);
    wf_put_big_endian(value, (uint32_t)r->pixel_aspect.num, 4);
    wf_put_big_endian(value + 4, (uint32_t)r->pixel_aspect.den, 4);
}

static void put_aperture(atoms *a) {
    uint32_t width, lines;
    wf_clean_aperture(a->facts->raster, &width, &lines);
    uint8_t *value = begin(a, "clap", 40);
    const uint32_t ratios[] = {width, 1, lines, 1, 0, 1, 0, 1}; /* size, and from the center */
    for (size_t i = 0; i < sizeof ratios / sizeof *ratios; i++)
        wf_put_big_endian(value + 4 * i, ratios[i], 4);
}

/* ---- Copying ---- */

static void copy(atoms *a, size_t at, size_t bytes) {
    memcpy(a->to + a->used, a->from + at, bytes);
    a->used += bytes;
}

static void put_compressor(uint8_t *entry, const char *name) {
    size_t length = name ? strlen(name) : 0;
    if (!length) return;
    if (length > COMPRESSOR_MOST) length = COMPRESSOR_MOST;
    memset(entry + COMPRESSOR_AT, 0, 1 + COMPRESSOR_MOST);
    entry[COMPRESSOR_AT] = (uint8_t)length;
    memcpy(entry + COMPRESSOR_AT + 1, name, length);
}

static const char *const own[] = {"fiel", "colr", "pasp", "clap"};

static bool is_own(const uint8_t *atom) {
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (is(atom, own[i])) return true;
    return false;
}

/* How long the atom at `at` is, which ends before `end`; 0 where there is none, or a
 * terminator. */
static size_t atom_bytes(const atoms *a, size_t at, size_t end) {
    size_t bytes = end - at < 8 ? 0 : wf_big_endian(a->from + at, 4);
    return bytes < 8 || bytes > end - at ? 0 : bytes;
}

/* Copies the first entry of a video's sample description: the atoms that describe the codec,
 * then those of weft that describe the picture. */
static void copy_entry(atoms *a, size_t at, size_t end) {
    size_t start = a->used, bytes;
    copy(a, at, ENTRY_BYTES);
    put_compressor(a->to + start, a->facts->compressor);
    for (at += ENTRY_BYTES; (bytes = atom_bytes(a, at, end)); at += bytes)
        if (!is_own(a->from + at)) copy(a, at, bytes);
    put_fields(a);
    put_colors(a);
    put_shape(a);
    put_aperture(a);
    wf_put_big_endian(a->to + start, (uint32_t)(a->used - start), 4);
}

/* Tracks of one or two channels say so; libavformat says nothing of channels that it has no
 * names for. */
static void put_layout(atoms *a, unsigned channels) {
    static const uint32_t tags[] = {0, 100 << 16 | 1, 101 << 16 | 2}; /* mono, stereo */
    if (channels >= sizeof tags / sizeof *tags) return;
    wf_put_big_endian(begin(a, "chan", LAYOUT_BYTES) + 4, tags[channels], 4);
}

/* Copies the first entry of a sound's sample description. */
static void copy_sound_entry(atoms *a, size_t at, size_t end) {
    const uint8_t *entry = a->from + at;
    size_t start = a->used, bytes;
    bool said = false, longer = wf_big_endian(entry + 16, 2) == 1;
    for (size_t part = at + (longer ? 52 : 36);
         part < end && (bytes = atom_bytes(a, part, end)); part += bytes)
        said |= is(a->from + part, "chan");
    copy(a, at, end - at);
    if (!said) put_layout(a, (unsigned)wf_big_endian(entry + 24, 2));
    wf_put_big_endian(a->to + start, (uint32_t)(a->used - start), 4);
}

static void copy_descriptions(atoms *a, size_t at, size_t end) {
    size_t entry = at + 16, bytes = atom_bytes(a, entry, end);
    copy(a, at, 16);
    bool fits = bytes >= (a->video ? ENTRY_BYTES : SOUND_ENTRY_BYTES);
    if (!fits || (!a->video && !a->sound)) {
        copy(a, entry, end - entry);
        return;
    }
    if (a->video)
        copy_entry(a, entry, entry + bytes);
    else
        copy_sound_entry(a, entry, entry + bytes);
    copy(a, entry + bytes, end - entry - bytes);
}

/* Writes the size at which the clean aperture is shown, as 16.16 fixed point numbers. */
static void put_shown(uint8_t *clef, const wf_raster *r) {
    uint32_t width, lines;
    wf_clean_aperture(r, &width, &lines);
    double shown = width * wf_ratio_value(r->pixel_aspect) * 65536;
    wf_put_big_endian(clef + 12, (uint32_t)(shown + 0.5), 4);
    wf_put_big_endian(clef + 16, lines << 16, 4);
}

/* Every track is enabled, in the movie and in its preview, and belongs to no group of which one
 * track is played: libavformat enables the first track of sound alone, and groups all. */
static void put_heard(uint8_t *tkhd, size_t bytes) {
    size_t group = tkhd[8] == 1 ? 54 : 42; /* in version 1 three numbers have 8 bytes */
    if (bytes < group + 2) return;
    tkhd[11] |= 7;
    wf_put_big_endian(tkhd + group, 0, 2);
}

/* How the picture is laid over others, in its vmhd: 0x100 by straight alpha, 0x102 by alpha
 * that is multiplied already, over black (QuickTime File Format, Graphics Modes). */
static void put_graphics_mode(uint8_t *vmhd, const wf_container_facts *facts) {
    if (facts->alpha) wf_put_big_endian(vmhd + 12, facts->straight ? 0x100 : 0x102, 2);
}

static bool holds(const atoms *a, const char *type, size_t at, size_t end) {
    for (size_t bytes; (bytes = atom_bytes(a, at, end)); at += bytes)
        if (is(a->from + at, type)) return true;
    return false;
}

static bool is_container(const uint8_t *atom) {
    static const char *const names[] = {"moov", "trak", "mdia", "minf", "stbl", "tapt"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (is(atom, names[i])) return true;
    return false;
}

/* Copies an atom and what it holds. It calls itself at most six deep, for moov, trak, mdia,
 * minf and stbl (or tapt) hold each other in this order only. */
static void copy_atom(atoms *a, size_t at, size_t end) {
    size_t start = a->used, bytes;
    const uint8_t *atom = a->from + at;
    if (is(atom, "stsd") && end - at > 16 && a->quicktime) {
        copy_descriptions(a, at, end);
    } else if (is_container(atom)) {
        if (is(atom, "minf")) a->video = holds(a, "vmhd", at + 8, end);
        if (is(atom, "minf")) a->sound = holds(a, "smhd", at + 8, end);
        copy(a, at, 8);
        for (at += 8; (bytes = atom_bytes(a, at, end)); at += bytes)
            copy_atom(a, at, at + bytes);
        copy(a, at, end - at);
    } else {
        copy(a, at, end - at);
        if (is(atom, "tkhd")) put_heard(a->to + start, end - at);
        if (is(atom, "clef") && end - at == 20 && a->quicktime)
            put_shown(a->to + start, a->facts->raster);
        if (is(atom, "vmhd") && end - at == 20) put_graphics_mode(a->to + start, a->facts);
    }
    wf_put_big_endian(a->to + start, (uint32_t)(a->used - start), 4);
}

/* ---- The file ---- */

static weft_status malformed(weft_error *err) {
    return wf_fail(err, WEFT_FAILED,
                   "the QuickTime file that libavformat wrote is not well "
                   "formed");
}

/* Finds the movie atom, which is the last of the file. */
static weft_status find_movie(wf_outfile *file, int64_t *at, int64_t *bytes, weft_error *err) {
    for (*at = 0;; *at += *bytes) {
        uint8_t head[16];
        size_t got;
        weft_status status = wf_outfile_read(file, *at, head, sizeof head, &got, err);
        if (status) return status;
        if (got < 8) return malformed(err);
        *bytes = (int64_t)wf_big_endian(head, 4);
        if (*bytes == 1 && got == sizeof head) *bytes = (int64_t)wf_big_endian(head + 8, 8);
        if (*bytes < 8) return malformed(err);
        if (is(head, "moov")) return WEFT_OK;
    }
}

static weft_status rewrite(wf_outfile *file, const wf_container_facts *facts, int64_t at,
                           size_t bytes, weft_error *err) {
    uint8_t *from = malloc(bytes), *to = malloc(bytes + GROWTH_BYTES);
    size_t got = 0, beyond = 0;
    uint8_t next;
    weft_status status = from && to ? wf_outfile_read(file, at, from, bytes, &got, err)
                                    : wf_fail(err, WEFT_NO_MEMORY, "no memory for a movie");
    if (!status) status = wf_outfile_read(file, at + (int64_t)bytes, &next, 1, &beyond, err);
    if (!status && (got < bytes || beyond)) status = malformed(err);
    if (!status) {
        atoms a = {
            .from = from, .to = to, .facts = facts, .quicktime = !strcmp(facts->muxer, "mov")};
        copy_atom(&a, 0, bytes);
        status = wf_outfile_seek(file, at, err);
        if (!status) status = wf_outfile_write(file, to, a.used, err);
    }
    free(from);
    free(to);
    return status;
}

weft_status wf_container_complete_mov(wf_outfile *file, const wf_container_facts *facts,
                                      weft_error *err) {
    int64_t at, bytes = 0;
    weft_status status = find_movie(file, &at, &bytes, err);
    if (!status && bytes > MOOV_MOST) status = malformed(err);
    return status ? status : rewrite(file, facts, at, (size_t)bytes, err);
}
