#pragma once

#include <string_view>

namespace farol::grade {

/// Returns an embedded file of grade/report: "view.css". Empty where there is none.
std::string_view pageFile(std::string_view name);

}  // namespace farol::grade
