// The writing half of the OpenImageIO module.
#include <OpenImageIO/filesystem.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "convert/media/oiio/oiio_guard.hpp"

extern "C" {
#include "convert/job/timecode.h"
#include "convert/media/oiio/oiio.h"

WEFT_API wf_oiio_write_fn wf_oiio_write;
}

using namespace OIIO;
using namespace oiio_guard;

namespace {

// ---- Writing ----

// Memory that a writer seeks in. Writers that overlook failures are found out by it.
class Memory final : public Filesystem::IOVecOutput {
  public:
    bool failed = false;
    size_t write(const void *data, size_t bytes) override {
        try {
            const size_t written = IOVecOutput::write(data, bytes);
            failed |= written != bytes;
            return written;
        } catch (...) { // not through the C of libpng and libtiff
            failed = true;
            return 0;
        }
    }
};

// The labels that ST 268-1 has for how codes are to be understood, by weft's names of color
// spaces; Rec. 2020 and 2100 are younger and have none.
const char *dpx_characteristic(const std::string &space) {
    static const struct {
        const char *space, *label;
    } labels[] = {{"rec601-525", "ITU-R 601-5 system M"},
                  {"rec601-625", "ITU-R 601-5 system B or G"},
                  {"rec709", "ITU-R 709-4"},
                  {"lin_", "Linear"}};
    for (const auto &row : labels)
        if (!space.compare(0, std::strlen(row.space), row.space)) return row.label;
    return "User defined";
}

// CIE x and y of red, green, blue and white, which EXR takes for Rec. 709's where nothing is
// said.
void describe_primaries(const std::string &space, ImageSpec &spec) {
    static const struct {
        const char *space; // how its name begins
        float xy[8];
    } rows[] = {{"rec601-525", {.63f, .34f, .31f, .595f, .155f, .07f, .3127f, .329f}},
                {"rec601-625", {.64f, .33f, .29f, .6f, .15f, .06f, .3127f, .329f}},
                {"rec709", {.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f}},
                {"lin_rec709", {.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f}},
                {"rec2", {.708f, .292f, .17f, .797f, .131f, .046f, .3127f, .329f}},
                {"lin_rec2020", {.708f, .292f, .17f, .797f, .131f, .046f, .3127f, .329f}},
                {"lin_rec601-525", {.63f, .34f, .31f, .595f, .155f, .07f, .3127f, .329f}},
                {"lin_rec601-625", {.64f, .33f, .29f, .6f, .15f, .06f, .3127f, .329f}},
                {"lin_p3d65", {.68f, .32f, .265f, .69f, .15f, .06f, .3127f, .329f}},
                {"ACEScg", {.713f, .293f, .165f, .83f, .128f, .044f, .32168f, .33767f}},
                {"ACES2065-1", {.7347f, .2653f, 0, 1, .0001f, -.077f, .32168f, .33767f}}};
    for (const auto &row : rows)
        if (!space.compare(0, std::strlen(row.space), row.space))
            spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), row.xy);
}

void describe_light(const double *chromaticities, ImageSpec &spec) {
    float xy[8];
    for (int i = 0; i < 8; i++) xy[i] = float(chromaticities[i]);
    spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), xy);
}

const char *order_name(const wf_oiio_picture &p) {
    if (p.field == 1) return p.top_lines ? "top field 1" : "bottom field 1";
    if (p.field == 2) return p.top_lines ? "top field 2" : "bottom field 2";
    return !p.interlaced ? "progressive" : p.top_first ? "top first" : "bottom first";
}

// Both fields of a frame have its label, told apart by the field mark: just what ST 12-1 does
// with pairs of progressive frames.
void describe_time(const wf_oiio_picture &p, ImageSpec &spec) {
    wf_timecode label;
    if (!wf_parse_timecode(p.timecode, &label)) return;
    if (p.field) label.frames = 2 * label.frames + p.field - 1;
    const unsigned words[2] = {wf_timecode_bcd(&label, p.frame_rate), 0}; // and no user bits
    spec.attribute("smpte:TimeCode", TypeTimeCode, words);
}

// Ratios that EXR's rationals cannot hold are left out.
void add_ratio(ImageSpec &spec, const char *name, wf_rational r) {
    const int parts[2] = {int(r.num), int(r.den)};
    if (r.den > 0 && r.num <= INT32_MAX && r.den <= INT32_MAX)
        spec.attribute(name, TypeRational, parts);
}

