/* Opens EXR files: finds out and checks everything that can be known without decoding a
 * pixel. */
#include "convert/read/source_exr.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/infile.h"
#include "convert/media/exr_times.h"
#include "convert/read/choice/exr_parts.h"

const char *wf_exr_trouble(exr_result_t result) {
    return exr_get_default_error_message(result);
}

weft_status wf_is_exr(const char *path, bool *is_exr, weft_error *err) {
    static const unsigned char magic[4] = {0x76, 0x2f, 0x31, 0x01};
    unsigned char head[4] = {0};
    size_t got;
    weft_status status = wf_infile_head(path, head, sizeof head, &got, err);
    *is_exr = got == sizeof head && !memcmp(head, magic, sizeof magic);
    return status;
}

weft_status wf_exr_unread(const wf_subframe *s, int y, exr_result_t result, weft_error *err) {
    weft_status status = wf_exr_stream_trouble(&s->stream, result, s->path, err);
    return status ? status
                  : wf_fail(err, WEFT_FAILED, "%s: the chunk at line %d cannot be read: %s",
                            s->path, y - s->info.display.y0, wf_exr_trouble(result));
}

/* ---- Parts ---- */

/* The picture among all parts; its part and the name of that. */
static weft_status choose_picture(wf_subframe *s, const wf_source_options *o, int part,
                                  weft_error *err) {
    const wf_wish wish = {
        .layer = o->layer, .part = part < 0 ? o->part : NULL, .only_part = part};
    char why[900];
    wf_exr_parts parts = {0};
    if (!wf_exr_parts_find(s->exr, &parts))
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for the names of its channels",
                       s->path);
    bool chosen = wf_pick_picture(parts.part, parts.count, &wish, &s->pick, why, sizeof why);
    if (chosen) s->part = s->pick.part;
    if (chosen && parts.count > 1)
        snprintf(s->part_name, sizeof s->part_name, "%s", parts.part[s->part].name);
    wf_exr_parts_free(&parts);
    return chosen ? WEFT_OK : wf_fail(err, WEFT_FAILED, "%s: %s", s->path, why);
}

/* ---- Layout ---- */

static size_t type_bytes(exr_pixel_type_t type) {
    return type == EXR_PIXEL_HALF ? 2 : 4;
}

static uint64_t hash_bytes(uint64_t hash, const void *data, size_t count) {
    const unsigned char *byte = data;
    for (size_t i = 0; i < count; i++) hash = (hash ^ byte[i]) * 0x100000001b3;
    return hash;
}

static weft_status check_channel(const wf_subframe *s, const exr_attr_chlist_entry_t *c,
                                 weft_error *err) {
    bool chroma = s->pick.kind == WF_PICTURE_LUMINANCE_CHROMA;
    if (c->pixel_type == EXR_PIXEL_UINT)
        return wf_fail(err, WEFT_FAILED,
                       "%s: channel %s holds whole numbers; a picture is half or float",
                       s->path, c->name.str);
    if (!chroma && (c->x_sampling != 1 || c->y_sampling != 1))
        return wf_fail(err, WEFT_FAILED,
                       "%s: channel %s is subsampled %dx%d; channels of a picture are of full "
                       "size (but RY and BY)",
                       s->path, c->name.str, c->x_sampling, c->y_sampling);
    return WEFT_OK;
}

static weft_status lay_out_channels(wf_subframe *s, weft_error *err) {
    const exr_attr_chlist_t *list = wf_exr_channels(s->exr, s->part);
    const wf_pick *pick = &s->pick;
    wf_exr_layout *l = &s->layout;
    l->channels = pick->count;
    l->channel_hash = 0xcbf29ce484222325;
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *c = &list->entries[i];
        const int kind[] = {(int)c->pixel_type, c->p_linear};
        l->subsampled |= c->x_sampling != 1 || c->y_sampling != 1;
        for (int p = 0; p < pick->count; p++)
            if (pick->channel[p] == i)
                l->before[p] = l->pixel_bytes, l->type[p] = c->pixel_type;
        l->pixel_bytes += type_bytes(c->pixel_type);
        l->channel_hash = hash_bytes(l->channel_hash, c->name.str, strlen(c->name.str) + 1);
        l->channel_hash = hash_bytes(l->channel_hash, kind, sizeof kind);
    }
    weft_status status = WEFT_OK;
    for (int p = 0; !status && p < pick->count; p++)
        status = check_channel(s, &list->entries[pick->channel[p]], err);
    return status;
}

