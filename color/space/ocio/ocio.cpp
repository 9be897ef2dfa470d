// OpenColorIO as a wf_transform. No exception gets out of here.
#include "color/space/ocio/ocio.h"
#include "color/space/ocio/walk.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
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

// ---- Colors ----

struct Color {
    float rgba[4];
};

Color passed(const OCIO::ConstCPUProcessorRcPtr &processor, float r, float g, float b) {
    Color color = {{r, g, b, 1}};
    processor->applyRGBA(color.rgba);
    return color;
}

bool is_number(const Color &color) {
    return std::isfinite(color.rgba[0]) && std::isfinite(color.rgba[1]) &&
           std::isfinite(color.rgba[2]);
}

// A matrix of NaN, or a table of it, would be black without a word.
void check_numbers(const OCIO::ConstCPUProcessorRcPtr &processor, const std::string &what) {
    const float colors[][3] = {{0.18f, 0.18f, 0.18f}, {1, 1, 1}, {0.5f, 0.3f, 0.1f}};
    for (const auto &c : colors)
        if (!is_number(passed(processor, c[0], c[1], c[2])))
            throw std::runtime_error(what + " gives no numbers for plain colors (R G B " +
                                     std::to_string(c[0]) + ' ' + std::to_string(c[1]) + ' ' +
                                     std::to_string(c[2]) + " becomes NaN or infinite)");
}

// Whether sums and multiples of what comes in are sums and multiples of what comes out, as of
// light.
bool is_linear(const OCIO::ConstCPUProcessorRcPtr &processor) {
    const float colors[][3] = {
        {0.02f, 0.3f, 0.7f}, {0.9f, 0.05f, 0.2f}, {0.18f, 0.18f, 0.18f}, {2, 4, 1}};
    const Color zero = passed(processor, 0, 0, 0);
    for (const auto &c : colors) {
        const Color whole = passed(processor, c[0], c[1], c[2]);
        Color sum = {{0, 0, 0, 0}};
        for (int k = 0; k < 3; k++) {
            const Color part = passed(processor, k == 0 ? c[0] / 4 : 0, k == 1 ? c[1] / 4 : 0,
                                      k == 2 ? c[2] / 4 : 0);
            for (int i = 0; i < 3; i++) sum.rgba[i] += 4 * part.rgba[i];
        }
        for (int i = 0; i < 3; i++)
            if (!(std::fabs(sum.rgba[i] - whole.rgba[i]) < 1e-4f) ||
                !(std::fabs(zero.rgba[i]) < 1e-6f))
                return false;
    }
    return true;
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
    Walk(config).space(query.to, false);
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
    Walk(config).view(display.c_str(), view.c_str());
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
    Walk(config).space(from.c_str(), true);
    if (given(query.look)) {
        check_looks(config, query.look);
        Walk(config).looks(query.look);
    }
    if (given(query.to) && by_view)
        throw std::runtime_error(
            "--to names one result and --display and --view another: leave one out");
    if (given(query.to)) return to_space(query, config, from);
    if (by_view) return to_view(query, config, from);
    throw std::runtime_error(
        "it does not say by itself what the video is to be; name a color space of "
        "it with --to, or a display and a view with --display and --view");
}

// ---- Lines ----

struct Transform {
    OCIO::ConstCPUProcessorRcPtr processor;
};

// So many pixels are handed over at once, on the caller's stack.
constexpr size_t block_px = 256;

struct Block {
    float rgba[block_px][4];
    unsigned char slot[block_px]; // which of rgba pixel i is
    size_t used;
};

// OpenColorIO makes all channels of a pixel black where one is NaN, and lets Inf into the
// others.
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

void scatter(const Block &block, float *const plane[3], size_t count) {
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < count; i++) {
            float value = block.rgba[block.slot[i]][c];
            plane[c][i] = std::isnan(value) ? 0 : value;
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
        scatter(block, plane, count);
    }
}

void release(void *self) {
    delete static_cast<Transform *>(self);
}

// ---- Opening ----

Config load(const char *file) {
    if (given(file)) {
        check_config_file(file);
        return OCIO::Config::CreateFromFile(file);
    }
    std::istringstream text(shipped_config);
    return OCIO::Config::CreateFromStream(text);
}

std::string name_of_result(const wf_ocio_query &query, const Config &config) {
    if (given(query.to)) return std::string("color space \"") + query.to + '"';
    const char *display = given(query.display) ? query.display : config->getDefaultDisplay();
    const char *view = given(query.view) ? query.view : config->getDefaultView(display);
    const char *space = config->getDisplayViewColorSpaceName(display, view);
    return std::string("view \"") + view + "\" of \"" + display + "\" (color space \"" +
           (given(space) ? space : "") + "\")";
}