void describe_exr(const wf_oiio_picture &p, ImageSpec &spec) {
    spec.attribute("compression", "zip");
    add_ratio(spec, "framesPerSecond", p.frame_rate);
    add_ratio(spec, "weft:subframeRate", p.subframe_rate);
    add_ratio(spec, "weft:time", p.time_s);
    if (*p.raster) spec.attribute("weft:raster", p.raster);
    if (*p.color_space) spec.attribute("weft:colorSpace", p.color_space);
    if (p.chromaticities[7] != 0)
        describe_light(p.chromaticities, spec);
    else
        describe_primaries(p.color_space, spec);
    if (p.field) spec.attribute("weft:field", p.field);
    describe_time(p, spec);
}

// ST 268 has two elements for fields. Where both are woven into one picture, the field number
// here is that of the field which owns the top line: 1 is top first, 2 bottom first. A lone
// field has its own number.
void describe_dpx(const wf_oiio_picture &p, ImageSpec &spec) {
    const float rate = float(wf_ratio_value(p.frame_rate));
    const char *label = dpx_characteristic(p.color_space);
    spec.attribute("oiio:BitsPerSample", p.bits);
    spec.attribute("oiio:Endian", "big");
    spec.attribute("dpx:FrameRate", rate);
    spec.attribute("dpx:TemporalFrameRate", rate);
    spec.attribute("dpx:Interlace", int(p.interlaced));
    spec.attribute("dpx:FieldNumber", p.field ? p.field : p.interlaced && !p.top_first ? 2 : 1);
    spec.attribute("dpx:Transfer", label);
    spec.attribute("dpx:Colorimetric", label);
    spec.attribute("DocumentName", p.color_space); // the project's name, for want of a better
    describe_time(p, spec);
}

// Neither has a pixel aspect but the ratio of two densities, which is cut off to whole numbers;
// 6600 = 600 x 11 keeps the elevenths of 525 and 625 lines exact.
void describe_density(const wf_oiio_picture &p, ImageSpec &spec) {
    spec.attribute("XResolution", 6600.0f);
    spec.attribute("YResolution", float(std::round(6600 * wf_ratio_value(p.pixel_aspect))));
    spec.attribute("ResolutionUnit", "none");
}

void describe_tiff(const wf_oiio_picture &p, ImageSpec &spec) {
    spec.attribute("compression", "zip");
    const std::string words = spec.get_string_attribute("ImageDescription");
    if (*p.color_space) spec.attribute("ImageDescription", words + ", " + p.color_space);
    describe_density(p, spec);
}

void describe_png(const wf_oiio_picture &p, ImageSpec &spec) {
    spec.attribute("png:compressionLevel", 4);
    spec.attribute("weft:raster", p.raster);
    if (*p.color_space) spec.attribute("weft:colorSpace", p.color_space);
    spec.attribute("weft:timecode", p.timecode);
    if (p.field) spec.attribute("weft:field", std::to_string(p.field));
    describe_density(p, spec);
}

// ---- What OpenImageIO cannot write ----

using Bytes = std::vector<unsigned char>;

void put_big(Bytes &bytes, size_t at, uint32_t word) {
    for (int i = 0; i < 4; i++) bytes[at + size_t(i)] = uint8_t(word >> (24 - 8 * i));
}

// OpenImageIO 2.4 rounds the pixel aspect to millionths and writes 1/2 as 1/0.
void finish_dpx(const wf_oiio_picture &p, Bytes &bytes) {
    constexpr size_t aspect = 1628;
    if (bytes.size() < aspect + 8 || p.pixel_aspect.num > UINT32_MAX ||
        p.pixel_aspect.den > UINT32_MAX)
        return;
    put_big(bytes, aspect, uint32_t(p.pixel_aspect.num));
    put_big(bytes, aspect + 4, uint32_t(p.pixel_aspect.den));
}

uint32_t png_checksum(const unsigned char *data, size_t bytes) {
    uint32_t sum = ~0u;
    for (size_t i = 0; i < bytes; i++) {
        sum ^= data[i];
        for (int bit = 0; bit < 8; bit++) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0);
    }
    return ~sum;
}

// cICP of PNG's third edition: primaries and transfer, no matrix, and whether codes are of full
// range. It comes before the picture, here first of all after IHDR.
void finish_png(const wf_oiio_picture &p, Bytes &bytes) {
    constexpr size_t after_header = 33;
    if (!p.transfer || bytes.size() < after_header) return;
    Bytes chunk = {0,
                   0,
                   0,
                   4,
                   'c',
                   'I',
                   'C',
                   'P',
                   uint8_t(p.primaries),
                   uint8_t(p.transfer),
                   0,
                   uint8_t(p.full_range),
                   0,
                   0,
                   0,
                   0};
    put_big(chunk, 12, png_checksum(&chunk[4], 8));
    bytes.insert(bytes.begin() + after_header, chunk.begin(), chunk.end());
}

