// The OpenImageIO module: formats that weft neither reads nor writes itself.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <new>
#include <string>
#include <vector>

extern "C" {
#include "convert/formats.h"
#include "convert/oiio.h"
#include "convert/timecode.h"

WEFT_API wf_oiio_probe_fn wf_oiio_probe;
WEFT_API wf_oiio_read_fn wf_oiio_read;
WEFT_API wf_oiio_write_fn wf_oiio_write;
}

using namespace OIIO;

namespace {

// Threads are weft's own; those of OpenImageIO and OpenEXR would outlive the job.
void prepare() {
    static std::once_flag once;
    std::call_once(once, [] {
        attribute("threads", 1);
        attribute("exr_threads", -1);
    });
}

// Runs work, of which nothing may be thrown at C.
template <typename Work> weft_status guarded(const char *what, weft_error *err, Work work) {
    try {
        prepare();
        return work();
    } catch (const std::bad_alloc &) {
        return wf_fail(err, WEFT_NO_MEMORY, "%.700s: out of memory", what);
    } catch (const std::exception &e) {
        return wf_fail(err, WEFT_FAILED, "%.600s: %.300s", what, e.what());
    } catch (...) {
        return wf_fail(err, WEFT_FAILED, "%.700s: OpenImageIO failed without saying why", what);
    }
}

// What a reader or writer has to say, which some leave out.
template <typename Unit>
weft_status trouble(Unit &unit, const char *what, const char *doing, weft_error *err) {
    std::string says = unit ? unit->geterror() : OIIO::geterror();
    std::replace(says.begin(), says.end(), '\n', ' ');
    if (says.empty()) says = "OpenImageIO does not say why; the file may be damaged";
    return wf_fail(err, WEFT_FAILED, "%.600s: it cannot be %s: %.300s", what, doing,
                   says.c_str());
}

// ---- Opening ----

// A file that remembers whether more was wanted of it than it has. Readers of DPX and TIFF take
// what they do not get for read.
class File final : public Filesystem::IOFile {
  public:
    bool starved = false;
    explicit File(const char *path) : IOFile(path, Read) {}
    size_t read(void *to, size_t bytes) override {
        return note(IOFile::read(to, bytes), bytes);
    }
    size_t pread(void *to, size_t bytes, int64_t offset) override {
        return note(IOFile::pread(to, bytes, offset), bytes);
    }

  private:
    size_t note(size_t got, size_t bytes) {
        starved |= got < bytes;
        return got;
    }
};

struct Input {
    std::unique_ptr<File> file; // outlives its reader
    std::unique_ptr<ImageInput> reader;
};

weft_status open_input(const char *path, int part, Input &in, weft_error *err) {
    const char *format;
    weft_status status = wf_format_of(path, &format, err);
    if (status) return status;
    in.reader = ImageInput::create(format);
    in.file = std::make_unique<File>(path);
    if (in.reader && in.reader->supports("ioproxy")) in.reader->set_ioproxy(in.file.get());
    ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1); // samples as they are in the file
    if (!in.reader || !in.reader->open(path, spec, config))
        return trouble(in.reader, path, "opened", err);
    if (in.reader->seek_subimage(std::max(part, 0), 0)) return WEFT_OK;
    (void)in.reader->geterror();
    return wf_fail(err, WEFT_FAILED, "%.700s: it has no part %d", path, part);
}

// Pictures whose lines are stored in another order than they are seen in are turned by their
// readers.
weft_status check_picture(const char *path, const ImageSpec &spec, weft_error *err) {
    if (spec.deep)
        return wf_fail(err, WEFT_FAILED,
                       "%.700s: its pixels are deep; flatten it (oiiotool --flatten)", path);
    if (spec.depth > 1)
        return wf_fail(err, WEFT_FAILED, "%.700s: it is a volume of %d slices, not a picture",
                       path, spec.depth);
    if (spec.width < 1 || spec.height < 1 || spec.full_width < 1 || spec.full_height < 1 ||
        spec.nchannels < 1 || spec.nchannels > 1024)
        return wf_fail(err, WEFT_FAILED,
                       "%.700s: a picture of %dx%d pixels and %d channels cannot be read", path,
                       spec.width, spec.height, spec.nchannels);
    int orientation = spec.get_int_attribute("Orientation", 1);
    if (orientation > 1)
        return wf_fail(err, WEFT_FAILED,
                       "%.700s: its orientation is %d, which turns it; write it upright "
                       "(oiiotool --reorient)",
                       path, orientation);
    return WEFT_OK;
}

