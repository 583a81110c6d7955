#pragma once

#include <string>
#include <string_view>
#include <vector>

/// File names as different systems write them.
namespace farol::scene::spelling {

/// Decodes %20 and the like where the two digits are hexadecimal and not 00; the rest stays.
std::string percentDecoded(std::string_view name);

/// The canonical decomposition (NFD) of UTF-8 text, for the alphabetic scripts, Kana and Hangul.
/// Bytes that are no UTF-8 stay as they are.
std::string decomposed(std::string_view name);

/// Returns one text for all names that differ only in case, Unicode form or percent-encoding.
std::string folded(std::string_view name);

/// Returns the possible names of a file whose name was decoded in a wrong code page (437, 850, 852,
/// 1250, 1252 or UTF-8), by each pair of pages that fits; none for ASCII.
std::vector<std::string> otherReadings(std::string_view name);

}  // namespace farol::scene::spelling
