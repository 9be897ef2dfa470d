// What the files of the OpenColorIO module share.
#ifndef WF_COLOR_SPACE_OCIO_WALK_HPP
#define WF_COLOR_SPACE_OCIO_WALK_HPP

#include <set>
#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>

namespace OCIO = OCIO_NAMESPACE;

// Walks through what a conversion is made of before OpenColorIO does, which does not return
// from a space that needs itself. Throws what is made of itself, by name.
class Walk {
  public:
    explicit Walk(const OCIO::ConstConfigRcPtr &config) : config_(config) {}

    void space(const char *name, bool out); // to the reference; else into it from there
    void looks(const std::string &list);    // "+this, -that | other"
    void view(const char *display, const char *name);

  private:
    bool enter(const std::string &what, bool out);
    void leave() { path_.pop_back(); }
    std::string way() const;
    void transform(const OCIO::ConstTransformRcPtr &t, bool inverse);
    void between(const char *from, const char *to, bool inverse);
    void named(const char *name);
    void look(const std::string &name);
    void view_transform(const char *name);

    const OCIO::ConstConfigRcPtr config_;
    std::vector<std::string> path_; // what is being walked through, from the outside in
    std::set<std::string> seen_;
};

#endif