/* A compression that is newer than OpenEXRCore, by its number in the file: the library says in
 * a message what that is, and goes on as if it were ZIP, or refuses what is deep. */
static weft_status refuse_compression(const wf_subframe *s, const char *others,
                                      weft_error *err) {
    unsigned number = s->stream.unknown_compression;
    const char *name = number == 10   ? "HTJ2K256, of OpenEXR 3.4"
                       : number == 11 ? "HTJ2K32, of OpenEXR 3.4"
                       : number == 12 ? "Zstd, of OpenEXR 3.5"
                                      : "newer than those of OpenEXR 3.5";
    return wf_fail(
        err, WEFT_FAILED,
        "%s: its compression, number %u (%s), is none that weft reads; write it with %s",
        s->path, number, name, others);
}

static weft_status lay_out_chunks(wf_subframe *s, weft_error *err) {
    exr_storage_t storage;
    int lines = 0;
    wf_exr_layout *l = &s->layout;
    exr_get_storage(s->exr, s->part, &storage);
    exr_get_compression(s->exr, s->part, &l->compression);
    if (s->stream.unknown_compression) return refuse_compression(s, "ZIP, PIZ or DWAA", err);
    if (storage == EXR_STORAGE_TILED) {
        if (exr_get_tile_sizes(s->exr, s->part, 0, 0, &l->tile_width, &l->tile_height) ||
            l->tile_width < 1 || l->tile_height < 1)
            return wf_fail(err, WEFT_FAILED, "%s: its tiles have no size", s->path);
        lines = l->tile_height;
    } else if (exr_get_scanlines_per_chunk(s->exr, s->part, &lines) || lines < 1) {
        return wf_fail(err, WEFT_FAILED, "%s: the height of its chunks cannot be told",
                       s->path);
    }
    int height = l->data.y1 - l->data.y0;
    l->chunk_lines = lines < height ? lines : height;
    return WEFT_OK;
}

/* ---- Windows and sizes ---- */

/* Half-open from EXR's inclusive corners; false where it is empty or absurd. */
static bool read_window(exr_attr_box2i_t from, wf_box *to) {
    const int64_t far = 1 << 30;
    int64_t width = (int64_t)from.max.x - from.min.x + 1,
            height = (int64_t)from.max.y - from.min.y + 1;
    bool fine = width > 0 && height > 0 && width <= WF_EXR_MOST_PIXELS_A_SIDE &&
                height <= WF_EXR_MOST_PIXELS_A_SIDE && from.min.x > -far && from.min.y > -far &&
                from.max.x < far && from.max.y < far;
    if (fine) *to = (wf_box){from.min.x, from.min.y, from.max.x + 1, from.max.y + 1};
    return fine;
}

static weft_status read_windows(wf_subframe *s, weft_error *err) {
    exr_attr_box2i_t data = {0}, display = {0};
    exr_get_data_window(s->exr, s->part, &data);
    exr_get_display_window(s->exr, s->part, &display);
    if (!read_window(display, &s->info.display))
        return wf_fail(err, WEFT_FAILED,
                       "%s: its display window is empty or absurd: %d,%d to %d,%d", s->path,
                       display.min.x, display.min.y, display.max.x, display.max.y);
    if (!read_window(data, &s->info.data))
        return wf_fail(err, WEFT_FAILED,
                       "%s: its data window is empty or absurd: %d,%d to %d,%d", s->path,
                       data.min.x, data.min.y, data.max.x, data.max.y);
    s->layout.data = s->info.data;
    return WEFT_OK;
}

/* Bytes of all samples but those of subsampled channels. */
static uint64_t least_samples_bytes(const wf_subframe *s) {
    const wf_exr_layout *l = &s->layout;
    const exr_attr_chlist_t *list = wf_exr_channels(s->exr, s->part);
    uint64_t pixel_bytes = 0;
    for (int i = 0; i < list->num_channels; i++)
        if (list->entries[i].x_sampling == 1 && list->entries[i].y_sampling == 1)
            pixel_bytes += type_bytes(list->entries[i].pixel_type);
    return (uint64_t)(l->data.x1 - l->data.x0) * (uint64_t)(l->data.y1 - l->data.y0) *
           pixel_bytes;
}

/* Checks, before anything is allocated, that what the header promises fits into the file and
 * that one row of chunks fits into memory. Deflate cannot shrink bytes more than 1032 times. */
