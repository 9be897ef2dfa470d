/* Image sequences: a file a frame, encoded in memory, so that a full disk or a broken pipe is
 * seen where bytes are written, and a file is at its name whole or not at all. */
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/module.h"
#include "convert/base/outfile.h"
#include "convert/base/pattern.h"
#include "convert/job/choices.h"
#include "convert/job/colors.h"
#include "convert/job/timecode.h"
#include "convert/media/picture_out.h"
#include "convert/write/exr_write.h"
#include "convert/write/png_write.h"
#include "convert/write/sink_kinds.h"

struct wf_sink {
    wf_output_options options;
    wf_encode_picture_fn *encode;
};

/* ---- Names ---- */

static weft_status check_name(const wf_output_options *o, weft_error *err) {
    int64_t files = o->frame_count * wf_output_files(o);
    if (wf_pattern_is(o->output) || (files >= 0 && files <= 1 && !o->chunked)) return WEFT_OK;
    const char *dot = strrchr(o->output, '.');
    return wf_fail(err, WEFT_USAGE,
                   "%.500s: there are %" PRId64
                   " %s%s, and each is a file; say where its number "
                   "goes, such as %.*s.####%s",
                   o->output, files, o->separate_fields ? "fields" : "frames",
                   o->chunked ? " in this chunk" : "", dot ? (int)(dot - o->output) : 0,
                   o->output, dot ? dot : "");
}

static weft_status name_file(const wf_output_options *o, int64_t number, char path[PATH_MAX],
                             weft_error *err) {
    bool fits = wf_pattern_is(o->output) ? wf_pattern_path(o->output, number, path, PATH_MAX)
                                         : snprintf(path, PATH_MAX, "%s", o->output) < PATH_MAX;
    if (fits) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%.500s: the name of number %" PRId64 " is too long; shorten it", o->output,
                   number);
}

/* Looks for files that would not be replaced before the run begins, so that it does not end
 * at one of them. */
static weft_status check_absent(const wf_output_options *o, weft_error *err) {
    char path[PATH_MAX];
    weft_status status = WEFT_OK;
    int files = wf_output_files(o);
    for (int64_t i = 0; !status && i < o->frame_count * files; i++) {
        struct stat about;
        status = name_file(o, o->first_frame * files + i, path, err);
        if (status || o->overwrite || o->resume || lstat(path, &about)) continue;
        if (S_ISREG(about.st_mode))
            status =
                wf_fail(err, WEFT_FAILED,
                        "%.700s exists; give --overwrite to replace it, or --resume to write "
                        "the frames that are not there",
                        path);
    }
    return status;
}

/* ---- Opening and writing ---- */

/* Formats that weft does not write itself are the OpenImageIO module's. */
static weft_status find_encoder(const wf_output_options *options, const char *format,
                                const char *entry, wf_encode_picture_fn **encode,
                                weft_error *err) {
    void *symbol;
    char what[600];
    snprintf(what, sizeof what, "%.500s: %s, unlike .exr and .png,", options->output,
             format);
    weft_status status = wf_module_symbol("oiio", entry, what, &symbol, err);
    if (!status) memcpy(encode, &symbol, sizeof symbol);
    return status;
}

static weft_status open_pictures(const wf_output_options *options, wf_encode_picture_fn *encode,
                                 wf_sink **out, weft_error *err) {
    weft_status status = check_name(options, err);
    if (!status) status = check_absent(options, err);
    if (status) return status;
    wf_sink *s = calloc(1, sizeof *s);
    if (!s)
        return wf_fail(err, WEFT_NO_MEMORY, "%.500s: no memory for the sequence",
                       options->output);
    *s = (wf_sink){.options = *options, .encode = encode};
    *out = s;
    return WEFT_OK;
}

/* Errors of the file name the file; those of the encoder do not. */
typedef struct encoded {
    wf_outfile *file;
    bool said;
} encoded;

static weft_status put_bytes(void *user, const void *data, size_t bytes, weft_error *err) {
    encoded *e = user;
    weft_status status = wf_outfile_write(e->file, data, bytes, err);
    e->said = status != WEFT_OK;
    return status;
}

static void label_frame(const wf_output_options *o, int64_t index,
                        char text[WF_TIMECODE_SIZE]) {
    wf_timecode start;
    *text = '\0';
    if (!o->timecode || !wf_parse_timecode(o->timecode, &start)) return;
    wf_timecode label = wf_timecode_add(&start, index, o->raster->frame_rate);
    wf_timecode_text(&label, text);
}

