/* Tells what format a picture is by how it begins, and whether it is whole. */
#include "convert/media/formats.h"

#include <errno.h>
#include <inttypes.h>
#include <libdeflate.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/big_endian.h"
#include "convert/base/infile.h"
#include "convert/media/kinds.h"
#include "convert/media/tiff_tags.h"

/* A file under examination. */
typedef struct exam {
    const char *path;
    FILE *file;
    uint64_t bytes; /* in all */
    weft_error *err;
} exam;

static weft_status damaged(const exam *x, const char *what) {
    return wf_fail(x->err, WEFT_FAILED, "%.700s: the file is damaged: %s; write it again",
                   x->path, what);
}

/* Of files that end too early, as they do while they are written or copied. */
static weft_status cut_short(const exam *x, const char *what) {
    return wf_fail(
        x->err, WEFT_FAILED,
        "%.700s: %s: the file may still be being written, or is damaged; wait for it "
        "or write it again",
        x->path, what);
}

static bool read_at(const exam *x, uint64_t offset, void *to, size_t bytes) {
    if (offset > x->bytes || bytes > x->bytes - offset) return false;
    return !fseeko(x->file, (off_t)offset, SEEK_SET) && fread(to, 1, bytes, x->file) == bytes;
}

/* ---- PNG (ISO/IEC 15948): chunks of a length, a name, data and their CRC ---- */

#define PNG_SIGNATURE_BYTES 8
#define PNG_FRAME_BYTES     12 /* of a chunk, around its data */

/* Continues the checksum over the next `bytes` bytes, which the file has. */
static bool sum_data(const exam *x, uint32_t *sum, uint64_t bytes) {
    uint8_t block[16384];
    while (bytes) {
        size_t step = bytes < sizeof block ? (size_t)bytes : sizeof block;
        if (fread(block, 1, step, x->file) != step) return false;
        *sum = libdeflate_crc32(*sum, block, step);
        bytes -= step;
    }
    return true;
}

/* Pictures that are written to one file one after the other, as ffmpeg's image2pipe does. */
static weft_status examine_after_png(const exam *x, uint64_t at) {
    uint8_t head[PNG_SIGNATURE_BYTES];
    if (!read_at(x, at, head, sizeof head) || memcmp(head, "\x89PNG\r\n\x1a\n", sizeof head))
        return WEFT_OK;
    return wf_fail(x->err, WEFT_FAILED,
                   "%.700s: it holds several PNG pictures, one after the other; "
                   "'ffmpeg -f png_pipe -i IN OUT.%%04d.png' makes files of them",
                   x->path);
}

/* The decoder stops at the last line, and so sees neither the end of the data nor its
 * checksum. */
static weft_status examine_png(const exam *x) {
    for (uint64_t at = PNG_SIGNATURE_BYTES;;) {
        uint8_t head[8], tail[4];
        if (!read_at(x, at, head, sizeof head))
            return cut_short(x, "it ends before its IEND chunk");
        uint64_t bytes = wf_big_endian(head, 4);
        if (bytes + PNG_FRAME_BYTES > x->bytes - at)
            return cut_short(x, "it ends within a chunk");
        uint32_t sum = libdeflate_crc32(0, head + 4, 4);
        if (!sum_data(x, &sum, bytes) || fread(tail, 1, sizeof tail, x->file) != sizeof tail)
            return damaged(x, "it cannot be read to its end");
        if (sum != wf_big_endian(tail, 4))
            return damaged(x, "the checksum of a chunk is wrong");
        at += bytes + PNG_FRAME_BYTES;
        if (!memcmp(head + 4, "IEND", 4)) return examine_after_png(x, at);
    }
}

/* ---- JPEG ---- */

/* Decoders fill missing data with gray. The marker is searched for in the last bytes, since
 * some writers pad behind it. */
static weft_status examine_jpeg(const exam *x) {
    uint8_t tail[1024];
    size_t bytes = x->bytes < sizeof tail ? (size_t)x->bytes : sizeof tail;
    if (!read_at(x, x->bytes - bytes, tail, bytes))
        return damaged(x, "it cannot be read to its end");
    for (size_t i = 0; i + 1 < bytes; i++)
        if (tail[i] == 0xff && tail[i + 1] == 0xd9) return WEFT_OK;
    return cut_short(x, "it ends before its end-of-image marker");
}

/* ---- DPX (SMPTE ST 268) ---- */

#define DPX_HEADER_BYTES 2048
#define DPX_USER_SIZE    32
#define DPX_ELEMENTS     770 /* U16 */
#define DPX_WIDTH        772
#define DPX_ELEMENT      780 /* 72 bytes each */
#define DPX_UNDEFINED    UINT32_MAX

