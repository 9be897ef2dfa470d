// What a configuration's file is, before OpenColorIO reads it.
#include "color/space/ocio/walk.hpp"

#include <cctype>
#include <fstream>
#include <stdexcept>
#include <sys/stat.h>

namespace {

constexpr off_t most_bytes = 64 << 20;
constexpr off_t most_table_bytes = 512 << 20;
constexpr size_t most_aliases = 16;

void check_regular(const std::string &path, off_t most) {
    struct stat about;
    if (stat(path.c_str(), &about)) return; // the library says why
    if (!S_ISREG(about.st_mode))
        throw std::runtime_error("\"" + path + "\" is no regular file, and may never end");
    if (about.st_size > most)
        throw std::runtime_error("\"" + path + "\" has more than " +
                                 std::to_string(most >> 20) + " MB");
}

std::string text_of(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
}

bool is_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
}

// The name after the mark at `at`, where one can stand; "": none does.
std::string name_after(const std::string &text, size_t at) {
    const char before = at ? text[at - 1] : ' ';
    size_t end = at + 1;
    if (!std::isspace(static_cast<unsigned char>(before)) && before != '[' && before != ',')
        return "";
    while (end < text.size() && is_name(text[end])) end++;
    return text.substr(at + 1, end - at - 1);
}

// YAML writes a thing once ("&a") and names it again ("*a"). Things of such names in turn
// double at every step, and OpenColorIO, which writes none, makes all of them.
void check_aliases(const std::string &text) {
    std::set<std::string> anchors;
    size_t aliases = 0;
    for (size_t at = 0; at < text.size(); at++)
        if (text[at] == '&')
            anchors.insert(name_after(text, at));
        else if (text[at] == '*')
            aliases += anchors.count(name_after(text, at)) && !name_after(text, at).empty();
    if (aliases > most_aliases)
        throw std::runtime_error("it names " + std::to_string(aliases) +
                                 " things of YAML again (*name), of which there may be " +
                                 std::to_string(most_aliases) + "; write them out");
}

} // namespace

void check_config_file(const char *path) {
    check_regular(path, most_bytes);
    check_aliases(text_of(path));
}

void check_table_file(const std::string &path) {
    check_regular(path, most_table_bytes);
}
