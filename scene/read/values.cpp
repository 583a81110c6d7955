#include "scene/read/values.h"

#include <cmath>

#include "core/did_you_mean.h"
#include "core/lenient_number.h"
#include "core/text.h"
#include "scene/messages.h"

namespace farol::scene {
namespace {

/// True for attributes of XML itself and of schemas, which do not describe the scene.
bool isForeign(std::string_view name) {
    return name.substr(0, 5) == "xmlns" || name.substr(0, 4) == "xml:" ||
           name.substr(0, 4) == "xsi:";
}

/// The nearest known word, or "".
std::string suggestion(std::string_view word, const std::vector<std::string>& known,
                       const Findings& findings) {
    if (findings.crowded()) return {};
    return didYouMean(std::string(word), known);
}

std::vector<std::string> attributeNames(const ElementSpec& spec) {
    std::vector<std::string> names;
    for (const AttributeSpec& row : spec.attributes) {
        names.emplace_back(row.name);
        for (const std::string_view alias : split(row.aliases)) names.emplace_back(alias);
    }
    return names;
}

Message rangeOf(const AttributeSpec& row) {
    if (row.max < kHugeNumber)
        return message<"part.range">("min"_arg = row.min, "max"_arg = row.max);
    return row.min == 0 ? message<"part.range-not-negative">() : message<"part.range-positive">();
}

class AttributeReader {
  public:
    AttributeReader(const Document& document, pugi::xml_node element, const ElementSpec& spec,
                    Findings& findings)
        : document_(document), spec_(spec), findings_(findings), element_(element.name()) {}

    void read(pugi::xml_attribute attribute, Unknown unknown, Values& values) {
        const std::string_view name = attribute.name();
        if (isForeign(name)) return;
        const AttributeSpec* row = findAttribute(spec_, name);
        if (row == nullptr) return unknownName(attribute, unknown, values);
        if (values.has(row->name)) {
            findings_.warn(message<"xml.duplicate-attribute">("name"_arg = name),
                           document_.at(attribute));
            return;
        }
        const std::string_view text = trimmed(attribute.value());
        if (text.empty() && row->kind != Kind::text) {
            findings_.warn(
                message<"scene.empty-value">("name"_arg = name, "element"_arg = element_),
                document_.at(attribute));
            return;
        }
        Values::Entry entry{row->name, 0.0, std::string(text), document_.atValue(attribute)};
        const bool good = row->kind == Kind::flag   ? flag(entry, name)
                          : row->kind == Kind::word ? word(*row, entry, name)
                          : row->kind == Kind::text ? textual(entry, name)
                                                    : number(*row, entry, name);
        if (good)
            values.entries.push_back(std::move(entry));
        else
            values.damaged = true;
    }

  private:
    /// Reports an unknown attribute as an error or a warning, by `unknown`.
    void unknownName(pugi::xml_attribute attribute, Unknown unknown, Values& values) {
        std::string hint = suggestion(attribute.name(), attributeNames(spec_), findings_);
        const std::string_view common = commonWord(attribute.name());
        if (common == "opacity")
            for (const char* name : {"opacity", "A"})
                if (hint.empty() && findAttribute(spec_, name) != nullptr) hint = name;
        Message text = message<"scene.unknown-attribute">(
            "name"_arg = attribute.name(), "element"_arg = element_, "suggestion"_arg = hint,
            "known"_arg = hint.empty() ? fewNames() : "");
        if (auto advice = colorAdvice(attribute); advice && hint.empty()) text = *advice;
        if (common == "shadows" && hint.empty())
            text = message<"scene.unknown-attribute/elsewhere">(
                "element"_arg = element_, "name"_arg = attribute.name(),
                "suggestion"_arg = uncut("render shadows=\"map\"/"));
        if (unknown == Unknown::error) {
            values.damaged = true;
            findings_.error(std::move(text), document_.at(attribute));
        } else {
            findings_.warn(std::move(text), document_.at(attribute));
        }
    }

