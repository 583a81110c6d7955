#include "grade/structure/fix.h"

#include "core/text.h"
#include "generator/entry.h"

namespace farol::grade {
namespace {

std::string lineOf(const Location& where) {
    return where.line > 0 ? " (line " + std::to_string(where.line) + ")" : "";
}

/// The kind of thing, without its numbers: "sphere", "bunny.obj".
std::string meshNameOf(const scene::Model& model) {
    if (model.source.kind == scene::ModelSource::Kind::shape && model.source.shape.entry != nullptr)
        return model.source.shape.entry->name;
    return shown(model.file.empty() ? model.command : model.file);
}

}  // namespace

std::string ordinal(int number) {
    const int tens = number % 100, ones = number % 10;
    const char* end = tens >= 11 && tens <= 13 ? "th"
                      : ones == 1              ? "st"
                      : ones == 2              ? "nd"
                      : ones == 3              ? "rd"
                                               : "th";
    return std::to_string(number) + end;
}

std::string articleFor(const std::string& word) {
    return !word.empty() && std::string("aeiou").find(word.front()) != std::string::npos ? "an "
                                                                                         : "a ";
}

std::string nameOfNode(const Outline& outline, int node) {
    if (node <= 0) return "the scene";
    const Outline::Node& one = outline.nodes[static_cast<std::size_t>(node)];
    if (!one.name.empty()) return "group " + farol::quoted(one.name);
    return "the " + ordinal(one.number) + " group" + lineOf(one.where);
}

std::string nameOfItem(const Outline& outline, int item) {
    const Outline::Item& one = outline.items[static_cast<std::size_t>(item)];
    const std::string given = !one.model.name.empty() ? one.model.name : one.model.id;
    if (!given.empty()) return farol::quoted(given);
    const Outline::Node& group = outline.nodes[static_cast<std::size_t>(one.node)];
    if (!group.name.empty()) {
        int count = 0;
        for (const Outline::Item& other : outline.items)
            count += other.node == one.node && !other.isGone ? 1 : 0;
        return count == 1 ? farol::quoted(group.name)
                          : "the " + meshNameOf(one.model) + " of " + farol::quoted(group.name);
    }
    return "the " + ordinal(one.number) + " model, " + articleFor(meshNameOf(one.model)) +
           meshNameOf(one.model);
}

}  // namespace farol::grade
