#include "scene/read/xsd.h"

#include <cstdio>
#include <map>
#include <vector>

#include "core/text.h"
#include "scene/read/tables.h"

namespace farol::scene {
namespace {

constexpr const char* kHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- Generated from the reader's tables by scripts/generate.
     The scene language in its clean form: the course dialect and all extensions, with the
     spellings of the other dialects. The reader takes more (any case, missing quotes, stray text)
     and reports it; docs/scene-language.md is the reference. -->
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="qualified">
)";
constexpr const char* kFlagPattern =
    "[tT][rR][uU][eE]|[fF][aA][lL][sS][eE]|1|0|[yY][eE][sS]|[nN][oO]|[oO][nN]|[oO][fF][fF]";

std::string numberText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

/// A number as part of a type's name.
std::string nameText(double value) {
    std::string name;
    for (const char c : numberText(value))
        if (c == '-')
            name += "Minus";
        else if (c != '+')
            name += c;
    return name;
}

std::string capitalised(std::string_view word) {
    std::string text(word);
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

/// A pattern that matches the word in any case: "[cC][oO]".
std::string anyCase(std::string_view word) {
    std::string pattern;
    for (const char c : lowerCase(word))
        if (c >= 'a' && c <= 'z')
            pattern += std::string("[") + c + static_cast<char>(c - 'a' + 'A') + "]";
        else
            pattern += c;
    return pattern;
}

std::string typeName(const AttributeSpec& row) {
    switch (row.kind) {
        case Kind::text:
            return "xs:string";
        case Kind::flag:
            return "Flag";
        case Kind::word: {
            std::string name = "Word";
            for (const std::string_view group : split(row.words))
                name += capitalised(group.substr(0, group.find('|')));
            return name;
        }
        case Kind::number:
        case Kind::integer:
            break;
    }
    std::string name = row.kind == Kind::integer ? "Whole" : "Number";
    if (row.min > -kHugeNumber) name += "From" + nameText(row.min);
    if (row.max < kHugeNumber) name += "To" + nameText(row.max);
    return name;
}

std::string typeBody(const AttributeSpec& row) {
    const std::string indent = "      ";
    std::string body;
    if (row.kind == Kind::flag || row.kind == Kind::word) {
        body = "    <xs:restriction base=\"xs:token\">\n";
        if (row.kind == Kind::flag)
            body += indent + "<xs:pattern value=\"" + kFlagPattern + "\"/>\n";
        else
            for (const std::string_view word : split(row.words, " |"))
                body += indent + "<xs:pattern value=\"" + anyCase(word) + "\"/>\n";
    } else {
        const char* base = row.kind == Kind::integer ? "integer" : "double";
        body = std::string("    <xs:restriction base=\"xs:") + base + "\">\n";
        body += indent + "<xs:minInclusive value=\"" + numberText(row.min) + "\"/>\n";
        body += indent + "<xs:maxInclusive value=\"" + numberText(row.max) + "\"/>\n";
    }
    return body + "    </xs:restriction>\n";
}

bool isLetter(std::string_view name) { return name.size() == 1; }

/// Spellings of an attribute. XML Schema knows no names in any case: those of lower and of mixed
/// case are listed, and single letters in both.
std::vector<std::string> attributeNames(const AttributeSpec& row) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        for (const std::string& known : names)
            if (known == name) return;
        names.push_back(name);
    };
    add(std::string(row.name));
    if (isLetter(row.name)) add(capitalised(row.name));
    add(lowerCase(row.name));
    for (const std::string_view alias : split(row.aliases)) {
        add(std::string(alias));
        if (isLetter(alias)) add(capitalised(alias));
    }
    return names;
}

std::string elementName(const ElementSpec& element) {
    return element.name == "namedColor" ? "" : std::string(element.name);
}

std::vector<std::string> elementNames(const ElementSpec& element) {
    std::vector<std::string> names;
    if (const std::string name = elementName(element); !name.empty()) names.push_back(name);
    for (const std::string_view alias : split(element.aliases)) names.emplace_back(alias);
    if (!names.empty() && lowerCase(names.front()) != names.front())
        names.push_back(lowerCase(names.front()));
    return names;
}

/// Markdown as the text of an XML element.
std::string plainText(std::string_view markdown) {
    std::string text;
    for (const char c : markdown) {
        if (c == '`') continue;
        if (c == '<')
            text += "&lt;";
        else if (c == '&')
            text += "&amp;";
        else
            text += c;
    }
    return text;
}

void appendComplexType(std::string& out, const ElementSpec& element) {
    out += "  <xs:complexType name=\"" + capitalised(element.name) + "\">\n";
    if (!element.summary.empty())
        out += "    <xs:annotation><xs:documentation>" + plainText(element.summary) +
               "</xs:documentation></xs:annotation>\n";
    if (!element.children.empty()) {
        out += "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n";
        for (const std::string_view child : split(element.children)) {
            const ElementSpec& spec = elementSpec(child);
            const std::string type = spec.isText() ? "xs:string" : capitalised(spec.name);
            for (const std::string& name : elementNames(spec))
                out += "      <xs:element name=\"" + name + "\" type=\"" + type + "\"/>\n";
        }
        out += "    </xs:choice>\n";
    }
    for (const AttributeSpec& row : element.attributes)
        for (const std::string& name : attributeNames(row))
            out += "    <xs:attribute name=\"" + name + "\" type=\"" + typeName(row) + "\"/>\n";
    out += "  </xs:complexType>\n";
}

}  // namespace

std::string xmlSchema() {
    std::map<std::string, std::string> types;
    for (const ElementSpec& element : elementSpecs())
        for (const AttributeSpec& row : element.attributes)
            if (row.kind != Kind::text) types.emplace(typeName(row), typeBody(row));
    std::string out = kHead;
    for (const std::string& root : elementNames(elementSpecs().front()))
        out += "  <xs:element name=\"" + root + "\" type=\"World\"/>\n";
    // A document may be a list of others and nothing else.
    out += "  <xs:element name=\"xmls\" type=\"Xmls\"/>\n\n";
    for (const auto& [name, body] : types)
        out += "  <xs:simpleType name=\"" + name + "\">\n" + body + "  </xs:simpleType>\n";
    out += "\n";
    for (const ElementSpec& element : elementSpecs())
        if (!element.isText()) appendComplexType(out, element);
    return out + "</xs:schema>\n";
}

}  // namespace farol::scene