weft_status check_size(const char *path, const ImageSpec &spec, size_t most, weft_error *err) {
    double bytes =
        double(spec.width) * spec.height * std::min(spec.nchannels, 4) * sizeof(float);
    if (bytes <= double(most)) return WEFT_OK;
    return wf_fail(
        err, WEFT_NO_MEMORY,
        "%.700s: %dx%d pixels take %.0f MB, and --max-memory allows %zu MB; allow more", path,
        spec.width, spec.height, bytes / (1 << 20), most >> 20);
}

// ---- Facts ----

// A rate as a float: files hold 30000/1001 as 29.97.
wf_rational rate_of_float(double value) {
    if (!(value >= 1e-3 && value <= 1e6)) return {0, 0};
    const int64_t thousandths = std::llround(value * 1000), whole = std::llround(value);
    const int64_t ntsc = std::llround(value * 1.001);
    if (std::fabs(value - double(whole)) < 1e-4 * value) return {whole, 1};
    if (std::fabs(value * 1.001 - double(ntsc)) < 1e-4 * value)
        return wf_ratio(ntsc * 1000, 1001);
    return wf_ratio(thousandths, 1000);
}

wf_rational ratio_attribute(const ImageSpec &spec, const char *name) {
    const ParamValue *p = spec.find_attribute(name);
    wf_rational value = {0, 0};
    if (!p) return value;
    const TypeDesc type = p->type();
    if (type.basetype == TypeDesc::INT && type.basevalues() == 2)
        return wf_ratio(p->get<int>(0), p->get<int>(1));
    if (type == TypeDesc::STRING)
        wf_rate_parse(p->get_string().c_str(), &value);
    else
        value = rate_of_float(p->get_float(0));
    return value;
}

wf_rational first_rate(const ImageSpec &spec, std::initializer_list<const char *> names) {
    for (const char *name : names) {
        wf_rational rate = ratio_attribute(spec, name);
        if (wf_ratio_given(rate) && rate.num > 0) return rate;
    }
    return {0, 0};
}

// The BCD word of ST 12-1 (convert/timecode.h) as text; digits out of range are no timecode.
void read_timecode(const ImageSpec &spec, wf_image_info *info) {
    const ParamValue *p = spec.find_attribute("smpte:TimeCode");
    if (!p || p->type().size() < sizeof(uint32_t)) return;
    uint32_t t;
    std::memcpy(&t, p->data(), sizeof t);
    const unsigned pair[4] = {t >> 24 & 0x3f, t >> 16 & 0x7f, t >> 8 & 0x7f, t & 0x3f};
    unsigned value[4];
    for (int i = 0; i < 4; i++) {
        if ((pair[i] & 15) > 9) return;
        value[i] = 10 * (pair[i] >> 4) + (pair[i] & 15);
    }
    snprintf(info->timecode, sizeof info->timecode, "%02u:%02u:%02u%c%02u", value[0], value[1],
             value[2], t & 0x40 ? ';' : ':', value[3]);
    info->timecode_mark = t >> 15 & 1;
}

void describe(const ImageInput &in, const ImageSpec &spec, wf_image_info *info) {
    std::string channels;
    for (int c = 0; c < spec.nchannels && c < 4; c++)
        channels += " " + spec.channelnames[size_t(c)].substr(0, 8);
    if (spec.nchannels > 4) channels += " ..";
    const int bits = spec.get_int_attribute("oiio:BitsPerSample", int(8 * spec.format.size()));
    snprintf(info->format, sizeof info->format, "%s,%s %s%d", in.format_name(),
             channels.c_str(), spec.format.is_floating_point() ? "float" : "uint", bits);
}

