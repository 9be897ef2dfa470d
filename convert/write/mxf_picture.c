/* Describes uncompressed pictures in MXF: labels and items, as data. */
#include "convert/job/colors.h"
#include "convert/media/klv.h"
#include "convert/write/mxf_parts.h"

#define COUNT(rows) (sizeof(rows) / sizeof *(rows))

/* ---- Essence containers ---- */

#define UNCOMPRESSED(form) WF_UL_LABEL(1, 0x0d01030102050000 | (form))

/* ST 384's label of pictures whose lines and rate the descriptor says. */
static const wf_ul any_raster = UNCOMPRESSED(0x7f01);

/* Rasters that have a label of their own in ST 384, frame wrapped. Those of 525 and 625
 * lines are recognized by their line maps, the others by their size. */
static const struct {
    int width_px, lines, total_lines;
    wf_scan scan;
    int64_t rate_num, rate_den;
    wf_ul label;
} containers[] = {
    {720, 0, 525, WF_INTERLACED, 30000, 1001, UNCOMPRESSED(0x0101)},
    {720, 0, 625, WF_INTERLACED, 25, 1, UNCOMPRESSED(0x0105)},
    {1920, 1080, 0, WF_PROGRESSIVE, 25, 1, UNCOMPRESSED(0x0221)},
    {1920, 1080, 0, WF_INTERLACED, 25, 1, UNCOMPRESSED(0x0229)},
    {1920, 1080, 0, WF_PROGRESSIVE, 30000, 1001, UNCOMPRESSED(0x0231)},
    {1920, 1080, 0, WF_INTERLACED, 30000, 1001, UNCOMPRESSED(0x0239)},
    {1920, 1080, 0, WF_PROGRESSIVE, 30, 1, UNCOMPRESSED(0x0241)},
    {1920, 1080, 0, WF_INTERLACED, 30, 1, UNCOMPRESSED(0x0249)},
    {1920, 1080, 0, WF_PROGRESSIVE, 50, 1, UNCOMPRESSED(0x0251)},
    {1920, 1080, 0, WF_PROGRESSIVE, 60000, 1001, UNCOMPRESSED(0x0259)},
    {1920, 1080, 0, WF_PROGRESSIVE, 60, 1, UNCOMPRESSED(0x0261)},
    {1280, 720, 0, WF_PROGRESSIVE, 25, 1, UNCOMPRESSED(0x0309)},
    {1280, 720, 0, WF_PROGRESSIVE, 30000, 1001, UNCOMPRESSED(0x0311)},
    {1280, 720, 0, WF_PROGRESSIVE, 30, 1, UNCOMPRESSED(0x0315)},
    {1280, 720, 0, WF_PROGRESSIVE, 50, 1, UNCOMPRESSED(0x0319)},
    {1280, 720, 0, WF_PROGRESSIVE, 60000, 1001, UNCOMPRESSED(0x0321)},
    {1280, 720, 0, WF_PROGRESSIVE, 60, 1, UNCOMPRESSED(0x0325)},
};

static wf_ul picture_container(const wf_raster *r) {
    for (size_t i = 0; i < COUNT(containers); i++)
        if (containers[i].width_px == r->width_px && containers[i].scan == r->scan &&
            (!containers[i].lines || containers[i].lines == r->lines) &&
            (!containers[i].total_lines || containers[i].total_lines == r->total_lines) &&
            containers[i].rate_num == r->frame_rate.num &&
            containers[i].rate_den == r->frame_rate.den)
            return containers[i].label;
    return any_raster;
}

int wf_mxf_containers(const wf_mxf_options *o, wf_ul out[WF_MXF_CONTAINERS]) {
    out[0] = picture_container(o->raster);
    if (!o->sound.tracks) return 1;
    out[1] = (wf_ul)WF_UL_LABEL(1, 0x0d01030102060100); /* Broadcast Wave, frame wrapped */
    out[2] = (wf_ul)WF_UL_LABEL(3, 0x0d010301027f0100); /* several mappings */
    return 3;
}

/* ---- Colors ---- */

typedef struct tag_label {
    int tag; /* code point of Rec. ITU-T H.273 */
    wf_ul label;
} tag_label;

static const tag_label primaries[] = {{6, WF_UL_LABEL(6, 0x0401010103010000)},
                                      {5, WF_UL_LABEL(6, 0x0401010103020000)},
                                      {1, WF_UL_LABEL(6, 0x0401010103030000)},
                                      {9, WF_UL_LABEL(13, 0x0401010103040000)},
                                      {0}};
static const tag_label transfers[] = {{1, WF_UL_LABEL(1, 0x0401010101020000)},
                                      {14, WF_UL_LABEL(14, 0x0401010101090000)},
                                      {16, WF_UL_LABEL(13, 0x04010101010a0000)},
                                      {18, WF_UL_LABEL(13, 0x04010101010b0000)},
                                      {0}};
static const tag_label equations[] = {{6, WF_UL_LABEL(1, 0x0401010102010000)},
                                      {1, WF_UL_LABEL(1, 0x0401010102020000)},
                                      {9, WF_UL_LABEL(13, 0x0401010102060000)},
                                      {0}};

static void put_label(wf_bytes *b, uint16_t item, const tag_label *rows, int tag) {
    for (; rows->tag; rows++)
        if (rows->tag == tag) wf_item_ul(b, item, rows->label);
}

