/* Writes pictures of floats as OpenEXR. */
#include "convert/write/exr_write.h"

#include <stdlib.h>
#include <string.h>

#include "convert/write/exr_header.h"
#include "convert/write/exr_zip.h"

enum { CHUNK_LINES = 16, CHUNK_HEAD = 8, DEFLATE_LEVEL = 4 };

/* ---- The header ---- */

/* CIE x and y of red, green, blue and white, which EXR takes for Rec. 709's where nothing is
 * said. */
static const struct {
    const char *space; /* how its name begins */
    float xy[8];
} primaries[] = {{"rec601-525", {.63f, .34f, .31f, .595f, .155f, .07f, .3127f, .329f}},
                 {"rec601-625", {.64f, .33f, .29f, .6f, .15f, .06f, .3127f, .329f}},
                 {"rec709", {.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f}},
                 {"lin_rec709", {.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f}},
                 {"rec2", {.708f, .292f, .17f, .797f, .131f, .046f, .3127f, .329f}},
                 {"lin_rec2020", {.708f, .292f, .17f, .797f, .131f, .046f, .3127f, .329f}},
                 {"lin_rec601-525", {.63f, .34f, .31f, .595f, .155f, .07f, .3127f, .329f}},
                 {"lin_rec601-625", {.64f, .33f, .29f, .6f, .15f, .06f, .3127f, .329f}},
                 {"lin_p3d65", {.68f, .32f, .265f, .69f, .15f, .06f, .3127f, .329f}},
                 {"ACEScg", {.713f, .293f, .165f, .83f, .128f, .044f, .32168f, .33767f}},
                 {"ACES2065-1", {.7347f, .2653f, 0, 1, .0001f, -.077f, .32168f, .33767f}}};

static void put_primaries(wf_exr_header *h, const wf_picture_out *p) {
    float own[8];
    const float *xy = NULL;
    for (int i = 0; i < 8; i++) own[i] = (float)p->chromaticities[i];
    if (own[7] != 0) xy = own;
    for (size_t i = 0; !xy && i < sizeof primaries / sizeof *primaries; i++) {
        const char *begins = primaries[i].space;
        if (!strncmp(p->color_space, begins, strlen(begins))) xy = primaries[i].xy;
    }
    if (xy) wf_exr_put(h, "chromaticities", "chromaticities", xy, sizeof own);
}

static void put_time(wf_exr_header *h, const wf_picture_out *p) {
    uint32_t words[2] = {0, 0}; /* and no user bits */
    if (wf_picture_time(p, words)) wf_exr_put(h, "timeCode", "timecode", words, sizeof words);
}

/* In the order of the alphabet; pictures have A or not. */
static const char *const names[] = {"A", "B", "G", "R"};
static const int planes[] = {3, 2, 1, 0};
enum { CHANNELS = sizeof planes / sizeof *planes };

/* The date is empty: equal pictures are to be equal files. */
static void put_words(wf_exr_header *h, const wf_picture_out *p) {
    char words[WF_PICTURE_WORDS_SIZE];
    wf_exr_put_int(h, "Orientation", 1);
    wf_exr_put_text(h, "Software", WF_PICTURE_SOFTWARE);
    wf_exr_put(h, "capDate", "string", "", 0);
    wf_exr_put_text(h, "comments", wf_picture_words(p, words));
    wf_exr_put_ratio(h, "framesPerSecond", p->frame_rate);
    put_primaries(h, p);
    put_time(h, p);
    wf_exr_put_text(h, "weft:colorSpace", p->color_space);
    if (p->field) wf_exr_put_int(h, "weft:field", p->field);
    wf_exr_put_text(h, "weft:raster", p->raster);
    wf_exr_put_ratio(h, "weft:subframeRate", p->subframe_rate);
    wf_exr_put_ratio(h, "weft:time", p->time_s);
}

static void put_header(wf_exr_header *h, const wf_picture_out *p) {
    wf_exr_header_begin(h, 0);
    wf_exr_put_channels(h, names + CHANNELS - p->channels, (size_t)p->channels);
    wf_exr_put_required(h, WF_EXR_ZIP, p->width_px, p->lines, p->pixel_aspect);
    put_words(h, p);
    wf_exr_header_end(h);
}

