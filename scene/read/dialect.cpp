#include <array>
#include <vector>

#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/scene_builder.h"

namespace farol::scene {
namespace {

/// A sign that a document is written in a dialect: an element, an attribute of it, a parent.
struct Sign {
    Dialect dialect;
    std::string_view element;
    std::string_view attributes = {};  ///< any of them; empty: the element alone
    std::string_view parents = {};     ///< empty: anywhere
};
// <window> and <camera> are no signs: scenes of all dialects have been given them.
constexpr Sign kSigns[] = {
    {Dialect::engine2020, "colors colours"},
    {Dialect::engine2020, "skybox"},
    {Dialect::engine2020, "model", "command emission"},
    {Dialect::engine2020, "light", "attenuation"},
    {Dialect::engine2017, "translate rotate scale", "", "scene group"},
    {Dialect::engine2017, "rotate", "axisX axisY axisZ"},
    {Dialect::engine2017, "model", "diffR ambtR specR emisR rand"},
    {Dialect::engine2017, "light", "spotDirX diffR ambtR specR"},
    {Dialect::engine2017, "entity"},
    {Dialect::course, "transform"},
    {Dialect::course, "color colour", "", "model"},
    {Dialect::course, "texture", "", "model"},
};

const char* dialectName(Dialect dialect) {
    if (dialect == Dialect::engine2017) return "2017";
    return dialect == Dialect::engine2020 ? "2020" : "course";
}

const Sign* signOf(pugi::xml_node element) {
    for (const Sign& sign : kSigns) {
        if (!isAmong(sign.element, element.name())) continue;
        if (!sign.parents.empty() && !isAmong(sign.parents, element.parent().name())) continue;
        if (sign.attributes.empty()) return &sign;
        for (const pugi::xml_attribute attribute : element.attributes())
            if (isAmong(sign.attributes, attribute.name())) return &sign;
    }
    return nullptr;
}

/// The element after this one in document order, without recursion.
pugi::xml_node nextElement(pugi::xml_node element, pugi::xml_node root) {
    if (element.first_child()) return element.first_child();
    while (element != root && !element.next_sibling()) element = element.parent();
    return element == root ? pugi::xml_node() : element.next_sibling();
}

}  // namespace

Dialect detectDialect(const Document& document, Findings& findings) {
    const pugi::xml_node root = document.root();
    for (const pugi::xml_attribute attribute : root.attributes())
        if (sameWord(attribute.name(), "dialect")) return Dialect::course;  // given, not guessed
    if (!sameWord(root.name(), "scene")) return Dialect::course;
    const Sign* first = nullptr;
    pugi::xml_node firstAt, otherAt;
    const Sign* other = nullptr;
    for (pugi::xml_node at = root; at && other == nullptr; at = nextElement(at, root)) {
        const Sign* sign = at.type() == pugi::node_element ? signOf(at) : nullptr;
        if (sign == nullptr) continue;
        if (first == nullptr) {
            first = sign;
            firstAt = at;
        } else if (sign->dialect != first->dialect) {
            other = sign;
            otherAt = at;
        }
    }
    if (first == nullptr) return Dialect::engine2017;
    if (other != nullptr)
        findings.info(
            message<"scene.dialect">("dialect"_arg = dialectName(first->dialect),
                                     "element"_arg = firstAt.name(), "other"_arg = otherAt.name(),
                                     "line"_arg = document.at(otherAt).line,
                                     "second"_arg = dialectName(other->dialect)),
            document.at(firstAt));
    return first->dialect;
}

}  // namespace farol::scene