const struct {
    const char *format;
    void (*describe)(const wf_oiio_picture &p, ImageSpec &spec);
    void (*finish)(const wf_oiio_picture &p, Bytes &bytes);
} writers[] = {{"openexr", describe_exr, nullptr},
               {"dpx", describe_dpx, finish_dpx},
               {"tiff", describe_tiff, nullptr},
               {"png", describe_png, finish_png}};

ImageSpec spec_of(const wf_oiio_picture &p) {
    const TypeDesc type = p.bits == 32  ? TypeDesc::FLOAT
                          : p.bits == 8 ? TypeDesc::UINT8
                                        : TypeDesc::UINT16;
    ImageSpec spec(p.width_px, p.lines, p.channels, type);
    if (p.channels == 4 && p.straight) spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("Software", "weft " WEFT_VERSION);
    spec.attribute("DateTime", ""); // or the writer's clock: equal frames are to be equal files
    spec.attribute("Orientation", 1);
    spec.attribute("PixelAspectRatio", float(wf_ratio_value(p.pixel_aspect)));
    const std::string order = order_name(p); // DPX holds 31 characters
    spec.attribute("ImageDescription",
                   std::string(p.raster).substr(0, 29 - order.size()) + ", " + order);
    for (const auto &row : writers)
        if (!std::strcmp(row.format, p.format)) row.describe(p, spec);
    return spec;
}

// OpenImageIO takes 10 and 12 bits as 16 of the same meaning, and drops the lower ones.
struct Codes8 {
    using type = uint8_t;
    static uint8_t convert(uint16_t code, int) { return uint8_t(code); }
};
struct Codes16 {
    using type = uint16_t;
    static uint16_t convert(uint16_t code, int bits) {
        return uint16_t(code << (16 - bits) | (bits < 16 ? code >> (2 * bits - 16) : 0));
    }
};
struct Floats {
    using type = float;
    static float convert(float sample, int) { return sample; }
};

template <typename From, typename Kind>
bool write_lines(ImageOutput &out, const wf_oiio_picture &p) {
    const size_t channels = size_t(p.channels);
    std::vector<typename Kind::type> line(channels * size_t(p.width_px));
    for (int y = 0; y < p.lines; y++) {
        for (size_t c = 0; c < channels; c++) {
            const From *from =
                static_cast<const From *>(p.plane[c]) + size_t(y) * p.line_stride[c];
            for (size_t x = 0; x < size_t(p.width_px); x++)
                line[channels * x + c] = Kind::convert(from[x], p.bits);
        }
        if (!out.write_scanline(y, 0, out.spec().format, line.data())) return false;
    }
    return true;
}

bool write_picture(ImageOutput &out, const wf_oiio_picture &p) {
    if (p.bits == 32) return write_lines<float, Floats>(out, p);
    if (p.bits == 8) return write_lines<uint16_t, Codes8>(out, p);
    return write_lines<uint16_t, Codes16>(out, p);
}

weft_status encode(const wf_oiio_picture &p, Memory &memory, weft_error *err) {
    std::unique_ptr<ImageOutput> out = ImageOutput::create(p.format);
    if (!out) return trouble(out, p.format, "written", err);
    if (!out->supports("ioproxy") || !out->set_ioproxy(&memory))
        return wf_fail(err, WEFT_FAILED,
                       "%s: this OpenImageIO writes it to files only; it needs 2.4", p.format);
    bool done = out->open("", spec_of(p)) && write_picture(*out, p);
    done &= out->close();
    if (memory.failed)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for the encoded picture", p.format);
    if (!done || memory.buffer().empty()) return trouble(out, p.format, "written", err);
    return WEFT_OK;
}

} // namespace

extern "C" weft_status wf_oiio_write(const wf_oiio_picture *picture, wf_oiio_bytes_fn *write,
                                     void *user, weft_error *err) {
    return guarded(picture->format, err, [&] {
        Memory memory;
        weft_status status = encode(*picture, memory, err);
        if (status) return status;
        Bytes bytes = memory.buffer();
        for (const auto &row : writers)
            if (row.finish && !std::strcmp(row.format, picture->format))
                row.finish(*picture, bytes);
        return write(user, bytes.data(), bytes.size(), err);
    });
}