static weft_status check_sizes(const wf_subframe *s, const wf_source_options *o,
                               weft_error *err) {
    const wf_exr_layout *l = &s->layout;
    struct stat about;
    int chunks = 0;
    uint64_t width = (uint64_t)(l->data.x1 - l->data.x0),
             height = (uint64_t)(l->data.y1 - l->data.y0);
    uint64_t length = stat(s->path, &about) ? 0 : (uint64_t)about.st_size;
    exr_get_chunk_count(s->exr, s->part, &chunks);
    uint64_t least = (uint64_t)chunks * 17;
    bool deflated =
        l->compression == EXR_COMPRESSION_ZIP || l->compression == EXR_COMPRESSION_ZIPS;
    uint64_t bytes = least_samples_bytes(s);
    if (deflated && bytes / 1032 > least) least = bytes / 1032;
    if (l->compression == EXR_COMPRESSION_NONE && bytes > least) least = bytes;
    if (chunks < 1 || least > length)
        return wf_fail(err, WEFT_FAILED,
                       "%s: its header promises %" PRIu64 "x%" PRIu64
                       " pixels, for which a file of %" PRIu64
                       " bytes is too short; it may still be "
                       "being written",
                       s->path, width, height, length);
    uint64_t band = width * (uint64_t)l->chunk_lines * l->pixel_bytes;
    if (band > o->max_memory_bytes / 4)
        return wf_fail(err, WEFT_NO_MEMORY,
                       "%s: one row of its chunks is %" PRIu64
                       " MB; raise --max-memory, or write the "
                       "file with smaller tiles",
                       s->path, band >> 20);
    return WEFT_OK;
}

/* The table of chunks is written when a file is finished. Its first and its last entry show
 * whether it has been. */
static weft_status check_chunks(const wf_subframe *s, weft_error *err) {
    const wf_exr_layout *l = &s->layout;
    exr_chunk_info_t chunk;
    exr_result_t result = EXR_ERR_SUCCESS;
    int width = l->data.x1 - l->data.x0, height = l->data.y1 - l->data.y0;
    for (int end = 0; end < 2 && result == EXR_ERR_SUCCESS; end++)
        result = l->tile_width
                     ? exr_read_tile_chunk_info(
                           s->exr, s->part, end ? (width - 1) / l->tile_width : 0,
                           end ? (height - 1) / l->tile_height : 0, 0, 0, &chunk)
                     : exr_read_scanline_chunk_info(s->exr, s->part,
                                                    end ? l->data.y1 - 1 : l->data.y0, &chunk);
    if (result == EXR_ERR_SUCCESS) return WEFT_OK;
    weft_status status = wf_exr_stream_trouble(&s->stream, result, s->path, err);
    if (status) return status;
    return wf_fail(err, WEFT_FAILED,
                   "%s: its table of chunks is not complete (%s): the file may still be being "
                   "written, or its writer was stopped; wait for it or render it again",
                   s->path, wf_exr_trouble(result));
}

/* ---- Attributes ---- */

static const exr_attribute_t *attribute(const wf_subframe *s, const char *name,
                                        exr_attribute_type_t type) {
    const exr_attribute_t *found = NULL;
    if (exr_get_attribute_by_name(s->exr, s->part, name, &found) || !found) return NULL;
    return found->type == type ? found : NULL;
}

/* SMPTE 12M binary coded decimal, as OpenEXR packs it. */
static void read_timecode(wf_subframe *s) {
    const exr_attribute_t *code = attribute(s, "timeCode", EXR_ATTR_TIMECODE);
    if (!code) return;
    uint32_t t = code->timecode->time_and_flags;
    unsigned frames = (t & 15) + 10 * (t >> 4 & 3),
             seconds = (t >> 8 & 15) + 10 * (t >> 12 & 7);
    unsigned minutes = (t >> 16 & 15) + 10 * (t >> 20 & 7),
             hours = (t >> 24 & 15) + 10 * (t >> 28 & 3);
    snprintf(s->info.timecode, sizeof s->info.timecode, "%02u:%02u:%02u%c%02u", hours % 100,
             minutes % 100, seconds % 100, t & 0x40 ? ';' : ':', frames % 100);
    s->info.timecode_mark = t >> 15 & 1;
}

static void read_raster(wf_subframe *s) {
    const exr_attribute_t *text = attribute(s, "weft:raster", EXR_ATTR_STRING);
    if (text) snprintf(s->info.raster, sizeof s->info.raster, "%s", text->string->str);
}

static void read_text(const wf_subframe *s, const char *name, char *to, size_t size) {
    const exr_attribute_t *text = attribute(s, name, EXR_ATTR_STRING);
    if (text) snprintf(to, size, "%s", text->string->str);
}