/* ---- Lines ---- */

/* The packed picture, and what its chunks are packed with. */
typedef struct packer {
    struct libdeflate_compressor *how;
    uint8_t *raw, *merged; /* one block: a chunk, twice */
    uint8_t *all;          /* chunks one after another, each with its head */
    uint64_t *table;       /* [chunks]: where they begin in the file */
    size_t bytes, chunks;  /* of all */
} packer;

static bool make_packer(const wf_picture_out *p, packer *k) {
    size_t line = (size_t)p->width_px * (size_t)p->channels * sizeof(float);
    size_t chunks = ((size_t)p->lines + CHUNK_LINES - 1) / CHUNK_LINES;
    *k = (packer){.how = libdeflate_alloc_compressor(DEFLATE_LEVEL), .chunks = chunks};
    k->raw = malloc(2 * CHUNK_LINES * line);
    k->all = malloc((size_t)p->lines * line + chunks * CHUNK_HEAD);
    k->table = malloc(chunks * sizeof *k->table);
    if (!k->how || !k->raw || !k->all || !k->table) return false;
    k->merged = k->raw + CHUNK_LINES * line;
    return true;
}

static void free_packer(packer *k) {
    if (k->how) libdeflate_free_compressor(k->how);
    free(k->raw);
    free(k->all);
    free(k->table);
}

/* Lines y0 <= y < y1 as they are stored: all of a line's samples of one channel, then of the
 * next. Returns their bytes. */
static size_t gather(const wf_picture_out *p, int y0, int y1, uint8_t *to) {
    size_t bytes = (size_t)p->width_px * sizeof(float);
    uint8_t *at = to;
    for (int y = y0; y < y1; y++)
        for (int c = CHANNELS - p->channels; c < CHANNELS; c++, at += bytes) {
            int plane = planes[c];
            const float *from = p->plane[plane];
            memcpy(at, from + (size_t)y * p->line_stride[plane], bytes);
        }
    return (size_t)(at - to);
}

/* Packs the picture, whose chunks follow a header of so many bytes and their table. */
static void pack(const wf_picture_out *p, size_t header_bytes, packer *k) {
    size_t first = header_bytes + k->chunks * sizeof *k->table;
    for (int y = 0; y < p->lines; y += CHUNK_LINES) {
        int end = y + CHUNK_LINES < p->lines ? y + CHUNK_LINES : p->lines;
        size_t count = gather(p, y, end, k->raw);
        uint8_t *to = k->all + k->bytes;
        size_t bytes = wf_exr_zip(k->how, k->raw, count, k->merged, to + CHUNK_HEAD);
        memcpy(to, (int32_t[]){y, (int32_t)bytes}, CHUNK_HEAD);
        k->table[y / CHUNK_LINES] = first + k->bytes;
        k->bytes += CHUNK_HEAD + bytes;
    }
}

/* ---- Pictures ---- */

static weft_status put_file(const wf_exr_header *h, const packer *k, wf_bytes_fn *write,
                            void *user, weft_error *err) {
    weft_status status = write(user, h->bytes, h->used, err);
    if (!status) status = write(user, k->table, k->chunks * sizeof *k->table, err);
    return status ? status : write(user, k->all, k->bytes, err);
}

weft_status wf_exr_encode(const wf_picture_out *picture, wf_bytes_fn *write, void *user,
                          weft_error *err) {
    wf_exr_header h;
    packer k;
    weft_status status = WEFT_OK;
    put_header(&h, picture);
    if (!make_packer(picture, &k))
        status = wf_fail(err, WEFT_NO_MEMORY, "no memory to encode it as EXR");
    else if (h.full)
        status = wf_fail(err, WEFT_FAILED, "the names of its colors or raster are too long");
    if (!status) {
        pack(picture, h.used, &k);
        status = put_file(&h, &k, write, user, err);
    }
    free_packer(&k);
    return status;
}