static weft_status write_file(wf_sink *s, const wf_picture_out *picture, const char *path,
                              weft_error *err) {
    wf_outfile *file;
    weft_error why = {""};
    /* A job that resumes writes only where no whole picture was found. */
    bool replace = s->options.overwrite || s->options.resume;
    weft_status status = wf_outfile_open(path, replace, &file, err);
    if (status) return status;
    encoded e = {file, false};
    status = s->encode(picture, put_bytes, &e, &why);
    if (!status) return wf_outfile_commit(file, err);
    wf_outfile_abandon(file);
    return e.said ? wf_fail(err, status, "%s", why.text)
                  : wf_fail(err, status, "%.600s: %.400s", path, why.text);
}

static void describe_light(const wf_chromaticities *c, wf_picture_out *picture) {
    const double *const xy[4] = {c->red, c->green, c->blue, c->white};
    for (int i = 0; i < 8; i++) picture->chromaticities[i] = xy[i / 2][i % 2];
}

static wf_picture_out describe(const wf_sink *s, const wf_frame *frame) {
    const wf_output_options *o = &s->options;
    wf_picture_out picture = {
        .width_px = o->raster->width_px,
        .lines = o->raster->lines,
        .bits = o->bits,
        .full_range = o->full_range,
        .pixel_aspect = o->raster->pixel_aspect,
        .frame_rate = o->raster->frame_rate,
        .interlaced = o->raster->scan == WF_INTERLACED,
        .top_first = o->raster->top_first,
        .color_space = o->color_space ? o->color_space : "",
        .raster = o->raster->name,
        .subframe_rate = o->subframe_rate,
    };
    if (o->primaries) describe_light(o->primaries, &picture);
    if (wf_color_has_tags(o->color_space)) {
        wf_color_tags tags = wf_color_tags_of(o->color_space, o->raster->matrix);
        picture.primaries = tags.primaries;
        picture.transfer = tags.transfer;
    }
    if (wf_ratio_given(o->subframe_rate))
        picture.time_s = wf_ratio_div(wf_ratio(frame->index, 1), o->subframe_rate);
    picture.channels = o->alpha ? 4 : 3;
    picture.straight = o->straight;
    for (int c = 0; c < picture.channels; c++) {
        picture.plane[c] = frame->plane[c];
        picture.line_stride[c] = frame->stride[c];
    }
    return picture;
}

/* Turns the picture of a frame into that of one of its fields: every other line. */
static void take_field(const wf_sink *s, int n, wf_picture_out *p) {
    const wf_raster *raster = s->options.raster;
    int parity = wf_raster_parity(raster, n);
    size_t bytes = p->bits == 32 ? sizeof(float) : sizeof(uint16_t);
    for (int c = 0; c < p->channels; c++) {
        p->plane[c] = (const char *)p->plane[c] + (size_t)parity * p->line_stride[c] * bytes;
        p->line_stride[c] *= 2;
    }
    p->lines = wf_raster_field_lines(raster, parity);
    p->pixel_aspect = wf_ratio_div(p->pixel_aspect, wf_ratio(2, 1));
    p->frame_rate = wf_ratio_mul(p->frame_rate, wf_ratio(2, 1));
    p->field = n + 1;
    p->top_lines = parity == 0;
}

static weft_status write_frame(wf_sink *s, const wf_frame *frame, weft_error *err) {
    const wf_output_options *o = &s->options;
    char path[PATH_MAX], timecode[WF_TIMECODE_SIZE];
    int files = wf_output_files(o);
    weft_status status = WEFT_OK;
    label_frame(o, frame->index, timecode);
    for (int n = 0; !status && n < files; n++) {
        wf_picture_out picture = describe(s, frame);
        picture.timecode = timecode;
        if (o->separate_fields) take_field(s, n, &picture);
        status = name_file(o, frame->index * files + n, path, err);
        if (!status) status = write_file(s, &picture, path, err);
    }
    return status;
}

static weft_status commit(wf_sink *s, weft_error *err) {
    (void)err;
    free(s);
    return WEFT_OK;
}

static void abandon(wf_sink *s) {
    free(s);
}

/* ---- Sizes ---- */

/* Bytes of a line of DPX as OpenImageIO writes it: three codes of 10 bits share a word, 12
 * bits are packed and the line filled to words, 8 and 16 bits are stored as they are.
 * Headers have 8192 bytes. */