    /// Returns the fix of an unknown attribute with a colour, #rrggbb or rrggbb, if the element or
    /// its child of that name has R, G and B.
    std::optional<Message> colorAdvice(pugi::xml_attribute attribute) const {
        std::string_view digits = attribute.value();
        if (digits.starts_with('#')) digits.remove_prefix(1);
        const bool isHex =
            digits.size() == 6 && digits.find_first_not_of("0123456789abcdefABCDEF") == digits.npos;
        const auto isRed = [](const AttributeSpec& row) { return row.name == "R"; };
        if (!isHex || std::none_of(spec_.attributes.begin(), spec_.attributes.end(), isRed))
            return std::nullopt;
        const auto channel = [&](std::size_t at) {
            return std::stoi(std::string(digits.substr(at, 2)), nullptr, 16);
        };
        const auto name = "name"_arg = attribute.name();
        const auto element = "element"_arg = element_;
        const auto red = "red"_arg = channel(0);
        const auto green = "green"_arg = channel(2);
        const auto blue = "blue"_arg = channel(4);
        if (isAmong(spec_.children, attribute.name()))
            return message<"scene.unknown-attribute/color-child">(name, element, red, green, blue);
        return message<"scene.unknown-attribute/color">(name, element, red, green, blue);
    }

    /// The names of the element's attributes, where they are few.
    std::string fewNames() const {
        constexpr std::size_t kMaxNames = 6;
        if (spec_.attributes.size() > kMaxNames) return "";
        return joined(spec_.attributes, ", ", [](const AttributeSpec& row) { return row.name; });
    }

    bool flag(Values::Entry& entry, std::string_view name) {
        if (isAmong("true 1 yes on", entry.text)) {
            entry.number = 1.0;
            return true;
        }
        if (isAmong("false 0 no off", entry.text)) return true;
        findings_.error(message<"scene.value/flag">("name"_arg = name, "element"_arg = element_,
                                                    "value"_arg = entry.text),
                        entry.where);
        return false;
    }

    bool word(const AttributeSpec& row, Values::Entry& entry, std::string_view name) {
        const std::string_view canonical = canonicalWord(row, entry.text);
        if (!canonical.empty()) {
            entry.text = canonical;
            return true;
        }
        std::vector<std::string> known;
        for (const std::string_view group : split(row.words))
            known.emplace_back(group.substr(0, group.find('|')));
        findings_.error(message<"scene.value/word">(
                            "name"_arg = name, "element"_arg = element_, "value"_arg = entry.text,
                            "words"_arg = uncut(joined(known, ", ")),
                            "suggestion"_arg = suggestion(entry.text, known, findings_)),
                        entry.where);
        return false;
    }

    bool textual(const Values::Entry& entry, std::string_view name) {
        constexpr std::size_t kMaxBytes = 1024;
        if (entry.text.size() <= kMaxBytes) return true;
        findings_.error(message<"limit.text/attribute">("name"_arg = name, "element"_arg = element_,
                                                        "max"_arg = kMaxBytes),
                        entry.where);
        return false;
    }

    /// Reads the leading number of the text, as the engines of the field do, with a warning where
    /// it is not all of it.
    std::optional<double> anyNumber(const AttributeSpec& row, const Values::Entry& entry,
                                    std::string_view name) {
        const ParsedNumber exact = parseNumber(entry.text);
        double value = exact.value;
        if (!exact.problem.empty()) {
            const ParsedNumber leading = leadingNumber(entry.text);
            if (!leading.problem.empty()) {
                // The next attribute's "=" inside the value: a quote was forgotten before it.
                const bool hasNextName = entry.text.find('=') != std::string::npos;
                findings_.error(
                    hasNextName
                        ? message<"scene.number/quote">("name"_arg = name, "element"_arg = element_,
                                                        "value"_arg = entry.text)
                        : message<"scene.number">("name"_arg = name, "element"_arg = element_,
                                                  "value"_arg = entry.text,
                                                  "problem"_arg = leading.problem),
                    entry.where);
                return std::nullopt;
            }
            value = leading.value;
            const bool isOpacity = row.name == "opacity" || row.name == "A";
            if (isOpacity && trimmed(entry.text).ends_with('%')) value *= 0.01;
        }
        const double whole = row.kind == Kind::integer ? std::trunc(value) : value;
        if (!exact.problem.empty() || whole != value)
            findings_.warn(
                row.kind == Kind::integer
                    ? message<"scene.number/whole">("name"_arg = name, "element"_arg = element_,
                                                    "value"_arg = entry.text, "number"_arg = whole)
                    : message<"scene.number/leading">("name"_arg = name, "element"_arg = element_,
                                                      "value"_arg = entry.text,
                                                      "number"_arg = whole),
                entry.where);
        return whole;
    }

