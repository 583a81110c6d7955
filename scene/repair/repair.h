#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/read/findings.h"
#include "scene/read/reader.h"

namespace farol::scene {

/// Lines of a document: offset -> line and column, both from 1. A byte order mark takes no column.
class LineIndex {
  public:
    LineIndex(std::string_view text, std::string file);
    Location at(std::size_t offset) const;

  private:
    std::string file_;
    std::vector<std::size_t> starts_;
};

/// Well-formed XML repaired from a source, with the source offset of each byte.
struct Repaired {
    std::string text;  ///< UTF-8, without comments, declarations and processing instructions
    std::vector<std::pair<std::size_t, std::size_t>> origins;  ///< offset in text, in the source
    /// `generator` comments: see Scene::generatorComments.
    std::map<std::string, std::vector<std::string>> generatorComments;
    int elements = 0;

    /// The source offset of a byte of `text`.
    std::size_t origin(std::size_t offset) const;
};

/// Makes `source` well-formed: quotes, blanks, stray text, comments, encoding. A repair is a
/// warning xml.*; a fault without a repair is an error xml.*, and its element is closed all the
/// same, so that reading finds later faults, too. Iterative: no nesting overflows the stack.
/// Throws Error limit.bytes, limit.depth, limit.elements, xml.empty, xml.character.
Repaired repair(std::string_view source, const LineIndex& lines, const ReadLimits& limits,
                Findings& findings);

/// Takes the commands of one comment or argv ("generator cone 1 2 4 3 cone.3d"), each to its .3d,
/// a semicolon or the end of the line, into `comments`. False if there is none. Sets `conflict` if
/// the file had other words before (the first stay).
bool takeGeneratorWords(std::string_view comment,
                        std::map<std::string, std::vector<std::string>>& comments, bool& conflict);

}  // namespace farol::scene
