#include "grade/finding.h"

#include <cmath>
#include <cstdio>

namespace farol::grade {

std::string shortNumber(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4f", value);
    std::string out = text;
    if (out.find('.') != std::string::npos) {
        out.erase(out.find_last_not_of('0') + 1);
        if (out.back() == '.') out.pop_back();
    }
    return out == "-0" ? "0" : out;
}

std::string inLine(const Location& where) {
    return where.line > 0 ? " (line " + std::to_string(where.line) + ")" : "";
}

}  // namespace farol::grade
