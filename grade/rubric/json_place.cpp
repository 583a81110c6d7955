#include "grade/rubric/json_place.h"

#include <algorithm>
#include <string>

#include "core/text.h"

namespace farol::grade {
namespace {

/// Walks valid JSON text; every function leaves `at` behind what it skips.
class Walker {
  public:
    explicit Walker(std::string_view text) : text_(text) {}

    void skipBlanks() {
        while (at < text_.size() && isBlank(text_[at])) ++at;
    }
    char here() const { return at < text_.size() ? text_[at] : '\0'; }

    /// The string at this place, as written: an escaped key is compared as it is.
    std::string_view string() {
        const std::size_t begin = ++at;
        while (at < text_.size() && text_[at] != '"') at += text_[at] == '\\' ? 2 : 1;
        const std::size_t end = std::min(at, text_.size());
        at = std::min(end + 1, text_.size());
        return text_.substr(begin, end - begin);
    }

    void value() {
        int depth = 0;
        do {
            skipBlanks();
            const char c = here();
            if (c == '"') {
                string();
            } else if (c == '{' || c == '[') {
                ++depth;
                ++at;
            } else if (c == '}' || c == ']') {
                --depth;
                ++at;
            } else if (c == ',' || c == ':') {
                ++at;
            } else {
                while (at < text_.size() &&
                       std::string_view(",:]} \t\r\n").find(text_[at]) == std::string_view::npos)
                    ++at;
            }
        } while (depth > 0 && at < text_.size());
    }

    /// Goes to the member `name` of the object or list at this place. False where there is none;
    /// `isKey` leaves `at` on the key, which is what a fault of the member shows.
    bool enter(std::string_view name, bool isKey) {
        skipBlanks();
        const bool isObject = here() == '{';
        if (!isObject && here() != '[') return false;
        ++at;
        for (std::size_t i = 0;; ++i) {
            skipBlanks();
            if (at >= text_.size() || here() == '}' || here() == ']') return false;
            const std::size_t begin = at;
            bool isMeant = !isObject && std::to_string(i) == name;
            if (isObject) {
                isMeant = string() == name;
                if (isMeant && isKey) {
                    at = begin;
                    return true;
                }
                skipBlanks();
                ++at;  // the colon
                skipBlanks();
            }
            if (isMeant) return true;
            value();
            skipBlanks();
            if (here() == ',') ++at;
        }
    }

    std::size_t at = 0;

  private:
    std::string_view text_;
};

std::string unescaped(std::string_view part) {
    std::string out;
    for (std::size_t i = 0; i < part.size(); ++i) {
        if (part[i] == '~' && i + 1 < part.size())
            out += part[++i] == '1' ? '/' : '~';
        else
            out += part[i];
    }
    return out;
}

}  // namespace

Location placeIn(std::string_view text, std::string_view pointer) {
    Walker walker(text);
    walker.skipBlanks();
    std::size_t at = walker.at;
    while (!pointer.empty()) {
        pointer.remove_prefix(1);
        const std::size_t end = std::min(pointer.find('/'), pointer.size());
        const std::string name = unescaped(pointer.substr(0, end));
        pointer.remove_prefix(end);
        if (!walker.enter(name, pointer.empty())) break;
        at = walker.at;
    }
    const std::string_view before = text.substr(0, at);
    const std::size_t line = before.rfind('\n');
    return {"", 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
            1 + static_cast<int>(line == std::string_view::npos ? at : at - line - 1)};
}

}  // namespace farol::grade
