/* Image sequences: a file a frame, encoded in memory by the OpenImageIO module, so that a full
 * disk or a broken pipe is seen where bytes are written, and a file is at its name whole or not
 * at all. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/module.h"
#include "convert/oiio.h"
#include "convert/outfile.h"
#include "convert/sequence.h"
#include "convert/sink.h"
#include "convert/timecode.h"

struct wf_sink {
    wf_sink_options options;
    const char *format;
    wf_oiio_write_fn *encode;
};

static weft_status open_pictures(const wf_sink_options *options, const char *format,
                                 wf_sink **out, weft_error *err) {
    bool pattern = wf_sequence_is_pattern(options->output);
    if (!pattern && (options->frame_count > 1 || options->first_frame > 0))
        return wf_fail(
            err, WEFT_USAGE,
            "%s: %lld frames need a name each; put #### where the number goes, as in "
            "out.####.%s",
            options->output, (long long)options->frame_count,
            strrchr(options->output, '.') + 1);
    wf_sink *s = calloc(1, sizeof *s);
    if (!s)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for the sequence", options->output);
    *s = (wf_sink){.options = *options, .format = format};
    void *symbol;
    weft_status status = wf_module_symbol("oiio", "wf_oiio_write", &symbol, err);
    if (status) {
        free(s);
        return status;
    }
    memcpy(&s->encode, &symbol, sizeof symbol);
    *out = s;
    return WEFT_OK;
}

static weft_status put_bytes(void *user, const void *data, size_t bytes, weft_error *err) {
    return wf_outfile_write(user, data, bytes, err);
}

static void frame_timecode(const wf_sink_options *o, int64_t index,
                           char text[WF_TIMECODE_SIZE]) {
    wf_timecode start;
    *text = '\0';
    if (!o->timecode || !wf_parse_timecode(o->timecode, &start)) return;
    wf_timecode label = wf_timecode_add(&start, index, o->raster->frame_rate);
    wf_timecode_text(&label, text);
}

static weft_status write_file(wf_sink *s, const wf_oiio_picture *picture, const char *path,
                              weft_error *err) {
    wf_outfile *file;
    weft_status status = wf_outfile_open(path, s->options.overwrite, &file, err);
    if (status) return status;
    status = s->encode(picture, put_bytes, file, err);
    if (!status) return wf_outfile_commit(file, err);
    wf_outfile_abandon(file);
    return status;
}

static weft_status write_frame(wf_sink *s, const wf_frame *frame, weft_error *err) {
    const wf_sink_options *o = &s->options;
    char path[4096], timecode[WF_TIMECODE_SIZE];
    if (!wf_sequence_is_pattern(o->output))
        snprintf(path, sizeof path, "%s", o->output);
    else if (!wf_sequence_output_path(o->output, frame->index, path, sizeof path))
        return wf_fail(err, WEFT_FAILED, "%s: the name of frame %lld is too long", o->output,
                       (long long)frame->index);
    frame_timecode(o, frame->index, timecode);
    wf_oiio_picture picture = {.format = s->format,
                               .width_px = o->raster->width_px,
                               .lines = o->raster->lines,
                               .bits = o->bits,
                               .pixel_aspect = wf_ratio_value(o->raster->pixel_aspect),
                               .frame_rate = o->raster->frame_rate,
                               .interlaced = o->raster->scan == WF_INTERLACED,
                               .top_first = o->raster->top_first,
                               .timecode = timecode,
                               .color_space = o->color_space,
                               .raster = o->raster->name};
    for (int c = 0; c < 3; c++) {
        picture.plane[c] = frame->plane[c];
        picture.line_stride[c] = frame->stride[c];
    }
    return write_file(s, &picture, path, err);
}

static weft_status commit(wf_sink *s, weft_error *err) {
    (void)err;
    free(s);
    return WEFT_OK;
}

static void abandon(wf_sink *s) {
    free(s);
}

#define PICTURES(kind, oiio_name)                                                              \
    static weft_status kind##_open(const wf_sink_options *options, wf_sink **out,              \
                                   weft_error *err) {                                          \
        return open_pictures(options, oiio_name, out, err);                                    \
    }

PICTURES(exr, "openexr")
PICTURES(dpx, "dpx")
PICTURES(tiff, "tiff")
PICTURES(png, "png")

#define BITS(n) (1u << (n))

extern const wf_sink_kind wf_sink_exr, wf_sink_dpx, wf_sink_tiff, wf_sink_png;

const wf_sink_kind wf_sink_exr = {.name = "OpenEXR",
                                  .endings = "exr",
                                  .help =
                                      "float R G B, scene-linear unless --to says otherwise",
                                  .layout = WF_LINEAR,
                                  .default_bits = 32,
                                  .full_range = true,
                                  .sequence = true,
                                  .joins = true,
                                  .open = exr_open,
                                  .write = write_frame,
                                  .commit = commit,
                                  .abandon = abandon};

const wf_sink_kind wf_sink_dpx = {.name = "DPX",
                                  .endings = "dpx",
                                  .help = "R'G'B' with interlace elements and time code",
                                  .layout = WF_RGB,
                                  .bits_mask = BITS(8) | BITS(10) | BITS(16),
                                  .default_bits = 10,
                                  .full_range = true,
                                  .sequence = true,
                                  .joins = true,
                                  .open = dpx_open,
                                  .write = write_frame,
                                  .commit = commit,
                                  .abandon = abandon};

const wf_sink_kind wf_sink_tiff = {.name = "TIFF",
                                   .endings = "tif tiff",
                                   .help = "R'G'B'",
                                   .layout = WF_RGB,
                                   .bits_mask = BITS(8) | BITS(16),
                                   .default_bits = 16,
                                   .full_range = true,
                                   .sequence = true,
                                   .joins = true,
                                   .open = tiff_open,
                                   .write = write_frame,
                                   .commit = commit,
                                   .abandon = abandon};

const wf_sink_kind wf_sink_png = {.name = "PNG",
                                  .endings = "png",
                                  .help = "R'G'B'",
                                  .layout = WF_RGB,
                                  .bits_mask = BITS(8) | BITS(16),
                                  .default_bits = 8,
                                  .full_range = true,
                                  .sequence = true,
                                  .joins = true,
                                  .open = png_open,
                                  .write = write_frame,
                                  .commit = commit,
                                  .abandon = abandon};