/* Chromaticities are an attribute that all parts share, which some writers give the first. */
static const exr_attribute_t *chromaticities_of(const wf_subframe *s) {
    const exr_attribute_t *own = attribute(s, "chromaticities", EXR_ATTR_CHROMATICITIES);
    if (!own &&
        (exr_get_attribute_by_name(s->exr, 0, "chromaticities", &own) != EXR_ERR_SUCCESS ||
         own->type != EXR_ATTR_CHROMATICITIES))
        return NULL;
    return own;
}

static void read_colors(wf_subframe *s) {
    wf_color_said *said = &s->info.colors;
    said->floats = true;
    read_text(s, "weft:colorSpace", said->space, sizeof said->space);
    read_text(s, "colorInteropID", said->interop, sizeof said->interop);
    const exr_attribute_t *found = chromaticities_of(s);
    if (!found) return;
    const exr_attr_chromaticities_t *c = found->chromaticities;
    const float xy[8] = {c->red_x,  c->red_y,  c->green_x, c->green_y,
                         c->blue_x, c->blue_y, c->white_x, c->white_y};
    said->has_chromaticities = true;
    for (int i = 0; i < 8; i++) said->chromaticities[i] = (double)xy[i];
}

static const char *compression_name(exr_compression_t compression) {
    static const char *const name[] = {"no compression", "RLE", "ZIPS", "ZIP",  "PIZ",
                                       "PXR24",          "B44", "B44A", "DWAA", "DWAB"};
    size_t index = (size_t)compression;
    return index < sizeof name / sizeof *name ? name[index] : "unknown compression";
}

static void describe(wf_subframe *s) {
    const wf_exr_layout *l = &s->layout;
    const exr_attr_chlist_t *list = wf_exr_channels(s->exr, s->part);
    char channels[48] = "";
    size_t used = 0;
    for (int i = 0; i < list->num_channels && i < 4; i++)
        used += (size_t)snprintf(channels + used, sizeof channels - used, " %.8s",
                                 list->entries[i].name.str);
    snprintf(s->info.format, sizeof s->info.format, "OpenEXR %s, %s,%s%s %s",
             l->tile_width ? "tiled" : "scanline", compression_name(l->compression), channels,
             list->num_channels > 4 ? " .." : "",
             l->type[0] == EXR_PIXEL_HALF ? "half" : "float");
}

/* A rate is of all parts, and some writers give it to the first alone. */
static void read_times(wf_subframe *s) {
    int parts = 0;
    exr_get_count(s->exr, &parts);
    wf_exr_read_times(s->exr, s->part, &s->info);
    for (int p = 0; p < parts && !wf_ratio_given(s->info.rate) && !*s->info.no_rate; p++) {
        wf_rational time_s = s->info.time_s;
        wf_exr_read_times(s->exr, p, &s->info);
        s->info.time_s = time_s;
    }
}

static void read_attributes(wf_subframe *s) {
    float aspect = 1;
    exr_get_pixel_aspect_ratio(s->exr, s->part, &aspect);
    s->info.pixel_aspect = aspect > 1e-3f && aspect < 1e3f ? (double)aspect : 1;
    read_times(s);
    s->info.band_lines = s->layout.chunk_lines;
    read_timecode(s);
    read_raster(s);
    describe(s);
}

/* ---- Opening ---- */

static weft_status start_reading(wf_subframe *s, weft_error *err) {
    exr_result_t result = wf_exr_stream_start(&s->stream, s->path);
    s->exr = s->stream.exr;
    if (result == EXR_ERR_SUCCESS) return WEFT_OK;
    weft_status status = wf_exr_stream_trouble(&s->stream, result, s->path, err);
    if (status) return status;
    const char *said = s->stream.said;
    if (s->stream.unknown_compression) return refuse_compression(s, "ZIPS", err);
    if (strstr(said, "compression for deep"))
        return wf_fail(err, WEFT_FAILED,
                       "%s: samples of deep pictures are compressed by none, RLE or ZIPS, and "
                       "not as this file says",
                       s->path);
    return wf_fail(
        err, WEFT_FAILED,
        "%s: not a readable EXR file: %s; it may still be being written, or is damaged",
        s->path, *said ? said : wf_exr_trouble(result));
}

