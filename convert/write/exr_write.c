/* Writes pictures of floats as OpenEXR. */
#include "convert/write/exr_write.h"

#include <stdlib.h>
#include <string.h>

#include "convert/write/exr_zip.h"

enum { CHUNK_LINES = 16, CHUNK_HEAD = 8, DEFLATE_LEVEL = 4, HEADER_BYTES = 8192 };

/* ---- The header ---- */

/* What a file begins with. Numbers are little-endian, as this machine has them. */
typedef struct header {
    uint8_t bytes[HEADER_BYTES];
    size_t used;
    bool full; /* something did not fit */
} header;

static void put(header *h, const void *data, size_t bytes) {
    h->full |= bytes > HEADER_BYTES - h->used;
    if (h->full) return;
    memcpy(h->bytes + h->used, data, bytes);
    h->used += bytes;
}

static void put_name(header *h, const char *name) {
    put(h, name, strlen(name) + 1);
}

static void put_int(header *h, int32_t value) {
    put(h, &value, sizeof value);
}

static void put_attribute(header *h, const char *name, const char *type, const void *value,
                          size_t bytes) {
    put_name(h, name);
    put_name(h, type);
    put_int(h, (int32_t)bytes);
    put(h, value, bytes);
}

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

static void put_primaries(header *h, const wf_picture_out *p) {
    float own[8];
    const float *xy = NULL;
    for (int i = 0; i < 8; i++) own[i] = (float)p->chromaticities[i];
    if (own[7] != 0) xy = own;
    for (size_t i = 0; !xy && i < sizeof primaries / sizeof *primaries; i++) {
        const char *begins = primaries[i].space;
        if (!strncmp(p->color_space, begins, strlen(begins))) xy = primaries[i].xy;
    }
    if (xy) put_attribute(h, "chromaticities", "chromaticities", xy, sizeof own);
}

static void put_text(header *h, const char *name, const char *text) {
    if (*text) put_attribute(h, name, "string", text, strlen(text));
}

/* Ratios that EXR's rationals cannot hold are left out. */
static void put_ratio(header *h, const char *name, wf_rational r) {
    const int32_t ratio[2] = {(int32_t)r.num, (int32_t)r.den};
    if (r.den > 0 && r.num <= INT32_MAX && r.den <= INT32_MAX)
        put_attribute(h, name, "rational", ratio, sizeof ratio);
}

static void put_time(header *h, const wf_picture_out *p) {
    uint32_t words[2] = {0, 0}; /* and no user bits */
    if (wf_picture_time(p, words))
        put_attribute(h, "timeCode", "timecode", words, sizeof words);
}

/* In the order of the alphabet, which lines have them in too. */
static const struct {
    const char *name;
    int plane;
} channels[] = {{"A", 3}, {"B", 2}, {"G", 1}, {"R", 0}};
enum { CHANNELS = sizeof channels / sizeof *channels };

static void put_channels(header *h, const wf_picture_out *p) {
    enum { FLOAT = 2, ENTRY = 2 + 16 }; /* a name of one letter, and what follows it */
    put_name(h, "channels");
    put_name(h, "chlist");
    put_int(h, p->channels * ENTRY + 1);
    for (int c = CHANNELS - p->channels; c < CHANNELS; c++) {
        const int32_t about[4] = {FLOAT, 0, 1, 1}; /* not of pLinear; sampling */
        put_name(h, channels[c].name);
        put(h, about, sizeof about);
    }
    put(h, "", 1);
}

/* What has to be there. */
static void put_required(header *h, const wf_picture_out *p) {
    const int32_t window[4] = {0, 0, p->width_px - 1, p->lines - 1};
    const uint8_t zip = 3, increasing_y = 0;
    const float aspect = (float)wf_ratio_value(p->pixel_aspect), one = 1, center[2] = {0, 0};
    put_channels(h, p);
    put_attribute(h, "compression", "compression", &zip, 1);
    put_attribute(h, "dataWindow", "box2i", window, sizeof window);
    put_attribute(h, "displayWindow", "box2i", window, sizeof window);
    put_attribute(h, "lineOrder", "lineOrder", &increasing_y, 1);
    put_attribute(h, "pixelAspectRatio", "float", &aspect, sizeof aspect);
    put_attribute(h, "screenWindowCenter", "v2f", center, sizeof center);
    put_attribute(h, "screenWindowWidth", "float", &one, sizeof one);
}

/* The date is empty: equal pictures are to be equal files. */
static void put_words(header *h, const wf_picture_out *p) {
    char words[WF_PICTURE_WORDS_SIZE];
    const int32_t upright = 1, field = p->field;
    put_attribute(h, "Orientation", "int", &upright, sizeof upright);
    put_text(h, "Software", WF_PICTURE_SOFTWARE);
    put_attribute(h, "capDate", "string", "", 0);
    put_text(h, "comments", wf_picture_words(p, words));
    put_ratio(h, "framesPerSecond", p->frame_rate);
    put_primaries(h, p);
    put_time(h, p);
    put_text(h, "weft:colorSpace", p->color_space);
    if (p->field) put_attribute(h, "weft:field", "int", &field, sizeof field);
    put_text(h, "weft:raster", p->raster);
    put_ratio(h, "weft:subframeRate", p->subframe_rate);
    put_ratio(h, "weft:time", p->time_s);
}

static void put_header(header *h, const wf_picture_out *p) {
    const int32_t magic = 20000630, version = 2;
    h->used = 0;
    h->full = false;
    put_int(h, magic);
    put_int(h, version);
    put_required(h, p);
    put_words(h, p);
    put(h, "", 1);
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
            int plane = channels[c].plane;
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

static weft_status put_file(const header *h, const packer *k, wf_bytes_fn *write, void *user,
                            weft_error *err) {
    weft_status status = write(user, h->bytes, h->used, err);
    if (!status) status = write(user, k->table, k->chunks * sizeof *k->table, err);
    return status ? status : write(user, k->all, k->bytes, err);
}

weft_status wf_exr_encode(const wf_picture_out *picture, wf_bytes_fn *write, void *user,
                          weft_error *err) {
    header h;
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
