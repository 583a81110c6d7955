#include "generator/io/obj_text.h"

#include <algorithm>
#include <string>

#include "generator/io/formats.h"

namespace farol::generator::io {

std::string_view nextObjWord(std::string_view& line) {
    constexpr std::string_view kBetween = " \t\r;";
    const std::size_t begin = line.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) return line = {};
    const std::size_t end = std::min(line.find_first_of(kBetween, begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

void eachObjLine(std::string_view bytes, const std::function<void(std::string_view, int)>& read) {
    std::string joined;  // a line that goes on after a backslash
    int number = 0;
    while (!bytes.empty()) {
        ++number;
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        if (!line.empty() && line.back() == '\\') {
            joined.append(line.substr(0, line.size() - 1)).append(" ");
            continue;
        }
        if (joined.empty()) {
            read(line, number);
        } else {
            joined += line;
            read(joined, number);
            joined.clear();
        }
    }
    if (!joined.empty()) read(joined, number);
}

int objIndexBase(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        const std::string_view keyword = nextObjWord(line);
        if (keyword != "f" && keyword != "F") continue;
        for (std::string_view word = nextObjWord(line); !word.empty(); word = nextObjWord(line))
            if (word.substr(0, word.find('/')) == "0") return 0;
    }
    return 1;
}

bool looksLikeObj(std::string_view bytes) {
    for (int looked = 0; !bytes.empty() && looked < 1000; ++looked) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        const std::string_view word = nextObjWord(line);
        if (word.empty() || word[0] == '#') continue;
        for (const char* keyword : {"v", "vt", "vn", "f", "o", "g", "s", "mtllib", "usemtl"})
            if (word == keyword) return true;
        return false;
    }
    return false;
}

}  // namespace farol::generator::io
