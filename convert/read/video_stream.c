/* Reads streams of frames back: Y4M, and raw v210 and uyvy. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "convert/media/y4m.h"
#include "convert/read/video_kinds.h"

typedef struct stream stream;

/* Unpacks a line into one array of codes a plane. */
typedef void unpack_fn(const uint8_t *packed, int width_px, uint16_t *const code[3]);

struct stream {
    FILE *file;
    uint8_t *bytes;
    uint8_t *held;     /* the last frame that is whole, where others may be missing; or NULL */
    uint16_t *code[3]; /* [width] each, of one block */
    size_t frame_bytes, line_bytes;
    unpack_fn *unpack; /* raw formats */
    wf_y4m header;
    off_t first_byte; /* of the frames of Y4M */
};

static weft_status failed(const wf_video *v, weft_error *err) {
    return wf_fail(err, WEFT_FAILED, "%s: %s", v->path, strerror(errno));
}

/* Of a stream's error, of which errno may say nothing any more. */
static weft_status unread(const wf_video *v, weft_error *err) {
    return wf_fail(err, WEFT_FAILED, "%s: %s", v->path, strerror(EIO));
}

static weft_status open_file(wf_video *v, weft_error *err) {
    stream *s = v->state = calloc(1, sizeof *s);
    if (!s) return wf_video_no_memory(v, err);
    s->file = v->pipe ? v->pipe : fopen(v->path, "rb");
    return s->file ? WEFT_OK : failed(v, err);
}

/* Allocates the bytes of a frame and the codes of a line. */
static weft_status make_buffers(wf_video *v, weft_error *err) {
    stream *s = v->state;
    size_t width = (size_t)v->info.width_px + 6; /* a whole group of v210 at the end */
    s->bytes = malloc(s->frame_bytes);
    s->code[0] = malloc(3 * width * sizeof *s->code[0]);
    if (!s->bytes || !s->code[0]) return wf_video_no_memory(v, err);
    s->code[1] = s->code[0] + width;
    s->code[2] = s->code[1] + width;
    return WEFT_OK;
}

static void close_stream(wf_video *v) {
    stream *s = v->state;
    if (!s) return;
    if (s->file && s->file != v->pipe) fclose(s->file);
    free(s->bytes);
    free(s->held);
    free(s->code[0]);
    free(s);
}

/* When the frame in hand is shown. */
static double time_s(const wf_video *v) {
    return (double)v->frame.index / wf_ratio_value(v->info.raster.frame_rate);
}

/* One frame's bytes. */
static weft_status read_bytes(wf_video *v, weft_error *err) {
    stream *s = v->state;
    size_t got = fread(s->bytes, 1, s->frame_bytes, s->file);
    if (got == s->frame_bytes) return WEFT_OK;
    if (ferror(s->file)) return unread(v, err);
    return wf_fail(err, WEFT_FAILED,
                   "%s: the file ends within frame %" PRId64
                   " (%.3f s), after %zu of its %zu bytes; write it again",
                   v->path, v->frame.index, time_s(v), got, s->frame_bytes);
}

/* ---- Y4M ---- */

static weft_status read_header(wf_video *v, weft_error *err) {
    stream *s = v->state;
    char line[WF_Y4M_LINE];
    bool told = fgets(line, sizeof line, s->file);
    if (ferror(s->file)) return unread(v, err);
    bool whole =
        told && strchr(line, '\n') && !strncmp(line, WF_Y4M_MAGIC " ", sizeof WF_Y4M_MAGIC);
    if (whole) *strchr(line, '\n') = '\0';
    if (!whole || !wf_y4m_parse(line, &s->header))
        return wf_fail(
            err, WEFT_FAILED,
            "%s: it does not begin with a whole Y4M header: YUV4MPEG2 with W, H and F "
            "in its first line",
            v->path);
    if (s->header.known) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "%s: its chroma is '%s'; known are 420, 422, 444, 411 and mono, and with p10, "
        "p12 .. more bits",
        v->path, s->header.chroma);
}

/* What writers of Y4M mean by its names for 4:2:0: plain and "jpeg" are amid the luma samples,
 * and those of more than 8 bits, which came later, lie as in MPEG-2. */
static wf_siting siting_of(const wf_y4m *h) {
    if (h->down != 2 || h->bits > 8 || !strncmp(h->chroma, "420mpeg2", 8))
        return WF_SITING_LEFT;
    return strncmp(h->chroma, "420paldv", 8) ? WF_SITING_CENTER : WF_SITING_TOP_LEFT;
}

static weft_status go_to(const wf_video *v, int64_t picture, weft_error *err) {
    const stream *s = v->state;
    off_t at = s->first_byte + picture * (off_t)(strlen("FRAME\n") + s->frame_bytes);
    return fseeko(s->file, at, SEEK_SET) ? failed(v, err) : WEFT_OK;
}

/* Whether one of the first so many lines FRAME has parameters. Where the first one is, those
 * before it are bare; a line that is damaged is not one. */
