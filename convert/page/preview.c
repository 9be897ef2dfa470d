/* Deinterlaces one frame and makes its pixels square. */
#include "convert/page/preview.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/names.h"
#include "convert/base/outfile.h"
#include "convert/page/shown.h"
#include "convert/write/png_write.h"

#define GAMMA       2.4f /* of the display, Rec. ITU-R BT.1886 */
#define MOST_ASPECT 32   /* of a pixel, and the least is 1 / this */

typedef struct picture {
    int width_px, lines;
    float *rgb; /* [lines][3][width_px] */
} picture;

static float *line_of(const picture *p, int y, int channel) {
    return p->rgb + (3 * (size_t)y + (size_t)channel) * (size_t)p->width_px;
}

/* It may be more than a size_t holds. */
static double bytes_of(double width_px, int lines) {
    return 3 * sizeof(float) * width_px * lines;
}

static weft_status new_picture(int width_px, int lines, picture *out, weft_error *err) {
    *out = (picture){.width_px = width_px, .lines = lines};
    out->rgb = malloc(3 * (size_t)width_px * (size_t)lines * sizeof *out->rgb);
    return out->rgb ? WEFT_OK
                    : wf_fail(err, WEFT_NO_MEMORY, "no memory for a picture of %dx%d", width_px,
                              lines);
}

/* ---- The frame ---- */

static weft_status no_such_frame(const wf_preview_request *r, int64_t frames, weft_error *err) {
    if (!frames) return wf_fail(err, WEFT_FAILED, "%.500s: there is no frame in it", r->video);
    return wf_fail(err, WEFT_USAGE,
                   "%.500s: there is no frame %" PRId64 "; it has %" PRId64 ", numbered from 0",
                   r->video, r->frame, frames);
}

static weft_status check_canceled(const wf_preview_request *r, weft_error *err) {
    if (!r->canceled || !*r->canceled) return WEFT_OK;
    return wf_fail(err, WEFT_INTERRUPTED, "interrupted; no preview was written");
}

/* Counts the frames of a video that does not say how many it has. */
static weft_status count_frames(const wf_preview_request *r, int64_t *frames, weft_error *err) {
    const wf_video_options options = {
        .raster = r->raster, .transfer = r->transfer, .max_memory_bytes = r->max_memory_bytes};
    const wf_video_frame *frame;
    wf_video *video;
    weft_status status = wf_video_open(r->video, &options, &video, err);
    if (status) return status;
    *frames = wf_video_info_of(video)->frames;
    for (int64_t n = 0; *frames < 0 && !status; n++) {
        status = check_canceled(r, err);
        if (!status) status = wf_video_next(video, &frame, err);
        if (!status && !frame) *frames = n;
    }
    wf_video_close(video);
    return status;
}

/* Reads forward to the frame. */
static weft_status find_frame(const wf_preview_request *r, wf_video *video, int64_t number,
                              const wf_video_frame **frame, weft_error *err) {
    weft_status status = WEFT_OK;
    int64_t next, passed = 0;
    if (number) status = wf_video_seek(video, number, &next, err);
    while (!status) {
        status = check_canceled(r, err);
        if (!status) status = wf_video_next(video, frame, err);
        if (!status && !*frame) return no_such_frame(r, passed, err);
        if (!status && (*frame)->index >= number) return WEFT_OK;
        if (!status) passed = (*frame)->index + 1;
    }
    return status;
}

static weft_status take_frame(const wf_preview_request *r, wf_video *video, int64_t number,
                              picture *out, weft_error *err) {
    const wf_video_info *info = wf_video_info_of(video);
    const wf_video_frame *frame;
    wf_page_shown *shown = NULL;
    weft_status status = new_picture(info->width_px, info->lines, out, err);
    if (!status) status = wf_page_shown_new(info, &shown, err);
    if (!status) status = find_frame(r, video, number, &frame, err);
    if (!status) wf_page_shown_take(shown, frame);
    for (int y = 0; y < info->lines && !status; y++) {
        float *rgb[3] = {line_of(out, y, 0), line_of(out, y, 1), line_of(out, y, 2)};
        wf_page_shown_rgb(shown, y, rgb);
    }
    wf_page_shown_free(shown);
    return status;
}