static weft_status read_header(wf_subframe *s, const wf_source_options *o, int part,
                               weft_error *err) {
    weft_status status = choose_picture(s, o, part, err);
    if (!status) status = read_windows(s, err);
    s->info.alpha = WF_ALPHA_PREMULTIPLIED; /* as OpenEXR has it */
    if (!status) read_colors(s);
    if (!status) status = wf_subframe_settle_colors(s, o, err);
    if (!status) wf_subframe_settle_alpha(s, o);
    if (!status) status = lay_out_channels(s, err);
    if (!status) status = lay_out_chunks(s, err);
    if (!status) status = check_sizes(s, o, err);
    if (!status) status = check_chunks(s, err);
    if (!status) read_attributes(s);
    return status;
}

weft_status wf_exr_open(wf_subframe *s, const wf_source_options *o, int part, bool *by_chunks,
                        weft_error *err) {
    weft_status status = start_reading(s, err);
    if (!status) status = read_header(s, o, part, err);
    *by_chunks = !s->layout.subsampled && s->pick.kind != WF_PICTURE_LUMINANCE_CHROMA;
    return status;
}

/* Opens a file for its headers alone, which wf_subframe_close ends; s->exr is NULL where it is
 * no EXR. */
static weft_status look_into(const char *path, wf_subframe **out, weft_error *err) {
    wf_subframe *s = *out = calloc(1, sizeof *s);
    if (!s || !(s->path = strdup(path))) {
        free(s);
        *out = NULL;
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory to open it", path);
    }
    bool is_exr;
    weft_status status = wf_is_exr(path, &is_exr, err);
    return status || !is_exr ? status : start_reading(s, err);
}

weft_status wf_source_layers(const char *path, wf_layer_fn *tell, void *user, weft_error *err) {
    wf_subframe *s;
    wf_exr_parts parts;
    weft_status status = look_into(path, &s, err);
    if (!status && s->exr && wf_exr_parts_find(s->exr, &parts)) {
        wf_each_layer(parts.part, parts.count, tell, user);
        wf_exr_parts_free(&parts);
    }
    wf_subframe_close(s);
    return status;
}

/* ---- Parts in time ---- */

typedef struct timed_part {
    wf_rational time;
    int part;
} timed_part;

static int by_time(const void *a, const void *b) {
    const timed_part *x = a, *y = b;
    __int128 left = (__int128)x->time.num * y->time.den,
             right = (__int128)y->time.num * x->time.den;
    if (left != right) return left < right ? -1 : 1;
    return (x->part > y->part) - (x->part < y->part);
}

static int find_timed(wf_subframe *s, timed_part *found, int parts) {
    int count = 0;
    for (s->part = 0; s->part < parts; s->part++) {
        wf_rational time = wf_exr_ratio(s->exr, s->part, "weft:time");
        if (wf_ratio_given(time)) found[count++] = (timed_part){time, s->part};
    }
    qsort(found, (size_t)count, sizeof *found, by_time);
    return count;
}

static weft_status hand_out(const timed_part *found, int count, int **part_of,
                            wf_rational **time_of, weft_error *err) {
    *part_of = malloc((size_t)count * sizeof **part_of);
    *time_of = malloc((size_t)count * sizeof **time_of);
    if (!*part_of || !*time_of) {
        free(*part_of);
        free(*time_of);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for a list of %d parts", count);
    }
    for (int i = 0; i < count; i++)
        (*part_of)[i] = found[i].part, (*time_of)[i] = found[i].time;
    return WEFT_OK;
}

weft_status wf_source_timed_parts(const char *path, int *count, int **part_of,
                                  wf_rational **time_of, weft_error *err) {
    wf_subframe *s;
    int parts = 0;
    *count = 0;
    weft_status status = look_into(path, &s, err);
    if (s && s->exr) exr_get_count(s->exr, &parts);
    timed_part *found = calloc((size_t)parts + 1, sizeof *found);
    if (!status && !found)
        status = wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for its parts", path);
    if (!status && parts > 1) *count = find_timed(s, found, parts);
    if (!status && *count && part_of) status = hand_out(found, *count, part_of, time_of, err);
    free(found);
    wf_subframe_close(s);
    return status;
}

weft_status wf_source_time(const char *path, int part, wf_rational *time_s, weft_error *err) {
    wf_subframe *s;
    int parts = 0;
    *time_s = (wf_rational){0, 0};
    weft_status status = look_into(path, &s, err);
    if (!s) return status;
    if (s->exr) exr_get_count(s->exr, &parts);
    for (s->part = part < 0 ? 0 : part; s->part < parts && !wf_ratio_given(*time_s);
         s->part++) {
        *time_s = wf_exr_ratio(s->exr, s->part, "weft:time");
        if (part >= 0) break;
    }
    wf_subframe_close(s);
    return status;
}
