// The OpenImageIO module: formats that weft neither reads nor writes itself. The reading half.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "convert/media/oiio/oiio_guard.hpp"

extern "C" {
#include "convert/job/timecode.h"
#include "convert/media/formats.h"
#include "convert/media/oiio/oiio.h"

WEFT_API wf_oiio_probe_fn wf_oiio_probe;
WEFT_API wf_oiio_read_fn wf_oiio_read;
}

using namespace OIIO;
using namespace oiio_guard;

namespace {

// ---- Opening ----

// A file that remembers whether more was wanted of it than it has. Readers of DPX and TIFF take
// what they do not get for read.
class File final : public Filesystem::IOFile {
  public:
    bool starved = false;
    int trouble; // errno of what the system refused; 0: nothing
    explicit File(const char *path) : IOFile(path, Read), trouble(mode() == Read ? 0 : errno) {}
    size_t read(void *to, size_t bytes) override {
        return note(IOFile::read(to, bytes), bytes);
    }
    size_t pread(void *to, size_t bytes, int64_t offset) override {
        return note(IOFile::pread(to, bytes, offset), bytes);
    }

  private:
    size_t note(size_t got, size_t bytes) {
        starved |= got < bytes;
        if (got < bytes && std::ferror(handle())) trouble = EIO;
        return got;
    }
};

struct Input {
    std::unique_ptr<File> file; // outlives its reader
    std::unique_ptr<ImageInput> reader;
};

// Why the system did not give what was wanted of the file.
weft_status unread(const char *path, const Input &in, weft_error *err) {
    return wf_fail(err, WEFT_FAILED, "%.700s: %s", path, std::strerror(in.file->trouble));
}

weft_status open_input(const char *path, int part, Input &in, weft_error *err) {
    const char *format;
    weft_status status = wf_format_of(path, &format, err);
    if (status) return status;
    in.file = std::make_unique<File>(path);
    if (in.file->trouble) return unread(path, in, err);
    in.reader = ImageInput::create(format);
    if (in.reader && in.reader->supports("ioproxy")) in.reader->set_ioproxy(in.file.get());
    ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1); // samples as they are in the file
    const bool opened = in.reader && in.reader->open(path, spec, config);
    if (in.file->trouble) return unread(path, in, err);
    if (!opened) return trouble(in.reader, path, "opened", err);
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

// The BCD word of ST 12-1 (convert/job/timecode.h) as text; digits out of range are no
// timecode.
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

// weft:raster where the format has a place for it; else the words that weft's own writer begins
// the description with.
void read_raster(const ImageSpec &spec, wf_image_info *info) {
    const std::string words = spec.get_string_attribute("ImageDescription");
    const std::string name =
        spec.get_string_attribute("weft:raster", words.substr(0, words.find(", ")));
    snprintf(info->raster, sizeof info->raster, "%s", name.c_str());
}

// PNG (ISO 15948), DPX, TGA and WebP are straight, EXR is premultiplied; TIFF says which by
// ExtraSamples, of which its reader keeps a mark.
void read_alpha(const ImageInput &in, const ImageSpec &spec, wf_image_info *info) {
    const std::string format = in.format_name();
    info->has_alpha = spec.alpha_channel >= 0;
    info->alpha_by_file = format == "tiff";
    if (!info->has_alpha) return;
    const bool premultiplied =
        format == "openexr" ||
        (format == "tiff" && !spec.get_int_attribute("oiio:UnassociatedAlpha", 0));
    info->alpha = premultiplied ? WF_ALPHA_PREMULTIPLIED : WF_ALPHA_STRAIGHT;
}

// Whether a profile calls itself sRGB, in letters of one byte or of two.
bool is_srgb(const char *data, size_t bytes) {
    const char narrow[] = {'s', 'R', 'G', 'B'}, wide[] = {'s', 0, 'R', 0, 'G', 0, 'B'};
    return std::search(data, data + bytes, narrow, narrow + sizeof narrow) != data + bytes ||
           std::search(data, data + bytes, wide, wide + sizeof wide) != data + bytes;
}

// A DPX has a field for its transfer; weft writes the space's name into its project besides.
void read_colors(const ImageInput &in, const ImageSpec &spec, wf_color_said *said) {
    said->floats = spec.format.is_floating_point();
    const bool dpx = !std::strcmp(in.format_name(), "dpx");
    const std::string space =
        spec.get_string_attribute(dpx ? "DocumentName" : "weft:colorSpace");
    if (dpx || said->floats) snprintf(said->space, sizeof said->space, "%s", space.c_str());
    const ParamValue *profile = spec.find_attribute("ICCProfile");
    if (!profile || is_srgb(static_cast<const char *>(profile->data()), profile->type().size()))
        return;
    const std::string name = spec.get_string_attribute("ICCProfile:profile_description");
    snprintf(said->profile, sizeof said->profile, "%s", name.empty() ? "ICC" : name.c_str());
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
    info->counts_files = wf_ratio_given(info->rate);
    if (!info->counts_files) info->rate = info->frames;
    info->time_s = ratio_attribute(spec, "weft:time");
    read_alpha(in, spec, info);
    read_colors(in, spec, &info->colors);
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
    int alpha;      // the file's channel by which its reader has multiplied; -1: none
    std::vector<float> slab;
};

bool read_slab(ImageInput &in, const ImageSpec &spec, Reading &r, int y0, int y1) {
    if (spec.tile_width)
        return in.read_tiles(r.part, 0, spec.x, spec.x + spec.width, y0, y1, spec.z, spec.z + 1,
                             r.first, r.end, TypeDesc::FLOAT, r.slab.data());
    return in.read_scanlines(r.part, 0, y0, y1, spec.z, r.first, r.end, TypeDesc::FLOAT,
                             r.slab.data());
}

// OpenImageIO 2.4 multiplies WebP's straight codes by alpha, whatever it is asked for; a reader
// that leaves them says so by an attribute.
int multiplied_by(const ImageInput &in, const ImageSpec &spec) {
    const bool left = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
    return std::strcmp(in.format_name(), "webp") || left ? -1 : spec.alpha_channel;
}

void divide_slab(Reading &r, size_t samples) {
    const size_t step = size_t(r.end - r.first), a = size_t(r.alpha - r.first);
    float *pixel = r.slab.data();
    for (size_t i = 0; i < samples; i++, pixel += step)
        for (size_t c = 0; c < step; c++)
            if (c != a && pixel[a] > 0) pixel[c] = std::min(pixel[c] / pixel[a], 1.0f);
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
        const bool read = read_slab(*in.reader, spec, r, y, end);
        if (in.file->trouble) return unread(r.path, in, err);
        if (!read) {
            char doing[64];
            snprintf(doing, sizeof doing, "read at lines %d to %d", y - spec.full_y,
                     end - 1 - spec.full_y);
            return trouble(in.reader, r.path, doing, err);
        }
        if (r.alpha >= r.first) divide_slab(r, size_t(spec.width) * size_t(end - y));
        spread_slab(spec, r, y, end, planes);
    }
    if (!in.file->starved) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "%.700s: the file ends before its picture does: it may still be being written; "
        "wait for it or write it again",
        r.path);
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
    r.alpha = multiplied_by(*in.reader, spec);
    if (r.alpha >= 0) r.first = std::min(r.first, r.alpha);
    r.end = std::max(*range.second, r.alpha) + 1;
    weft_status status = check_picture(r.path, spec, err);
    if (status) return status;
    if (!same_window(spec, data) || r.first < 0 || r.end > spec.nchannels)
        return wf_fail(err, WEFT_FAILED,
                       "%.700s: it is no longer what it was when it was opened; write it "
                       "before it is read",
                       r.path);
    return read_picture(in, spec, r, planes, err);
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
        Reading reading = {path, std::max(part, 0), channel, count, 0, 0, -1, {}};
        weft_status status = open_input(path, part, in, err);
        return status ? status : read_checked(in, reading, *data, planes, err);
    });
}
