#include "grade/rubric/severity.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "core/number.h"
#include "core/text.h"

namespace farol::grade {
namespace {

const std::vector<Kind>& table() {
    using T = Topic;
    static const std::vector<Kind> kTable{
        {"model.missing", T::models, 0, 0, "an object is missing: it earns nothing"},
        {"group.missing", T::models, 0, 0, "a group is missing with its objects"},
        {"model.extra", T::models, 3, 14, "an object is not in the reference"},
        {"group.extra", T::models, 3, 14, "a group is not in the reference"},
        {"model.doubled", T::models, 1, 6, "an object is duplicated at one place"},
        {"model.shape", T::models, 5, 24, "another shape or surface"},
        {"model.arguments", T::models, 4, 20, "another length or angle of a shape"},
        {"model.swapped-arguments", T::models, 2, 12, "two numbers of a shape exchanged"},
        {"model.divisions", T::models, 0, 5, "has different divisions"},
        {"model.file-missing", T::models, 5, 20, "a mesh that was not handed in"},
        {"model.winding", T::models, 8, 32, "triangles clockwise: drawn with culling"},
        {"model.inside-out", T::models, 8, 32, "normals and triangles face inward"},
        {"model.normals-inward", T::models, 4, 18, "normals point inward"},
        {"model.normal-matrix", T::models, 3, 12, "normals scaled like positions"},
        {"model.flat-normals", T::models, 3, 12, "normals of the faces"},
        {"model.normals", T::models, 4, 16, "other normals"},
        {"model.culling", T::models, 3, 12, "one side drawn instead of two, or two for one"},
        {"transform.angle-sign", T::transforms, 5, 26, "sign of an angle"},
        {"transform.sign", T::transforms, 5, 26, "sign of a coordinate or factor"},
        {"transform.radians", T::transforms, 6, 28, "radians where degrees are meant"},
        {"transform.axis", T::transforms, 5, 26, "another axis"},
        {"transform.coordinates", T::transforms, 5, 26, "coordinates exchanged"},
        {"transform.magnitude", T::transforms, 5, 26, "ten or a hundred times too large or small"},
        {"transform.inverse", T::transforms, 5, 26, "the inverse of a scale"},
        {"transform.value", T::transforms, 4, 24, "another number"},
        {"transform.kind", T::transforms, 5, 28, "another kind of transform"},
        {"transform.order", T::transforms, 6, 30, "transforms in the wrong order"},
        {"transform.missing", T::transforms, 5, 28, "a transform is missing"},
        {"transform.extra", T::transforms, 5, 28, "a transform is not in the reference"},
        {"group.parent", T::transforms, 6, 30, "a group is in the wrong group"},
        {"transform.other", T::transforms, 8, 32, "transforms that place it elsewhere"},
        {"whole.moved", T::transforms, 4, 16, "the whole scene is moved"},
        {"whole.turned", T::transforms, 4, 16, "the whole scene is turned"},
        {"whole.scaled", T::transforms, 4, 18,
         "the whole scene has a different size, or is mirrored"},
        {"texture.missing", T::textures, 4, 20, "no texture"},
        {"texture.file-missing", T::textures, 4, 20, "a texture's file was not handed in"},
        {"texture.wrong", T::textures, 4, 18, "another picture"},
        {"texture.extra", T::textures, 3, 14, "a texture where none is meant"},
        {"texture.upside-down", T::textures, 4, 18, "V runs the other way"},
        {"texture.mirrored", T::textures, 3, 16, "U runs the other way"},
        {"texture.turned", T::textures, 3, 16, "turned by half"},
        {"texture.swapped-uv", T::textures, 4, 16, "U and V exchanged"},
        {"texture.coordinates", T::textures, 4, 16, "other texture coordinates"},
        {"texture.filter", T::textures, 1, 6, "a different filter, or no mipmaps"},
        {"texture.mapping", T::textures, 3, 14, "a different texture mapping"},
        {"background.skybox", T::textures, 3, 14, "another skybox, or none"},
        {"background.other", T::textures, 2, 10, "another background"},
        {"material.scale", T::materials, 5, 22, "colours 0..1 where 0..255 are meant"},
        {"material.missing", T::materials, 3, 16, "a colour of the material is left out"},
        {"material.color", T::materials, 3, 16, "a different colour"},
        {"material.shininess", T::materials, 2, 10, "another shininess"},
        {"shading.flat", T::materials, 3, 12, "flat shading for smooth"},
        {"shading.mode", T::materials, 3, 12, "another shading"},
        {"light.missing", T::lights, 5, 20, "a light is missing"},
        {"light.extra", T::lights, 3, 14, "a light is not in the reference"},
        {"light.type", T::lights, 5, 20, "another type of light"},
        {"light.group", T::lights, 5, 18, "a light is outside of its group"},
        {"light.space", T::lights, 4, 14, "a light moves with another space"},
        {"light.position", T::lights, 4, 18, "a light is elsewhere"},
        {"light.direction-negated", T::lights, 6, 20, "a light shines the opposite way"},
        {"light.direction", T::lights, 4, 18, "a different direction"},
        {"light.cutoff", T::lights, 3, 12, "another cutoff"},
        {"light.cutoff-radians", T::lights, 3, 14, "the cutoff in radians"},
        {"light.exponent", T::lights, 2, 8, "another exponent"},
        {"light.attenuation", T::lights, 3, 12, "a different attenuation"},
        {"light.color", T::lights, 3, 14, "a different colour of a light"},
        {"camera.missing", T::camera, 8, 12, "no camera"},
        {"camera.position", T::camera, 4, 12, "the camera is elsewhere"},
        {"camera.target", T::camera, 4, 12, "the camera looks elsewhere"},
        {"camera.up", T::camera, 4, 12, "another up"},
        {"camera.fov", T::camera, 3, 12, "another field of view"},
        {"camera.fov-radians", T::camera, 4, 12, "the field of view in radians"},
        {"camera.range", T::camera, 1, 8, "other distances near and far"},
        {"animation.time", T::animation, 4, 12, "too fast or too slow"},
        {"animation.direction", T::animation, 4, 14, "the other way round"},
        {"animation.axis", T::animation, 4, 14, "about another axis"},
        {"animation.align", T::animation, 3, 12, "turned with its curve, or not"},
        {"animation.points", T::animation, 4, 16, "other points of a curve"},
        {"animation.missing", T::animation, 5, 18, "it does not move"},
        {"animation.extra", T::animation, 4, 16, "it moves, and should not"},
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

std::string kindsMarkdown() {
    std::string out = "| code | criterion | least to most | is |\n| --- | --- | --- | --- |\n";
    for (const Kind& one : table())
        out += "| `" + std::string(one.code) + "` | " + std::string(kTopicWords[one.topic]) +
               " | " +
               (one.most > 0.0 ? formatNumber(one.least) + " to " + formatNumber(one.most)
                               : std::string("its weight")) +
               " | " + std::string(one.about) + " |\n";
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
