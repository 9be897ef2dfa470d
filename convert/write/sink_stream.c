/* Outputs that are one stream of frames: Y4M, raw v210 and uyvy, and two for tests, null and
 * hash. Each is a way to pack a frame into bytes. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "convert/base/outfile.h"
#include "convert/write/packing.h"
#include "convert/write/sink_kinds.h"

#define HEADER_SIZE 256 /* of the text before the first frame */

typedef struct stream_format {
    /* Text before the first frame; its length, 0: none. */
    int (*header)(const wf_output_options *options, char *text, size_t size);
    size_t (*frame_bytes)(const wf_output_options *options);
    /* Packs the frame into `to`; returns how many bytes of it are to be written. */
    size_t (*pack)(const wf_output_options *options, const wf_frame *frame, uint8_t *to);
    int64_t line_bytes; /* of a frame that are written, where these are fewer than packing
                           takes; 0: they are not */
    const char *prefix; /* of the output's name, before the file's; NULL: none */
    bool silent;        /* nothing is written */
} stream_format;

struct wf_sink {
    wf_output_options options;
    const stream_format *format;
    wf_outfile *file;
    uint8_t *bytes;
};

static int plane_width(const wf_output_options *o, int p) {
    return p && o->subsampled ? o->raster->width_px / 2 : o->raster->width_px;
}

/* ---- Opening and writing ---- */

static void release(wf_sink *s) {
    free(s->bytes);
    free(s);
}

static const char *file_of(const wf_sink *s) {
    const char *prefix = s->format->prefix;
    const char *name = s->options.output + (prefix ? strlen(prefix) : 0);
    return *name ? name : "-";
}

static weft_status write_header(wf_sink *s, weft_error *err) {
    char text[HEADER_SIZE];
    if (!s->format->header || !s->options.stream_header) return WEFT_OK;
    int length = s->format->header(&s->options, text, sizeof text);
    return wf_outfile_write(s->file, text, (size_t)length, err);
}

static wf_sink_size stream_size(const wf_output_options *options, const stream_format *format,
                                int64_t frames) {
    char text[HEADER_SIZE];
    int header = format->header && options->stream_header
                     ? format->header(options, text, sizeof text)
                     : 0;
    int64_t each =
        format->line_bytes ? format->line_bytes : (int64_t)format->frame_bytes(options);
    return (wf_sink_size){header + frames * each, WF_SIZE_EXACT};
}

static weft_status open_stream(const wf_output_options *options, const stream_format *format,
                               wf_sink **out, weft_error *err) {
    wf_sink *s = calloc(1, sizeof *s);
    size_t bytes = format->frame_bytes(options);
    if (s) s->bytes = malloc(bytes ? bytes : 1);
    if (!s || !s->bytes) {
        free(s);
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for a frame", options->output);
    }
    s->options = *options;
    s->format = format;
    weft_status status = WEFT_OK;
    /* A job that resumes gets here only if what stands at the name is no whole output, which
     * it may replace. */
    bool replace = options->overwrite || options->resume;
    if (!format->silent) status = wf_outfile_open(file_of(s), replace, &s->file, err);
    if (!status && !format->silent) status = write_header(s, err);
    if (!status) {
        *out = s;
        return WEFT_OK;
    }
    if (s->file) wf_outfile_abandon(s->file);
    release(s);
    return status;
}

static weft_status write_frame(wf_sink *s, const wf_frame *frame, weft_error *err) {
    size_t bytes = s->format->pack(&s->options, frame, s->bytes);
    return s->format->silent ? WEFT_OK : wf_outfile_write(s->file, s->bytes, bytes, err);
}

static weft_status commit(wf_sink *s, weft_error *err) {
    weft_status status = s->file ? wf_outfile_commit(s->file, err) : WEFT_OK;
    release(s);
    return status;
}

static void abandon(wf_sink *s) {
    if (s->file) wf_outfile_abandon(s->file);
    release(s);
}

/* ---- Y4M: the YUV4MPEG2 stream of mjpegtools ---- */

static const char frame_mark[] = "FRAME\n";
#define MARK_BYTES (sizeof frame_mark - 1)

static char interlace_letter(const wf_raster *raster) {
    return raster->scan != WF_INTERLACED ? 'p' : raster->top_first ? 't' : 'b';
}

static int y4m_header(const wf_output_options *o, char *text, size_t size) {
    const wf_raster *r = o->raster;
    char color[64];
    const char *sampling = o->subsampled ? "422" : "444";
    if (o->bits == 8)
        snprintf(color, sizeof color, "%s", sampling);
    else
        snprintf(color, sizeof color, "%sp%d XYSCSS=%sP%d", sampling, o->bits, sampling,
                 o->bits);
    return snprintf(text, size,
                    "YUV4MPEG2 W%d H%d F%" PRId64 ":%" PRId64 " I%c A%" PRId64 ":%" PRId64
                    " C%s XCOLORRANGE=%s\n",
                    r->width_px, r->lines, r->frame_rate.num, r->frame_rate.den,
                    interlace_letter(r), r->pixel_aspect.num, r->pixel_aspect.den, color,
                    o->full_range ? "FULL" : "LIMITED");
}

static size_t y4m_frame_bytes(const wf_output_options *o) {
    size_t samples = 0;
    for (int p = 0; p < 3; p++) samples += (size_t)plane_width(o, p) * (size_t)o->raster->lines;
    return MARK_BYTES + samples * (o->bits > 8 ? 2 : 1);
}

