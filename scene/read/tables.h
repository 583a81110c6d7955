#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/number.h"

/// The language as data: one row an attribute or element. A new alias is a word in a row: the
/// schema, the reference and the page's completion are generated from the rows (scripts/generate).
namespace farol::scene {

enum class Kind { number, integer, flag, text, word };

struct AttributeSpec {
    std::string_view name;     ///< canonical
    std::string_view aliases;  ///< other spellings, between blanks; case never matters
    Kind kind = Kind::number;
    double min = -kHugeNumber, max = kHugeNumber;  ///< of numbers, inclusive
    std::string_view words = {};     ///< kind word: canonical words, aliases after "|"
    bool clamped = false;            ///< outside the range: the nearest end, with a warning
    std::string_view fallback = {};  ///< value without it, for readers; may be empty
    std::string_view meaning = {};   ///< Markdown for the reference; may be empty
};

struct ElementSpec {
    std::string_view name;
    std::string_view aliases;
    std::span<const AttributeSpec> attributes;
    std::string_view children;  ///< canonical names of elements that may stand in it
    std::string_view summary;   ///< Markdown for the reference, a sentence or two
    /// Element in whose section of the reference these attributes are described; empty: its own.
    std::string_view describedBy = {};

    /// An element without attributes and children holds text.
    bool isText() const { return attributes.empty() && children.empty(); }
};

/// The element `name` as it may stand in `parent` (one of elementSpecs()), or null.
const ElementSpec* findChild(const ElementSpec& parent, std::string_view name);

/// The element of that canonical name. Precondition: it exists.
const ElementSpec& elementSpec(std::string_view canonical);

const AttributeSpec* findAttribute(const ElementSpec& element, std::string_view name);

/// The word of this language for one that other languages use for see-through models and shadows;
/// others as they are.
std::string_view commonWord(std::string_view word);

/// All elements, for suggestions and for the tests of the schema and the docs.
std::span<const ElementSpec> elementSpecs();

/// The canonical form of `word` in a row of kind word; empty if it is none of them.
std::string_view canonicalWord(const AttributeSpec& row, std::string_view word);

/// True for the names of a scene document's root element.
bool isSceneRoot(std::string_view name);

/// True if `word` is among the blank-separated `words`, ignoring case.
bool isAmong(std::string_view words, std::string_view word);

}  // namespace farol::scene
