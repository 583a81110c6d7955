#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Generated forms of the tables: of dialects, shapes, formats, options, settings and messages.
namespace farol::cli {

/// Everything in one document (api/schema.json).
nlohmann::ordered_json tablesAsJson();

/// The message catalogue: [{id, text, code, samples, example}], by id. `code` is missing for the
/// messages that are only arguments of others.
nlohmann::ordered_json messagesAsJson();

/// The table of api/errors.md: each code with its templates.
std::string messagesMarkdown();

/// Decimal digits without an exponent: "0.000001".
std::string plainNumber(double value);

/// A section of a generated file, without its markers.
struct Section {
    std::string name;  ///< as in "<!-- generated: NAME -->"
    std::string text;  ///< whole lines
};

/// Reference tables of docs/ in Markdown.
std::vector<Section> markdownSections();

/// Parts of api/openapi.yaml, not indented.
std::vector<Section> openapiSections();

}  // namespace farol::cli