// weft:raster where the format has room for it; else the words that weft's own writer begins
// the description with.
void read_raster(const ImageSpec &spec, wf_image_info *info) {
    const std::string words = spec.get_string_attribute("ImageDescription");
    const std::string name =
        spec.get_string_attribute("weft:raster", words.substr(0, words.find(", ")));
    snprintf(info->raster, sizeof info->raster, "%s", name.c_str());
}

void fill_info(const ImageInput &in, const ImageSpec &spec, wf_image_info *info) {
    *info = wf_image_info{};
    info->display = {spec.full_x, spec.full_y, spec.full_x + spec.full_width,
                     spec.full_y + spec.full_height};
    info->data = {spec.x, spec.y, spec.x + spec.width, spec.y + spec.height};
    const double aspect = spec.get_float_attribute("PixelAspectRatio", 1);
    info->pixel_aspect = aspect > 1e-3 && aspect < 1e3 ? aspect : 1;
    info->frames =
        first_rate(spec, {"framesPerSecond", "dpx:FrameRate", "dpx:TemporalFrameRate"});
    info->rate = first_rate(spec, {"weft:subframeRate"});
    if (!wf_ratio_given(info->rate)) info->rate = info->frames;
    info->time_s = ratio_attribute(spec, "weft:time");
    info->has_alpha = spec.alpha_channel >= 0;
    info->whole = true;
    info->band_lines = spec.height;
    read_timecode(spec, info);
    read_raster(spec, info);
    describe(in, spec, info);
}

char *join_names(const ImageSpec &spec) {
    size_t bytes = 1;
    for (const std::string &name : spec.channelnames) bytes += name.size() + 1;
    char *names = static_cast<char *>(std::calloc(bytes, 1)), *at = names;
    for (const std::string &name : spec.channelnames)
        if (names) at += name.copy(at, std::strlen(name.c_str())) + 1;
    return names;
}

// ---- Reading ----

// A multiple of the lines that any EXR compression takes together (DWAB: 256).
constexpr int SLAB_LINES = 256;

struct Reading {
    const char *path;
    int part;
    const int *channel;
    int count;
    int first, end; // the file's channels that are read, the picked ones among them
    std::vector<float> slab;
};

bool read_slab(ImageInput &in, const ImageSpec &spec, Reading &r, int y0, int y1) {
    if (spec.tile_width)
        return in.read_tiles(r.part, 0, spec.x, spec.x + spec.width, y0, y1, spec.z, spec.z + 1,
                             r.first, r.end, TypeDesc::FLOAT, r.slab.data());
    return in.read_scanlines(r.part, 0, y0, y1, spec.z, r.first, r.end, TypeDesc::FLOAT,
                             r.slab.data());
}

void spread_slab(const ImageSpec &spec, const Reading &r, int y0, int y1, float *planes) {
    const size_t width = size_t(spec.width), step = size_t(r.end - r.first);
    const size_t samples = width * size_t(y1 - y0), before = width * size_t(y0 - spec.y);
    for (int c = 0; c < r.count; c++) {
        const float *from = r.slab.data() + (r.channel[c] - r.first);
        float *to = planes + size_t(c) * width * size_t(spec.height) + before;
        for (size_t i = 0; i < samples; i++) to[i] = from[i * step];
    }
}

