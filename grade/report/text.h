#pragma once

#include <string>

namespace farol::grade {

/// Returns "12.50".
std::string twoDigits(double value);

/// Escapes text for elements and attributes of XML 1.0 and HTML. Characters that XML cannot hold
/// are left out; bytes that are no UTF-8 become U+FFFD.
std::string forMarkup(const std::string& text);

}  // namespace farol::grade