static uint32_t dpx_word(const uint8_t *header, size_t offset) {
    const uint8_t *b = header + offset;
    bool little = header[0] == 'X';
    uint32_t word = (uint32_t)wf_big_endian(b, 4);
    return little ? __builtin_bswap32(word) : word;
}

/* The least number of bytes that the samples of one element can take, which is when they are
 * packed without gaps. */
static uint64_t dpx_element_bytes(const uint8_t *header, const uint8_t *element) {
    static const struct {
        uint8_t descriptor, components;
    } kinds[] = {{50, 3}, {51, 4}, {52, 4}, {100, 2}, {101, 3}, {102, 3}, {103, 4}};
    uint64_t components = 1;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].descriptor == element[20]) components = kinds[i].components;
    uint64_t pixels = (uint64_t)dpx_word(header, DPX_WIDTH) * dpx_word(header, DPX_WIDTH + 4);
    return pixels > UINT64_MAX / 1024 ? UINT64_MAX : pixels * components * element[23] / 8;
}

/* OpenImageIO allocates as much user data as the header states, so that is checked too. */
static weft_status examine_dpx(const exam *x) {
    uint8_t header[DPX_HEADER_BYTES];
    if (!read_at(x, 0, header, sizeof header)) return cut_short(x, "its header is not whole");
    uint32_t user = dpx_word(header, DPX_USER_SIZE);
    if (user != DPX_UNDEFINED && user > x->bytes - sizeof header)
        return damaged(x, "its header states more user data than the file has");
    const uint8_t *element = header + DPX_ELEMENT;
    uint32_t offset = dpx_word(header, DPX_ELEMENT + 28);
    if (offset == DPX_UNDEFINED || offset == 0) offset = dpx_word(header, 4);
    bool encoded =
        dpx_word(header, DPX_ELEMENT + 24) & (header[0] == 'X' ? 0xffff0000 : 0xffff);
    if (offset > x->bytes ||
        (!encoded && dpx_element_bytes(header, element) > x->bytes - offset))
        return cut_short(x, "it ends before its picture does");
    return WEFT_OK;
}

/* ---- TGA, which begins with nothing of its own ---- */

#define TGA_HEADER_BYTES 18

/* A color map or none, one of six kinds of picture, a size, and a depth there is. */
static bool looks_like_tga(const exam *x) {
    uint8_t h[TGA_HEADER_BYTES];
    if (!read_at(x, 0, h, sizeof h)) return false;
    int kind = h[2] & 7, depth = h[16];
    bool mapped = kind == 1;
    return h[1] <= 1 && (!mapped || h[1]) && kind >= 1 && kind <= 3 && (h[2] & ~0xb) == 0 &&
           (h[12] || h[13]) && (h[14] || h[15]) && (h[17] & 0xc0) == 0 &&
           (depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32);
}

/* ---- TIFF ---- */

/* What OpenImageIO would hand out as R G B all the same. Raw pictures of cameras begin as TIFF,
 * and hold a small picture for looking at. */
static weft_status examine_tiff(const exam *x) {
    wf_tiff_tags tags;
    weft_status status = wf_refuse_kind(x->path, x->err);
    if (status) return status;
    if (!wf_tiff_tags_read(x->file, &tags)) return cut_short(x, "it has no directory");
    if (tags.more_pages)
        return wf_fail(x->err, WEFT_FAILED,
                       "%.700s: it is a TIFF of several pictures, which weft does not read; "
                       "'oiiotool IN --subimage 0 -o OUT.tif' makes a TIFF of the first",
                       x->path);
    bool negative = tags.photometric == WF_TIFF_WHITE_IS_ZERO && tags.bits > 8;
    if (!negative && tags.photometric < WF_TIFF_CIELAB) return WEFT_OK;
    return wf_fail(x->err, WEFT_FAILED,
                   "%.700s: a TIFF of %s, which weft does not read; write it as R G B or gray",
                   x->path,
                   negative                                ? "16 bits and more whose 0 is white"
                   : tags.photometric < WF_TIFF_CIELAB + 3 ? "CIE L*a*b*"
                                                           : "a rare photometric kind");
}

/* ---- The formats ---- */

static weft_status examine_nothing(const exam *x) {
    (void)x;
    return WEFT_OK;
}

/* OpenImageIO would take one picture, and libav 5.1 decodes none. Its flag is in the chunk
 * VP8X, which comes first. */
static weft_status refuse_animated(const exam *x) {
    uint8_t chunk[9];
    if (!read_at(x, 12, chunk, sizeof chunk) || memcmp(chunk, "VP8X", 4) || !(chunk[8] & 2))
        return WEFT_OK;
    return wf_fail(x->err, WEFT_FAILED,
                   "%.700s: it is an animated WebP, which weft does not read; ImageMagick's "
                   "'convert IN -coalesce OUT.%%04d.png' makes pictures of it, whose rate "
                   "--subframe-rate gives",
                   x->path);
}

