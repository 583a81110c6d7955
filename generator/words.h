#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "generator/call.h"

/// Parses shape calls from the file names and generator comments of missing meshes.
namespace farol::generator {

/// Words parted by blanks or commas; quotes are removed. At most 16: no shape has more.
std::vector<std::string> splitWords(const std::string& text);
/// Whether splitWords gives the text back as its only word.
bool isOneWord(const std::string& text);

/// Returns the words of a file name: "cone_1_2_4_3.3d" is {"cone", "1", "2", "4", "3"}, and
/// "bezier_10.3d" {"patch", "teapot.patch", "10"}; the ending may be missing after a number.
/// Nothing when the name is no shape's.
std::optional<std::vector<std::string>> wordsOfName(const std::string& fileName);

/// Parses a generator comment or command, the program's name and "teapot" for its patches
/// understood. A missing shape word is read from the file's name ("2 3" for box_2_3.3d); a file
/// that stands after the numbers goes first. Throws as parseCall where no order of the arguments
/// makes sense; the older order, counts before lengths ("sphere 8 8 1"), is understood with a
/// warning at `where`.
ShapeCall parseComment(std::vector<std::string> words, const std::string& fileName,
                       const Location& where, Diagnostics& diagnostics);

/// The shape whose files have that name's ending (".patch"), or null.
const ShapeEntry* shapeOfFile(const std::string& fileName);

}  // namespace farol::generator
