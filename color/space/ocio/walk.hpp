// What the files of the OpenColorIO module share.
#ifndef WF_COLOR_SPACE_OCIO_WALK_HPP
#define WF_COLOR_SPACE_OCIO_WALK_HPP

#include <map>
#include <set>
#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>

namespace OCIO = OCIO_NAMESPACE;

// Refuse what would never end or fill memory as it is read: pipes and devices, files of absurd
// size, YAML that doubles. A path that is not there is left to OpenColorIO.
void check_config_file(const char *path);
void check_table_file(const std::string &path);

// Walks through what a conversion is made of before OpenColorIO does, which does not return
// from a space that needs itself, or that needs another twice, which needs another twice, and
// so on. Throws what is made of itself or of too much, by name.
class Walk {
  public:
    explicit Walk(const OCIO::ConstConfigRcPtr &config) : config_(config) {}

    void space(const char *name, bool out); // to the reference; else into it from there
    void looks(const std::string &list);    // "+this, -that | other"
    void view(const char *display, const char *name);

  private:
    bool enter(const std::string &what, bool out);
    void leave();
    void count(double steps);
    void table(const char *name);
    std::string way() const;
    void transform(const OCIO::ConstTransformRcPtr &t, bool inverse);
    void between(const char *from, const char *to, bool inverse);
    void named(const char *name);
    void look(const std::string &name);
    void view_transform(const char *name);

    const OCIO::ConstConfigRcPtr config_;
    std::vector<std::string> path_;       // what is being walked through, from the outside in
    std::vector<double> before_;          // steps before each of it
    std::map<std::string, double> steps_; // of what has been walked through
    double step_ = 0;
};

#endif
