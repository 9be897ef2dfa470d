/* Writes pictures of floats as OpenEXR, through its C core. */
#include "convert/write/exr_write.h"

#include <openexr.h>
#include <stdlib.h>
#include <string.h>

#include "convert/write/exr_zip.h"

enum { CHUNK_LINES = 16, DEFLATE_LEVEL = 4 };

/* ---- The file, in memory ---- */

/* OpenEXRCore fills its table of chunks in last, and does not report writes that fail. */
typedef struct memory {
    uint8_t *bytes;
    size_t used, size;
    bool out; /* there was no more */
} memory;

static bool make_room(memory *m, size_t bytes) {
    size_t size = 2 * m->size > bytes ? 2 * m->size : bytes;
    if (bytes <= m->size) return true;
    uint8_t *more = realloc(m->bytes, size);
    m->out |= !more;
    if (!more) return false;
    m->bytes = more;
    m->size = size;
    return true;
}

static int64_t put_bytes(exr_const_context_t exr, void *user, const void *data, uint64_t bytes,
                         uint64_t at, exr_stream_error_func_ptr_t error) {
    memory *m = user;
    (void)exr, (void)error;
    if (m->out || !make_room(m, (size_t)(at + bytes))) return -1;
    if (at > m->used) memset(m->bytes + m->used, 0, (size_t)at - m->used);
    memcpy(m->bytes + at, data, (size_t)bytes);
    if (at + bytes > m->used) m->used = (size_t)(at + bytes);
    return (int64_t)bytes;
}

static void say_nothing(exr_const_context_t exr, exr_result_t code, const char *says) {
    (void)exr, (void)code, (void)says;
}

/* ---- The header ---- */

/* CIE x and y of red, green, blue and white, which EXR takes for Rec. 709's where nothing is
 * said. */
