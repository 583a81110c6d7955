#include <array>
#include <cmath>
#include <span>

#include "core/did_you_mean.h"
#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/scene_builder.h"

namespace farol::scene {
namespace {

/// A colour that cycles through the hues; rgb is its start.
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

/// Reads other forms of a colour: "ff8800", "0xff8800", "#ff8800ff", "rgb(255, 136, 0)",
/// "rgba(255, 136, 0, 0.5)". Sets `reading` to the colour's standard form, and `opacity` where the
/// text has one.
std::optional<Color> SceneBuilder::looseColor(std::string_view text, std::string& reading,
                                              float& opacity) const {
    constexpr std::size_t kDigits = 6, kWithAlpha = 8;
    std::string_view digits = text;
    for (const std::string_view prefix : {"#", "0x", "0X"})
        if (digits.starts_with(prefix)) digits.remove_prefix(prefix.size());
    if (digits.size() == kDigits || digits.size() == kWithAlpha)
        if (const auto rgb = hexColor(digits.substr(0, kDigits))) {
            reading = "#" + std::string(digits.substr(0, kDigits));
            // The two digits of the alpha as a grey.
            const std::string_view alpha = digits.substr(kDigits);
            if (const auto grey =
                    hexColor(std::string(alpha) + std::string(alpha) + std::string(alpha)))
                opacity = grey->r;
            return Color{*rgb, false};
        }
    const std::size_t open = text.find('(');
    if (open != std::string_view::npos && text.back() == ')' &&
        (sameWord(text.substr(0, open), "rgb") || sameWord(text.substr(0, open), "rgba"))) {
        const std::string_view inside = text.substr(open + 1, text.size() - open - 2);
        const auto words = split(inside, ", \t");
        if (words.size() == 3 || words.size() == 4)
            if (const auto rgb = triple(joined(std::span(words).first(3), ","))) {
                reading = joined(std::span(words).first(3), ",");
                const ParsedNumber alpha = parseNumber(words.size() == 4 ? words[3] : "1");
                if (alpha.problem.empty() && alpha.value >= 0.0) opacity = opacityOf(alpha.value);
                return Color{*rgb, false};
            }
    }
    return std::nullopt;
}

/// `opacity`: null where the colour's has no meaning.
bool SceneBuilder::namedColor(const Values& given, std::string_view attribute, Color& color,
                              float* opacity) {
    if (given.text(attribute).empty()) return false;
    const std::string& text = given.text(attribute);
    if (const auto known = colorText(text)) {
        color = *known;
        if (const auto named = opacities_.find(text);
            opacity != nullptr && named != opacities_.end())
            *opacity = named->second;
        // Three numbers of which none is over 1 are nearly black as 0 to 255.
        const float largest = std::fmax(color.rgb.r, std::fmax(color.rgb.g, color.rgb.b)) * 255.0F;
        if (text.find_first_of(", ") != std::string::npos && largest > 0.0F && largest <= 1.0F) {
            color.rgb *= 255.0F;
            findings().warn(message<"scene.color-scale/text">("value"_arg = text),
                            given.where(attribute));
        }
        return true;
    }
    std::string reading;
    float alpha = 1.0F;
    if (const auto loose = looseColor(text, reading, alpha)) {
        color = *loose;
        if (opacity != nullptr) *opacity = alpha;
        findings().warn(message<"scene.value/color">("value"_arg = text, "reading"_arg = reading),
                        given.where(attribute));
        return true;
    }
    std::vector<std::string> known;
    if (!findings().crowded()) {
        for (const auto& [name, one] : colors_) known.push_back(name);
        for (const BasicColor& one : kBasicColors) known.emplace_back(one.name);
    }
    const std::string near = didYouMean(given.text(attribute), known);
    findings().error(message<"scene.unknown-color">("value"_arg = text, "suggestion"_arg = near),
                     given.where(attribute));
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
        findings().warn(message<"scene.color-scale/bytes">(), first);
    }
    for (int i = 0; i < 3; ++i)
        if (read[i] >= 0.0) color.rgb[i] = static_cast<float>(read[i] / scale);
    color.cycles = false;
    return true;
}

/// One element of <color>, 0..255 by the course dialect. `opacity`: of <diffuse>, else null.
void SceneBuilder::colorPart(pugi::xml_node element, const ElementSpec& spec, Color& color,
                             float* opacity) {
    const Values given = values(element, spec);
    if (const auto alpha = given.number("A"); alpha && opacity != nullptr)
        *opacity = opacityOf(*alpha);
    const glm::dvec3 read = given.vector("R", "G", "B", glm::dvec3(-1.0));
    double scale = given.text("max") == "1" ? 1.0 : 255.0;
    const double largest = std::fmax(read.x, std::fmax(read.y, read.z));
    if (!given.has("max") && largest > 0.0 && largest <= 1.0) {
        bool fraction = false;
        for (int i = 0; i < 3; ++i) fraction = fraction || (read[i] > 0.0 && read[i] < 1.0);
        if (fraction) scale = 1.0;
        findings().warn(fraction
                            ? message<"scene.color-scale">("element"_arg = element.name())
                            : message<"scene.color-scale/doubt">("element"_arg = element.name()),
                        at(element));
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

/// Reads R, G and B of a <color> itself: 0 to 255, or 0 to 1 where none is over 1. False where
/// none is given.
bool SceneBuilder::straightColor(const Values& given, Color& color) {
    if (!given.hasAny("R G B")) return false;
    const glm::dvec3 read = given.vector("R", "G", "B", glm::dvec3(0.0));
    const bool bytes = std::fmax(read.x, std::fmax(read.y, read.z)) > 1.0;
    color = Color{glm::vec3(read / (bytes ? 255.0 : 1.0)), false};
    return true;
}

/// Reads the <color> of a group or a <transform>: of all models in it without colours of theirs.
void SceneBuilder::groupColor(pugi::xml_node element) {
    const ElementSpec& spec = elementSpec("color");
    const Values given = values(element, spec);
    GroupColor group =
        session_.groupColor.value_or(GroupColor{defaultMaterial(scene_.dialect).diffuse});
    if (const auto alpha = given.number("A")) group.opacity = opacityOf(*alpha);
    bool isGiven = straightColor(given, group.color) || given.has("A");
    children(element, spec, [&](std::string_view canonical, pugi::xml_node child) {
        if (canonical == "diffuse") {
            colorPart(child, elementSpec(canonical), group.color, &group.opacity);
            isGiven = true;
        }
    });
    if (isGiven)
        session_.groupColor = group;
    else
        findings().warn(
            message<"scene.missing-attribute/group-color">("element"_arg = element.name()),
            at(element));
}

void SceneBuilder::colorElement(pugi::xml_node element, Model& model) {
    Material& material = materialOf(model);
    const ElementSpec& spec = elementSpec("color");
    const Values given = values(element, spec);
    if (straightColor(given, material.diffuse))
        findings().warn(message<"scene.misplaced/color">("element"_arg = element.name()),
                        at(element));
    if (const auto alpha = given.number("A")) material.opacity = opacityOf(*alpha);
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
                                                : material.emissive,
                      canonical == "diffuse" ? &material.opacity : nullptr);
    });
}

