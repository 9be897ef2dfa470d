/* Writes an MXF file: partitions, edit units, index, random index pack. */
#include "convert/write/mxf.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "convert/write/mxf_parts.h"

/* Elements of the generic container start at multiples of this many bytes. */
#define GRID_BYTES 512

#define ELEMENT(number)                                                                        \
    { 0x060e2b3401020101, 0x0d01030100000000 | (number) }

typedef enum partition_kind { HEADER = 2, BODY = 3, FOOTER = 4, PARTITIONS = 3 } partition_kind;

struct wf_mxf {
    wf_mxf_options options;
    wf_outfile *file;
    wf_uid seed;
    XXH3_state_t *hash;   /* of all bytes that are written */
    wf_bytes bytes;       /* what is being put together */
    uint64_t at;          /* bytes written */
    int64_t frames;       /* written */
    size_t picture_bytes; /* of an edit unit, with what fills it up */
    size_t sound_bytes;   /* of each sound element, likewise */
    size_t header_bytes;  /* of the header metadata */
    uint64_t start[PARTITIONS];
    int32_t *samples; /* of a frame, [][tracks]; NULL: there is no sound */
    uint8_t *packed;  /* the same of one track as it is written */
};

/* ---- Sizes ---- */

static size_t on_grid(size_t bytes) {
    return (bytes + GRID_BYTES - 1) / GRID_BYTES * GRID_BYTES;
}

/* How many samples of sound the run's frames before the file's frame n have. */
static int64_t samples_before(const wf_mxf *m, int64_t n) {
    return wf_sound_samples(m->options.raster->frame_rate, m->options.first_frame + n);
}

/* How long an element is: it always ends in a fill item, which makes all elements of a kind
 * equally long. */
static size_t element_bytes(size_t value_bytes) {
    const size_t key_and_length = 24;
    return on_grid(key_and_length + value_bytes + WF_KLV_FILL_LEAST);
}

static size_t unit_bytes(const wf_mxf *m) {
    return m->picture_bytes + m->sound_bytes * (size_t)m->options.sound.tracks;
}

static size_t most_samples(const wf_mxf *m) {
    wf_rational rate = m->options.raster->frame_rate;
    return (size_t)(WF_SOUND_RATE * rate.den / rate.num) + 1;
}

static size_t sample_bytes(const wf_mxf *m) {
    return (size_t)m->options.sound.bits / 8;
}

static void plan_sizes(wf_mxf *m) {
    m->picture_bytes = element_bytes(m->options.frame_bytes);
    m->sound_bytes = element_bytes(most_samples(m) * sample_bytes(m));
}

/* ---- Writing ---- */

static weft_status flush(wf_mxf *m, weft_error *err) {
    if (m->bytes.failed) return wf_fail(err, WEFT_NO_MEMORY, "no memory for an MXF partition");
    XXH3_128bits_update(m->hash, m->bytes.data, m->bytes.size);
    weft_status status = wf_outfile_write(m->file, m->bytes.data, m->bytes.size, err);
    m->at += m->bytes.size;
    m->bytes.size = 0;
    return status;
}

static void put_partition(wf_mxf *m, partition_kind kind, size_t index_bytes) {
    wf_bytes *b = &m->bytes;
    wf_ul containers[WF_MXF_CONTAINERS];
    int count = wf_mxf_containers(&m->options, containers), n = (int)kind - HEADER;
    /* Status 4: closed and complete. */
    size_t begun =
        wf_klv_begin(b, (wf_ul)WF_UL_PACK(0x0d01020101000400 | (uint64_t)kind << 16));
    wf_bytes_number(b, 2, 1); /* version 1.3 */
    wf_bytes_number(b, 2, 3);
    wf_bytes_number(b, 4, GRID_BYTES);
    wf_bytes_number(b, 8, m->start[n]);
    wf_bytes_number(b, 8, n ? m->start[n - 1] : 0);
    wf_bytes_number(b, 8, m->start[FOOTER - HEADER]);
    wf_bytes_number(b, 8, kind == HEADER ? m->header_bytes : 0);
    wf_bytes_number(b, 8, index_bytes);
    wf_bytes_number(b, 4, index_bytes ? WF_MXF_INDEX_SID : 0);
    wf_bytes_number(b, 8, 0); /* where in the body this partition begins */
    wf_bytes_number(b, 4, kind == BODY ? WF_MXF_BODY_SID : 0);
    wf_bytes_ul(b, wf_mxf_op1a);
    wf_bytes_number(b, 4, (uint64_t)count);
    wf_bytes_number(b, 4, 16);
    for (int i = 0; i < count; i++) wf_bytes_ul(b, containers[i]);
    wf_klv_end(b, begun);
    wf_klv_fill(b, GRID_BYTES);
}

/* A number for the first frame's sound; 0 for silence. */
static uint64_t sound_seed(const wf_mxf *m) {
    const wf_sound_feed *sound = &m->options.sound;
    size_t count = (size_t)samples_before(m, 1) * (size_t)sound->tracks;
    count -= (size_t)samples_before(m, 0) * (size_t)sound->tracks;
    if (!sound->read) return 0;
    return XXH3_64bits(m->samples, count * sizeof *m->samples) + (uint64_t)sound->bits;
}

