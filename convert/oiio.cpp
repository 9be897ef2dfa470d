// The OpenImageIO module (convert/oiio.h): formats that weft does not read or write itself.
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/sysutil.h>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

extern "C" {
#include "convert/oiio.h"
}

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

#define ENTRY extern "C" __attribute__((visibility("default"))) weft_status

// Runs f; what it throws becomes an error that names the file.
template <class F> static weft_status guarded(const char *path, weft_error *err, F f) {
    try {
        return f();
    } catch (const std::bad_alloc &) {
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for the picture", path);
    } catch (const std::exception &e) {
        return wf_fail(err, WEFT_FAILED, "%s: %s", path, e.what());
    } catch (...) {
        return wf_fail(err, WEFT_FAILED, "%s: OpenImageIO gave up", path);
    }
}

// OpenImageIO's message on one line.
static std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    for (char &c : text)
        if (c == '\n') c = ' ';
    return text.empty() ? "OpenImageIO does not say why" : text;
}

// Threads are the caller's; the library is to start none of its own.
static void settle() {
    static const bool once =
        OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);
    (void)once;
}

// ---- Reading
// --------------------------------------------------------------------------------------

static std::unique_ptr<ImageInput> open_input(const char *path, int part, weft_status *status,
                                              weft_error *err) {
    settle();
    std::unique_ptr<ImageInput> in = ImageInput::open(path);
    if (!in) {
        *status = wf_fail(err, WEFT_FAILED, "%s: not a picture that can be read: %s", path,
                          one_line(OIIO::geterror()).c_str());
    } else if (part > 0 && !in->seek_subimage(part, 0)) {
        *status = wf_fail(err, WEFT_FAILED, "%s: there is no picture %d in it", path, part);
        in.reset();
    }
    return in;
}

static wf_box box_of(int x, int y, int width, int height) {
    return wf_box{x, y, x + width, y + height};
}

static wf_rational ratio_of(const ImageSpec &spec, const char *name) {
    const OIIO::ParamValue *value = spec.find_attribute(name);
    wf_rational ratio = {0, 0};
    if (!value) return ratio;
    if (value->type() == OIIO::TypeRational) {
        const int *pair = static_cast<const int *>(value->data());
        return wf_ratio(pair[0], pair[1]);
    }
    if (!wf_rate_parse(value->get_string().c_str(), &ratio)) return wf_rational{0, 0};
    return ratio;
}

static wf_rational first_given(const ImageSpec &spec,
                               std::initializer_list<const char *> names) {
    for (const char *name : names) {
        wf_rational ratio = ratio_of(spec, name);
        if (wf_ratio_given(ratio) && ratio.num > 0) return ratio;
    }
    return wf_rational{0, 0};
}

static void describe(const ImageInput &in, const ImageSpec &spec, wf_image_info *info) {
    *info = wf_image_info{};
    info->display = box_of(spec.full_x, spec.full_y, spec.full_width, spec.full_height);
    info->data = box_of(spec.x, spec.y, spec.width, spec.height);
    info->pixel_aspect = spec.get_float_attribute("PixelAspectRatio", 1.0f);
    info->rate = first_given(spec, {"weft:subframeRate", "FramesPerSecond", "dpx:FrameRate"});
    info->time_s = ratio_of(spec, "weft:time");
    info->whole = true;
    std::string channels;
    for (size_t c = 0; c < spec.channelnames.size() && c < 4; c++)
        channels += " " + spec.channelnames[c];
    std::snprintf(info->format, sizeof info->format, "%s,%s %s", in.format_name(),
                  channels.c_str(), spec.format.c_str());
    std::string timecode = spec.get_string_attribute("smpte:TimeCode");
    if (timecode.size() < sizeof info->timecode)
        std::memcpy(info->timecode, timecode.c_str(), timecode.size() + 1);
}

