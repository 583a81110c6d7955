#include "grade/rubric/severity.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "core/number.h"
#include "core/text.h"
#include "grade/rubric/kind_messages.h"

namespace farol::grade {
namespace {

const std::vector<Kind>& table() {
    using T = Topic;
    static const std::vector<Kind> kTable{
        {"model.missing", T::models, 0, 0},
        {"group.missing", T::models, 0, 0},
        {"model.extra", T::models, 3, 14},
        {"group.extra", T::models, 3, 14},
        {"model.doubled", T::models, 1, 6},
        {"model.shape", T::models, 5, 24},
        {"model.arguments", T::models, 4, 20},
        {"model.swapped-arguments", T::models, 2, 12},
        {"model.divisions", T::models, 0, 5},
        {"model.file-missing", T::models, 5, 20},
        {"model.winding", T::models, 8, 32},
        {"model.inside-out", T::models, 8, 32},
        {"model.normals-inward", T::models, 4, 18},
        {"model.normal-matrix", T::models, 3, 12},
        {"model.flat-normals", T::models, 3, 12},
        {"model.normals", T::models, 4, 16},
        {"model.culling", T::models, 3, 12},
        {"transform.angle-sign", T::transforms, 5, 26},
        {"transform.sign", T::transforms, 5, 26},
        {"transform.radians", T::transforms, 6, 28},
        {"transform.axis", T::transforms, 5, 26},
        {"transform.coordinates", T::transforms, 5, 26},
        {"transform.magnitude", T::transforms, 5, 26},
        {"transform.inverse", T::transforms, 5, 26},
        {"transform.value", T::transforms, 4, 24},
        {"transform.kind", T::transforms, 5, 28},
        {"transform.order", T::transforms, 6, 30},
        {"transform.missing", T::transforms, 5, 28},
        {"transform.extra", T::transforms, 5, 28},
        {"group.parent", T::transforms, 6, 30},
        {"transform.other", T::transforms, 8, 32},
        {"whole.moved", T::transforms, 4, 16},
        {"whole.turned", T::transforms, 4, 16},
        {"whole.scaled", T::transforms, 4, 18},
        {"texture.missing", T::textures, 4, 20},
        {"texture.file-missing", T::textures, 4, 20},
        {"texture.wrong", T::textures, 4, 18},
        {"texture.extra", T::textures, 3, 14},
        {"texture.upside-down", T::textures, 4, 18},
        {"texture.mirrored", T::textures, 3, 16},
        {"texture.turned", T::textures, 3, 16},
        {"texture.swapped-uv", T::textures, 4, 16},
        {"texture.coordinates", T::textures, 4, 16},
        {"texture.alpha", T::textures, 3, 14},
        {"texture.filter", T::textures, 1, 6},
        {"texture.mapping", T::textures, 3, 14},
        {"background.skybox", T::textures, 3, 14},
        {"background.other", T::textures, 2, 10},
        {"material.scale", T::materials, 5, 22},
        {"material.missing", T::materials, 3, 16},
        {"material.color", T::materials, 3, 16},
        {"material.shininess", T::materials, 2, 10},
        {"material.opacity", T::materials, 3, 16},
        {"transparency.mode", T::materials, 3, 12},
        {"shading.flat", T::materials, 3, 12},
        {"shading.mode", T::materials, 3, 12},
        {"light.missing", T::lights, 5, 20},
        {"light.extra", T::lights, 3, 14},
        {"light.type", T::lights, 5, 20},
        {"light.group", T::lights, 5, 18},
        {"light.space", T::lights, 4, 14},
        {"light.position", T::lights, 4, 18},
        {"light.direction-negated", T::lights, 6, 20},
        {"light.direction", T::lights, 4, 18},
        {"light.cutoff", T::lights, 3, 12},
        {"light.cutoff-radians", T::lights, 3, 14},
        {"light.exponent", T::lights, 2, 8},
        {"light.attenuation", T::lights, 3, 12},
        {"light.color", T::lights, 3, 14},
        {"camera.missing", T::camera, 8, 12},
        {"camera.position", T::camera, 4, 12},
        {"camera.target", T::camera, 4, 12},
        {"camera.up", T::camera, 4, 12},
        {"camera.fov", T::camera, 3, 12},
        {"camera.fov-radians", T::camera, 4, 12},
        {"camera.range", T::camera, 1, 8},
        {"animation.time", T::animation, 4, 12},
        {"animation.direction", T::animation, 4, 14},
        {"animation.axis", T::animation, 4, 14},
        {"animation.align", T::animation, 3, 12},
        {"animation.points", T::animation, 4, 16},
        {"animation.missing", T::animation, 5, 18},
        {"animation.extra", T::animation, 4, 16},
    };
    return kTable;
}

}  // namespace

std::span<const Kind> kinds() { return table(); }

const Kind& kindOf(const std::string& code) {
    static const std::map<std::string_view, const Kind*> kByCode = [] {
        std::map<std::string_view, const Kind*> out;
        for (const Kind& one : table()) out.emplace(one.code, &one);
        return out;
    }();
    const auto found = kByCode.find(code);
    if (found == kByCode.end()) throw std::logic_error("no kind of mistake is called " + code);
    return *found->second;
}

std::string aboutKind(const std::string& code, Language language) {
    std::string id = "part.kind/" + code;
    std::replace(id.begin() + static_cast<std::ptrdiff_t>(id.find('/')), id.end(), '.', '-');
    for (const MessageRow& row : kKindMessages)
        if (row.id == id) return textIn(language, Message{id, std::string(row.text), {}});
    return code;
}

std::string kindsMarkdown() {
    std::string out = "| code | criterion | least to most | is |\n| --- | --- | --- | --- |\n";
    for (const Kind& one : table())
        out += "| `" + std::string(one.code) + "` | " + std::string(kTopicWords[one.topic]) +
               " | " +
               (one.most > 0.0 ? formatNumber(one.least) + " to " + formatNumber(one.most)
                               : std::string("its weight")) +
               " | " + aboutKind(std::string(one.code)) + " |\n";
    return out;
}

double costOf(const Kind& kind, double spoiled, std::size_t places) {
    constexpr double kSeveral = 1.5;
    const double single =
        kind.least + (kind.most - kind.least) *
                         std::sqrt(std::clamp(spoiled / static_cast<double>(places), 0.0, 1.0));
    // The cost of one place with the same effect is the lower bound.
    const double whole =
        kind.least + (kind.most - kind.least) * std::sqrt(std::clamp(spoiled, 0.0, 1.0));
    return places > 1 ? std::max(whole, kSeveral * single) : single;
}

}  // namespace farol::grade
