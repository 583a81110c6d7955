#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "scene/repair/repair.h"

namespace farol::scene {

/// One XML document, repaired and parsed, with the source locations of its names and values.
/// Private to the scene folder: no other code uses pugixml.
class Document {
  public:
    /// Throws Error as `repair` does; other faults go to `findings`.
    Document(std::string_view source, const std::string& name, const ReadLimits& limits,
             Findings& findings);
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    /// Returns the first root element that is a scene's, else the first; null if there is none.
    pugi::xml_node root() const;
    Location at(pugi::xml_node element) const;              ///< of its "<"
    Location at(pugi::xml_attribute attribute) const;       ///< of its name
    Location atValue(pugi::xml_attribute attribute) const;  ///< of its value, after the quote
    const Repaired& repaired() const { return repaired_; }

  private:
    std::size_t origin(const char* place) const;

    LineIndex lines_;
    Repaired repaired_;
    std::string buffer_;
    pugi::xml_document parsed_;
};

}  // namespace farol::scene