/* ---- Deinterlacing ---- */

static float middle_of(float a, float b, float c) {
    float low = fminf(a, b), high = fmaxf(a, b);
    return c < low ? low : c > high ? high : c;
}

/* Between the lines of the field that owns lines `parity`, `parity` + 2, ... */
static void deinterlace(const picture *p, int parity) {
    if (p->lines < 2) return; /* there is nothing beside it */
    for (int y = 1 - parity; y < p->lines; y += 2)
        for (int c = 0; c < 3; c++) {
            const float *above = line_of(p, y ? y - 1 : y + 1, c);
            const float *below = line_of(p, y + 1 < p->lines ? y + 1 : y - 1, c);
            float *own = line_of(p, y, c);
            for (int x = 0; x < p->width_px; x++)
                own[x] = middle_of(above[x], below[x], own[x]);
        }
}

/* ---- Square pixels ---- */

static float light_of(float code) {
    return code > 0 ? powf(code, GAMMA) : 0;
}

/* One line of another width, in light, by a triangle as wide as a pixel of the coarser one. */
static void stretch_line(const float *from, int width_px, float *to, int to_px) {
    double step = (double)width_px / to_px, reach = fmax(step, 1);
    for (int x = 0; x < to_px; x++) {
        double center = (x + 0.5) * step - 0.5, sum = 0, weights = 0;
        int first = (int)fmax(ceil(center - reach), 0);
        int last = (int)fmin(floor(center + reach), width_px - 1);
        for (int i = first; i <= last; i++) {
            double weight = 1 - fabs(i - center) / reach;
            sum += weight * (double)light_of(from[i]);
            weights += weight;
        }
        to[x] = powf((float)(sum / weights), 1 / GAMMA);
    }
}

/* An aspect is whatever the file says. */
static weft_status check_square(const picture *p, double aspect, const wf_preview_request *r,
                                weft_error *err) {
    double width_px = p->width_px * aspect;
    if (!(aspect >= 1.0 / MOST_ASPECT && aspect <= MOST_ASPECT))
        return wf_fail(err, WEFT_FAILED,
                       "%.500s says that its pixels are %.3g times as wide as high, and a "
                       "preview goes from 1/%d to %d; --raster says otherwise",
                       r->video, aspect, MOST_ASPECT, MOST_ASPECT);
    if (bytes_of(width_px, p->lines) <= (double)r->max_memory_bytes) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%.500s: with square pixels it is a picture of %.0fx%d, which takes more "
                   "memory than --max-memory allows",
                   r->video, width_px, p->lines);
}

static weft_status make_square(picture *p, double aspect, const wf_preview_request *r,
                               weft_error *err) {
    picture wide;
    weft_status status = check_square(p, aspect, r, err);
    if (status) return status;
    int width_px = (int)fmax(1, round(p->width_px * aspect));
    if (width_px == p->width_px) return WEFT_OK;
    status = new_picture(width_px, p->lines, &wide, err);
    if (status) return status;
    for (int y = 0; y < p->lines; y++)
        for (int c = 0; c < 3; c++)
            stretch_line(line_of(p, y, c), p->width_px, line_of(&wide, y, c), width_px);
    free(p->rgb);
    *p = wide;
    return WEFT_OK;
}

/* ---- The file ---- */

static uint16_t *codes_of(const picture *p) {
    size_t samples = (size_t)p->width_px * (size_t)p->lines;
    uint16_t *codes = malloc(3 * samples * sizeof *codes);
    for (int c = 0; codes && c < 3; c++)
        for (int y = 0; y < p->lines; y++) {
            const float *line = line_of(p, y, c);
            uint16_t *to = codes + (size_t)c * samples + (size_t)y * (size_t)p->width_px;
            for (int x = 0; x < p->width_px; x++)
                to[x] = (uint16_t)lrintf(255 * fminf(fmaxf(line[x], 0), 1));
        }
    return codes;
}