static bool has_parameters(const wf_video *v, int64_t frames) {
    const stream *s = v->state;
    char mark[6];
    bool found = false;
    weft_error err;
    for (int64_t n = 0; n < frames && !found; n++)
        found = !go_to(v, n, &err) && fread(mark, sizeof mark, 1, s->file) &&
                !memcmp(mark, "FRAME ", sizeof mark);
    return go_to(v, 0, &err) || found;
}

/* A file that was cut off within a frame, which may be missing, has that one too. Frames with
 * parameters are of no one length, and cannot be counted. */
static int64_t count_y4m(const wf_video *v) {
    const stream *s = v->state;
    int64_t frames = wf_y4m_count(&s->header, s->file, s->first_byte);
    int64_t each = (int64_t)(strlen("FRAME\n") + s->frame_bytes);
    struct stat about;
    bool cut = frames < 0 && v->options.mends && !v->pipe && s->first_byte >= 0 &&
               !fstat(fileno(s->file), &about);
    if (cut) frames = (about.st_size - s->first_byte + each - 1) / each;
    return frames > 0 && has_parameters(v, cut ? frames : 1) ? -1 : frames;
}

static weft_status y4m_open(wf_video *v, wf_video_label *label, weft_error *err) {
    weft_status status = open_file(v, err);
    if (!status) status = read_header(v, err);
    if (status) return status;
    stream *s = v->state;
    const wf_y4m *h = &s->header;
    wf_video_info *info = &v->info;
    snprintf(info->format, sizeof info->format, "Y4M %s", h->chroma);
    info->width_px = h->width_px;
    info->lines = h->lines;
    info->layout = WF_YCBCR;
    info->bits = h->bits;
    info->full_range = h->full_range;
    info->planes = h->across ? 3 : 1;
    info->across = h->across ? h->across : 1;
    info->down = h->down ? h->down : 1;
    info->alpha = h->alpha;
    info->tags.range_said = h->range_said;
    info->tags.siting = siting_of(h);
    s->frame_bytes = (size_t)wf_y4m_frame_bytes(h);
    status = wf_video_check_memory(v, err);
    if (status) return status;
    s->first_byte = ftello(s->file);
    info->frames = count_y4m(v);
    if (ferror(s->file)) return unread(v, err);
    *label =
        (wf_video_label){.scan_known = h->order && strchr("ptb", h->order),
                         .interlaced = h->order && strchr("tbm", h->order), /* m: some are */
                         .top_first = h->order == 't',
                         .rate = h->rate,
                         .aspect = h->aspect};
    return make_buffers(v, err);
}

/* Takes the lines of a plane, whose codes have one or two bytes, and returns where it ends. */
static const uint8_t *take_plane(wf_video *v, int p, const uint8_t *from) {
    stream *s = v->state;
    int width = v->frame.width_px[p];
    bool wide = v->info.bits > 8;
    for (int y = 0; y < v->frame.lines[p]; y++, from += (size_t)width * (wide ? 2 : 1)) {
        if (v->take_codes && !wide) {
            wf_video_take_bytes(v, p, y, from);
            continue;
        }
        for (int x = 0; x < width; x++)
            s->code[0][x] =
                wide ? (uint16_t)(from[2 * x] | from[2 * x + 1] << 8) : (uint16_t)from[x];
        wf_video_take_codes(v, p, y, s->code[0]);
    }
    return from;
}

/* A frame begins with a line "FRAME", which may have parameters. */
static weft_status y4m_mark(wf_video *v, bool *more, weft_error *err) {
    stream *s = v->state;
    char line[WF_Y4M_LINE];
    *more = fgets(line, sizeof line, s->file) != NULL;
    if (!*more) return ferror(s->file) ? unread(v, err) : WEFT_OK;
    if (!strncmp(line, "FRAME", 5) && strchr(line, '\n')) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: frame %" PRId64
                   " (%.3f s) does not begin with the line FRAME: the file is damaged, "
                   "or its header does not say what it holds",
                   v->path, v->frame.index, time_s(v));
}

static void take_y4m(wf_video *v, const uint8_t *from) {
    for (int p = 0; p < v->info.planes; p++) from = take_plane(v, p, from);
    if (wf_video_planes(&v->options, &v->info) > 3) take_plane(v, 3, from);
}

/* A frame that is not there is missing where others tell its place; else it is the end. */
static weft_status miss_y4m(wf_video *v, bool *more, const weft_error *why, weft_error *err) {
    stream *s = v->state;
    *more = v->info.frames >= 0;
    if (*more && !s->held) return wf_fail(err, WEFT_FAILED, "%s", why->text);
    wf_video_note_trouble(v, why);
    v->troubles.cut = v->frame.missing = true;
    if (!*more) return WEFT_OK;
    v->troubles.cut = false;
    take_y4m(v, s->held);
    return go_to(v, v->frame.index + 1, err);
}

static weft_status hold_y4m(wf_video *v, weft_error *err) {
    stream *s = v->state;
    if (!s->held) s->held = malloc(s->frame_bytes);
    if (!s->held) return wf_video_no_memory(v, err);
    memcpy(s->held, s->bytes, s->frame_bytes);
    return WEFT_OK;
}

