// What a conversion of OpenColorIO is made of.
#include "color/space/ocio/walk.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace {

constexpr size_t deepest = 100;
constexpr double most_steps = 10000;

bool given(const char *text) {
    return text && *text;
}

} // namespace

void Walk::space(const char *name, bool out) {
    OCIO::ConstColorSpaceRcPtr space = config_->getColorSpace(name);
    if (!space) return named(name);
    if (!enter(std::string("color space \"") + space->getName() + '"', out)) return;
    const auto to = OCIO::COLORSPACE_DIR_TO_REFERENCE,
               from = OCIO::COLORSPACE_DIR_FROM_REFERENCE;
    OCIO::ConstTransformRcPtr own = space->getTransform(out ? to : from);
    if (own)
        transform(own, false);
    else
        transform(space->getTransform(out ? from : to), true);
    if (space->getReferenceSpaceType() == OCIO::REFERENCE_SPACE_DISPLAY)
        view_transform(config_->getDefaultViewTransformName());
    leave();
}

void Walk::looks(const std::string &list) {
    for (size_t start = 0, end; start < list.size(); start = end + 1) {
        end = std::min(list.find_first_of(",:|", start), list.size());
        size_t first = list.find_first_not_of(" +-", start),
               last = list.find_last_not_of(' ', end - 1);
        if (first < end) look(list.substr(first, last + 1 - first));
    }
}

void Walk::view(const char *display, const char *name) {
    const char *space = config_->getDisplayViewColorSpaceName(display, name);
    if (space && !std::strcmp(space, "<USE_DISPLAY_NAME>")) space = display;
    if (given(space)) this->space(space, false);
    view_transform(config_->getDisplayViewTransformName(display, name));
    const char *list = config_->getDisplayViewLooks(display, name);
    if (given(list)) looks(list);
}

bool Walk::enter(const std::string &what, bool out) {
    const std::string key = what + (out ? " out" : " in");
    if (std::find(path_.begin(), path_.end(), key) != path_.end())
        throw std::runtime_error("the " + what + " is made of itself (" + way() + ")");
    if (path_.size() == deepest)
        throw std::runtime_error("the " + what + " is made of too many others");
    const auto seen = steps_.find(key);
    if (seen != steps_.end()) {
        count(seen->second);
        return false;
    }
    path_.push_back(key);
    before_.push_back(step_);
    return true;
}

void Walk::leave() {
    steps_[path_.back()] = step_ - before_.back();
    path_.pop_back();
    before_.pop_back();
}

// The library makes all steps again wherever they are needed.
void Walk::count(double steps) {
    step_ += steps;
    if (step_ <= most_steps) return;
    throw std::runtime_error(
        (path_.empty() ? std::string("it")
                       : "the " + path_.front().substr(0, path_.front().rfind(' '))) +
        " is made of more than " + std::to_string(int(most_steps)) + " steps");
}

void Walk::table(const char *name) {
    std::string path;
    try {
        path = config_->getCurrentContext()->resolveFileLocation(name);
    } catch (const OCIO::Exception &) {
        return; // the library says so
    }
    check_table_file(path);
}

std::string Walk::way() const {
    std::string text;
    for (const std::string &key : path_)
        text += (text.empty() ? "" : ", ") + key.substr(0, key.rfind(' '));
    return text;
}

void Walk::transform(const OCIO::ConstTransformRcPtr &t, bool inverse) {
    if (!t) return;
    count(1);
    if (auto file = std::dynamic_pointer_cast<const OCIO::FileTransform>(t))
        table(file->getSrc());
    inverse ^= t->getDirection() == OCIO::TRANSFORM_DIR_INVERSE;
    if (auto group = std::dynamic_pointer_cast<const OCIO::GroupTransform>(t))
        for (int i = 0; i < group->getNumTransforms(); i++)
            transform(group->getTransform(i), inverse);
    if (auto pair = std::dynamic_pointer_cast<const OCIO::ColorSpaceTransform>(t))
        between(pair->getSrc(), pair->getDst(), inverse);
    if (auto looked = std::dynamic_pointer_cast<const OCIO::LookTransform>(t)) {
        between(looked->getSrc(), looked->getDst(), inverse);
        looks(looked->getLooks());
    }
    if (auto shown = std::dynamic_pointer_cast<const OCIO::DisplayViewTransform>(t)) {
        space(shown->getSrc(), !inverse);
        view(shown->getDisplay(), shown->getView());
    }
}

void Walk::between(const char *from, const char *to, bool inverse) {
    space(inverse ? to : from, true);
    space(inverse ? from : to, false);
}

void Walk::named(const char *name) {
    OCIO::ConstNamedTransformRcPtr t = config_->getNamedTransform(name);
    if (!t || !enter(std::string("named transform \"") + name + '"', true)) return;
    transform(t->getTransform(OCIO::TRANSFORM_DIR_FORWARD), false);
    transform(t->getTransform(OCIO::TRANSFORM_DIR_INVERSE), false);
    leave();
}

void Walk::look(const std::string &name) {
    OCIO::ConstLookRcPtr l = config_->getLook(name.c_str());
    if (!l || !enter("look \"" + name + '"', true)) return;
    space(l->getProcessSpace(), true);
    space(l->getProcessSpace(), false);
    transform(l->getTransform(), false);
    transform(l->getInverseTransform(), false);
    leave();
}

void Walk::view_transform(const char *name) {
    OCIO::ConstViewTransformRcPtr v = given(name) ? config_->getViewTransform(name) : nullptr;
    if (!v || !enter(std::string("view transform \"") + name + '"', true)) return;
    transform(v->getTransform(OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE), false);
    transform(v->getTransform(OCIO::VIEWTRANSFORM_DIR_TO_REFERENCE), true);
    leave();
}