static weft_status check(const char *path, const ImageSpec &spec, size_t max_memory_bytes,
                         weft_error *err) {
    if (spec.deep)
        return wf_fail(err, WEFT_FAILED, "%s: a deep picture; weft reads flat ones here", path);
    if (spec.depth > 1 || spec.full_depth > 1)
        return wf_fail(err, WEFT_FAILED, "%s: a volume, not a picture", path);
    if (spec.width < 1 || spec.height < 1 || spec.full_width < 1 || spec.full_height < 1 ||
        spec.nchannels < 1)
        return wf_fail(err, WEFT_FAILED, "%s: it has no pixels", path);
    double bytes = double(spec.width) * spec.height * spec.nchannels * sizeof(float);
    if (bytes > double(max_memory_bytes) / 2)
        return wf_fail(err, WEFT_NO_MEMORY,
                       "%s: its %dx%d pixels take %.0f MB; raise --max-memory", path,
                       spec.width, spec.height, bytes / 1048576);
    return WEFT_OK;
}

static weft_status hand_names(const char *path, const ImageSpec &spec, int *count, char **names,
                              weft_error *err) {
    std::string all;
    for (const std::string &name : spec.channelnames)
        all += name.c_str() + std::string(1, '\0');
    *count = int(spec.channelnames.size());
    *names = static_cast<char *>(std::malloc(all.size() + 1));
    if (!*names) return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for channel names", path);
    std::memcpy(*names, all.data(), all.size());
    return WEFT_OK;
}

ENTRY wf_oiio_probe(const char *path, int part, size_t max_memory_bytes, wf_image_info *info,
                    int *channel_count, char **names, weft_error *err) {
    return guarded(path, err, [&] {
        weft_status status = WEFT_OK;
        auto in = open_input(path, part, &status, err);
        if (!in) return status;
        const ImageSpec spec = in->spec();
        describe(*in, spec, info);
        status = check(path, spec, max_memory_bytes, err);
        return status ? status : hand_names(path, spec, channel_count, names, err);
    });
}

// Which run of channels holds all those wanted.
static void channel_range(const int *channel, int count, int *first, int *end) {
    *first = *end = channel[0];
    for (int c = 0; c < count; c++) {
        if (channel[c] < *first) *first = channel[c];
        if (channel[c] >= *end) *end = channel[c] + 1;
    }
}

static void unravel(const std::vector<float> &pixels, int stride, const int *channel, int count,
                    int first, float *planes) {
    const size_t samples = pixels.size() / size_t(stride);
    for (int c = 0; c < count; c++)
        for (size_t i = 0; i < samples; i++)
            planes[size_t(c) * samples + i] =
                pixels[i * size_t(stride) + size_t(channel[c] - first)];
}

ENTRY wf_oiio_read(const char *path, int part, const int *channel, int count,
                   const wf_box *data, float *planes, weft_error *err) {
    return guarded(path, err, [&] {
        weft_status status = WEFT_OK;
        auto in = open_input(path, part, &status, err);
        if (!in) return status;
        const ImageSpec spec = in->spec();
        const wf_box box = box_of(spec.x, spec.y, spec.width, spec.height);
        int first, end;
        channel_range(channel, count, &first, &end);
        if (std::memcmp(&box, data, sizeof box) || end > spec.nchannels)
            return wf_fail(err, WEFT_FAILED, "%s: it changed while it was read", path);
        std::vector<float> pixels(size_t(spec.width) * size_t(spec.height) *
                                  size_t(end - first));
        if (!in->read_image(in->current_subimage(), 0, first, end, TypeDesc::FLOAT,
                            pixels.data()))
            return wf_fail(err, WEFT_FAILED, "%s: it is damaged or cut short: %s", path,
                           one_line(in->geterror()).c_str());
        unravel(pixels, end - first, channel, count, first, planes);
        return WEFT_OK;
    });
}

// ---- Writing
// --------------------------------------------------------------------------------------

