#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/read/tables.h"
#include "scene/repair/document.h"

namespace farol::scene {

/// The attributes of one element, checked against its rows. Names are canonical.
class Values {
  public:
    struct Entry {
        std::string_view name;
        double number = 0.0;  ///< number, integer; flag: 0 or 1
        std::string text;     ///< text as written; word: canonical
        Location where;       ///< of the value
    };

    bool has(std::string_view name) const { return find(name) != nullptr; }
    /// True if any of the blank-separated names is given.
    bool hasAny(std::string_view names) const;
    std::optional<double> number(std::string_view name) const;
    double number(std::string_view name, double otherwise) const;
    std::optional<int> integer(std::string_view name) const;
    bool flag(std::string_view name) const;
    /// Empty when it is not given.
    const std::string& text(std::string_view name) const;
    glm::dvec3 vector(std::string_view x, std::string_view y, std::string_view z,
                      const glm::dvec3& otherwise) const;
    Location where(std::string_view name) const;
    bool damaged = false;  ///< an attribute was refused: its consequences are not reported

    const Entry* find(std::string_view name) const;
    std::vector<Entry> entries;
};

/// The severity of an attribute without a row: a warning, or an error where the element has no
/// attribute that is understood.
enum class Unknown { warning, error };

/// Reads all attributes of `element` by its table; faults are added to `findings`
/// (scene.unknown-attribute, scene.number, scene.range, scene.value, xml.duplicate-attribute).
Values readValues(const Document& document, pugi::xml_node element, const ElementSpec& spec,
                  Findings& findings, Unknown unknown = Unknown::warning);

}  // namespace farol::scene