void SceneBuilder::modelMaterial(const Values& given, Model& model) {
    Material material = model.material.value_or(defaultMaterial(scene_.dialect));
    bool any = colorAttributes(given, "diff", material.diffuse);
    any = colorAttributes(given, "ambt", material.ambient) || any;
    any = colorAttributes(given, "spec", material.specular) || any;
    any = colorAttributes(given, "emis", material.emissive) || any;
    any = namedColor(given, "diffuse", material.diffuse, &material.opacity) || any;
    any = namedColor(given, "ambient", material.ambient) || any;
    any = namedColor(given, "specular", material.specular) || any;
    any = namedColor(given, "emission", material.emissive) || any;
    if (const auto shininess = given.number("shininess")) {
        material.shininess = static_cast<float>(*shininess);
        any = true;
    }
    if (any) model.material = material;
    if (material.opacity == 0.0F || model.opacity == 0.0F)
        findings().warn(message<"scene.value/opacity">(), model.where);
    session_.hasOwnColors = session_.hasOwnColors || model.material || model.texture;
    if (model.material || !session_.groupColor) return;
    model.material = material;
    model.material->diffuse = session_.groupColor->color;
    model.material->opacity = session_.groupColor->opacity;
    session_.usesGroupColor = true;
}

}  // namespace farol::scene