weft_status read_picture(Input &in, const ImageSpec &spec, Reading &r, float *planes,
                         weft_error *err) {
    const int tile = std::max(spec.tile_height, 1), bottom = spec.y + spec.height;
    const int lines = std::min((SLAB_LINES + tile - 1) / tile * tile, spec.height);
    r.slab.resize(size_t(lines) * size_t(spec.width) * size_t(r.end - r.first));
    for (int y = spec.y; y < bottom; y += lines) {
        const int end = std::min(y + lines, bottom);
        if (!read_slab(*in.reader, spec, r, y, end)) {
            char doing[64];
            snprintf(doing, sizeof doing, "read at lines %d to %d", y - spec.full_y,
                     end - 1 - spec.full_y);
            return trouble(in.reader, r.path, doing, err);
        }
        spread_slab(spec, r, y, end, planes);
    }
    if (!in.file->starved) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%.700s: the file ends before its picture does; write it again", r.path);
}

bool same_window(const ImageSpec &spec, const wf_box &data) {
    return spec.x == data.x0 && spec.y == data.y0 && spec.width == data.x1 - data.x0 &&
           spec.height == data.y1 - data.y0;
}

weft_status read_checked(Input &in, Reading &r, const wf_box &data, float *planes,
                         weft_error *err) {
    const ImageSpec spec = in.reader->spec();
    const auto range = std::minmax_element(r.channel, r.channel + r.count);
    r.first = *range.first;
    r.end = *range.second + 1;
    weft_status status = check_picture(r.path, spec, err);
    if (status) return status;
    if (!same_window(spec, data) || r.first < 0 || r.end > spec.nchannels)
        return wf_fail(err, WEFT_FAILED,
                       "%.700s: it is no longer what it was when it was opened; write it "
                       "before it is read",
                       r.path);
    return read_picture(in, spec, r, planes, err);
}

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
                {"lin_p3d65", {.68f, .32f, .265f, .69f, .15f, .06f, .3127f, .329f}},
                {"ACEScg", {.713f, .293f, .165f, .83f, .128f, .044f, .32168f, .33767f}},
                {"ACES2065-1", {.7347f, .2653f, 0, 1, .0001f, -.077f, .32168f, .33767f}}};
    for (const auto &row : rows)
        if (!space.compare(0, std::strlen(row.space), row.space))
            spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), row.xy);
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
    ImageSpec spec(p.width_px, p.lines, 3, type);
    spec.attribute("Software", "weft " WEFT_VERSION);
    spec.attribute("DateTime", ""); // or the writer's clock: equal frames are to be equal files
    spec.attribute("Orientation", 1);
    spec.attribute("PixelAspectRatio", float(wf_ratio_value(p.pixel_aspect)));
    const std::string order = order_name(p); // DPX has room for 31 characters
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
    std::vector<typename Kind::type> line(3 * size_t(p.width_px));
    for (int y = 0; y < p.lines; y++) {
        for (size_t c = 0; c < 3; c++) {
            const From *from =
                static_cast<const From *>(p.plane[c]) + size_t(y) * p.line_stride[c];
            for (size_t x = 0; x < size_t(p.width_px); x++)
                line[3 * x + c] = Kind::convert(from[x], p.bits);
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

extern "C" weft_status wf_oiio_probe(const char *path, int part, size_t max_memory_bytes,
                                     wf_image_info *info, int *channel_count, char **names,
                                     weft_error *err) {
    *names = nullptr;
    return guarded(path, err, [&] {
        Input in;
        weft_status status = open_input(path, part, in, err);
        if (status) return status;
        const ImageSpec spec = in.reader->spec();
        status = check_picture(path, spec, err);
        if (!status) status = check_size(path, spec, max_memory_bytes, err);
        if (status) return status;
        fill_info(*in.reader, spec, info);
        *channel_count = spec.nchannels;
        *names = join_names(spec);
        return *names ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "%.700s: out of memory", path);
    });
}

extern "C" weft_status wf_oiio_read(const char *path, int part, const int *channel, int count,
                                    const wf_box *data, float *planes, weft_error *err) {
    return guarded(path, err, [&] {
        Input in;
        Reading reading = {path, std::max(part, 0), channel, count, 0, 0, {}};
        weft_status status = open_input(path, part, in, err);
        return status ? status : read_checked(in, reading, *data, planes, err);
    });
}

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