OCIO::ConstCPUProcessorRcPtr to_light(const std::string &from, const Config &config) {
    Walk(config).space(from.c_str(), true);
    if (!config->hasRole(OCIO::ROLE_SCENE_LINEAR))
        throw std::runtime_error("it has no scene_linear role to decode \"" + from + "\" to");
    Walk(config).space(OCIO::ROLE_SCENE_LINEAR, false);
    auto processor =
        config->getProcessor(from.c_str(), OCIO::ROLE_SCENE_LINEAR)->getDefaultCPUProcessor();
    check_numbers(processor, "color space \"" + from + '"');
    return processor;
}

Transform *open(const wf_ocio_query &query) {
    const Config config = load(query.config);
    const std::string from = from_of(query, config);
    const auto processor = processor_of(query, config)->getDefaultCPUProcessor();
    if (config->hasRole(OCIO::ROLE_SCENE_LINEAR)) to_light(from, config);
    check_numbers(processor, "the " + name_of_result(query, config));
    return new Transform{processor};
}

const char *space_of_role(const Config &config, const char *role) {
    OCIO::ConstColorSpaceRcPtr space = config->getColorSpace(role);
    return space ? space->getName() : "";
}

void open_input(const char *config_file, const char *name, wf_ocio_input &out) {
    const Config config = load(config_file);
    wf_ocio_query query = {};
    query.from = name;
    const std::string from = from_of(query, config);
    const bool has_light = config->hasRole(OCIO::ROLE_SCENE_LINEAR);
    out.has_ap0 = config->hasRole(WF_OCIO_AP0);
    snprintf(out.light_space, sizeof out.light_space, "%s",
             space_of_role(config, from.c_str()));
    if (!has_light) return;
    const auto processor = to_light(from, config);
    if (is_linear(processor)) return;
    snprintf(out.light_space, sizeof out.light_space, "%s",
             space_of_role(config, OCIO::ROLE_SCENE_LINEAR));
    out.decode = wf_transform{apply, release, new Transform{processor}};
}

// What cannot be told whole ends in "..".
void explain(const char *file, const char *says, char *why, size_t why_size) {
    const char *name = given(file) ? file : "weft's own configuration";
    int length = std::snprintf(why, why_size, "%.300s: %s", name, says);
    if (length >= 0 && static_cast<size_t>(length) >= why_size && why_size > 4)
        std::memcpy(why + why_size - 4, " ..", 4);
}

// Does work, of which nothing may be thrown at C. Without memory there is no reason: where
// OpenColorIO meets that as it reads a configuration, its own exception says so in words alone.
template <typename Work> bool guarded(const char *file, char *why, size_t why_size, Work work) {
    if (why_size) *why = 0;
    try {
        work();
        return true;
    } catch (const std::bad_alloc &) {
        return false;
    } catch (const std::exception &failure) {
        if (!std::strstr(failure.what(), "bad_alloc"))
            explain(file, failure.what(), why, why_size);
    } catch (...) {
        explain(file, "OpenColorIO failed and does not say why", why, why_size);
    }
    return false;
}

} // namespace

extern "C" {
__attribute__((visibility("default"))) wf_ocio_open_fn wf_ocio_open;
__attribute__((visibility("default"))) wf_ocio_input_fn wf_ocio_input_open;
__attribute__((visibility("default"))) wf_ocio_display_fn wf_ocio_display_of;

bool wf_ocio_open(const wf_ocio_query *query, wf_transform *out, char *why, size_t why_size) {
    *out = wf_transform{nullptr, nullptr, nullptr};
    return guarded(query->config, why, why_size, [&] {
        *out = wf_transform{apply, release, open(*query)};
    });
}

bool wf_ocio_input_open(const char *config, const char *from, wf_ocio_input *out, char *why,
                        size_t why_size) {
    *out = wf_ocio_input{};
    return guarded(config, why, why_size, [&] { open_input(config, from, *out); });
}

bool wf_ocio_display_of(const char *config, const char *display, const char *view,
                        wf_ocio_shown *out, char *why, size_t why_size) {
    return guarded(config, why, why_size, [&] {
        const Config c = load(config);
        const char *shown_on = given(display) ? display : c->getDefaultDisplay();
        const char *shown = given(view) ? view : c->getDefaultView(shown_on);
        const char *space = c->getDisplayViewColorSpaceName(shown_on, shown);
        OCIO::ConstColorSpaceRcPtr found = given(space) ? c->getColorSpace(space) : nullptr;
        out->is_data = found && found->isData();
        std::snprintf(out->display, sizeof out->display, "%s", shown_on);
        std::snprintf(out->space, sizeof out->space, "%s", found ? found->getName() : "");
    });
}
}
