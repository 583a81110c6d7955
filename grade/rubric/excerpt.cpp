#include "grade/rubric/excerpt.h"

#include <algorithm>

namespace farol::grade {

std::string excerptOf(const std::string& xml, int line) {
    constexpr std::size_t kMaxLineBytes = 160;  // bytes of a line
    std::string out;
    std::size_t begin = 0;
    for (int number = 1; begin < xml.size() && number <= line + 1; ++number) {
        const std::size_t end = std::min(xml.size(), xml.find('\n', begin));
        if (number >= line - 1) {
            std::string text = xml.substr(begin, std::min(end - begin, kMaxLineBytes));
            while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.pop_back();
            out += std::to_string(number) + (number == line ? " > " : "   ") + text + "\n";
        }
        begin = end + 1;
    }
    return out;
}

}  // namespace farol::grade