// A file in memory under a name that every writer of OpenImageIO can open, seek and rewrite.
class memory_file {
  public:
    memory_file() : descriptor(memfd_create("weft-picture", MFD_CLOEXEC)) {}
    memory_file(const memory_file &) = delete;
    ~memory_file() {
        if (descriptor >= 0) close(descriptor);
    }
    std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor); }
    const int descriptor;
};

static weft_status hand_bytes(const memory_file &file, wf_oiio_bytes_fn *write, void *user,
                              weft_error *err) {
    struct stat about;
    if (fstat(file.descriptor, &about) || about.st_size <= 0)
        return wf_fail(err, WEFT_FAILED, "OpenImageIO encoded an empty picture");
    const size_t size = size_t(about.st_size);
    void *bytes = mmap(nullptr, size, PROT_READ, MAP_SHARED, file.descriptor, 0);
    if (bytes == MAP_FAILED)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory to read an encoded picture");
    weft_status status = write(user, bytes, size, err);
    munmap(bytes, size);
    return status;
}

// What DPX calls the transfer and the primaries of a space.
static const char *dpx_space(const std::string &space) {
    static const struct {
        const char *start, *name;
    } spaces[] = {{"rec601-525", "ITU-R 601-5 system M"},
                  {"rec601-625", "ITU-R 601-5 system B or G"},
                  {"rec709", "ITU-R 709-4"}};
    for (const auto &known : spaces)
        if (!space.compare(0, std::strlen(known.start), known.start)) return known.name;
    return "User defined";
}

static void tell_dpx(const wf_oiio_picture &p, ImageSpec &spec) {
    const float rate = float(wf_ratio_value(p.frame_rate));
    spec.attribute("oiio:BitsPerSample", p.bits);
    spec.attribute("dpx:Interlace", p.interlaced ? 1 : 0);
    spec.attribute("dpx:FieldNumber", p.interlaced ? 1 : 0); // a frame begins with field 1
    spec.attribute("dpx:FrameRate", rate);
    spec.attribute("dpx:TemporalFrameRate", rate);
    spec.attribute("dpx:Transfer", dpx_space(p.color_space));
    spec.attribute("dpx:Colorimetric", dpx_space(p.color_space));
    if (*p.timecode) spec.attribute("dpx:TimeCode", p.timecode);
}

static int digits(const char *text) {
    return (text[0] - '0') << 4 | (text[1] - '0');
}

static void tell_timecode(const char *text, ImageSpec &spec) {
    if (std::strlen(text) != 11) return;
    const unsigned drop = text[8] == ';' ? 0x40 : 0;
    const unsigned word[2] = {unsigned(digits(text)) << 24 | unsigned(digits(text + 3)) << 16 |
                                  unsigned(digits(text + 6)) << 8 | unsigned(digits(text + 9)) |
                                  drop,
                              0};
    spec.attribute("smpte:TimeCode", OIIO::TypeTimeCode, word);
}

// PNG and TIFF have no pixel aspect but the ratio of two densities, which OpenImageIO rounds to
// whole numbers; 6600 = 600 x 11 keeps the elevenths of 525 and 625 lines exact.
static void tell_density(const wf_oiio_picture &p, ImageSpec &spec) {
    spec.attribute("XResolution", 6600.0f);
    spec.attribute("YResolution", float(std::round(6600 * p.pixel_aspect)));
    spec.attribute("ResolutionUnit", "none");
}