/* Makes the seed of the file's identifiers, from what it is asked to be and its first frame. */
static wf_uid seed_of(const wf_mxf *m, const void *picture) {
    const wf_mxf_options *o = &m->options;
    char text[256];
    wf_uid seed;
    snprintf(text, sizeof text, "%.64s %d %d %.64s %" PRId64 " %d:%d:%d:%d %d %d",
             o->raster->name, o->bits, o->full_range, o->color_space ? o->color_space : "",
             o->frame_count, o->start.hours, o->start.minutes, o->start.seconds,
             o->start.frames, o->start.drop_frame, o->sound.tracks);
    uint64_t words = XXH3_64bits_withSeed(text, strlen(text), sound_seed(m));
    XXH128_canonicalFromHash((XXH128_canonical_t *)(void *)&seed,
                             XXH3_128bits_withSeed(picture, o->frame_bytes, words));
    return seed;
}

static wf_bytes make_metadata(const wf_mxf *m) {
    wf_bytes metadata = {0};
    wf_mxf_metadata(&metadata, &m->options, m->seed);
    wf_klv_fill(&metadata, GRID_BYTES);
    return metadata;
}

static weft_status write_header(wf_mxf *m, const void *picture, weft_error *err) {
    m->seed = seed_of(m, picture);
    wf_bytes metadata = make_metadata(m);
    m->header_bytes = metadata.size;
    m->start[1] = GRID_BYTES + metadata.size;
    m->start[2] = m->start[1] + GRID_BYTES + (uint64_t)m->options.frame_count * unit_bytes(m);
    put_partition(m, HEADER, 0);
    wf_bytes_put(&m->bytes, metadata.data, metadata.size);
    m->bytes.failed |= metadata.failed;
    free(metadata.data);
    put_partition(m, BODY, 0);
    return flush(m, err);
}

/* Writes the key and the length of an element (ST 379 allows 4 to 9 bytes; frames of 2160
 * lines need more than three). */
static void put_element_head(wf_bytes *b, uint32_t number, size_t value_bytes) {
    wf_bytes_ul(b, (wf_ul)ELEMENT(number));
    wf_bytes_number(b, 8, (uint64_t)0x87 << 56 | value_bytes);
}

static int64_t frame_samples(const wf_mxf *m) {
    return samples_before(m, m->frames + 1) - samples_before(m, m->frames);
}

/* The next samples of all tracks; where nothing is to be read they stay 0. */
static weft_status read_sound(wf_mxf *m, weft_error *err) {
    const wf_sound_feed *sound = &m->options.sound;
    if (!sound->tracks || !sound->read) return WEFT_OK;
    return sound->read(sound->self, m->samples, frame_samples(m), err);
}

static void put_track(wf_mxf *m, int track) {
    const wf_sound_feed *sound = &m->options.sound;
    int64_t samples = frame_samples(m);
    int bytes = sound->bits / 8;
    size_t begun = m->bytes.size;
    uint8_t *to = m->packed;
    put_element_head(&m->bytes, wf_mxf_sound_number(sound->tracks, track),
                     (size_t)samples * (size_t)bytes);
    for (int64_t i = 0; i < samples; i++) {
        uint32_t value = (uint32_t)m->samples[i * sound->tracks + track];
        for (int b = 0; b < bytes; b++) *to++ = (uint8_t)(value >> (32 - sound->bits + 8 * b));
    }
    wf_bytes_put(&m->bytes, m->packed, (size_t)(to - m->packed));
    wf_klv_fill_to(&m->bytes, begun + m->sound_bytes);
}

weft_status wf_mxf_write(wf_mxf *m, const void *picture, weft_error *err) {
    if (m->frames == m->options.frame_count)
        return wf_fail(err, WEFT_FAILED,
                       "MXF: a frame more than the %" PRId64 " that the header says",
                       m->options.frame_count);
    weft_status status = read_sound(m, err);
    if (!status && !m->frames) status = write_header(m, picture, err);
    if (status) return status;
    put_element_head(&m->bytes, wf_mxf_picture_number(), m->options.frame_bytes);
    wf_bytes_put(&m->bytes, picture, m->options.frame_bytes);
    wf_klv_fill_to(&m->bytes, m->picture_bytes);
    for (int track = 0; track < m->options.sound.tracks; track++) put_track(m, track);
    m->frames++;
    return flush(m, err);
}

/* ---- Footer ---- */

