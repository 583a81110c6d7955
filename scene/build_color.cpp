#include <array>
#include <cmath>

#include "scene/scene_builder.h"
#include "scene/text.h"
#include "scene/words.h"

namespace farol::scene {
namespace {

/// Its rgb is what it starts with.
const Color kTurningHue{glm::vec3(1.0F, 0.0F, 0.0F), true};

struct BasicColor {
    std::string_view name;
    glm::vec3 rgb;
};
constexpr BasicColor kBasicColors[] = {
    {"black", {0, 0, 0}},         {"white", {1, 1, 1}},     {"red", {1, 0, 0}},
    {"green", {0, 1, 0}},         {"blue", {0, 0, 1}},      {"yellow", {1, 1, 0}},
    {"cyan", {0, 1, 1}},          {"magenta", {1, 0, 1}},   {"gray", {0.5F, 0.5F, 0.5F}},
    {"grey", {0.5F, 0.5F, 0.5F}}, {"orange", {1, 0.5F, 0}},
};

std::optional<glm::vec3> hexColor(std::string_view digits) {
    if (digits.size() != 3 && digits.size() != 6) return std::nullopt;
    std::array<int, 6> nibbles{};
    for (std::size_t i = 0; i < digits.size(); ++i) {
        const char c = lowerCase(digits[i]);
        if (c >= '0' && c <= '9')
            nibbles[i] = c - '0';
        else if (c >= 'a' && c <= 'f')
            nibbles[i] = c - 'a' + 10;
        else
            return std::nullopt;
    }
    glm::vec3 rgb{};
    for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const int value =
            digits.size() == 3 ? 17 * nibbles[at] : 16 * nibbles[2 * at] + nibbles[2 * at + 1];
        rgb[i] = static_cast<float>(value) / 255.0F;
    }
    return rgb;
}

/// "r,g,b" or "r g b" with 0..255 each.
std::optional<glm::vec3> triple(std::string_view text) {
    std::string blanks(text);
    for (char& c : blanks)
        if (c == ',') c = ' ';
    const auto words = split(blanks);
    if (words.size() != 3) return std::nullopt;
    glm::vec3 rgb{};
    for (int i = 0; i < 3; ++i) {
        const ParsedNumber parsed = parseNumber(words[static_cast<std::size_t>(i)]);
        if (!parsed.problem.empty() || parsed.value < 0.0 || parsed.value > 255.0)
            return std::nullopt;
        rgb[i] = static_cast<float>(parsed.value / 255.0);
    }
    return rgb;
}

}  // namespace

std::optional<Color> SceneBuilder::colorText(std::string_view text) const {
    if (sameWord(text, "rgb")) return kTurningHue;
    if (const auto named = colors_.find(std::string(text)); named != colors_.end())
        return named->second;
    if (!text.empty() && text.front() == '#') {
        const auto rgb = hexColor(text.substr(1));
        return rgb ? std::optional(Color{*rgb, false}) : std::nullopt;
    }
    for (const BasicColor& one : kBasicColors)
        if (sameWord(one.name, text)) return Color{one.rgb, false};
    const auto rgb = triple(text);
    return rgb ? std::optional(Color{*rgb, false}) : std::nullopt;
}

bool SceneBuilder::namedColor(const Values& given, std::string_view attribute, Color& color) {
    if (given.text(attribute).empty()) return false;
    if (const auto found = colorText(given.text(attribute))) {
        color = *found;
        return true;
    }
    std::vector<std::string> known;
    for (const auto& [name, one] : colors_) known.push_back(name);
    for (const BasicColor& one : kBasicColors) known.emplace_back(one.name);
    const std::string near = didYouMean(given.text(attribute), known);
    findings().error("scene.unknown-color", given.where(attribute),
                     "there is no colour " + quoted(given.text(attribute)) +
                         "; define it in <colors>, or write #rrggbb" +
                         (near.empty() ? "" : "; did you mean " + quoted(near) + "?"));
    return false;
}

