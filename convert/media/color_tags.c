/* Tags of colors in files of pictures: PNG, WebP, JPEG, TIFF, DPX and Radiance's HDR. */
#include "convert/media/color_tags.h"

#include <libdeflate.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/big_endian.h"
#include "convert/base/infile.h"
#include "convert/media/tiff_tags.h"

/* ---- ICC profiles ---- */

#define PROFILE_MOST (1 << 20) /* bytes of a profile that are looked at */

/* Whether a profile calls itself sRGB, in letters of one byte or of two. */
static bool is_srgb(const uint8_t *data, size_t bytes) {
    static const char narrow[] = {'s', 'R', 'G', 'B'}, wide[] = {'s', 0, 'R', 0, 'G', 0, 'B'};
    return memmem(data, bytes, narrow, sizeof narrow) || memmem(data, bytes, wide, sizeof wide);
}

static void take_profile(const char *name, const uint8_t *data, size_t bytes,
                         wf_color_said *said) {
    if (strstr(name, "sRGB") || is_srgb(data, bytes)) return;
    snprintf(said->profile, sizeof said->profile, "%s", *name ? name : "ICC");
}

/* ---- PNG ---- */

typedef void png_chunk_fn(const uint8_t *data, wf_color_said *said);

static void png_header(const uint8_t *data, wf_color_said *said) {
    said->bits = data[8];
}

static void png_cicp(const uint8_t *data, wf_color_said *said) {
    said->primaries = data[0];
    said->transfer = data[1];
    said->narrow = !data[3];
}

static void png_srgb(const uint8_t *data, wf_color_said *said) {
    (void)data;
    said->srgb = true;
}

static void png_gamma(const uint8_t *data, wf_color_said *said) {
    said->gamma = (double)wf_big_endian(data, 4) / 100000;
}

/* White comes first. */
static void png_chromaticities(const uint8_t *data, wf_color_said *said) {
    said->has_chromaticities = true;
    for (size_t i = 0; i < 8; i++)
        said->chromaticities[(i + 6) % 8] = (double)wf_big_endian(data + 4 * i, 4) / 100000;
}

/* iCCP: a name of at most 79 bytes, its end, the method, and zlib's data. */
static void png_profile(const uint8_t *data, size_t bytes, wf_color_said *said) {
    char name[80] = "";
    size_t length = strnlen((const char *)data, bytes < 79 ? bytes : 79), size = 0;
    uint8_t *profile = malloc(PROFILE_MOST);
    struct libdeflate_decompressor *inflate = libdeflate_alloc_decompressor();
    memcpy(name, data, length);
    if (profile && inflate && bytes > length + 2 &&
        libdeflate_zlib_decompress(inflate, data + length + 2, bytes - length - 2, profile,
                                   PROFILE_MOST, &size) != LIBDEFLATE_SUCCESS)
        size = 0;
    if (profile && inflate) take_profile(name, profile, size, said);
    libdeflate_free_decompressor(inflate);
    free(profile);
}

/* The next `bytes` bytes, of a profile. */
static void read_profile(FILE *file, size_t bytes, wf_color_said *said,
                         void (*take)(const uint8_t *data, size_t bytes, wf_color_said *said)) {
    uint8_t *data = bytes && bytes <= PROFILE_MOST ? malloc(bytes) : NULL;
    if (data && fread(data, 1, bytes, file) == bytes) take(data, bytes, said);
    free(data);
}

#define PNG_MOST_DATA 32

static const struct {
    const char *name;
    size_t bytes;
    png_chunk_fn *take;
} png_chunks[] = {{"IHDR", 13, png_header},
                  {"cICP", 4, png_cicp},
                  {"sRGB", 1, png_srgb},
                  {"gAMA", 4, png_gamma},
                  {"cHRM", 32, png_chromaticities}};

static void take_chunk(const uint8_t *name, const uint8_t *data, size_t bytes,
                       wf_color_said *said) {
    for (size_t i = 0; i < sizeof png_chunks / sizeof *png_chunks; i++)
        if (!memcmp(name, png_chunks[i].name, 4) && bytes == png_chunks[i].bytes)
            png_chunks[i].take(data, said);
}

