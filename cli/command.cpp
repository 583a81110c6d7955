#include "cli/command.h"

#include <charconv>
#include <sstream>

namespace farol::cli {

void takesNumber(CLI::Option* option, double min, double max) {
    std::ostringstream range;
    range.precision(10);
    range << min << ".." << max;
    const auto check = [min, max, range = range.str()](const std::string& text) -> std::string {
        double value = 0.0;
        const char* end = text.data() + text.size();
        const auto [at, error] = std::from_chars(text.data(), end, value);
        const bool inside = value >= min && value <= max;  // false for NaN
        if (error == std::errc() && at == end && inside) return "";
        return text + " is not a number in " + range;
    };
    option->check(check)->type_name(range.str())->capture_default_str();
}

}  // namespace farol::cli