/* One segment tells where every frame is, since edit units are all equally long. */
static void put_index(wf_bytes *b, const wf_mxf *m) {
    static const wf_ul key = WF_UL_SET(0x0d01020101100100);
    int elements = 1 + m->options.sound.tracks;
    size_t begun = wf_klv_begin(b, key);
    wf_item_uid(b, 0x3c0a, wf_mxf_uid(m->seed, WF_MXF_INDEX_UID));
    wf_item_rational(b, 0x3f0b, m->options.raster->frame_rate);
    wf_item_number(b, 0x3f0c, 8, 0);
    wf_item_number(b, 0x3f0d, 8, (uint64_t)m->frames);
    wf_item_number(b, 0x3f05, 4, unit_bytes(m));
    wf_item_number(b, 0x3f06, 4, WF_MXF_INDEX_SID);
    wf_item_number(b, 0x3f07, 4, WF_MXF_BODY_SID);
    wf_item_number(b, 0x3f08, 1, 0);
    wf_item_array(b, 0x3f09, (uint32_t)elements, 6);
    for (int i = 0; i < elements; i++) {
        wf_bytes_number(b, 2, 0); /* not reordered; in the first slice */
        wf_bytes_number(b, 4, i ? m->picture_bytes + (size_t)(i - 1) * m->sound_bytes : 0);
    }
    wf_klv_end(b, begun);
    wf_klv_fill(b, GRID_BYTES);
}

static void put_random_index(wf_mxf *m) {
    static const wf_ul key = WF_UL_PACK(0x0d01020101110100);
    wf_bytes *b = &m->bytes;
    size_t begun = wf_klv_begin(b, key);
    for (int n = 0; n < PARTITIONS; n++) {
        wf_bytes_number(b, 4, n == BODY - HEADER ? WF_MXF_BODY_SID : 0);
        wf_bytes_number(b, 8, m->start[n]);
    }
    wf_bytes_number(b, 4, 16 + 4 + PARTITIONS * 12 + 4); /* of the whole pack */
    wf_klv_end(b, begun);
}

/* Shots that begin alike get other identifiers: those of all that was written, which are known
 * now. The metadata are as long as they were. */
static void identify(wf_mxf *m) {
    XXH128_canonical_t words[2];
    memcpy(&words[0], m->seed.byte, sizeof words[0]);
    XXH128_canonicalFromHash(&words[1], XXH3_128bits_digest(m->hash));
    XXH128_canonicalFromHash((XXH128_canonical_t *)(void *)&m->seed,
                             XXH3_128bits(words, sizeof words));
}

static weft_status write_metadata_again(wf_mxf *m, weft_error *err) {
    wf_bytes metadata = make_metadata(m);
    weft_status status = metadata.failed || metadata.size != m->header_bytes
                             ? wf_fail(err, WEFT_NO_MEMORY, "no memory for an MXF header")
                             : wf_outfile_seek(m->file, GRID_BYTES, err);
    if (!status) status = wf_outfile_write(m->file, metadata.data, metadata.size, err);
    free(metadata.data);
    return status;
}

weft_status wf_mxf_finish(wf_mxf *m, weft_error *err) {
    wf_bytes index = {0};
    if (m->frames != m->options.frame_count || !m->frames)
        return wf_fail(err, WEFT_FAILED,
                       "MXF: %" PRId64 " frames were written and the header says %" PRId64,
                       m->frames, m->options.frame_count);
    identify(m);
    put_index(&index, m);
    put_partition(m, FOOTER, index.size);
    wf_bytes_put(&m->bytes, index.data, index.size);
    m->bytes.failed |= index.failed;
    free(index.data);
    put_random_index(m);
    weft_status status = flush(m, err);
    return status ? status : write_metadata_again(m, err);
}

/* ---- Opening ---- */

static weft_status check(const wf_mxf_options *o, weft_error *err) {
    if (o->sound.tracks < 0 || o->sound.tracks > WF_SOUND_TRACKS)
        return wf_fail(err, WEFT_USAGE, "MXF: %d tracks of sound; there can be 0 to %d",
                       o->sound.tracks, WF_SOUND_TRACKS);
    if (o->frame_bytes > UINT32_MAX / 2)
        return wf_fail(err, WEFT_USAGE, "MXF: frames of %zu bytes are too large for its index",
                       o->frame_bytes);
    return WEFT_OK;
}

/* For the sound of a frame. */
static weft_status make_room(wf_mxf *m, weft_error *err) {
    size_t count = most_samples(m), tracks = (size_t)m->options.sound.tracks;
    if (!tracks) return WEFT_OK;
    m->samples = calloc(count * tracks, sizeof *m->samples);
    m->packed = calloc(count, sample_bytes(m));
    if (m->samples && m->packed) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the sound of a frame");
}

weft_status wf_mxf_open(const wf_mxf_options *options, wf_outfile *file, wf_mxf **out,
                        weft_error *err) {
    weft_status status = check(options, err);
    if (status) return status;
    wf_mxf *m = calloc(1, sizeof *m);
    if (!m) return wf_fail(err, WEFT_NO_MEMORY, "no memory to write MXF");
    m->options = *options;
    m->file = file;
    m->hash = XXH3_createState();
    plan_sizes(m);
    status =
        m->hash ? make_room(m, err) : wf_fail(err, WEFT_NO_MEMORY, "no memory to write MXF");
    if (!status) XXH3_128bits_reset(m->hash);
    if (status)
        wf_mxf_free(m);
    else
        *out = m;
    return status;
}

void wf_mxf_free(wf_mxf *m) {
    XXH3_freeState(m->hash);
    free(m->samples);
    free(m->packed);
    free(m->bytes.data);
    free(m);
}
