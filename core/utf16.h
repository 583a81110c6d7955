#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace farol {

/// Returns UTF-16 text as UTF-8, without its byte order mark; nothing where the bytes are not
/// UTF-16: they begin with a byte order mark, or with '<' and another ASCII character. A surrogate
/// without its other half and an odd last byte become U+FFFD. The result has at most 1.5 times the
/// bytes.
std::optional<std::string> utf16ToUtf8(std::string_view bytes);

}  // namespace farol
