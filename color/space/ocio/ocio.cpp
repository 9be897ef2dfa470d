// OpenColorIO as a wf_transform. No exception gets out of here.
#include "color/space/ocio/ocio.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>
#include <strings.h>

#include <OpenColorIO/OpenColorIO.h>

namespace OCIO = OCIO_NAMESPACE;

namespace {

// color/weft.ocio as the build found it, so that the module depends on no file.
const char shipped_config[] =
#include "color/weft_ocio.inc"
    ;

using Config = OCIO::ConstConfigRcPtr;

bool given(const char *text) {
    return text && *text;
}

// ---- Names ----

// "a, b, c", to tell what there is.
class Names {
  public:
    void add(const char *name) {
        if (!text_.empty()) text_ += ", ";
        text_ += name;
    }
    std::string text() const { return text_.empty() ? "none" : text_; }

  private:
    std::string text_;
};

[[noreturn]] void refuse(const std::string &what, const std::string &name, const Names &there) {
    throw std::runtime_error("there is no " + what + " \"" + name + "\"; there are " +
                             there.text());
}

void check_space(const Config &config, const char *name) {
    if (config->getColorSpace(name) || config->getNamedTransform(name)) return;
    Names there;
    for (int i = 0; i < config->getNumColorSpaces(); i++)
        there.add(config->getColorSpaceNameByIndex(i));
    refuse("color space", name, there);
}

void check_display(const Config &config, const char *display) {
    if (config->getNumViews(display) > 0) return;
    Names there;
    for (int i = 0; i < config->getNumDisplays(); i++) there.add(config->getDisplay(i));
    refuse("display", display, there);
}

void check_view(const Config &config, const char *display, const char *view) {
    Names there;
    for (int i = 0; i < config->getNumViews(display); i++) {
        const char *name = config->getView(display, i);
        if (!strcasecmp(name, view)) return;
        there.add(name);
    }
    refuse("view of " + std::string(display), view, there);
}

// A look can be a list such as "+this, -that | other".
void check_looks(const Config &config, const std::string &looks) {
    Names there;
    for (int i = 0; i < config->getNumLooks(); i++) there.add(config->getLookNameByIndex(i));
    for (size_t start = 0, end; start < looks.size(); start = end + 1) {
        end = looks.find_first_of(",:|", start);
        if (end == std::string::npos) end = looks.size();
        size_t first = looks.find_first_not_of(" +-", start),
               last = looks.find_last_not_of(' ', end - 1);
        if (first >= end) continue;
        std::string name = looks.substr(first, last + 1 - first);
        if (!config->getLook(name.c_str())) refuse("look", name, there);
    }
}

// ---- Processors ----

std::string from_of(const wf_ocio_query &query, const Config &config) {
    if (given(query.from)) {
        check_space(config, query.from);
        return query.from;
    }
    if (config->hasRole(OCIO::ROLE_SCENE_LINEAR)) return OCIO::ROLE_SCENE_LINEAR;
    throw std::runtime_error("it has no scene_linear role; say with --from what the input is");
}

OCIO::ConstProcessorRcPtr to_space(const wf_ocio_query &query, const Config &config,
                                   const std::string &from) {
    check_space(config, query.to);
    if (!given(query.look)) return config->getProcessor(from.c_str(), query.to);
    auto look = OCIO::LookTransform::Create();
    look->setSrc(from.c_str());
    look->setDst(query.to);
    look->setLooks(query.look);
    return config->getProcessor(look);
}

OCIO::ConstProcessorRcPtr to_view(const wf_ocio_query &query, const Config &config,
                                  const std::string &from) {
    const std::string display =
        given(query.display) ? query.display : config->getDefaultDisplay();
    check_display(config, display.c_str());
    const std::string view =
        given(query.view) ? query.view : config->getDefaultView(display.c_str());
    check_view(config, display.c_str(), view.c_str());
    auto transform = OCIO::DisplayViewTransform::Create();
    transform->setSrc(from.c_str());
    transform->setDisplay(display.c_str());
    transform->setView(view.c_str());
    auto pipeline = OCIO::LegacyViewingPipeline::Create();
    pipeline->setDisplayViewTransform(transform);
    if (given(query.look)) {
        pipeline->setLooksOverrideEnabled(true);
        pipeline->setLooksOverride(query.look);
    }
    return pipeline->getProcessor(config);
}

OCIO::ConstProcessorRcPtr processor_of(const wf_ocio_query &query, const Config &config) {
    const std::string from = from_of(query, config);
    bool by_view = given(query.display) || given(query.view);
    if (given(query.look)) check_looks(config, query.look);
    if (given(query.to) && by_view)
        throw std::runtime_error(
            "--to names one result and --display and --view another: leave one out");
    if (given(query.to)) return to_space(query, config, from);
    if (by_view) return to_view(query, config, from);
    throw std::runtime_error(
        "it does not say by itself what the video is to be; name a color space of "
        "it with --to, or a display and a view with --display and --view");
}

// Light may be negative; R'G'B' may not.
bool is_light(const wf_ocio_query &query, const Config &config) {
    OCIO::ConstColorSpaceRcPtr space =
        given(query.to) ? config->getColorSpace(query.to) : nullptr;
    if (!space) return false;
    const std::string encoding = space->getEncoding();
    return space->isData() || encoding == "scene-linear" || encoding == "display-linear";
}

// ---- Lines ----

struct Transform {
    OCIO::ConstCPUProcessorRcPtr processor;
    float least; // of what comes out
};

// So many pixels are handed over at once, on the caller's stack.
constexpr size_t block_px = 256;

struct Block {
    float rgba[block_px][4];
    unsigned char slot[block_px]; // which of rgba pixel i is
    size_t used;
};

// OpenColorIO makes all channels of a pixel black where one is NaN, and lets Inf into the others.
float finite(float x) {
    if (std::isnan(x)) return 0;
    return std::isinf(x) ? std::copysign(65504.0f, x) : x;
}

// A pixel that equals the one before it is converted with it: renders are flat in places, and
// the comparison takes 3 ns, a conversion from 25 (matrix and curve) to 130 (ACES).
void gather(Block &block, const float *r, const float *g, const float *b, size_t count) {
    block.used = 0;
    for (size_t i = 0; i < count; i++) {
        const float pixel[4] = {finite(r[i]), finite(g[i]), finite(b[i]), 1};
        if (!block.used || std::memcmp(block.rgba[block.used - 1], pixel, sizeof pixel) != 0)
            std::memcpy(block.rgba[block.used++], pixel, sizeof pixel);
        block.slot[i] = static_cast<unsigned char>(block.used - 1);
    }
}

void scatter(const Block &block, float least, float *const plane[3], size_t count) {
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < count; i++) {
            float value = block.rgba[block.slot[i]][c];
            if (std::isnan(value)) value = 0;
            plane[c][i] = value > least ? value : least;
        }
}