static weft_status y4m_next(wf_video *v, bool *more, weft_error *err) {
    stream *s = v->state;
    weft_error why = {""};
    weft_status status = y4m_mark(v, more, &why);
    if (!status && *more) status = read_bytes(v, &why);
    v->frame.missing = false;
    if (status && v->options.mends) return miss_y4m(v, more, &why, err);
    if (status) return wf_fail(err, status, "%s", why.text);
    if (!*more) return WEFT_OK;
    take_y4m(v, s->bytes);
    return v->options.mends ? hold_y4m(v, err) : WEFT_OK;
}

/* Frames that could be counted are all of one length. */
static weft_status y4m_seek(wf_video *v, int64_t picture, weft_error *err) {
    if (picture >= v->info.frames) return WEFT_OK;
    v->frame.index = picture - 1;
    return go_to(v, picture, err);
}

const wf_video_kind wf_video_y4m = {y4m_open, y4m_next, y4m_seek, close_stream};

/* ---- Raw frames ---- */

static void uyvy_unpack(const uint8_t *packed, int width_px, uint16_t *const code[3]) {
    for (int x = 0; x < width_px; x += 2, packed += 4) {
        code[1][x / 2] = packed[0];
        code[0][x] = packed[1];
        code[2][x / 2] = packed[2];
        code[0][x + 1] = packed[3];
    }
}

static uint32_t word_at(const uint8_t *packed) {
    return (uint32_t)packed[0] | (uint32_t)packed[1] << 8 | (uint32_t)packed[2] << 16 |
           (uint32_t)packed[3] << 24;
}

/* Four words of three codes: Cb Y Cr, Y Cb Y, Cr Y Cb, Y Cr Y. */
static void v210_unpack(const uint8_t *packed, int width_px, uint16_t *const code[3]) {
    static const uint8_t plane[12] = {1, 0, 2, 0, 1, 0, 2, 0, 1, 0, 2, 0};
    size_t at[3] = {0};
    for (int x = 0; x < width_px; x += 6)
        for (int i = 0; i < 12; i++) {
            uint32_t word = word_at(packed + (size_t)x / 6 * 16 + (size_t)i / 3 * 4);
            int p = plane[i];
            code[p][at[p]++] = (uint16_t)(word >> 10 * (i % 3) & 1023);
        }
}

static const struct {
    const char *ending;
    int bits, group_px, group_bytes; /* a line is made of whole groups */
    unpack_fn *unpack;
} raw_formats[] = {{".v210", 10, 48, 128, v210_unpack}, {".uyvy", 8, 2, 4, uyvy_unpack}};

static weft_status raw_count(wf_video *v, weft_error *err) {
    stream *s = v->state;
    struct stat about;
    if (fstat(fileno(s->file), &about)) return failed(v, err);
    v->info.frames = about.st_size / (int64_t)s->frame_bytes;
    if (about.st_size && about.st_size % (int64_t)s->frame_bytes == 0) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: %" PRId64 " bytes are not whole frames of %s, which take %zu each; raw "
                   "video does not say what it is: --raster does",
                   v->path, (int64_t)about.st_size, v->options.raster->name, s->frame_bytes);
}

static weft_status raw_open(wf_video *v, wf_video_label *label, weft_error *err) {
    const wf_raster *r = v->options.raster;
    if (!r) v->options.raster = r = wf_raster_at(0); /* as 'weft convert' presumes */
    weft_status status = open_file(v, err);
    if (status) return status;
    stream *s = v->state;
    size_t f = strcasecmp(strrchr(v->path, '.'), raw_formats[0].ending) ? 1 : 0;
    size_t group = (size_t)raw_formats[f].group_px;
    snprintf(v->info.format, sizeof v->info.format, "raw %s", raw_formats[f].ending + 1);
    v->info.width_px = r->width_px;
    v->info.lines = r->lines;
    v->info.layout = WF_YCBCR;
    v->info.bits = raw_formats[f].bits;
    v->info.across = 2;
    s->unpack = raw_formats[f].unpack;
    s->line_bytes =
        ((size_t)r->width_px + group - 1) / group * (size_t)raw_formats[f].group_bytes;
    s->frame_bytes = s->line_bytes * (size_t)r->lines;
    *label = (wf_video_label){.scan_known = true};
    status = raw_count(v, err);
    return status ? status : make_buffers(v, err);
}

static weft_status raw_next(wf_video *v, bool *more, weft_error *err) {
    stream *s = v->state;
    *more = v->frame.index < v->info.frames;
    weft_status status = *more ? read_bytes(v, err) : WEFT_OK;
    for (int y = 0; !status && *more && y < v->info.lines; y++) {
        s->unpack(s->bytes + (size_t)y * s->line_bytes, v->info.width_px, s->code);
        for (int p = 0; p < 3; p++) wf_video_take_codes(v, p, y, s->code[p]);
    }
    return status;
}

const wf_video_kind wf_video_raw = {raw_open, raw_next, NULL, close_stream};