/// Colours as three attributes of a light or model, 0..1 by the 2017 dialect.
bool SceneBuilder::colorAttributes(const Values& given, std::string_view prefix, Color& color) {
    glm::dvec3 read(-1.0);
    Location first;
    for (int i = 0; i < 3; ++i) {
        const std::string name = std::string(prefix) + "RGB"[i];
        if (const Values::Entry* entry = given.find(name)) {
            read[i] = entry->number;
            if (first.line == 0) first = entry->where;
        }
    }
    if (first.line == 0) return false;
    double scale = 1.0;
    if (std::fmax(read.x, std::fmax(read.y, read.z)) > 1.0) {
        scale = 255.0;
        findings().warn("scene.color-scale", first,
                        "a colour attribute over 1: taken as 0 to 255 instead of 0 to 1");
    }
    for (int i = 0; i < 3; ++i)
        if (read[i] >= 0.0) color.rgb[i] = static_cast<float>(read[i] / scale);
    color.cycles = false;
    return true;
}

/// One element of <color>, 0..255 by the course dialect.
void SceneBuilder::colorPart(pugi::xml_node element, const ElementSpec& spec, Color& color) {
    const Values given = values(element, spec);
    const glm::dvec3 read = given.vector("R", "G", "B", glm::dvec3(-1.0));
    double scale = given.text("max") == "1" ? 1.0 : 255.0;
    const double largest = std::fmax(read.x, std::fmax(read.y, read.z));
    if (!given.has("max") && largest > 0.0 && largest <= 1.0) {
        bool fraction = false;
        for (int i = 0; i < 3; ++i) fraction = fraction || (read[i] > 0.0 && read[i] < 1.0);
        if (fraction) scale = 1.0;
        findings().warn("scene.color-scale", at(element),
                        "<" + shown(element.name()) + "> is nearly black as 0 to 255; " +
                            (fraction ? "it is taken as 0 to 1" : "was 0 to 1 meant?"));
    }
    for (int i = 0; i < 3; ++i)
        if (read[i] >= 0.0) color.rgb[i] = static_cast<float>(std::fmin(read[i] / scale, 1.0));
    color.cycles = false;
    if (given.flag("cycles")) color = kTurningHue;
}

Material& SceneBuilder::materialOf(Model& model) const {
    if (!model.material) model.material = defaultMaterial(scene_.dialect);
    return *model.material;
}

void SceneBuilder::colorElement(pugi::xml_node element, Model& model) {
    Material& material = materialOf(model);
    const ElementSpec& spec = elementSpec("color");
    values(element, spec);
    std::set<std::string_view> seen;
    children(element, spec, [&](std::string_view canonical, pugi::xml_node child) {
        onlyOnce(canonical, child, seen);
        const ElementSpec& part = elementSpec(canonical);
        if (canonical == "shininess")
            material.shininess =
                static_cast<float>(values(child, part).number("value", double{material.shininess}));
        else
            colorPart(child, part,
                      canonical == "diffuse"    ? material.diffuse
                      : canonical == "ambient"  ? material.ambient
                      : canonical == "specular" ? material.specular
                                                : material.emissive);
    });
}

void SceneBuilder::modelMaterial(const Values& given, Model& model) {
    Material material = model.material.value_or(defaultMaterial(scene_.dialect));
    bool any = colorAttributes(given, "diff", material.diffuse);
    any = colorAttributes(given, "ambt", material.ambient) || any;
    any = colorAttributes(given, "spec", material.specular) || any;
    any = colorAttributes(given, "emis", material.emissive) || any;
    any = namedColor(given, "diffuse", material.diffuse) || any;
    any = namedColor(given, "ambient", material.ambient) || any;
    any = namedColor(given, "specular", material.specular) || any;
    any = namedColor(given, "emission", material.emissive) || any;
    if (const auto shininess = given.number("shininess")) {
        material.shininess = static_cast<float>(*shininess);
        any = true;
    }
    if (any) model.material = material;
}

}  // namespace farol::scene
