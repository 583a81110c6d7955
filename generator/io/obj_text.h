#pragma once

#include <functional>
#include <string_view>

/// The lines and words of OBJ and MTL files.
namespace farol::generator::io {

/// Removes the next word from a line and returns it; empty at its end. Semicolons are blanks.
std::string_view nextObjWord(std::string_view& line);

/// Calls `read` with each line and its number from 1. Lines that end in a backslash are joined to
/// those after them.
void eachObjLine(std::string_view bytes, const std::function<void(std::string_view, int)>& read);

/// Returns the base of a file's indices: 1, or 0 where a corner of a face begins with 0.
int objIndexBase(std::string_view bytes);

}  // namespace farol::generator::io
