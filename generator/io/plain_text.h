#pragma once

#include <string>
#include <string_view>

namespace farol::generator::io {

/// A mesh file's text as the readers know it: UTF-16 becomes UTF-8, without a byte order mark, lone
/// carriage returns line feeds, and decimal commas points. Returns `bytes` or a view of `storage`;
/// lines keep their numbers. A decimal comma is one where no number has a point, every comma stands
/// between two digits, no number has two, and a line has several numbers that blanks part.
std::string_view plainText(std::string_view bytes, std::string& storage);

}  // namespace farol::generator::io
