/* QuickTime: libavformat 5.1 leaves the fields of DNxHD and H.264 unsaid. */
#include <stdlib.h>
#include <string.h>

#include "convert/container_kinds.h"
#include "convert/klv.h"

#define MOVIE_MOST  ((int64_t)1 << 28) /* bytes of an index that is held in memory */
#define ENTRY_BYTES 86                 /* of a video sample description, before its atoms */
#define FIEL_BYTES  10
#define DEPTH       7

typedef struct movie {
    uint8_t *bytes;
    size_t size;
    size_t path[DEPTH]; /* of the atoms around the video's sample description: where they are */
} movie;

static size_t size_of(const movie *m, size_t at) {
    return (size_t)wf_big_endian(m->bytes + at, 4);
}

/* The atom `name` between two places; `end` where there is none. */
static size_t find_atom(const movie *m, size_t at, size_t end, const char *name) {
    while (at + 8 <= end) {
        size_t bytes = size_of(m, at);
        if (bytes < 8 || bytes > end - at) return end;
        if (!memcmp(m->bytes + at + 4, name, 4)) return at;
        at += bytes;
    }
    return end;
}

/* Follows the names from the track at path[1] down; false where one is not there. */
static bool descend(movie *m) {
    static const char names[][5] = {"mdia", "minf", "stbl", "stsd"};
    for (int d = 2; d < DEPTH - 1; d++) {
        size_t parent = m->path[d - 1], end = parent + size_of(m, parent);
        m->path[d] = find_atom(m, parent + 8, end, names[d - 2]);
        if (m->path[d] == end) return false;
    }
    m->path[DEPTH - 1] = m->path[DEPTH - 2] + 16; /* version, flags and count are between */
    return m->path[DEPTH - 1] + ENTRY_BYTES <= m->size;
}

static bool is_video(const movie *m) {
    size_t media = m->path[2], end = media + size_of(m, media);
    size_t handler = find_atom(m, media + 8, end, "hdlr");
    return handler + 20 <= end && !memcmp(m->bytes + handler + 16, "vide", 4);
}

static bool find_video(movie *m) {
    m->path[0] = 0;
    for (size_t at = 8; at < m->size; at += size_of(m, at)) {
        at = m->path[1] = find_atom(m, at, m->size, "trak");
        if (at == m->size) return false;
        if (descend(m) && is_video(m)) return true;
    }
    return false;
}

/* QuickTime File Format, field handling: {2, 9} has the top field earlier, {2, 14} the bottom.
 */
static void put_fiel(movie *m, size_t at, const wf_raster *raster) {
    bool fields = raster->scan == WF_INTERLACED;
    uint8_t *to = m->bytes + at;
    memmove(to + FIEL_BYTES, to, m->size - at);
    wf_put_big_endian(to, FIEL_BYTES, 4);
    memcpy(to + 4, "fiel", 4);
    to[8] = fields ? 2 : 1;
    to[9] = !fields ? 0 : raster->top_first ? 9 : 14;
    m->size += FIEL_BYTES;
    for (int d = 0; d < DEPTH; d++)
        wf_put_big_endian(m->bytes + m->path[d], size_of(m, m->path[d]) + FIEL_BYTES, 4);
}

/* True where something was added. */
static bool mend_movie(movie *m, const wf_raster *raster) {
    if (!find_video(m)) return false;
    size_t entry = m->path[DEPTH - 1], end = entry + size_of(m, entry);
    if (end > m->size || find_atom(m, entry + ENTRY_BYTES, end, "fiel") != end) return false;
    /* Before the others: those of DNxHD end in zeros, at which readers stop. */
    put_fiel(m, entry + ENTRY_BYTES, raster);
    return true;
}

/* The index, which is the file's last atom and so may grow. */
static weft_status read_movie(wf_outfile *file, int64_t *at, movie *m, weft_error *err) {
    for (*at = 0;;) {
        uint8_t head[16];
        size_t got;
        weft_status status = wf_outfile_read(file, *at, head, sizeof head, &got, err);
        if (status || got < 8) return status;
        int64_t bytes = (int64_t)wf_big_endian(head, 4);
        if (bytes == 1 && got == 16) bytes = (int64_t)wf_big_endian(head + 8, 8);
        if (bytes < 8) return WEFT_OK;
        if (memcmp(head + 4, "moov", 4)) {
            *at += bytes;
            continue;
        }
        if (bytes > MOVIE_MOST) return WEFT_OK;
        m->bytes = malloc((size_t)bytes + FIEL_BYTES);
        if (!m->bytes) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a movie's index");
        status = wf_outfile_read(file, *at, m->bytes, (size_t)bytes, &m->size, err);
        return status;
    }
}

weft_status wf_container_mend_mov(wf_outfile *file, const wf_raster *raster, weft_error *err) {
    movie m = {NULL, 0, {0}};
    int64_t at = 0;
    weft_status status = read_movie(file, &at, &m, err);
    if (!status && m.bytes && mend_movie(&m, raster)) {
        status = wf_outfile_seek(file, at, err);
        if (!status) status = wf_outfile_write(file, m.bytes, m.size, err);
    }
    free(m.bytes);
    return status;
}