static const struct {
    const char *space; /* how its name begins */
    exr_attr_chromaticities_t xy;
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

/* False where nothing is known of the space. */
static bool primaries_of(const wf_picture_out *p, exr_attr_chromaticities_t *xy) {
    const double *c = p->chromaticities;
    *xy = (exr_attr_chromaticities_t){(float)c[0], (float)c[1], (float)c[2], (float)c[3],
                                      (float)c[4], (float)c[5], (float)c[6], (float)c[7]};
    if (c[7] != 0) return true;
    for (size_t i = 0; i < sizeof primaries / sizeof *primaries; i++) {
        const char *begins = primaries[i].space;
        if (strncmp(p->color_space, begins, strlen(begins))) continue;
        *xy = primaries[i].xy;
        return true;
    }
    return false;
}

static bool set_text(exr_context_t exr, const char *name, const char *text) {
    return !*text || !exr_attr_set_string(exr, 0, name, text);
}

/* Ratios that EXR's rationals cannot hold are left out. */
static bool set_ratio(exr_context_t exr, const char *name, wf_rational r) {
    const exr_attr_rational_t ratio = {(int32_t)r.num, (uint32_t)r.den};
    if (r.den <= 0 || r.num > INT32_MAX || r.den > INT32_MAX) return true;
    return !exr_attr_set_rational(exr, 0, name, &ratio);
}

static bool set_primaries(exr_context_t exr, const wf_picture_out *p) {
    exr_attr_chromaticities_t xy;
    return !primaries_of(p, &xy) || !exr_attr_set_chromaticities(exr, 0, "chromaticities", &xy);
}

static bool set_time(exr_context_t exr, const wf_picture_out *p) {
    exr_attr_timecode_t time = {0, 0}; /* and no user bits */
    return !wf_picture_time(p, &time.time_and_flags) ||
           !exr_attr_set_timecode(exr, 0, "timeCode", &time);
}

static bool set_field(exr_context_t exr, const wf_picture_out *p) {
    return !p->field || !exr_attr_set_int(exr, 0, "weft:field", p->field);
}

/* What the file says of the picture. The date is empty: equal pictures are to be equal files.
 */
static bool describe(exr_context_t exr, const wf_picture_out *p) {
    char words[WF_PICTURE_WORDS_SIZE];
    return set_text(exr, "Software", WF_PICTURE_SOFTWARE) &&
           !exr_attr_set_string(exr, 0, "capDate", "") &&
           !exr_attr_set_int(exr, 0, "Orientation", 1) &&
           set_text(exr, "comments", wf_picture_words(p, words)) &&
           set_ratio(exr, "framesPerSecond", p->frame_rate) && set_primaries(exr, p) &&
           set_time(exr, p) && set_text(exr, "weft:raster", p->raster) &&
           set_text(exr, "weft:colorSpace", p->color_space) && set_field(exr, p) &&
           set_ratio(exr, "weft:subframeRate", p->subframe_rate) &&
           set_ratio(exr, "weft:time", p->time_s);
}

/* In the order of the alphabet, which lines have them in too. */
static const struct {
    const char *name;
    int plane;
} channels[] = {{"A", 3}, {"B", 2}, {"G", 1}, {"R", 0}};
enum { CHANNELS = sizeof channels / sizeof *channels };

static bool put_header(exr_context_t exr, const wf_picture_out *p) {
    exr_attr_box2i_t window = {.min = {.x = 0, .y = 0},
                               .max = {.x = p->width_px - 1, .y = p->lines - 1}};
    exr_attr_v2f_t center = {.x = 0, .y = 0};
    bool good = !exr_add_part(exr, NULL, EXR_STORAGE_SCANLINE, NULL) &&
                !exr_initialize_required_attr(
                    exr, 0, &window, &window, (float)wf_ratio_value(p->pixel_aspect), &center,
                    1, EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP);
    for (int c = CHANNELS - p->channels; good && c < CHANNELS; c++)
        good = !exr_add_channel(exr, 0, channels[c].name, EXR_PIXEL_FLOAT,
                                EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return good && describe(exr, p) && !exr_write_header(exr);
}

/* ---- Lines ---- */

/* What chunks are packed with, for as long as a picture takes. */
typedef struct packer {
    struct libdeflate_compressor *how;
    uint8_t *raw, *merged, *packed; /* of one block, a chunk each */
} packer;

static bool make_packer(const wf_picture_out *p, packer *k) {
    size_t chunk = (size_t)p->width_px * (size_t)p->channels * CHUNK_LINES * sizeof(float);
    *k = (packer){libdeflate_alloc_compressor(DEFLATE_LEVEL), malloc(3 * chunk), NULL, NULL};
    if (!k->how || !k->raw) return false;
    k->merged = k->raw + chunk;
    k->packed = k->merged + chunk;
    return true;
}

static void free_packer(packer *k) {
    if (k->how) libdeflate_free_compressor(k->how);
    free(k->raw);
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

static bool put_chunks(exr_context_t exr, const wf_picture_out *p, packer *k) {
    for (int y = 0; y < p->lines; y += CHUNK_LINES) {
        int end = y + CHUNK_LINES < p->lines ? y + CHUNK_LINES : p->lines;
        size_t count = gather(p, y, end, k->raw);
        size_t bytes = wf_exr_zip(k->how, k->raw, count, k->merged, k->packed);
        if (exr_write_scanline_chunk(exr, 0, y, k->packed, bytes)) return false;
    }
    return true;
}

/* ---- Pictures ---- */

static bool encode(const wf_picture_out *p, packer *k, memory *m) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t exr = NULL;
    how.user_data = m;
    how.write_fn = put_bytes;
    how.error_handler_fn = say_nothing;
    if (exr_start_write(&exr, "a picture", EXR_WRITE_FILE_DIRECTLY, &how)) return false;
    bool good = put_header(exr, p) && put_chunks(exr, p, k);
    return !exr_finish(&exr) && good && !m->out;
}

weft_status wf_exr_encode(const wf_picture_out *picture, wf_bytes_fn *write, void *user,
                          weft_error *err) {
    memory m = {.bytes = NULL};
    packer k;
    bool room = make_packer(picture, &k);
    bool good = room && encode(picture, &k, &m);
    weft_status status = good ? write(user, m.bytes, m.used, err)
                         : !room || m.out
                             ? wf_fail(err, WEFT_NO_MEMORY, "no memory to encode it as EXR")
                             : wf_fail(err, WEFT_FAILED, "OpenEXR cannot encode it");
    free_packer(&k);
    free(m.bytes);
    return status;
}