/* Chunks that say something come before the picture's data. */
static void read_png(FILE *file, wf_color_said *said) {
    uint8_t head[8], data[PNG_MOST_DATA];
    if (fseeko(file, 8, SEEK_SET)) return;
    while (fread(head, 1, sizeof head, file) == sizeof head && memcmp(head + 4, "IDAT", 4)) {
        size_t bytes = (size_t)wf_big_endian(head, 4);
        size_t taken = bytes <= sizeof data ? bytes : 0;
        off_t at = ftello(file);
        if (!memcmp(head + 4, "iCCP", 4)) read_profile(file, bytes, said, png_profile);
        if (fseeko(file, at, SEEK_SET) || fread(data, 1, taken, file) != taken) return;
        if (taken) take_chunk(head + 4, data, bytes, said);
        if (fseeko(file, (off_t)(bytes - taken) + 4, SEEK_CUR)) return;
    }
}

/* ---- WebP: chunks of RIFF ---- */

static void webp_profile(const uint8_t *data, size_t bytes, wf_color_said *said) {
    take_profile("", data, bytes, said);
}

static void read_webp(FILE *file, wf_color_said *said) {
    uint8_t head[8];
    if (fseeko(file, 12, SEEK_SET)) return;
    while (fread(head, 1, sizeof head, file) == sizeof head) {
        size_t bytes =
            head[4] | (size_t)head[5] << 8 | (size_t)head[6] << 16 | (size_t)head[7] << 24;
        off_t at = ftello(file);
        if (!memcmp(head, "ICCP", 4)) read_profile(file, bytes, said, webp_profile);
        if (fseeko(file, at + (off_t)(bytes + bytes % 2), SEEK_SET)) return;
    }
}

/* ---- JPEG: markers (ITU-T T.81), up to the frame's, which has the number of components ----
 */

static bool is_frame(int marker) {
    return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 &&
           marker != 0xcc;
}

static void read_jpeg(FILE *file, wf_color_said *said) {
    uint8_t head[4], frame[6];
    if (fseeko(file, 2, SEEK_SET)) return;
    while (fread(head, 1, sizeof head, file) == sizeof head && head[0] == 0xff) {
        size_t bytes = (size_t)wf_big_endian(head + 2, 2);
        if (is_frame(head[1])) {
            if (fread(frame, 1, sizeof frame, file) == sizeof frame) said->inks = frame[5] == 4;
            return;
        }
        if (bytes < 2 || fseeko(file, (off_t)bytes - 2, SEEK_CUR)) return;
    }
}

/* ---- TIFF ---- */

static void read_tiff(FILE *file, wf_color_said *said) {
    wf_tiff_tags tags;
    if (!wf_tiff_tags_read(file, &tags)) return;
    said->inks = tags.photometric == WF_TIFF_SEPARATED;
    said->no_alpha = !tags.has_extra_samples;
    said->has_chromaticities = tags.has_chromaticities;
    memcpy(said->chromaticities, tags.chromaticities, sizeof tags.chromaticities);
}

/* ---- DPX ---- */

#define DPX_TRANSFER     801 /* of the first element; the colorimetric field follows */
#define DPX_COLORIMETRIC 802

static void read_dpx(FILE *file, wf_color_said *said) {
    uint8_t header[DPX_COLORIMETRIC + 1];
    if (fseeko(file, 0, SEEK_SET) || fread(header, 1, sizeof header, file) != sizeof header)
        return;
    said->dpx = true;
    said->dpx_transfer = header[DPX_TRANSFER];
    said->dpx_colorimetric = header[DPX_COLORIMETRIC];
}

/* ---- Radiance's HDR ---- */

static void read_hdr(FILE *file, wf_color_said *said) {
    char line[256];
    double xy[8];
    if (fseeko(file, 0, SEEK_SET)) return;
    while (fgets(line, sizeof line, file) && *line != '\n')
        if (sscanf(line, "PRIMARIES= %lf %lf %lf %lf %lf %lf %lf %lf", &xy[0], &xy[1], &xy[2],
                   &xy[3], &xy[4], &xy[5], &xy[6], &xy[7]) == 8) {
            memcpy(said->chromaticities, xy, sizeof xy);
            said->has_chromaticities = true;
        }
}

/* ---- The formats ---- */

weft_status wf_read_color_tags(const char *path, const char *format, wf_color_said *said,
                               weft_error *err) {
    static const struct {
        const char *format;
        void (*read)(FILE *file, wf_color_said *said);
    } readers[] = {{"png", read_png},   {"dpx", read_dpx},   {"hdr", read_hdr},
                   {"webp", read_webp}, {"jpeg", read_jpeg}, {"tiff", read_tiff}};
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++) {
        if (strcmp(readers[i].format, format)) continue;
        FILE *file;
        weft_status status = wf_infile_open(path, &file, err);
        if (status) return status;
        readers[i].read(file, said);
        return wf_infile_close(file, path, WEFT_OK, err);
    }
    return WEFT_OK;
}
