#pragma once

#include "core/number.h"

namespace farol {

/// Reads the number that a text begins with, as atof, scanf and TinyXML do, for text that
/// parseNumber refuses. Also reads these spellings:
///   "0,48"      a decimal comma: 0.48
///   "1.000,5"   thousands and a decimal comma: 1000.5 ("1,000.5" and "1,234,567" likewise)
///   "- 1"       a blank after the sign: -1
///   minus signs and dashes of Unicode as "-", blanks of Unicode as blanks
/// Ignores text after the number ("1.5-", "90deg", "45%", "1e"). Has a problem where no number
/// begins the text, and for NaN, infinity, numbers over kHugeNumber, hexadecimal numbers, and a
/// text with "=" in it (an unclosed quote).
ParsedNumber leadingNumber(std::string_view text);

}  // namespace farol