static uint8_t *put_line(uint8_t *to, const uint16_t *code, int count, bool wide) {
    if (wide) {
        for (int i = 0; i < count; i++) {
            to[2 * i] = (uint8_t)(code[i] & 255);
            to[2 * i + 1] = (uint8_t)(code[i] >> 8);
        }
    } else {
        for (int i = 0; i < count; i++) to[i] = (uint8_t)code[i];
    }
    return to + (wide ? 2 : 1) * count;
}

static size_t y4m_pack(const wf_output_options *o, const wf_frame *frame, uint8_t *to) {
    memcpy(to, frame_mark, MARK_BYTES);
    to += MARK_BYTES;
    for (int p = 0; p < 3; p++)
        for (int y = 0; y < o->raster->lines; y++)
            to = put_line(to, wf_frame_codes(frame, p, y), plane_width(o, p), o->bits > 8);
    return y4m_frame_bytes(o);
}

/* ---- null and hash ---- */

static size_t nothing_bytes(const wf_output_options *o) {
    (void)o;
    return 0;
}

static size_t nothing(const wf_output_options *o, const wf_frame *frame, uint8_t *to) {
    (void)o, (void)frame, (void)to;
    return 0;
}

#define HASH_LINE_BYTES 64

static size_t hash_frame_bytes(const wf_output_options *o) {
    return HASH_LINE_BYTES + y4m_frame_bytes(o);
}

/* Writes one line a frame: its number and the XXH3-128 of its codes, in the bytes and the
 * order of Y4M. No line says anything of the run, so that the files of chunks, joined, are
 * the file of the whole run. */
static size_t hash_pack(const wf_output_options *o, const wf_frame *frame, uint8_t *to) {
    uint8_t *codes = to + HASH_LINE_BYTES;
    size_t bytes = y4m_pack(o, frame, codes);
    XXH128_hash_t hash = XXH3_128bits(codes + MARK_BYTES, bytes - MARK_BYTES);
    return (size_t)snprintf((char *)to, HASH_LINE_BYTES,
                            "%08" PRId64 " %016" PRIx64 "%016" PRIx64 "\n", frame->index,
                            (uint64_t)hash.high64, (uint64_t)hash.low64);
}

/* ---- The rows of the registry ---- */

#define STREAM(kind, ...)                                                                      \
    static const stream_format kind##_format = __VA_ARGS__;                                    \
    static weft_status kind##_open(const wf_output_options *options, wf_sink **out,            \
                                   weft_error *err) {                                          \
        return open_stream(options, &kind##_format, out, err);                                 \
    }                                                                                          \
    static wf_sink_size kind##_size(const wf_output_options *options, int64_t frames) {        \
        return stream_size(options, &kind##_format, frames);                                   \
    }

STREAM(y4m, {.header = y4m_header, .frame_bytes = y4m_frame_bytes, .pack = y4m_pack})
STREAM(v210, {.frame_bytes = wf_v210_bytes, .pack = wf_v210_pack})
STREAM(uyvy, {.frame_bytes = wf_uyvy_bytes, .pack = wf_uyvy_pack})
STREAM(null, {.frame_bytes = nothing_bytes, .pack = nothing, .silent = true})
STREAM(hash, {.frame_bytes = hash_frame_bytes,
              .line_bytes = 8 + 1 + 32 + 1,
              .pack = hash_pack,
              .prefix = "hash:"})

#define BITS(n) (1u << (n))

static const wf_output_kind y4m_kind = {
    .name = "Y4M",
    .endings = "y4m -",
    .help = "YUV4MPEG2, which ffmpeg and mpv read; - is standard output",
    .layout = WF_YCBCR,
    .bits_mask = BITS(8) | BITS(10) | BITS(12) | BITS(16),
    .default_bits = 10,
    .joins = true,
};
static const wf_sink_ops y4m_ops = {
    .size = y4m_size,
    .open = y4m_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_y4m = {&y4m_kind, &y4m_ops};

static const wf_output_kind v210_kind = {
    .name = "v210",
    .endings = "v210",
    .help = "raw 10-bit 4:2:2 frames, lines padded to 48 pixels",
    .layout = WF_YCBCR,
    .bits_mask = BITS(10),
    .default_bits = 10,
    .joins = true,
    .fixed_422 = true,
};
static const wf_sink_ops v210_ops = {
    .size = v210_size,
    .open = v210_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_v210 = {&v210_kind, &v210_ops};

static const wf_output_kind uyvy_kind = {
    .name = "uyvy",
    .endings = "uyvy",
    .help = "raw 8-bit 4:2:2 frames, Cb Y Cr Y",
    .layout = WF_YCBCR,
    .bits_mask = BITS(8),
    .default_bits = 8,
    .joins = true,
    .fixed_422 = true,
};
static const wf_sink_ops uyvy_ops = {
    .size = uyvy_size,
    .open = uyvy_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_uyvy = {&uyvy_kind, &uyvy_ops};

static const wf_output_kind null_kind = {
    .name = "null",
    .endings = "null:",
    .help = "null: writes nothing",
    .layout = WF_YCBCR,
    .bits_mask = BITS(8) | BITS(10) | BITS(12) | BITS(16),
    .default_bits = 10,
    .joins = true,
};
static const wf_sink_ops null_ops = {
    .size = null_size,
    .open = null_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_null = {&null_kind, &null_ops};

static const wf_output_kind hash_kind = {
    .name = "hash",
    .endings = "hash:",
    .help = "hash:FILE writes a line a frame: its number and the XXH3-128 of its codes",
    .layout = WF_YCBCR,
    .bits_mask = BITS(8) | BITS(10) | BITS(12) | BITS(16),
    .default_bits = 10,
    .joins = true,
};
static const wf_sink_ops hash_ops = {
    .size = hash_size,
    .open = hash_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_hash = {&hash_kind, &hash_ops};
