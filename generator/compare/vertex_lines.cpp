#include "generator/compare/vertex_lines.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/number.h"
#include "core/text.h"

namespace farol::generator {
namespace {

using Key = std::tuple<float, float, float>;

Key keyOf(double x, double y, double z) {
    // + 0.0F: -0 is 0.
    return {static_cast<float>(x) + 0.0F, static_cast<float>(y) + 0.0F,
            static_cast<float>(z) + 0.0F};
}

/// The lines of one position.
struct Hits {
    std::vector<int> atStart, inside;
    std::size_t next = 0;

    int take() {
        const std::vector<int>& lines = atStart.empty() ? inside : atStart;
        if (lines.empty()) return 0;
        const std::size_t at = std::min(next++, lines.size() - 1);
        return lines[at];
    }
};

/// Reads the numbers of a text one after the other.
class Numbers {
  public:
    explicit Numbers(std::string_view text) : text_(text) {}

    /// False at the end.
    bool next(double& value, int& line, bool& isFirst) {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n') {
                ++line_;
                isFirst_ = true;
                ++at_;
            } else if (isNumberStart()) {
                std::size_t end = at_ + 1;
                while (end < text_.size() && isNumberPart(end)) ++end;
                const auto number = parseExact<double>(
                    text_.substr(at_ + (c == '+' ? 1 : 0), end - at_ - (c == '+' ? 1 : 0)));
                at_ = end;
                if (!number) continue;
                value = *number;
                line = line_;
                isFirst = isFirst_;
                isFirst_ = false;
                return true;
            } else {
                ++at_;
            }
        }
        return false;
    }

  private:
    /// Digits that follow a letter are part of a word: "v1".
    bool isNumberStart() const {
        const char c = text_[at_];
        const bool isSigned = (c == '-' || c == '+' || c == '.') && at_ + 1 < text_.size() &&
                              (isDigit(text_[at_ + 1]) || text_[at_ + 1] == '.');
        if (!isDigit(c) && !isSigned) return false;
        return at_ == 0 || !(isAlphanumeric(text_[at_ - 1]) || text_[at_ - 1] == '_');
    }
    bool isNumberPart(std::size_t at) const {
        const char c = text_[at];
        const bool isExponentSign =
            (c == '-' || c == '+') && (text_[at - 1] == 'e' || text_[at - 1] == 'E');
        return isDigit(c) || c == '.' || c == 'e' || c == 'E' || isExponentSign;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
    bool isFirst_ = true;
};

}  // namespace

std::vector<int> vertexLines(std::string_view text, const std::vector<glm::dvec3>& positions) {
    std::vector<int> lines(positions.size(), 0);
    if (text.find('\0') != std::string_view::npos) return lines;
    std::map<Key, Hits> hits;
    for (const glm::dvec3& p : positions) hits[keyOf(p.x, p.y, p.z)];
    struct Number {
        double value = 0.0;
        int line = 0;
        bool isFirst = false;
    };
    Number last[3];
    Numbers numbers(text);
    for (std::size_t count = 1;; ++count) {
        last[0] = last[1];
        last[1] = last[2];
        if (!numbers.next(last[2].value, last[2].line, last[2].isFirst)) break;
        if (count < 3) continue;
        const auto found = hits.find(keyOf(last[0].value, last[1].value, last[2].value));
        if (found == hits.end()) continue;
        std::vector<int>& list = last[0].isFirst ? found->second.atStart : found->second.inside;
        if (list.empty() || list.back() != last[0].line) list.push_back(last[0].line);
    }
    for (std::size_t i = 0; i < positions.size(); ++i)
        lines[i] = hits[keyOf(positions[i].x, positions[i].y, positions[i].z)].take();
    return lines;
}

}  // namespace farol::generator
