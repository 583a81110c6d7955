#include "scene/values.h"

#include <cmath>

#include "scene/text.h"
#include "scene/words.h"

namespace farol::scene {
namespace {

/// Attributes of XML itself and of schemas, which say nothing about the scene.
bool isForeign(std::string_view name) {
    return name.substr(0, 5) == "xmlns" || name.substr(0, 4) == "xml:" ||
           name.substr(0, 4) == "xsi:";
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known,
                       const Findings& findings) {
    if (findings.crowded()) return {};
    const std::string near = didYouMean(std::string(word), known);
    return near.empty() ? std::string() : "; did you mean " + quoted(near) + "?";
}

std::vector<std::string> attributeNames(const ElementSpec& spec) {
    std::vector<std::string> names;
    for (const AttributeSpec& row : spec.attributes) {
        names.emplace_back(row.name);
        for (const std::string_view alias : split(row.aliases)) names.emplace_back(alias);
    }
    return names;
}

std::string rangeText(const AttributeSpec& row) {
    if (row.max >= kHugeNumber) return row.min == 0 ? "0 or more" : "more than 0";
    return formatNumber(row.min) + " to " + formatNumber(row.max);
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
            findings_.warn("xml.duplicate-attribute", document_.at(attribute),
                           "the attribute " + quoted(name) + " is given twice; the first counts");
            return;
        }
        const std::string_view text = trimmed(attribute.value());
        if (text.empty() && row->kind != Kind::text) {
            findings_.warn("scene.empty-value", document_.at(attribute),
                           place(name) + " is empty and is taken as left out");
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
    std::string place(std::string_view attribute) const {
        return quoted(attribute) + " of <" + shown(element_) + ">";
    }

    void unknownName(pugi::xml_attribute attribute, Unknown unknown, Values& values) {
        std::string hint = suggestion(attribute.name(), attributeNames(spec_), findings_);
        if (hint.empty()) hint = fewNames();
        const std::string message =
            "<" + shown(element_) + "> has no attribute " + quoted(attribute.name()) + hint;
        if (unknown == Unknown::error) {
            values.damaged = true;
            findings_.error("scene.unknown-attribute", document_.at(attribute), message);
        } else {
            findings_.warn("scene.unknown-attribute", document_.at(attribute), message);
        }
    }

    /// "; it has x, y and z", where there are few.
    std::string fewNames() const {
        constexpr std::size_t kFew = 6;
        const auto& all = spec_.attributes;
        if (all.empty() || all.size() > kFew) return "";
        std::string text = "; it has ";
        for (std::size_t i = 0; i < all.size(); ++i)
            text += (i == 0 ? "" : i + 1 == all.size() ? " and " : ", ") + std::string(all[i].name);
        return text;
    }

    bool flag(Values::Entry& entry, std::string_view name) {
        if (isAmong("true 1 yes on", entry.text)) {
            entry.number = 1.0;
            return true;
        }
        if (isAmong("false 0 no off", entry.text)) return true;
        findings_.error("scene.value", entry.where,
                        place(name) + " is " + quoted(entry.text) + "; it must be true or false");
        return false;
    }

    bool word(const AttributeSpec& row, Values::Entry& entry, std::string_view name) {
        const std::string_view canonical = canonicalWord(row, entry.text);
        if (!canonical.empty()) {
            entry.text = canonical;
            return true;
        }
        std::vector<std::string> known;
        std::string list;
        for (const std::string_view group : split(row.words)) {
            known.emplace_back(group.substr(0, group.find('|')));
            list += (list.empty() ? "" : ", ") + known.back();
        }
        findings_.error("scene.value", entry.where,
                        place(name) + " is " + quoted(entry.text) + "; it must be one of " + list +
                            suggestion(entry.text, known, findings_));
        return false;
    }

    bool textual(const Values::Entry& entry, std::string_view name) {
        constexpr std::size_t kLongest = 1024;
        if (entry.text.size() <= kLongest) return true;
        findings_.error("limit.text", entry.where, place(name) + " is longer than 1024 bytes");
        return false;
    }

    bool number(const AttributeSpec& row, Values::Entry& entry, std::string_view name) {
        const ParsedNumber parsed = parseNumber(entry.text);
        if (!parsed.problem.empty()) {
            // The next attribute's "=" inside the value: a quote was forgotten before it.
            const bool swallowed = entry.text.find('=') != std::string::npos;
            findings_.error("scene.number", entry.where,
                            place(name) + ": " + quoted(entry.text) + " " + parsed.problem +
                                (swallowed ? "; is its closing quote missing?" : ""));
            return false;
        }
        entry.number = parsed.value;
        if (row.kind == Kind::integer && parsed.value != std::floor(parsed.value)) {
            findings_.error("scene.number", entry.where,
                            place(name) + ": " + quoted(entry.text) + " is not a whole number");
            return false;
        }
        if (parsed.value >= row.min && parsed.value <= row.max) return true;
        const std::string message =
            place(name) + " is " + quoted(entry.text) + "; it must be " + rangeText(row);
        if (row.clamped) {
            entry.number = std::fmin(std::fmax(parsed.value, row.min), row.max);
            findings_.warn("scene.clamped", entry.where, message);
            return true;
        }
        findings_.error("scene.range", entry.where, message);
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
    for (const pugi::xml_attribute attribute : element.attributes())
        reader.read(attribute, unknown, values);
    return values;
}

}  // namespace farol::scene