    bool number(const AttributeSpec& row, Values::Entry& entry, std::string_view name) {
        const std::optional<double> parsed = anyNumber(row, entry, name);
        if (!parsed) return false;
        entry.number = *parsed;
        if (*parsed >= row.min && *parsed <= row.max) return true;
        // Over 0 as required, but too small to compute with.
        const bool isTiny = row.min > 0 && row.max >= kHugeNumber && *parsed > 0;
        if (row.clamped || isTiny) {
            entry.number = std::fmin(std::fmax(*parsed, row.min), row.max);
            const Message range =
                isTiny ? message<"part.range-at-least">("min"_arg = row.min) : rangeOf(row);
            findings_.warn(message<"scene.clamped">("name"_arg = name, "element"_arg = element_,
                                                    "value"_arg = entry.text, "range"_arg = range,
                                                    "number"_arg = entry.number),
                           entry.where);
            return true;
        }
        findings_.error(
            message<"scene.range">("name"_arg = name, "element"_arg = element_,
                                   "value"_arg = entry.text, "range"_arg = rangeOf(row)),
            entry.where);
        return false;
    }

    const Document& document_;
    const ElementSpec& spec_;
    Findings& findings_;
    std::string_view element_;
};

}  // namespace

const Values::Entry* Values::find(std::string_view name) const {
    for (const Entry& one : entries)
        if (one.name == name) return &one;
    return nullptr;
}

bool Values::hasAny(std::string_view names) const {
    for (const std::string_view name : split(names))
        if (has(name)) return true;
    return false;
}

std::optional<double> Values::number(std::string_view name) const {
    const Entry* entry = find(name);
    return entry != nullptr ? std::optional(entry->number) : std::nullopt;
}

double Values::number(std::string_view name, double otherwise) const {
    return number(name).value_or(otherwise);
}

std::optional<int> Values::integer(std::string_view name) const {
    const Entry* entry = find(name);
    return entry != nullptr ? std::optional(static_cast<int>(entry->number)) : std::nullopt;
}

bool Values::flag(std::string_view name) const { return number(name, 0.0) != 0.0; }

const std::string& Values::text(std::string_view name) const {
    static const std::string kNone;
    const Entry* entry = find(name);
    return entry != nullptr ? entry->text : kNone;
}

glm::dvec3 Values::vector(std::string_view x, std::string_view y, std::string_view z,
                          const glm::dvec3& otherwise) const {
    return {number(x, otherwise.x), number(y, otherwise.y), number(z, otherwise.z)};
}

Location Values::where(std::string_view name) const {
    const Entry* entry = find(name);
    return entry != nullptr ? entry->where : Location{};
}

Values readValues(const Document& document, pugi::xml_node element, const ElementSpec& spec,
                  Findings& findings, Unknown unknown) {
    Values values;
    AttributeReader reader(document, element, spec, findings);
    // With a known attribute, unknown ones are warnings.
    if (unknown == Unknown::error)
        for (const pugi::xml_attribute attribute : element.attributes())
            if (findAttribute(spec, attribute.name()) != nullptr) unknown = Unknown::warning;
    for (const pugi::xml_attribute attribute : element.attributes())
        reader.read(attribute, unknown, values);
    return values;
}

}  // namespace farol::scene