static int64_t dpx_line_bytes(const wf_output_options *o) {
    int64_t samples = (o->alpha ? 4 : 3) * (int64_t)o->raster->width_px;
    if (o->bits == 10) return (samples + 2) / 3 * 4;
    return o->bits == 12 ? (samples * 12 + 31) / 32 * 4 : samples * o->bits / 8;
}

static wf_sink_size dpx_size(const wf_output_options *o, int64_t frames) {
    int64_t lines = o->raster->lines * dpx_line_bytes(o);
    return (wf_sink_size){frames * (8192 * wf_output_files(o) + lines), WF_SIZE_EXACT};
}

/* The other formats compress: a file takes no more than its samples and a header. */
static wf_sink_size compressed_size(const wf_output_options *o, int64_t frames) {
    int64_t sample = o->bits == 32 ? 4 : o->bits > 8 ? 2 : 1;
    int64_t pixel = (o->alpha ? 4 : 3) * sample;
    int64_t picture = pixel * o->raster->width_px * o->raster->lines;
    return (wf_sink_size){frames * (4096 * wf_output_files(o) + picture), WF_SIZE_MOST};
}

static weft_status exr_open(const wf_output_options *options, wf_sink **out, weft_error *err) {
    return open_pictures(options, wf_exr_encode, out, err);
}

static weft_status png_open(const wf_output_options *options, wf_sink **out, weft_error *err) {
    return open_pictures(options, wf_png_encode, out, err);
}

static weft_status dpx_open(const wf_output_options *options, wf_sink **out, weft_error *err) {
    wf_encode_picture_fn *encode;
    weft_status status = find_encoder(options, "DPX", "wf_oiio_dpx", &encode, err);
    return status ? status : open_pictures(options, encode, out, err);
}

static weft_status tiff_open(const wf_output_options *options, wf_sink **out, weft_error *err) {
    wf_encode_picture_fn *encode;
    weft_status status = find_encoder(options, "TIFF", "wf_oiio_tiff", &encode, err);
    return status ? status : open_pictures(options, encode, out, err);
}

#define BITS(n) (1u << (n))
#define EITHER  (BITS(WF_FILL_PREMULTIPLIED) | BITS(WF_FILL_STRAIGHT))

static const wf_output_kind exr_kind = {
    .name = "OpenEXR",
    .endings = "exr",
    .help = "float R G B, scene-linear unless --to says otherwise",
    .layout = WF_LINEAR,
    .fills = BITS(WF_FILL_PREMULTIPLIED), /* OpenEXR */
    .default_bits = 32,
    .full_range = true,
    .sequence = true,
    .joins = true,
};
static const wf_sink_ops exr_ops = {
    .size = compressed_size,
    .open = exr_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_exr = {&exr_kind, &exr_ops};

static const wf_output_kind dpx_kind = {
    .name = "DPX",
    .endings = "dpx",
    .help = "R'G'B' with interlace elements and time code",
    .layout = WF_RGB,
    .fills = EITHER,
    .bits_mask = BITS(8) | BITS(10) | BITS(12) | BITS(16),
    .default_bits = 10,
    .full_range = true,
    .sequence = true,
    .joins = true,
};
static const wf_sink_ops dpx_ops = {
    .size = dpx_size,
    .open = dpx_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_dpx = {&dpx_kind, &dpx_ops};

static const wf_output_kind tiff_kind = {
    .name = "TIFF",
    .endings = "tif tiff",
    .help = "R'G'B'",
    .layout = WF_RGB,
    .fills = EITHER,
    .bits_mask = BITS(8) | BITS(16),
    .default_bits = 16,
    .full_range = true,
    .sequence = true,
    .joins = true,
};
static const wf_sink_ops tiff_ops = {
    .size = compressed_size,
    .open = tiff_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_tiff = {&tiff_kind, &tiff_ops};

static const wf_output_kind png_kind = {
    .name = "PNG",
    .endings = "png",
    .help = "R'G'B'",
    .layout = WF_RGB,
    .fills = BITS(WF_FILL_STRAIGHT), /* ISO 15948 */
    .bits_mask = BITS(8) | BITS(16),
    .default_bits = 16,
    .full_range = true,
    .sequence = true,
    .joins = true,
};
static const wf_sink_ops png_ops = {
    .size = compressed_size,
    .open = png_open,
    .write = write_frame,
    .commit = commit,
    .abandon = abandon,
};
const wf_output wf_output_png = {&png_kind, &png_ops};
