// The writing half of the OpenImageIO module: DPX and TIFF.
#include <OpenImageIO/filesystem.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "convert/media/oiio/oiio_guard.hpp"

extern "C" {
#include "convert/media/oiio/oiio.h"

WEFT_API wf_encode_picture_fn wf_oiio_dpx, wf_oiio_tiff;
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

// ST 268 has two elements for fields. Where both are woven into one picture, the field number
// here is that of the field which owns the top line: 1 is top first, 2 bottom first. A lone
// field has its own number.
void describe_dpx(const wf_picture_out &p, ImageSpec &spec) {
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
    uint32_t words[2] = {0, 0};                    // and no user bits
    if (wf_picture_time(&p, words)) spec.attribute("smpte:TimeCode", TypeTimeCode, words);
}

// It has no pixel aspect but the ratio of two densities, which is cut off to whole numbers;
// 6600 = 600 x 11 keeps the elevenths of 525 and 625 lines exact.
void describe_density(const wf_picture_out &p, ImageSpec &spec) {
    spec.attribute("XResolution", 6600.0f);
    spec.attribute("YResolution", float(std::round(6600 * wf_ratio_value(p.pixel_aspect))));
    spec.attribute("ResolutionUnit", "none");
}

void describe_tiff(const wf_picture_out &p, ImageSpec &spec) {
    spec.attribute("compression", "zip");
    const std::string words = spec.get_string_attribute("ImageDescription");
    if (*p.color_space) spec.attribute("ImageDescription", words + ", " + p.color_space);
    describe_density(p, spec);
}

// ---- What OpenImageIO cannot write ----

using Bytes = std::vector<unsigned char>;

void put_big(Bytes &bytes, size_t at, uint32_t word) {
    for (int i = 0; i < 4; i++) bytes[at + size_t(i)] = uint8_t(word >> (24 - 8 * i));
}

// OpenImageIO 2.4 rounds the pixel aspect to millionths and writes 1/2 as 1/0.
void finish_dpx(const wf_picture_out &p, Bytes &bytes) {
    constexpr size_t aspect = 1628;
    if (bytes.size() < aspect + 8 || p.pixel_aspect.num > UINT32_MAX ||
        p.pixel_aspect.den > UINT32_MAX)
        return;
    put_big(bytes, aspect, uint32_t(p.pixel_aspect.num));
    put_big(bytes, aspect + 4, uint32_t(p.pixel_aspect.den));
}

struct Format {
    const char *name; // as OpenImageIO has it
    void (*describe)(const wf_picture_out &p, ImageSpec &spec);
    void (*finish)(const wf_picture_out &p, Bytes &bytes); // NULL: there is nothing to do
};
const Format dpx = {"dpx", describe_dpx, finish_dpx}, tiff = {"tiff", describe_tiff, nullptr};

ImageSpec spec_of(const Format &format, const wf_picture_out &p) {
    const TypeDesc type = p.bits == 8 ? TypeDesc::UINT8 : TypeDesc::UINT16;
    ImageSpec spec(p.width_px, p.lines, p.channels, type);
    char words[WF_PICTURE_WORDS_SIZE];
    if (p.channels == 4 && p.straight) spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("Software", WF_PICTURE_SOFTWARE);
    spec.attribute("DateTime", ""); // or the writer's clock: equal frames are to be equal files
    spec.attribute("Orientation", 1);
    spec.attribute("PixelAspectRatio", float(wf_ratio_value(p.pixel_aspect)));
    spec.attribute("ImageDescription", wf_picture_words(&p, words));
    format.describe(p, spec);
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
template <typename Kind> bool write_lines(ImageOutput &out, const wf_picture_out &p) {
    const size_t channels = size_t(p.channels);
    std::vector<typename Kind::type> line(channels * size_t(p.width_px));
    for (int y = 0; y < p.lines; y++) {
        for (size_t c = 0; c < channels; c++) {
            const uint16_t *from =
                static_cast<const uint16_t *>(p.plane[c]) + size_t(y) * p.line_stride[c];
            for (size_t x = 0; x < size_t(p.width_px); x++)
                line[channels * x + c] = Kind::convert(from[x], p.bits);
        }
        if (!out.write_scanline(y, 0, out.spec().format, line.data())) return false;
    }
    return true;
}

bool write_picture(ImageOutput &out, const wf_picture_out &p) {
    return p.bits == 8 ? write_lines<Codes8>(out, p) : write_lines<Codes16>(out, p);
}

weft_status encode(const Format &format, const wf_picture_out &p, Memory &memory,
                   weft_error *err) {
    std::unique_ptr<ImageOutput> out = ImageOutput::create(format.name);
    if (!out) return trouble(out, format.name, "written", err);
    if (!out->supports("ioproxy") || !out->set_ioproxy(&memory))
        return wf_fail(err, WEFT_FAILED,
                       "%s: this OpenImageIO writes it to files only; it needs 2.4",
                       format.name);
    bool done = out->open("", spec_of(format, p)) && write_picture(*out, p);
    done &= out->close();
    if (memory.failed)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for the encoded picture",
                       format.name);
    if (!done || memory.buffer().empty()) return trouble(out, format.name, "written", err);
    return WEFT_OK;
}

weft_status write_file(const Format &format, const wf_picture_out &p, wf_bytes_fn *write,
                       void *user, weft_error *err) {
    return guarded(format.name, err, [&] {
        Memory memory;
        weft_status status = encode(format, p, memory, err);
        if (status) return status;
        Bytes bytes = memory.buffer();
        if (format.finish) format.finish(p, bytes);
        return write(user, bytes.data(), bytes.size(), err);
    });
}

} // namespace

extern "C" weft_status wf_oiio_dpx(const wf_picture_out *picture, wf_bytes_fn *write,
                                   void *user, weft_error *err) {
    return write_file(dpx, *picture, write, user, err);
}

extern "C" weft_status wf_oiio_tiff(const wf_picture_out *picture, wf_bytes_fn *write,
                                    void *user, weft_error *err) {
    return write_file(tiff, *picture, write, user, err);
}
