/* Tags of colors in files of pictures: PNG, DPX and Radiance's HDR. */
#include "convert/media/color_tags.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "convert/base/big_endian.h"

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
        if (fread(data, 1, taken, file) != taken) return;
        if (taken) take_chunk(head + 4, data, bytes, said);
        if (fseeko(file, (off_t)(bytes - taken) + 4, SEEK_CUR)) return;
    }
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
    rewind(file);
    while (fgets(line, sizeof line, file) && *line != '\n')
        if (sscanf(line, "PRIMARIES= %lf %lf %lf %lf %lf %lf %lf %lf", &xy[0], &xy[1], &xy[2],
                   &xy[3], &xy[4], &xy[5], &xy[6], &xy[7]) == 8) {
            memcpy(said->chromaticities, xy, sizeof xy);
            said->has_chromaticities = true;
        }
}

/* ---- The formats ---- */

void wf_read_color_tags(const char *path, const char *format, wf_color_said *said) {
    static const struct {
        const char *format;
        void (*read)(FILE *file, wf_color_said *said);
    } readers[] = {{"png", read_png}, {"dpx", read_dpx}, {"hdr", read_hdr}};
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++) {
        if (strcmp(readers[i].format, format)) continue;
        FILE *file = fopen(path, "rbe");
        if (!file) return;
        readers[i].read(file, said);
        fclose(file);
    }
}