static ImageSpec describe_output(const wf_oiio_picture &p) {
    const TypeDesc type = p.bits == 32 ? TypeDesc::FLOAT
                          : p.bits > 8 ? TypeDesc::UINT16
                                       : TypeDesc::UINT8;
    ImageSpec spec(p.width_px, p.lines, 3, type);
    const int rate[2] = {int(p.frame_rate.num), int(p.frame_rate.den)};
    spec.attribute("PixelAspectRatio", float(p.pixel_aspect));
    spec.attribute("FramesPerSecond", OIIO::TypeRational, rate);
    spec.attribute("Software", "weft " WEFT_VERSION);
    if (!std::strcmp(p.format, "png") || !std::strcmp(p.format, "tiff")) tell_density(p, spec);
    if (*p.raster) spec.attribute("weft:raster", p.raster);
    if (!std::strcmp(p.format, "openexr")) {
        spec.attribute("compression", "zip");
        tell_timecode(p.timecode, spec);
    }
    if (!std::strcmp(p.format, "tiff")) spec.attribute("compression", "zip");
    if (!std::strcmp(p.format, "dpx")) tell_dpx(p, spec);
    return spec;
}

// Codes of fewer bits than their type has are spread over it by repeating their top bits, which
// the writer drops again.
static void ravel(const wf_oiio_picture &p, int y, int spread, uint16_t *to) {
    for (int c = 0; c < 3; c++) {
        const uint16_t *from =
            static_cast<const uint16_t *>(p.plane[c]) + size_t(y) * p.line_stride[c];
        for (int x = 0; x < p.width_px; x++)
            to[3 * x + c] =
                uint16_t(from[x] << spread | (spread ? from[x] >> (16 - 2 * spread) : 0));
    }
}

static void ravel(const wf_oiio_picture &p, int y, float *to) {
    for (int c = 0; c < 3; c++) {
        const float *from =
            static_cast<const float *>(p.plane[c]) + size_t(y) * p.line_stride[c];
        for (int x = 0; x < p.width_px; x++) to[3 * x + c] = from[x];
    }
}

// Lines y0 <= y < y1, in the type the file has.
static bool write_lines(const wf_oiio_picture &p, int y0, int y1, ImageOutput &out) {
    const size_t line = 3 * size_t(p.width_px), count = line * size_t(y1 - y0);
    if (p.bits == 32) {
        std::vector<float> pixels(count);
        for (int y = y0; y < y1; y++) ravel(p, y, &pixels[size_t(y - y0) * line]);
        return out.write_scanlines(y0, y1, 0, TypeDesc::FLOAT, pixels.data());
    }
    std::vector<uint16_t> pixels(count);
    const int spread = p.bits > 8 ? 16 - p.bits : 0;
    for (int y = y0; y < y1; y++) ravel(p, y, spread, &pixels[size_t(y - y0) * line]);
    if (p.bits > 8) return out.write_scanlines(y0, y1, 0, TypeDesc::UINT16, pixels.data());
    const std::vector<uint8_t> bytes(pixels.begin(), pixels.end());
    return out.write_scanlines(y0, y1, 0, TypeDesc::UINT8, bytes.data());
}

// In blocks, so that the picture is not in memory twice.
static bool write_pixels(const wf_oiio_picture &p, ImageOutput &out) {
    const int block = 64;
    bool fine = true;
    for (int y = 0; fine && y < p.lines; y += block)
        fine = write_lines(p, y, y + block < p.lines ? y + block : p.lines, out);
    return fine;
}

ENTRY wf_oiio_write(const wf_oiio_picture *picture, wf_oiio_bytes_fn *write, void *user,
                    weft_error *err) {
    return guarded(picture->format, err, [&] {
        settle();
        const memory_file file;
        auto out = ImageOutput::create(picture->format);
        if (!out)
            return wf_fail(err, WEFT_FAILED, "this OpenImageIO writes no %s", picture->format);
        const ImageSpec spec = describe_output(*picture);
        const bool fine = file.descriptor >= 0 && out->open(file.name(), spec) &&
                          write_pixels(*picture, *out);
        if (!fine || !out->close())
            return wf_fail(err, WEFT_FAILED, "a %s picture cannot be encoded: %s",
                           picture->format, one_line(out->geterror()).c_str());
        return hand_bytes(file, write, user, err);
    });
}