// The processor does not throw on buffers such as these; should it, black is better than what
// came in.
void convert(const Transform &t, Block &block) noexcept {
    try {
        OCIO::PackedImageDesc image(block.rgba, static_cast<long>(block.used), 1, 4);
        t.processor->apply(image);
    } catch (...) {
        std::memset(block.rgba, 0, sizeof block.rgba);
    }
}

void apply(const void *self, float *r, float *g, float *b, size_t width_px) {
    const Transform &t = *static_cast<const Transform *>(self);
    Block block;
    for (size_t start = 0; start < width_px; start += block_px) {
        size_t count = width_px - start < block_px ? width_px - start : block_px;
        float *const plane[3] = {r + start, g + start, b + start};
        gather(block, plane[0], plane[1], plane[2], count);
        convert(t, block);
        scatter(block, t.least, plane, count);
    }
}

void release(void *self) {
    delete static_cast<Transform *>(self);
}

// ---- Opening ----

Config load(const wf_ocio_query &query) {
    if (given(query.config)) return OCIO::Config::CreateFromFile(query.config);
    std::istringstream text(shipped_config);
    return OCIO::Config::CreateFromStream(text);
}

Transform *open(const wf_ocio_query &query) {
    const Config config = load(query);
    const auto processor = processor_of(query, config)->getDefaultCPUProcessor();
    return new Transform{processor, is_light(query, config) ? -HUGE_VALF : 0.0f};
}

// What cannot be told whole ends in "..".
void explain(const wf_ocio_query &query, const char *says, char *why, size_t why_size) {
    const char *name = given(query.config) ? query.config : "weft's own configuration";
    int length = std::snprintf(why, why_size, "%.300s: %s", name, says);
    if (length >= 0 && static_cast<size_t>(length) >= why_size && why_size > 4)
        std::memcpy(why + why_size - 4, " ..", 4);
}

} // namespace

extern "C" {
__attribute__((visibility("default"))) wf_ocio_open_fn wf_ocio_open;

bool wf_ocio_open(const wf_ocio_query *query, wf_transform *out, char *why, size_t why_size) {
    *out = wf_transform{nullptr, nullptr, nullptr};
    try {
        *out = wf_transform{apply, release, open(*query)};
        return true;
    } catch (const std::exception &failure) {
        explain(*query, failure.what(), why, why_size);
    } catch (...) {
        explain(*query, "OpenColorIO failed and does not say why", why, why_size);
    }
    return false;
}
}