static weft_status put_bytes(void *file, const void *data, size_t bytes, weft_error *err) {
    return wf_outfile_write(file, data, bytes, err);
}

/* It is no frame of the raster any more, and has none of its labels. */
static weft_status put_picture(const picture *p, const uint16_t *codes, wf_outfile *file,
                               weft_error *err) {
    size_t width = (size_t)p->width_px, samples = width * (size_t)p->lines;
    const wf_picture_out out = {.channels = 3,
                                .plane = {codes, codes + samples, codes + 2 * samples},
                                .line_stride = {width, width, width},
                                .width_px = p->width_px,
                                .lines = p->lines,
                                .bits = 8,
                                .full_range = true,
                                .pixel_aspect = {1, 1},
                                .timecode = "",
                                .color_space = "",
                                .raster = ""};
    return wf_png_encode(&out, put_bytes, file, err);
}

static weft_status write_picture(const picture *p, const wf_preview_request *r,
                                 const char *path, weft_error *err) {
    uint16_t *codes = codes_of(p);
    wf_outfile *file;
    if (!codes) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the picture");
    weft_status status = wf_outfile_open(path, r->overwrite, &file, err);
    if (!status) {
        status = put_picture(p, codes, file, err);
        if (status)
            wf_outfile_abandon(file);
        else
            status = wf_outfile_commit(file, err);
    }
    free(codes);
    return status;
}

static weft_status check_ending(const char *path, weft_error *err) {
    if (wf_name_ends_in(path, ".png")) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%.500s: a preview is a PNG picture; name it such as "
                   "look.png",
                   path);
}

weft_status wf_preview_read_frame(const char *text, const char *preview, int64_t *frame,
                                  weft_error *err) {
    char *end;
    if (!text) return WEFT_OK;
    if (!preview)
        return wf_fail(err, WEFT_USAGE,
                       "--preview-frame says which frame a preview is of; give --preview "
                       "look.png too, or leave it out");
    errno = 0;
    long long number = strtoll(text, &end, 10);
    if (!errno && end != text && !*end && number >= 0) {
        *frame = number;
        return WEFT_OK;
    }
    return wf_fail(
        err, WEFT_USAGE,
        "--preview-frame: '%.200s' will not do; it takes the number of a frame, from "
        "0",
        text);
}

weft_status wf_preview_check_name(const char *path, bool overwrite, weft_error *err) {
    weft_status status = check_ending(path, err);
    return status ? status : wf_outfile_check(path, overwrite, err);
}

weft_status wf_preview_write(const wf_preview_request *r, const char *path, weft_error *err) {
    const wf_video_options options = {
        .raster = r->raster, .transfer = r->transfer, .max_memory_bytes = r->max_memory_bytes};
    picture p = {.rgb = NULL};
    wf_video *video = NULL;
    int64_t frames = 0, number = r->frame;
    weft_status status = check_ending(path, err);
    if (!status) status = count_frames(r, &frames, err);
    if (!status && (number >= frames || !frames)) status = no_such_frame(r, frames, err);
    if (number < 0) number = frames / 2;
    if (!status) status = wf_video_open(r->video, &options, &video, err);
    if (!status) status = take_frame(r, video, number, &p, err);
    if (!status) {
        const wf_raster *raster = &wf_video_info_of(video)->raster;
        if (raster->scan == WF_INTERLACED) deinterlace(&p, wf_raster_parity(raster, 0));
        status = make_square(&p, wf_ratio_value(raster->pixel_aspect), r, err);
    }
    if (!status) status = check_canceled(r, err);
    if (!status) status = write_picture(&p, r, path, err);
    if (video) wf_video_close(video);
    free(p.rgb);
    return status;
}