static weft_status examine_webp(const exam *x) {
    uint8_t head[12];
    if (read_at(x, 0, head, sizeof head) && !memcmp(head + 8, "WEBP", 4)) {
        uint64_t bytes = (uint64_t)head[4] | (uint64_t)head[5] << 8 | (uint64_t)head[6] << 16 |
                         (uint64_t)head[7] << 24;
        if (bytes + 8 > x->bytes) return damaged(x, "it ends before its picture does");
        return refuse_animated(x);
    }
    weft_status status = wf_refuse_kind(x->path, x->err);
    return status ? status
                  : wf_fail(x->err, WEFT_FAILED, "%.700s: it is RIFF, and not a WebP picture",
                            x->path);
}

#define MAGIC_MOST 8

static const struct {
    const char *name;
    const char *magic;
    uint8_t magic_bytes;
    weft_status (*examine)(const exam *x);
} formats[] = {
    {"openexr", "\x76\x2f\x31\x01", 4, examine_nothing},
    {"dpx", "SDPX", 4, examine_dpx},
    {"dpx", "XPDS", 4, examine_dpx},
    {"tiff", "II*\0", 4, examine_tiff},
    {"tiff", "MM\0*", 4, examine_tiff},
    {"tiff", "II+\0", 4, examine_tiff},
    {"tiff", "MM\0+", 4, examine_tiff},
    {"png", "\x89PNG\r\n\x1a\n", 8, examine_png},
    {"jpeg", "\xff\xd8\xff", 3, examine_jpeg},
    {"hdr", "#?RADIAN", 8, examine_nothing},
    {"hdr", "#?RGBE", 6, examine_nothing},
    {"webp", "RIFF", 4, examine_webp},
};

static weft_status examine(const exam *x, const char **format) {
    uint8_t head[MAGIC_MOST] = {0};
    size_t got = fread(head, 1, sizeof head, x->file);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        if (got < formats[i].magic_bytes ||
            memcmp(head, formats[i].magic, formats[i].magic_bytes))
            continue;
        *format = formats[i].name;
        return formats[i].examine(x);
    }
    if (looks_like_tga(x)) {
        *format = "targa";
        return WEFT_OK;
    }
    weft_status status = wf_refuse_kind(x->path, x->err);
    if (status) return status;
    return wf_fail(
        x->err, WEFT_FAILED,
        "%.700s: it does not begin like an EXR, DPX, TIFF, PNG, JPEG, WebP, HDR or TGA, which "
        "are the pictures that weft reads; 'file IN' may tell what it is",
        x->path);
}

/* The chunk acTL comes before the picture, and says how many there are. */
static bool tells_animation(FILE *file) {
    uint8_t head[8], count[4];
    bool png = fread(head, sizeof head, 1, file) == 1 && !memcmp(head, "\x89PNG\r\n\x1a\n", 8);
    while (png && fread(head, sizeof head, 1, file) == 1 && memcmp(head + 4, "IDAT", 4)) {
        if (!memcmp(head + 4, "acTL", 4))
            return fread(count, sizeof count, 1, file) == 1 && wf_big_endian(count, 4) > 1;
        if (fseeko(file, (off_t)wf_big_endian(head, 4) + 4, SEEK_CUR)) return false;
    }
    return false;
}

weft_status wf_is_animated_png(const char *path, bool *is, weft_error *err) {
    FILE *file;
    *is = false;
    weft_status status = wf_infile_open(path, &file, err);
    if (status) return status;
    *is = tells_animation(file);
    return wf_infile_close(file, path, WEFT_OK, err);
}

weft_status wf_begins_as_picture(const char *path, bool *is, weft_error *err) {
    char head[12] = "";
    size_t got;
    *is = false;
    weft_status status = wf_infile_head(path, head, sizeof head, &got, err);
    for (size_t i = 0; !*is && i < sizeof formats / sizeof *formats; i++)
        *is = got == sizeof head && !memcmp(head, formats[i].magic, formats[i].magic_bytes) &&
              (formats[i].examine != examine_webp || !memcmp(head + 8, "WEBP", 4));
    return status;
}

weft_status wf_format_of(const char *path, const char **format, weft_error *err) {
    struct stat about;
    exam x = {.path = path, .err = err};
    weft_status status = wf_infile_open(path, &x.file, err);
    if (status) return status;
    if (fstat(fileno(x.file), &about))
        status = wf_fail(err, WEFT_FAILED, "%.700s: %s", path, strerror(errno));
    x.bytes = (uint64_t)about.st_size;
    if (!status) status = examine(&x, format);
    return wf_infile_close(x.file, path, status, err);
}