static void put_colors(wf_bytes *b, const wf_mxf_options *o) {
    wf_color_tags tags = wf_color_tags_of(o->color_space, o->raster->matrix);
    put_label(b, 0x3219, primaries, tags.primaries);
    put_label(b, 0x3210, transfers, tags.transfer);
    put_label(b, 0x321a, equations, tags.matrix);
}

static void put_levels(wf_bytes *b, const wf_mxf_options *o) {
    uint64_t one = (uint64_t)1 << (o->bits - 8), codes = (uint64_t)1 << o->bits;
    wf_item_number(b, 0x3304, 4, o->full_range ? 0 : 16 * one);
    wf_item_number(b, 0x3305, 4, o->full_range ? codes - 1 : 235 * one);
    wf_item_number(b, 0x3306, 4, o->full_range ? codes : 224 * one + 1);
}

/* ---- Geometry ---- */

/* The 720 samples of 525 and 625 lines are wider than the 4:3 or 16:9 picture; files state
 * the aspect ratio of that picture. */
static wf_rational aspect_of(const wf_raster *r) {
    wf_rational exact = wf_ratio_mul(wf_ratio(r->width_px, r->lines), r->pixel_aspect);
    bool sd = r->width_px == 720 && (r->total_lines == 525 || r->total_lines == 625);
    if (!sd) return exact;
    return wf_ratio_value(exact) > 1.5 ? wf_ratio(16, 9) : wf_ratio(4, 3);
}

/* First lines of fields 1 and 2. Readers tell the order by whether their sum is odd, so
 * rasters without a line map get one, with an even number of lines in a field as all systems
 * have. */
static void line_map(const wf_raster *r, int out[2]) {
    int field_lines = (r->lines / 2 + 2) / 2 * 2;
    out[0] = r->line1;
    out[1] = r->line2;
    if (r->scan != WF_INTERLACED) {
        out[0] = r->lines == 1080 ? 42 : r->lines == 720 ? 26 : 1;
        out[1] = 0;
    } else if (!r->total_lines) {
        out[0] = 1;
        out[1] = 1 + field_lines + r->top_first;
    }
}

/* The number of the raster's standard in ST 377-1: ITU-R BT.601, SMPTE ST 274, SMPTE ST 296;
 * 0: another. */
static unsigned signal_standard(const wf_raster *r) {
    if (r->total_lines == 525 || r->total_lines == 625) return 1;
    if (r->width_px == 1920 && r->lines == 1080) return 4;
    return r->width_px == 1280 && r->lines == 720 ? 5 : 0;
}

/* Woven fields are "mixed fields", with the heights of the picture, as ST 377-1 has it and
 * bmx's readers ask for it; ffmpeg and MediaInfo take the heights as they are. "Separate
 * fields", which ffmpeg writes for woven ones, have the heights of a field, and bmx does not
 * know such files as uncompressed. Segmented frames are stored whole and labeled progressive,
 * since "segmented frame" is shown as interlaced. */
static wf_mxf_layout frame_layout(const wf_raster *r) {
    return r->scan == WF_INTERLACED ? WF_MXF_MIXED_FIELDS : WF_MXF_FULL_FRAME;
}

static void put_geometry(wf_bytes *b, const wf_raster *r) {
    static const uint16_t heights[] = {0x3202, 0x3204, 0x3208},
                          widths[] = {0x3203, 0x3205, 0x3209},
                          offsets[] = {0x3206, 0x3207, 0x320a, 0x320b};
    int map[2];
    wf_mxf_layout layout = frame_layout(r);
    line_map(r, map);
    for (size_t i = 0; i < COUNT(heights); i++) {
        wf_item_number(b, heights[i], 4, (uint64_t)r->lines);
        wf_item_number(b, widths[i], 4, (uint64_t)r->width_px);
    }
    for (size_t i = 0; i < COUNT(offsets); i++) wf_item_number(b, offsets[i], 4, 0);
    wf_item_rational(b, 0x320e, aspect_of(r));
    wf_item_array(b, 0x320d, 2, 4);
    for (int i = 0; i < 2; i++) wf_bytes_number(b, 4, (uint64_t)map[i]);
    wf_item_number(b, 0x320c, 1, layout);
    if (layout == WF_MXF_MIXED_FIELDS)
        wf_item_number(b, 0x3212, 1, 1); /* field 1, whichever it is, comes first */
}

void wf_mxf_describe_picture(wf_bytes *b, const wf_mxf_options *o) {
    static const wf_ul uyvy = WF_UL_LABEL(10, 0x0401020101020101),
                       v210 = WF_UL_LABEL(10, 0x0401020101020201);
    unsigned standard = signal_standard(o->raster);
    wf_item_ul(b, 0x3201, o->bits == 8 ? uyvy : v210);
    if (standard) wf_item_number(b, 0x3215, 1, standard);
    put_geometry(b, o->raster);
    put_colors(b, o);
    wf_item_number(b, 0x3301, 4, (uint64_t)o->bits);
    wf_item_number(b, 0x3302, 4, 2);
    wf_item_number(b, 0x3308, 4, 1);
    wf_item_number(b, 0x3303, 1, 0); /* chroma sits on the first luma sample of a pair */
    put_levels(b, o);
}
